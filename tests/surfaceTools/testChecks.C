// SPDX-License-Identifier: GPL-3.0-or-later
// Crossings, thin places and caps of surfaces with known answers
#include "facetCrossings.H"
#include "featureSize.H"
#include "geometry/testShapes.H"
#include "polygonFilling.H"
#include "relative.H"
#include "surfaceCapping.H"
#include "surfaceRepair.H"
#include "surfaceTopology.H"

#include <doctest/doctest.h>
#include <random>

using namespace ispf;
using namespace ispf::testShapes;

namespace
{

// Facets around an axis, without ends
triSurface openTube(const vector& from, const vector& to, scalar radius, int n, int rings)
{
    triSurface s;
    s.addPatch("tube");
    const vector axis = (to - from).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
    const auto at = [&](int k, int m) {
        const scalar angle = 2 * M_PI * k / n;
        return vector(from + (to - from) * m / rings +
                      radius * (std::cos(angle) * u + std::sin(angle) * v));
    };
    for (int m = 0; m < rings; ++m)
        for (int k = 0; k < n; ++k)
        {
            s.add(at(k, m), at(k + 1, m), at(k + 1, m + 1), 0);
            s.add(at(k, m), at(k + 1, m + 1), at(k, m + 1), 0);
        }
    s.weld(1e-9);
    return s;
}

// A cube of edge 2 whose faces have 2 x 2 squares
triSurface latticeCube(const vector& at, bool inward = false)
{
    triSurface s;
    s.addPatch("cube");
    for (int axis = 0; axis < 3; ++axis)
        for (int m = 0; m < 8; ++m)
        {
            const bool far = m & 1;
            const auto corner = [&](int a, int b) {
                vector c = at;
                c[axis] += 2 * far;
                c[(axis + 1) % 3] += (m >> 1 & 1) + a;
                c[(axis + 2) % 3] += (m >> 2 & 1) + b;
                return c;
            };
            const vector b = corner(1, 0), d = corner(0, 1);
            s.add(corner(0, 0), far == inward ? d : b, corner(1, 1), 0);
            s.add(corner(0, 0), corner(1, 1), far == inward ? b : d, 0);
        }
    return s;
}

triSurface bothCubes(const vector& shift, bool firstInward, bool secondInward)
{
    triSurface s = latticeCube({0, 0, 0}, firstInward);
    s.append(latticeCube(shift, secondInward));
    s.weld(1e-9);
    orientOutward(s);
    return s;
}

word refusalOf(triSurface s, const List<capRequest>& requests, scalar tolerance)
{
    try
    {
        capEnds(s, requests, tolerance, 0.1);
    }
    catch (const fatalError& error)
    {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("facets that cross are found with the place, facets that touch are not")
{
    triSurface s = box({0, 0, 0}, {1, 1, 1});
    CHECK(facetCrossings(surfaceSearch(s), 1e-9, 10).empty());
    triSurface touching = s;
    touching.append(box({1, 0, 0}, {2, 1, 1}));
    CHECK(facetCrossings(surfaceSearch(touching), 1e-9, 10).empty());
    CHECK(facetWithin(touching, 1e-4) == -1);

    s.append(box({0.9, 0.4, 0.4}, {2, 0.6, 0.6}));
    const auto crossings = facetCrossings(surfaceSearch(s), 1e-9, 100);
    REQUIRE(!crossings.empty());
    for (const facetCrossing& c : crossings) CHECK(c.at[0] == relative(1, 1e-12));
    CHECK(facetCrossings(surfaceSearch(s), 1e-9, 3).size() == 3);

    triSurface shallow = box({0, 0, 0}, {1, 1, 1});
    shallow.append(box({1 - 1e-5, 0.4, 0.4}, {2, 0.6, 0.6}));
    CHECK(facetCrossings(surfaceSearch(shallow), 1e-4, 100).empty());
    CHECK(facetWithin(shallow, 1e-4) == -1);
    CHECK(!facetCrossings(surfaceSearch(shallow), 1e-6, 100).empty());
    CHECK(facetWithin(shallow, 1e-6) >= 0);

    // overlap along common planes: no edge passes through a facet
    triSurface aligned = box({0, 0, 0}, {2, 1, 1});
    aligned.append(box({1, 0, 0}, {3, 1, 1}));
    CHECK(facetCrossings(surfaceSearch(aligned), 1e-9, 10).empty());
    CHECK(facetWithin(aligned, 1e-4) >= 0);
    CHECK(facetWithin(sphere({0, 0, 0}, 1, 4), 1e-4) == -1);
}

TEST_CASE(
    "bodies that cross along edges of their meshes are found out, those that touch along one are "
    "not")
{
    for (const bool inward : {false, true})
    {
        const triSurface crossing = bothCubes({1, 1, 1}, inward, inward);
        CHECK(checkClosed(crossing).closed());
        CHECK(crossing.volume() == doctest::Approx(16));
        CHECK(facetCrossings(surfaceSearch(crossing), 1e-9, 10).empty());
        CHECK(facetWithin(crossing, 1e-4) >= 0);
        for (const vector& shift : {vector(2, 2, 0), vector(2, 1, 2), vector(2, 2, 2)})
            for (const bool other : {false, true})
            {
                const triSurface touching = bothCubes(shift, inward, other);
                CHECK(checkClosed(touching).closed());
                CHECK(touching.volume() == doctest::Approx(16));
                CHECK(facetWithin(touching, 1e-4) == -1);
            }
    }
    // cubes that touch by whole faces or by parts of them
    for (const unsigned seed : {0u, 1u, 2u})
        for (const vector& next : {vector(2, 0, 0), vector(2, 1, 0)})
        {
            triSurface s = latticeCube({0, 0, 0}, true);
            s.append(latticeCube(next)), s.append(latticeCube(2 * next, seed == 2));
            std::mt19937 random(seed);
            for (auto& f : s.triangles)
                if (seed > 0 && random() % 2) std::swap(f[0], f[1]);
            repairSettings settings;
            settings.weld = 1e-9;
            repair(s, settings);
            CHECK(checkClosed(s).closed());
            CHECK(s.volume() == doctest::Approx(24));
            CHECK(facetWithin(s, 1e-4) == -1);
        }
    // cubes that overlap, turned at random: points inside both could not be recognised
    for (const vector& shift : {vector(1, 1, 1), vector(1, 0, 0), vector(1, 1, 0)})
    {
        triSurface s = latticeCube({0, 0, 0});
        s.append(latticeCube(shift));
        std::mt19937 random(1);
        for (auto& f : s.triangles)
            if (random() % 2) std::swap(f[0], f[1]);
        repairSettings settings;
        settings.weld = 1e-9;
        repair(s, settings);
        CHECK((!checkClosed(s).closed() || facetWithin(s, 1e-4) >= 0));
    }
}

TEST_CASE("thinnest place and narrowest gap")
{
    const featureSizes cube = smallestFeatures(box({0, 0, 0}, {3, 2, 1}), 0.1, false);
    CHECK(cube.thickness.size == relative(1, 1e-9));
    CHECK(cube.thickness.at[2] == relative(0.5, 1e-9));
    CHECK_FALSE(cube.gap.found());

    triSurface two = box({0, 0, 0}, {1, 1, 1});
    two.append(box({1.03, 0.2, 0.2}, {4, 0.8, 0.9}));
    const featureSizes apart = smallestFeatures(two, 0.1, false);
    CHECK(apart.gap.size == relative(0.03, 1e-9));
    CHECK(apart.gap.at[0] == relative(1.015, 1e-9));
    CHECK(apart.thickness.size == relative(0.6, 1e-9));

    triSurface shell = sphere({0, 0, 0}, 1, 4), hole = sphere({0, 0, 0.05}, 0.9, 4);
    hole.flip(), shell.append(hole);
    const featureSizes wall = smallestFeatures(shell, 0.05, false);
    CHECK(wall.thickness.size == relative(0.05, 0.1));
    CHECK(wall.thickness.at[2] > 0.8);
    const featureSizes prism = smallestFeatures(box({0, 0, 0}, {3, 2, 1}), 0.1, true);
    CHECK(prism.thickness.size == relative(2, 1e-9));
}

TEST_CASE("the facets along a sharp edge are no thin place")
{
    // a wedge of 30 degrees, 2 long, with slivers along its edge.  The thickness is that at half a spacing from the edge
    const scalar slope = std::tan(M_PI / 6), sliver = 1e-7;
    triSurface wedge;
    wedge.addPatch("wedge");
    wedge.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 2 * slope, 0}, {sliver, sliver * slope, 0},
                   {0, 0, 3}, {2, 0, 3}, {2, 2 * slope, 3}, {sliver, sliver * slope, 3}};
    wedge.triangles = {{0, 3, 1}, {3, 2, 1}, {4, 5, 7}, {7, 5, 6}, {0, 1, 5}, {0, 5, 4},
                       {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    wedge.patch.assign(12, 0);
    REQUIRE(checkClosed(wedge).closed());
    REQUIRE(wedge.volume() == relative(6 * slope, 1e-6));
    for (const scalar spacing : {0.2, 0.1})
    {
        const scalar thickness = smallestFeatures(wedge, spacing, false).thickness.size;
        CHECK(thickness > 0.2 * slope * spacing);
        CHECK(thickness < slope * spacing);
    }
}

TEST_CASE("edges whose triangles disagree on the outside are counted in words")
{
    triSurface s = box({0, 0, 0}, {1, 1, 1});
    std::swap(s.triangles[0][1], s.triangles[0][2]);
    CHECK(checkClosed(s).describe() ==
          "6 open edges of total length 6.82843 m, the longest at (0.5 0.5 0) m, and 3 edges "
          "whose two triangles disagree on the outside");
    s = s.subset([](label t) { return t == 0 || t == 1; });
    CHECK(checkClosed(s).describe().find("m, and 1 edge whose two") != word::npos);
}

TEST_CASE("the tightest rounding")
{
    CHECK(smallestRadius(sphere({1, 2, 3}, 0.5, 4), 0.1, false).size == relative(0.5, 0.15));
    CHECK(!smallestRadius(box({0, 0, 0}, {3, 2, 1}), 0.1, false).found());
    // a cylinder of many and of few facets; its far end is a sharp edge
    for (const int n : {12, 100})
        CHECK(smallestRadius(openTube({0, 0, 0}, {3, 4, 0}, 0.2, n, 7), 0.1, false).size ==
              relative(0.2, 0.05));
    // a groove: a quarter of a cylinder between two planes, seen from outside
    triSurface groove;
    groove.addPatch("groove");
    List<vector> profile = {{-3, 0, 0}, {-2, 0, 0}, {-1, 0, 0}};
    for (int k = 1; k <= 9; ++k)
    {
        const scalar a = k * M_PI / 18;
        profile.emplace_back(-1 + std::sin(a), 1 - std::cos(a), 0);
    }
    profile.insert(profile.end(), {{0, 2, 0}, {0, 3, 0}});
    for (size_t k = 0; k + 1 < profile.size(); ++k)
        for (int m = 0; m < 6; ++m)
        {
            const vector up(0, 0, m), next(0, 0, m + 1), &a = profile[k], &b = profile[k + 1];
            groove.add(a + up, b + up, b + next, 0), groove.add(a + up, b + next, a + next, 0);
        }
    groove.weld(1e-9);
    const featureSize tight = smallestRadius(groove, 0.1, false);
    CHECK(tight.size == relative(1, 0.05));
    CHECK(std::hypot(tight.at[0] + 1, tight.at[1] - 1) == relative(1, 1e-9));
    // the same outline as a prism in two dimensions: its ends do not count
    CHECK(smallestRadius(groove, 0.1, true).size == relative(1, 0.05));
    // rounding of coordinates is no curvature
    triSurface plate = box({0, 0, 0}, {3, 2, 1});
    plate.add({0, 0, 1}, {3, 0, 1}, {1.5, 1e-6, 1 + 1e-7}, 0);
    CHECK(!smallestRadius(plate, 0.1, false).found());
}

TEST_CASE("open ends become plane lids of the exact volume, in the order asked for")
{
    const int n = 40;
    const scalar polygon = 0.5 * n * std::sin(2 * M_PI / n);  // of radius 1
    triSurface s = openTube({1, 2, 3}, {4, 2, 7}, 1, n, 3);
    SUBCASE("as it is") {}
    SUBCASE("inside out")
    {
        s.flip();
    }
    scalar fit = 1e-9;  // of the normals
    SUBCASE("a rim that wavers")
    {
        fit = 1e-3;
        const vector axis = vector(3, 0, 4) / 5;
        for (size_t k = 0; k < s.nodes.size(); ++k)
            if (std::abs((s.nodes[k] - vector(4, 2, 7)).dot(axis)) < 1e-9)
                s.nodes[k] += (k % 2 ? 0.02 : -0.02) * axis;
    }
    capEnds(s, {{"outlet", {5, 2, 7}}, {"inlet", {0, 0, 0}}}, 0.05, 0.1);
    orientOutward(s);
    CHECK(checkClosed(s).closed());
    CHECK(s.volume() == relative(5 * polygon, fit));
    const triSurface inlet = s.patchSurface("inlet"), outlet = s.patchSurface("outlet");
    CHECK(inlet.area() == relative(polygon, fit));
    for (label t = 0; t < inlet.size(); ++t)
        CHECK((inlet.normal(t) - vector(-0.6, 0, -0.8)).norm() < fit);
    for (label t = 0; t < outlet.size(); ++t)
        CHECK((outlet.normal(t) - vector(0.6, 0, 0.8)).norm() < fit);
}

// Rims of teeth: seen along the axis, nodes lie above each other
TEST_CASE("an end with teeth is capped")
{
    const int n = 24, rings = 50;
    for (const int tooth : {1, 2, 3})
        for (const vector& to : {vector(1, 2, 8), vector(4, 2, 7), vector(2.1, 3.7, 6.5)})
        {
            const vector from(1, 2, 3);
            const triSurface whole = openTube(from, to, 1, n, rings);
            triSurface s = whole.subset([&](label t) {
                const label ring = t / (2 * n), side = t / 2 % n;
                return ring + 1 < rings || side / tooth % 2 == 0;
            });
            capEnds(s, {}, 0.2, 0.1);
            orientOutward(s);
            CHECK_MESSAGE(checkClosed(s).closed(), checkClosed(s).describe());
            const scalar polygon = 0.5 * n * std::sin(2 * M_PI / n), cut = 0.5 / rings;
            CHECK(s.volume() == relative((1 - cut) * (to - from).norm() * polygon, 1e-4));
        }
}

TEST_CASE("caps that cannot be are refused with the measure")
{
    const triSurface tube = openTube({0, 0, 0}, {0, 0, 4}, 1, 24, 4);
    const auto says = [](const word& said, const word& what) {
        CAPTURE(said);
        CHECK(said.find(what) != word::npos);
    };
    says(refusalOf(tube, {{"in", {0, 0, 0}}}, 0.05), "No cap is asked for over the open end at (");
    says(refusalOf(tube, {{"in", {0, 0, 0}}, {"out", {0, 0, 1}}}, 0.05),
         "The caps in and out are nearest to the same open end");
    triSurface bent = tube;
    for (vector& x : bent.nodes)
        if (x[2] > 3.9) x[2] += 0.3 * x[0] * x[0];
    says(refusalOf(bent, {}, 0.05), "= 1.5 dx off the plane fitted to it");
    says(refusalOf(box({0, 0, 0}, {1, 1, 1}), {}, 0.05), "has no open end");
}

// Outer side, lumen, and a cord in the lumen; at each end their three rims lie within one another
TEST_CASE("the wall of a thick vessel is capped by rings")
{
    const int n = 30, m = 17;
    const auto polygon = [](int k) { return 0.5 * k * std::sin(2 * M_PI / k); };
    for (const bool oriented : {true, false})
        for (const bool cord : {true, false})
        {
            triSurface s = openTube({1, 2, 3}, {4, 2, 7}, 1, n, 3);
            triSurface lumen = openTube({1, 2, 3}, {4, 2, 7}, 0.6, m, 4);
            if (oriented) lumen.flip();
            s.append(lumen);
            const scalar ring = polygon(n) - 0.36 * polygon(m);
            if (cord)
                s.append(openTube({1, 2, 3}, {4, 2, 7}, 0.2, 5, 2)), capEnds(s, {}, 0.05, 0.1);
            else capEnds(s, {{"outlet", {5, 2, 7}}, {"inlet", {0, 0, 0}}}, 0.05, 0.1);
            orientOutward(s);
            CHECK_MESSAGE(checkClosed(s).closed(), checkClosed(s).describe());
            CHECK(s.volume() == relative(5 * (ring + cord * 0.04 * polygon(5)), 1e-9));
            CHECK(s.patchSurface(cord ? "cap0" : "inlet").area() == relative(ring, 1e-9));
        }
}

TEST_CASE("a plate with many holes is filled")
{
    List<List<vector>> rings = {{{0, 0, 0}, {9, 0, 0}, {9, 6, 0}, {0, 6, 0}}};
    scalar area = 54;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j)
        {
            List<vector> hole;
            const int n = 3 + i + 2 * j;
            for (int k = 0; k < n; ++k)
            {
                const scalar a = -2 * M_PI * k / n;
                hole.emplace_back(1.5 + 2 * i + 0.7 * std::cos(a), 1 + 2 * j + 0.7 * std::sin(a),
                                  0);
            }
            area -= 0.49 * 0.5 * n * std::sin(2 * M_PI / n);
            rings.push_back(hole);
        }
    List<vector> points;
    for (const List<vector>& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
    scalar filled = 0;
    const auto triangles = fillPolygon(rings, {0, 0, 1});
    for (const auto& [a, b, c] : triangles)
    {
        const vector n = 0.5 * (points[b] - points[a]).cross(points[c] - points[a]);
        CHECK(n[2] > -1e-12);
        filled += n[2];
    }
    CHECK(triangles.size() == points.size() + 2 * 12 - 2);
    CHECK(filled == relative(area, 1e-12));
}

TEST_CASE("polygons of any shape are filled")
{
    for (const int n : {3, 4, 7, 60})
    {
        List<vector> star;
        for (int k = 0; k < 2 * n; ++k)
        {
            const scalar r = k % 2 ? 1 : 0.3, a = M_PI * k / n;
            star.emplace_back(r * std::cos(a), r * std::sin(a), 0);
            if (k % 3 == 0)  // a point in line with the next
            {
                const scalar q = k % 2 ? 0.3 : 1, b = M_PI * (k + 1) / n;
                star.push_back(0.5 * (star.back() + vector(q * std::cos(b), q * std::sin(b), 0)));
            }
        }
        scalar area = 0, filled = 0;
        for (size_t k = 0; k < star.size(); ++k)
            area += 0.5 * star[k].cross(star[(k + 1) % star.size()])[2];
        const auto triangles = fillPolygon(star, vector::UnitZ());
        CHECK(triangles.size() == star.size() - 2);
        for (const auto& [a, b, c] : triangles)
            filled += 0.5 * (star[b] - star[a]).cross(star[c] - star[a])[2];
        CHECK(filled == relative(area, 1e-12));
    }
    CHECK(fillPolygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, vector::UnitZ()).empty());
}
