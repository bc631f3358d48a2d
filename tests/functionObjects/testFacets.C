// SPDX-License-Identifier: GPL-3.0-or-later
// Facets, over which surface integrals are summed: their number follows from the area, not from the triangulation
#include "facets.H"
#include "relative.H"
#include "roundSurfaces.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3;

struct integrals
{
    vector area = vector::Zero(), moment = vector::Zero();
    scalar size = 0;
};

integrals sumOf(const List<facet>& facets)
{
    integrals sum;
    for (const facet& f : facets)
        sum.area += f.area, sum.moment += f.area.norm() * f.centre, sum.size += f.area.norm();
    return sum;
}

// A strip of the plane z = 0 in two triangles
triSurface strip(scalar length, scalar width)
{
    triSurface s;
    s.addPatch("strip");
    s.add({0, 0, 0}, {length, 0, 0}, {length, width, 0}, 0);
    s.add({0, 0, 0}, {length, width, 0}, {0, width, 0}, 0);
    return s;
}

}  // namespace

TEST_CASE("strips, broad and narrow: area and centre are kept, in no more pieces than they want")
{
    for (const scalar width : {0.05 * dx, 0.3 * dx, dx, 4 * dx, 30 * dx})
    {
        CAPTURE(width);
        const scalar length = 200 * dx;
        const List<facet> facets = facetsOf(strip(length, width), dx, 3);
        const integrals sum = sumOf(facets);
        CHECK(sum.area[2] == relative(length * width, 1e-12));
        CHECK(sum.moment[0] / sum.size == relative(0.5 * length, 1e-12));
        CHECK(sum.moment[1] / sum.size == relative(0.5 * width, 1e-12));
        CHECK(label(facets.size()) < 4 * length * std::max(width, 0.5 * dx) / (dx * dx));
        for (const facet& f : facets) CHECK(f.area.norm() < 2.3 * dx * dx);
    }
}

TEST_CASE("one slender triangle: its pieces have its centroid")
{
    triSurface s;
    const vector a(0, 0, 0), b(40 * dx, 0, 0), c(40 * dx, 0.6 * dx, 0);
    s.add(a, b, c, s.addPatch("triangle"));
    const integrals sum = sumOf(facetsOf(s, dx, 3));
    CHECK((sum.moment / sum.size - (a + b + c) / 3).norm() < 1e-12);
}

TEST_CASE("a long pipe drawn in strips: a piece per dx^2 or two")
{
    const scalar R = 12 * dx, length = 100 * dx;
    const List<facet> facets = facetsOf(tube(R, length, 240, 1), dx, 3);
    const integrals sum = sumOf(facets);
    CHECK(sum.area.norm() < 1e-12 * sum.size);
    CHECK(sum.size == relative(2 * M_PI * R * length, 1e-3));
    CHECK(label(facets.size()) < 2 * sum.size / (dx * dx));
}

TEST_CASE("a thick slice of an edge drawn far finer than dx: lengths in the plane, two sides apart")
{
    triSurface s;
    s.addPatch("edge");
    for (int k = 0; k < 1000; ++k)
        for (const scalar y : {0.0, 0.2 * dx})
        {
            const scalar a = 0.01 * k * dx, b = a + 0.01 * dx, top = y > 0 ? a : b;
            s.add({a, y, 0}, {b, y, 0}, {top, y, 20 * dx}, 0);
            s.add({a + b - top, y, 0}, {b, y, 20 * dx}, {a, y, 20 * dx}, 0);
        }
    const integrals sum = sumOf(facetsOf(s, dx, 2));
    CHECK(sum.size == relative(20 * dx, 0.01));
    CHECK(facetsOf(s, dx, 2).size() < 60);
    for (const facet& f : facetsOf(s, dx, 2)) CHECK(f.centre[2] == 0);
}
