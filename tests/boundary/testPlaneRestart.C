// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace scene;

namespace
{

constexpr scalar dx = 0.67e-3;

particleCloud column(int from, int to)
{
    List<vector> points;
    for (int j = from; j < to; ++j)
        for (int i = 0; i < 3; ++i) points.emplace_back((i + 0.5) * dx, (j + 0.37) * dx, 0);
    return fluid(points, dx, 2);
}

// Rigid points beside the same particles, for a wall made when the fluid had rows [0, n)
List<scalar> heights(const word& others, int n)
{
    folder files;
    particleCloud whole = column(0, n);
    boundary walls(
        files.path,
        dictionary::fromString("plunger { type wall; surface plane; representation particles; "
                               "point (0 0 0); normal (-1 0 0); motion { direction (1 0 0); "
                               "displacement table ((0 0) (1 1e-3)); } } " +
                               others),
        whole, 2.6 * dx);
    particleCloud cloud = column(23, 30);
    walls.setStep(0, 0.1);
    walls.exchange(whole, 0.1);
    walls.updateGhosts(cloud);
    List<scalar> y;
    for (label g = cloud.n(); g < cloud.nAll(); ++g) y.push_back(cloud.x[g][1]);
    std::sort(y.begin(), y.end());
    return y;
}

}  // namespace

TEST_CASE("the points of a plane wall do not depend on where the fluid was when it was made")
{
    // a wall at rest bounds the other end
    const word bottom =
        "bottom { type wall; surface plane; representation particles; "
        "point (0 0 0); normal (0 -1 0); }";
    for (const word& others : {word(), bottom})
        for (const int n : {31, 34, 37, 45, 52, 61})
        {
            const List<scalar> first = heights(others, 40);
            CHECK(first.size() > 20);
            CHECK(heights(others, n) == first);
        }
}
