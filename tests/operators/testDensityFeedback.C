// SPDX-License-Identifier: GPL-3.0-or-later
#include "densityFeedback.H"
#include "../periodicBox.H"
#include "../relative.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

const auto none = [](label) { return false; };

// Source of the particles in lattice spacings per time, where the fastest moves by one; at the start they were
// `start` as dense as the lattice
List<scalar> sourceOf(periodicBox& box, const word& solution, bool drained,
                      const List<scalar>& given, const std::function<bool(label)>& isCut = none,
                      scalar start = 1)
{
    box.cloud.Up[3].setXyz({0, box.cloud.dx, 0});
    box.cloud.history[startDensity] = {start};
    densityFeedback feedback(dictionary::fromString(solution), *box.kernel, box.cloud);
    List<scalar> q = given;
    feedback.addTo(q, box.list, List<char>(box.cloud.n(), drained), isCut);
    return q;
}

List<scalar> sourceOf(periodicBox& box, const word& solution = "", bool drained = true)
{
    return sourceOf(box, solution, drained, List<scalar>(box.cloud.n(), 0));
}

}  // namespace

TEST_CASE("density feedback: none on a lattice, and what lies off it is not taken for dense")
{
    for (const char* kernel : {"WendlandC2", "WendlandC4", "quintic", "cubic"})
        for (const int nDims : {2, 3})
        {
            CAPTURE(kernel);
            CAPTURE(nDims);
            const scalar hByDx = kernel[0] == 'W' ? (kernel[8] == '4' ? 1.6 : 1.3) : 1;
            periodicBox lattice(nDims, nDims == 2 ? 40 : 14, 0, kernel, hByDx);
            CHECK(std::abs(sourceOf(lattice)[5]) < 1e-12);
            // displacements by up to dx/10 look like 0.23 to 0.85 % of fluid too much
            periodicBox box(nDims, nDims == 2 ? 40 : 14, 0.1, kernel, hByDx);
            CHECK(std::abs(sourceOf(box)[5]) < 0.0015);
        }
}

TEST_CASE(
    "density feedback: a sink for thin fluid, evenly; none if closed, with a source, or at rest")
{
    periodicBox box(2, 30, 0.05, "WendlandC2", 1.3);
    List<char> gone(box.cloud.n(), 0);
    for (label i = 0; i < box.cloud.n(); i += 90) gone[i] = 1;  // ten of 900
    box.cloud.remove(gone);
    box.update();
    const List<scalar> q = sourceOf(box);
    CHECK(q[5] < -0.005);
    CHECK(q[5] > -0.02);
    CHECK(*std::min_element(q.begin(), q.end()) == *std::max_element(q.begin(), q.end()));
    CHECK(sourceOf(box, "densityFeedback 0.5;")[5] == relative(0.5 * q[5], 1e-12));
    CHECK(sourceOf(box, "densityFeedback 0;")[5] == 0);
    CHECK(sourceOf(box, "", false)[5] == 0);
    CHECK(sourceOf(box, "", true, List<scalar>(box.cloud.n(), 0.3))[5] == 0.3);
    box.cloud.pFixed[7] = 1;
    CHECK(sourceOf(box)[7] == 0);
    densityFeedback feedback(dictionary::fromString(""), *box.kernel, box.cloud);
    for (vec4& up : box.cloud.Up) up = vec4{};
    List<scalar> atRest(box.cloud.n(), 0);
    feedback.addTo(atRest, box.list, List<char>(box.cloud.n(), 1), none);
    CHECK(atRest[5] == 0);
}

TEST_CASE("density feedback: what it moves a long zone by is not more than a short one")
{
    scalar pushed[2];
    for (const int n : {30, 90})
    {
        periodicBox box(2, n, 0.05, "WendlandC2", 1.3);
        List<char> gone(box.cloud.n(), 0);
        for (label i = 0; i < box.cloud.n(); i += 19) gone[i] = 1;
        box.cloud.remove(gone);
        box.update();
        pushed[n > 30] = sourceOf(box)[5] * n;
    }
    CHECK(pushed[1] == relative(pushed[0], 0.05));
}

TEST_CASE("density feedback: sums that a face cuts off tell nothing, but what they lack they get")
{
    periodicBox box(2, 30, 0.05, "WendlandC2", 1.3);
    const auto isCut = [&](label i) { return box.cloud.x[i][0] > 0.5; };
    List<char> gone(box.cloud.n(), 0);
    for (label i = 0; i < box.cloud.n(); i += 9)
        gone[i] = box.cloud.x[i][0] > 0.6 && box.cloud.x[i][0] < 0.9;
    box.cloud.remove(gone);
    box.update();
    const List<scalar> given(box.cloud.n(), 0);
    CHECK(sourceOf(box, "", true, given)[5] < -0.02);
    const List<scalar> q = sourceOf(box, "", true, given, isCut);
    CHECK(std::abs(q[5]) < 0.002);
    CHECK(*std::min_element(q.begin(), q.end()) == *std::max_element(q.begin(), q.end()));
}

TEST_CASE(
    "density feedback: half way between the lattice and what it began with, also over a restart")
{
    periodicBox box(2, 30, 0.05, "WendlandC2", 1.3);
    const List<char> all(box.cloud.n(), 1);
    densityFeedback first(dictionary::fromString(""), *box.kernel, box.cloud);
    List<scalar> q(box.cloud.n(), 0);
    first.addTo(q, box.list, all, none);  // at rest
    first.book(box.cloud, 0.1);
    const scalar start = box.cloud.history.at(startDensity)[0];
    CHECK(start == relative(1, 0.002));
    box.cloud.Up[3].setXyz({0, box.cloud.dx, 0});
    first.addTo(q, box.list, all, none);
    CHECK(q[5] == relative(0.5 * (start - 1), 1e-9));

    List<char> gone(box.cloud.n(), 0);
    for (label i = 0; i < box.cloud.n(); i += 90) gone[i] = 1;  // ten of 900
    box.cloud.remove(gone);
    box.update();
    densityFeedback again(dictionary::fromString(""), *box.kernel, box.cloud);
    q.assign(box.cloud.n(), 0);
    again.addTo(q, box.list, List<char>(box.cloud.n(), 1), none);
    CHECK(q[5] < -0.005);
    CHECK(q == sourceOf(box, "", true, List<scalar>(box.cloud.n(), 0), none, start));
    CHECK(q[5] == relative(sourceOf(box)[5] + 0.5 * (1 - start), 1e-9));
}

TEST_CASE("density feedback books what it has put in")
{
    periodicBox box(2, 20, 0.05, "WendlandC2", 1.3);
    box.cloud.Up[3].setXyz({0, 1, 0});
    box.cloud.history[startDensity] = {1};
    densityFeedback feedback(dictionary::fromString(""), *box.kernel, box.cloud);
    List<scalar> q(box.cloud.n(), 0);
    feedback.addTo(q, box.list, List<char>(box.cloud.n(), 1), none);
    feedback.book(box.cloud, 0.25), feedback.book(box.cloud, 0.5);
    CHECK(box.cloud.history.at(fluidFeedback)[0] ==
          relative(0.75 * q[5], 1e-9));  // of a unit square
}
