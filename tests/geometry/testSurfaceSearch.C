// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceSearch.H"
#include "testShapes.H"
#include "windingNumber.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::testShapes;

namespace
{

// Signed distance to the box [-1, 1]^3
scalar boxDistance(const vector& p)
{
    const vector q = p.cwiseAbs() - vector::Ones();
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

}  // namespace

TEST_CASE("signed distance to a box is exact at facets, edges and corners")
{
    const surfaceSearch search(box({-1, -1, -1}, {1, 1, 1}));
    std::mt19937 g(1);
    int seen[3] = {};
    for (int k = 0; k < 20000; ++k)
    {
        const vector p = randomPoint(g, 2);
        const surfacePoint q = search.nearest(p);
        REQUIRE(std::abs(q.signedDistance(p) - boxDistance(p)) < 1e-13);
        ++seen[int(q.feature)];
    }
    for (const int n : seen) CHECK(n > 1000);
}

TEST_CASE("distance to a sphere within the sag of its facets")
{
    const vector centre(0.3, -0.2, 0.1);
    const surfaceSearch search(sphere(centre, 1, 5));
    const scalar sag = 1.5e-3;
    std::mt19937 g(2);
    for (int k = 0; k < 5000; ++k)
    {
        const vector p = randomPoint(g, 2);
        const scalar exact = (p - centre).norm() - 1;
        const scalar d = search.signedDistance(p);
        REQUIRE(std::abs(d - exact) < sag);
        CHECK(search.within(p, std::abs(d) + 1e-9));
        CHECK_FALSE(search.within(p, std::abs(d) - 1e-9));
        const surfacePoint q = search.nearest(p, 0.2);
        CHECK(q.found == (std::abs(d) <= 0.2));
        if (q.found) CHECK(q.signedDistance(p) == d);
    }
}

TEST_CASE(
    "a segment crosses a sphere if its ends lie on different sides, whatever the triangle edges")
{
    const triSurface ball = sphere({0, 0, 0}, 1, 3);
    const surfaceSearch search(ball);
    std::mt19937 g(3);
    for (int k = 0; k < 20000; ++k)
    {
        const vector a = randomPoint(g, 0.5), b = a + 4 * randomPoint(g, 1).normalized();
        REQUIRE(search.crosses(a, b));
        const surfaceHit hit = search.firstHit(a, b);
        REQUIRE(search.within(hit.point, 1e-9));
        REQUIRE_FALSE(search.crosses(a, a + 0.999 * hit.fraction * (b - a)));
    }
    for (const vector& corner : ball.nodes)  // exactly through corners and edges
        REQUIRE(search.crosses(0.5 * corner, 1.5 * corner));
    for (label t = 0; t < ball.size(); ++t)
    {
        const vector middle = 0.5 * (ball.corner(t, 0) + ball.corner(t, 1));
        REQUIRE(search.crosses(0.5 * middle, 1.5 * middle));
    }
    CHECK_FALSE(search.crosses({2, 0, 0}, {1.001, 0, 0}));
    CHECK_FALSE(search.crosses({2, 2, -3}, {2, 2, 3}));
}

TEST_CASE("the first hit of a ray that meets several walls is the nearest")
{
    triSurface walls = box({1, -1, -1}, {2, 1, 1});
    walls.append(box({4, -1, -1}, {5, 1, 1}));
    const surfaceSearch search(walls);
    const surfaceHit there = search.firstHit({0, 0.3, 0.1}, {6, 0.3, 0.1});
    CHECK(there.point[0] == doctest::Approx(1));
    const surfaceHit back = search.firstHit({6, 0.3, 0.1}, {0, 0.3, 0.1});
    CHECK(back.point[0] == doctest::Approx(5));
    CHECK(back.fraction == doctest::Approx(1.0 / 6));
}

TEST_CASE("winding number inside and outside, also with one triangle in a hundred missing")
{
    const triSurface whole = sphere({0, 0, 0}, 1, 4);
    const windingNumber closed(whole);
    const windingNumber torn(whole.subset([](label t) { return t % 100 != 7; }));
    std::mt19937 g(4);
    int wrong = 0, asked = 0;
    for (int k = 0; k < 5000; ++k)
    {
        const vector p = randomPoint(g, 1.5);
        if (std::abs(p.norm() - 1) < 0.02) continue;
        const scalar exact = p.norm() < 1 ? 1 : 0;
        REQUIRE(std::abs(closed.value(p) - exact) < 0.05);
        ++asked;
        wrong += torn.inside(p) != (exact > 0.5);
    }
    CHECK(asked > 4000);
    CHECK(wrong <= asked / 1000);
}

TEST_CASE("the winding number of a box is exact near by, where no dipole is used")
{
    const windingNumber w(box({-1, -1, -1}, {1, 1, 1}));
    CHECK(w.value({0.3, 0.2, 0.9}) == doctest::Approx(1).epsilon(1e-13));
    CHECK(std::abs(w.value({0.3, 0.2, 1.1})) < 1e-13);
}
