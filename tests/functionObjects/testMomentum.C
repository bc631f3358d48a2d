// SPDX-License-Identifier: GPL-3.0-or-later
#include "relative.H"
#include "testCase.H"

#include <doctest/doctest.h>

using namespace ispf;

TEST_CASE("momentum of a turning block that moves: linear, angular, centre")
{
    testCase box;
    box.addBlock("water", {0, 0, 0}, {6, 4, 3});
    const vector centre = box.dx * vector(3, 2, 1.5), drift(2, -1, 0.5), omega(3, 5, -7);
    for (size_t i = 0; i < box.particles.x.size(); ++i)
        box.particles.vectors["U"][i] = drift + omega.cross(box.particles.x[i] - centre);
    box.addBlock("oil", box.dx * vector(6, 0, 0), {2, 4, 3});  // at rest
    box.functions =
        "motion { type momentum; zones (water); writePrecision 12; }"
        "all { type momentum; writePrecision 12; }";
    const auto running = box.start();
    functionObjectList list(*running.c);
    list.start();
    const List<scalar> row = box.rows("motion/0/momentum.dat").at(0);
    REQUIRE(row.size() == 10);
    const scalar mass = 72 * 1000 * std::pow(box.dx, 3);
    // sum of m (r^2 omega - r (r.omega)) over an evenly filled lattice: (n^2 - 1) dx^2/12 per axis
    const vector squares = box.dx * box.dx / 12 * vector(35, 15, 8);
    const vector spin =
        mass * vector(squares[1] + squares[2], squares[2] + squares[0], squares[0] + squares[1])
                   .cwiseProduct(omega);
    const vector angular = mass * centre.cross(drift) + spin;
    for (int d = 0; d < 3; ++d)
    {
        CHECK(row[1 + d] == doctest::Approx(mass * drift[d]).epsilon(1e-10));
        CHECK(row[4 + d] == doctest::Approx(angular[d]).epsilon(1e-9));
        CHECK(row[7 + d] == doctest::Approx(centre[d]).epsilon(1e-10));
    }
    const List<scalar> both = box.rows("all/0/momentum.dat").at(0);
    CHECK(both[1] == doctest::Approx(mass * drift[0]).epsilon(1e-10));
    CHECK(both[7] == doctest::Approx(4 * box.dx).epsilon(1e-10));  // 8 cells along x
}
