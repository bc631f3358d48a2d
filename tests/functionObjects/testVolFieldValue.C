// SPDX-License-Identifier: GPL-3.0-or-later
// Sums, means and integrals of a field that is linear in x have exact values over a block
#include "core/errorOf.H"
#include "testCase.H"

#include <doctest/doctest.h>

using namespace ispf;

TEST_CASE("mean, integral and sum of a linear field over a zone and over all")
{
    testCase box;
    box.addBlock("water", {0, 0, 0}, {6, 4, 3});
    for (size_t i = 0; i < box.particles.x.size(); ++i)
        box.particles.scalars["p"][i] = 5e3 * box.particles.x[i][0],
        box.particles.vectors["U"][i] =
            vector(1, -2, 3) + 100 * box.particles.x[i][1] * vector::UnitX();
    box.addBlock("oil", box.dx * vector(6, 0, 0), {2, 4, 3});  // at rest, without pressure
    box.functions =
        "mean { type volFieldValue; operation volAverage; zones (water); writePrecision 12; }"
        "integral { type volFieldValue; operation volIntegrate; fields (p); writePrecision 12; }"
        "sum { type volFieldValue; operation sum; fields (U); writePrecision 12; }";
    const auto running = box.start();
    functionObjectList list(*running.c);
    list.start();
    const List<scalar> mean = box.rows("mean/0/volFieldValue.dat").at(0),
                       integral = box.rows("integral/0/volFieldValue.dat").at(0),
                       sum = box.rows("sum/0/volFieldValue.dat").at(0);
    REQUIRE(mean.size() == 5);
    CHECK(mean[1] == doctest::Approx(1 + 100 * 2 * box.dx).epsilon(1e-10));
    CHECK(mean[2] == doctest::Approx(-2).epsilon(1e-10));
    CHECK(mean[3] == doctest::Approx(3).epsilon(1e-10));
    CHECK(mean[4] == doctest::Approx(5e3 * 3 * box.dx).epsilon(1e-10));
    CHECK(integral[1] ==
          doctest::Approx(5e3 * 3 * box.dx * 72 * std::pow(box.dx, 3)).epsilon(1e-10));
    CHECK(sum[2] == doctest::Approx(-2 * 72).epsilon(1e-10));
}

TEST_CASE("an operation that there is not is refused with those that there are")
{
    testCase box;
    box.addBlock("water", {0, 0, 0}, {4, 4, 4});
    box.functions = "mean { type volFieldValue; operation average; }";
    CHECK_ERROR(
        [&] {
            const auto running = box.start();
            functionObjectList list(*running.c);
        }(),
        "volAverage", 0);
}
