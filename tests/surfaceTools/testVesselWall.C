// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces at a distance, and walls around lumens with known volumes
#include "core/errorOf.H"
#include "geometry/testShapes.H"
#include "offsetSurface.H"
#include "relative.H"
#include "surfaceTopology.H"
#include "vesselWall.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::testShapes;

namespace
{

constexpr scalar radius = 1, length = 4;
constexpr int nAround = 64, nAlong = 32;

// A closed tube of radius 1 with the patches side, start and end.  The end's plane is z = 4 + slope x
triSurface tube(scalar slope)
{
    triSurface s;
    const label side = s.addPatch("side"), start = s.addPatch("start"), end = s.addPatch("end");
    const auto at = [&](int k, int m) {
        const scalar angle = 2 * M_PI * k / nAround, x = radius * std::cos(angle);
        return vector(x, radius * std::sin(angle), (length + slope * x) * m / nAlong);
    };
    for (int k = 0; k < nAround; ++k)
    {
        for (int m = 0; m < nAlong; ++m)
        {
            s.add(at(k, m), at(k + 1, m), at(k + 1, m + 1), side);
            s.add(at(k, m), at(k + 1, m + 1), at(k, m + 1), side);
        }
        s.add(vector(0, 0, 0), at(k + 1, 0), at(k, 0), start);
        s.add(vector(0, 0, length), at(k, nAlong), at(k + 1, nAlong), end);
    }
    s.weld(1e-9);
    return s;
}

bool isEnd(const word& patch)
{
    return patch == "start" || patch == "end";
}

// Area of the polygon, and of all points nearer to it than h
scalar polygon(scalar h)
{
    return nAround * (0.5 * std::sin(2 * M_PI / nAround) + 2 * h * std::sin(M_PI / nAround)) +
           M_PI * h * h;
}

}  // namespace

TEST_CASE("a surface at a distance encloses the volume of Steiner's formula")
{
    const scalar h = 0.3;
    const vector edges(1, 2, 3);
    const surfaceSearch body(box({0, 0, 0}, edges));
    const scalar areas = edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0];
    const scalar exact =
        edges.prod() + 2 * h * areas + M_PI * h * h * edges.sum() + 4 * M_PI / 3 * h * h * h;
    // its nodes are exact, its facets cut off the rounded edges: second order in their size
    scalar error = 0;
    for (const scalar spacing : {0.1, 0.05})
    {
        const triSurface s = offsetSurface(body, h, spacing, false);
        CHECK(checkClosed(s).closed());
        for (const vector& x : s.nodes)
            CHECK(body.signedDistance(x) == relative(h, 0.01 * spacing / h));
        const scalar now = 1 - s.volume() / exact;
        CHECK(now > 0);
        if (error > 0) CHECK(now < error / 3);
        error = now;
    }
    CHECK(error < 1e-3);
}

TEST_CASE(
    "the wall of a tube has its volume, ends in the planes of the openings and keeps the lumen")
{
    const scalar h = 0.3;
    for (const scalar slope : {0.0, 0.5, 1.0})
    {
        const triSurface lumen = tube(slope);
        const vesselWall wall = makeVesselWall(lumen, isEnd, {h, 0.1, 0.1});
        REQUIRE(wall.openings.size() == 2);
        CHECK(checkClosed(wall.surface).closed());
        CHECK(wall.surface.volume() == relative((polygon(h) - polygon(0)) * length, 2e-3));
        scalar inner = 0;
        const surfaceSearch own(lumen);
        for (label t = 0; t < wall.surface.size(); ++t)
        {
            const vector c = wall.surface.centre(t);
            CHECK(c[2] > -1e-6);
            CHECK(c[2] < length + slope * c[0] + 1e-6);
            // no facet lies over an opening
            const bool overOpening = c.head(2).norm() < 0.98 * radius;
            CHECK(!overOpening);
            if (own.within(c, 1e-9)) inner += wall.surface.areaVector(t).norm();
        }
        scalar side = 0;
        for (label t = 0; t < lumen.size(); ++t)
            if (!isEnd(lumen.patchNames[lumen.patch[t]])) side += lumen.areaVector(t).norm();
        CHECK(inner == relative(side, 1e-9));
    }
}

TEST_CASE("a wall reaches beyond the openings as far as is said")
{
    const scalar h = 0.3, beyond = 0.7;
    for (const scalar slope : {0.0, 1.0})
    {
        const vesselWall wall = makeVesselWall(tube(slope), isEnd, {h, 0.1, 0.1, false, beyond});
        REQUIRE(wall.openings.size() == 2);
        CHECK(checkClosed(wall.surface).closed());
        // along the axis, the plane of the oblique end moves farther than along its normal
        const scalar longer = length + beyond * (1 + std::sqrt(1 + slope * slope));
        CHECK(wall.surface.volume() == relative((polygon(h) - polygon(0)) * longer, 2e-3));
        for (const vector& x : wall.surface.nodes) CHECK(x[2] > -beyond - 1e-6);
    }
}

TEST_CASE("a wall without openings surrounds its lumen")
{
    const triSurface lumen = sphere({1, 2, 3}, 1, 4);
    const vesselWall wall = makeVesselWall(lumen, isEnd, {0.5, 0.1, 0.1});
    CHECK(checkClosed(wall.surface).closed());
    CHECK(wall.openings.empty());
    const scalar h = 0.5;  // the integral of the mean curvature is that of the sphere
    CHECK(wall.surface.volume() ==
          relative(lumen.area() * h + 4 * M_PI * h * h * (1 + h / 3), 2e-3));
}

TEST_CASE("walls that would meet and openings that end no vessel are refused")
{
    triSurface two = tube(0);
    triSurface second = tube(0);
    for (vector& x : second.nodes) x[0] += 2.5;  // 0.5 apart
    two.append(second);
    CHECK_ERROR(makeVesselWall(two, isEnd, {0.3, 0.1, 0.1}), "A wall of 0.3 m is too thick", 0);
    CHECK_ERROR(makeVesselWall(two, isEnd, {0.3, 0.1, 0.1}), "0.50", 0);
    CHECK(makeVesselWall(two, isEnd, {0.2, 0.1, 0.1}).openings.size() == 4);

    triSurface cut = box({0, 0, 0}, {1, 1, 1});  // half of one face is an opening
    cut.patch[0] = cut.addPatch("start");
    CHECK_ERROR(makeVesselWall(cut, isEnd, {0.2, 0.1, 0.1}), "does not end the vessel", 0);
}
