// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleShifting.H"
#include "periodicBox.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// Where shifting takes the particles of a disordered box, seen by an observer who moves at -drift
List<vec4> shifted(const word& entries, const word& frame, const vector& drift)
{
    periodicBox box(2, 12, 0.2, "WendlandC2", 1.3);
    for (label i = 0; i < box.cloud.n(); ++i)
    {
        const vector x = 2 * M_PI * box.cloud.x[i].xyz();
        box.cloud.Up[i] = vec4::from(vector(std::sin(x[1]), std::sin(x[0]), 0) + drift);
    }
    box.update();
    const particleShifting shifting(dictionary::fromString(entries), frame);
    shifting.shift(box.cloud, box.list, box.B, 0.01, nullptr);
    return {box.cloud.x.begin(), box.cloud.x.begin() + box.cloud.n()};
}

scalar difference(const List<vec4>& a, const List<vec4>& b)
{
    scalar most = 0;
    for (size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i].xyz() - b[i].xyz()).norm());
    return most;
}

}  // namespace

TEST_CASE("by the speed against the mean, shifting is the same for every observer")
{
    const vector drift(3, -1, 0);
    const word given = "maxShift 0.2;";
    const List<vec4> still = shifted(given, "mean", vector::Zero());
    CHECK(difference(still, shifted(given, "mean", drift)) < 1e-14);
    CHECK(difference(still, shifted(given + "frame mean;", "still", drift)) < 1e-14);
    const List<vec4> byAll = shifted(given, "still", vector::Zero());
    CHECK(difference(still, byAll) < 3e-4);  // the flow's own mean is nearly zero
    CHECK(difference(byAll, shifted(given, "still", drift)) > 1e-3);
    CHECK(difference(shifted(given + "frame still;", "mean", drift),
                     shifted(given, "still", drift)) == 0);
}
