// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs are compared with the damage that was done
#include "boundaryLoops.H"
#include "geometry/testShapes.H"
#include "relative.H"
#include "surfaceRepair.H"
#include "surfaceTopology.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::testShapes;

namespace
{

const repairSettings settings = {1e-6, 0.5};

void dropTriangle(triSurface& s, label t)
{
    s.triangles.erase(s.triangles.begin() + t), s.patch.erase(s.patch.begin() + t);
}

void addTriangle(triSurface& s, triSurface::triangle f)
{
    s.triangles.push_back(f), s.patch.push_back(0);
}

// Triangles in random order, with random orientation and first corner
triSurface shuffled(const triSurface& s, unsigned seed)
{
    std::mt19937 g(seed);
    triSurface loose;
    loose.patchNames = s.patchNames;
    List<label> order(s.size());
    for (label t = 0; t < s.size(); ++t) order[t] = t;
    std::shuffle(order.begin(), order.end(), g);
    for (const label t : order)
    {
        const int k = int(g() % 3), step = g() % 2 ? 1 : 2;
        loose.add(s.corner(t, k), s.corner(t, (k + step) % 3), s.corner(t, (k + 2 * step) % 3),
                  s.patch[t]);
    }
    return loose;
}

}  // namespace

TEST_CASE("a good surface is left as it is")
{
    triSurface s = sphere({1, 2, 3}, 2, 3);
    const triSurface before = s;
    const repairReport report = repair(s, settings);
    CHECK(report.describe().empty());
    CHECK(s.triangles == before.triangles);
    CHECK(s.nodes == before.nodes);
}

TEST_CASE("each defect is repaired and counted")
{
    const triSurface whole = sphere({0, 0, 0}, 2, 3);
    triSurface s = whole;
    SUBCASE("duplicates of either sense")
    {
        addTriangle(s, whole.triangles[5]);
        addTriangle(s, {whole.triangles[9][1], whole.triangles[9][0], whole.triangles[9][2]});
        addTriangle(s, {whole.triangles[10][1], whole.triangles[10][0], whole.triangles[10][2]});
        const repairReport report = repair(s, settings);
        CHECK(report.duplicates == 3);
        CHECK(report.describe() == "3 facets dropped that lay on others");
    }
    SUBCASE("every facet twice, on both sides")
    {
        triSurface inside = whole;
        inside.flip();
        s.append(inside);
        CHECK(repair(s, settings).duplicates == whole.size());
    }
    SUBCASE("a fin")
    {
        const auto f = whole.triangles[0];
        s.nodes.push_back(1.5 * whole.nodes[f[0]]);
        const label tip = label(s.nodes.size()) - 1;
        addTriangle(s, {f[0], f[1], tip}), addTriangle(s, {f[1], f[0], tip});
        CHECK(repair(s, settings).duplicates == 2);
    }
    SUBCASE("a facet without area, its neighbour cut in two")
    {
        const auto f = whole.triangles[7];
        const label middle = label(s.nodes.size());
        s.nodes.push_back(0.5 * (s.nodes[f[0]] + s.nodes[f[1]]));
        s.triangles[7] = {f[0], middle, f[2]};
        addTriangle(s, {middle, f[1], f[2]});
        addTriangle(s, {f[0], f[1], middle});
        const repairReport report = repair(s, settings);
        CHECK(report.flat == 1);
        CHECK(report.sewn == 1);
    }
    SUBCASE("turned facets")
    {
        for (const label t : {3, 40, 41, 300}) std::swap(s.triangles[t][0], s.triangles[t][1]);
        CHECK(repair(s, settings).describe() == "4 of 512 facets turned to agree with the others");
    }
    SUBCASE("all inwards")
    {
        s.flip();
        CHECK(repair(s, settings).describe() == "all normals pointed inwards and were turned");
    }
    SUBCASE("a missing facet and a larger hole")
    {
        const label centre = whole.triangles[100][0];
        for (label t = s.size(); t-- > 0;)
            if (std::count(s.triangles[t].begin(), s.triangles[t].end(), centre))
                dropTriangle(s, t);
        dropTriangle(s, 0);
        const repairReport report = repair(s, {1e-6, 1});
        CHECK(report.holes == 2);
        CHECK((report.holeAt - whole.nodes[centre]).norm() < 0.2);
    }
    SUBCASE("nodes apart")
    {
        triSurface loose;
        loose.patchNames = s.patchNames;
        for (label t = 0; t < s.size(); ++t)
        {
            const vector off = t % 2 ? vector(5e-7, 0, 0) : vector(0, 0, 0);
            loose.add(s.corner(t, 0) + off, s.corner(t, 1) + off, s.corner(t, 2) + off, 0);
        }
        s = loose;
        CHECK(repair(s, settings).joined > 100);
    }
    CHECK(checkClosed(s).closed());
    CHECK(s.volume() == relative(whole.volume(), 0.003));
}

TEST_CASE("a seam with other nodes on either side is sewn")
{
    // two halves of a box; one side of the seam has three nodes more
    triSurface s = box({0, 0, 0}, {1, 1, 1});
    triSurface open = s.subset([&](label t) { return s.normal(t)[2] < 0.5; });
    for (const auto& [a, b] : {std::pair{0.0, 0.3}, {0.3, 0.35}, {0.35, 1.0}})
        open.add({a, 0, 1}, {b, 0, 1}, {0.5, 1, 1}, 0);
    open.add({0, 0, 1}, {0.5, 1, 1}, {0, 1, 1}, 0);
    open.add({1, 0, 1}, {1, 1, 1}, {0.5, 1, 1}, 0);
    open.weld(1e-9);
    CHECK_FALSE(checkClosed(open).closed());
    const repairReport report = repair(open, {1e-6, 0});
    CHECK(report.sewn == 2);
    CHECK(report.holes == 0);
    CHECK(checkClosed(open).closed());
    CHECK(open.volume() == relative(1, 1e-12));
}

TEST_CASE("holes are found with place, size, edges and plane")
{
    const triSurface whole = box({0, 0, 0}, {4, 2, 1});
    const triSurface s = whole.subset([&](label t) { return std::abs(whole.normal(t)[0]) < 0.5; });
    const auto loops = boundaryLoops(s);
    REQUIRE(loops.size() == 2);
    CHECK((loops[0].centre - vector(0, 1, 0.5)).norm() < 1e-14);
    CHECK((loops[1].normal() - vector(1, 0, 0)).norm() < 1e-14);
    CHECK(loops[0].area.norm() == relative(2, 1e-14));
    CHECK(loops[0].size == 2);
    CHECK(loops[0].nodes.size() == 4);
    CHECK(loops[0].offPlane < 1e-14);
    CHECK(loops[0].describe(0.5) == "at (0 1 0.5) m, 2 m = 4 dx across, 4 edges");
    // two holes that touch in a node remain two
    triSurface pinched = box({0, 0, 0}, {1, 1, 1});
    dropTriangle(pinched, 6), dropTriangle(pinched, 2);
    CHECK(boundaryLoops(pinched).size() == 2);
}

TEST_CASE("order, sense and first corner of the facets do not matter, bit for bit")
{
    triSurface s = sphere({0.1, 0.2, 0.3}, 1, 3);
    s.append(sphere({0.1, 0.2, 0.3}, 0.5, 2));  // a cavity
    triSurface reference;
    for (unsigned seed = 0; seed < 8; ++seed)
    {
        triSurface other = shuffled(s, seed);
        sortByPlace(other);
        repair(other, settings);
        sortByPlace(other);
        if (seed == 0) reference = other;
        CHECK(other.nodes == reference.nodes);
        CHECK(other.triangles == reference.triangles);
        CHECK(
            other.volume() ==
            relative(s.volume() - 2 * s.subset([&](label t) { return t >= 512; }).volume(), 1e-12));
    }
}
