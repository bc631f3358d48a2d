// SPDX-License-Identifier: GPL-3.0-or-later
#include "halfSpace.H"
#include "openVolume.H"
#include "relative.H"
#include "surfaceRefinement.H"
#include "surfaceTopology.H"
#include "testShapes.H"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace ispf;
using namespace ispf::testShapes;

namespace
{

word scratch(const word& name)
{
    const auto folder =
        std::filesystem::temp_directory_path() / ("ispfGeometry." + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    return (folder / name).string();
}

triSurface twoSolids()
{
    triSurface s = box({0, 0, 0}, {1, 2, 3}, "lower");
    s.append(box({0, 0, 5}, {1, 1, 6}, "upper"));
    return s;
}

}  // namespace

TEST_CASE("volume, area and bounds of a box are exact")
{
    const triSurface s = box({1, 2, 3}, {2, 4, 6});
    CHECK(s.volume() == doctest::Approx(6).epsilon(1e-14));
    CHECK(s.area() == doctest::Approx(22).epsilon(1e-14));
    CHECK((s.bounds().max - vector(2, 4, 6)).norm() == 0);
    CHECK(checkClosed(s).closed());
}

TEST_CASE("the sphere's volume converges with the square of the triangle size")
{
    const scalar exact = 4 * M_PI / 3;
    const scalar coarse = exact - sphere({0, 0, 0}, 1, 3).volume();
    const scalar fine = exact - sphere({0, 0, 0}, 1, 4).volume();
    CHECK(coarse > 0);
    CHECK(coarse / fine == doctest::Approx(4).epsilon(0.02));
}

TEST_CASE("welding joins unsewn faces and only nodes within the tolerance")
{
    triSurface loose;
    loose.addPatch("box");
    const triSurface s = box({0, 0, 0}, {1, 1, 1});
    for (label t = 0; t < s.size(); ++t)
    {
        const vector gap = (t % 3) * 1e-6 * vector(1, -1, 1);
        loose.add(s.corner(t, 0) + gap, s.corner(t, 1) + gap, s.corner(t, 2) + gap, 0);
    }
    CHECK(checkClosed(loose).openEdges == 36);
    triSurface tooTight = loose;
    tooTight.weld(1e-7);
    CHECK_FALSE(checkClosed(tooTight).closed());
    loose.weld(1e-5);
    CHECK(loose.nodes.size() == 8);
    CHECK(checkClosed(loose).closed());
}

TEST_CASE("an open surface is told with the place of the gap")
{
    triSurface s = box({0, 0, 0}, {1, 1, 1});
    s.triangles.pop_back();  // on the face x = 1
    s.patch.pop_back();
    const closednessReport report = checkClosed(s);
    CHECK(report.openEdges == 3);
    CHECK(report.openAt[0] == 1);
    CHECK(report.openLength == doctest::Approx(2 + std::sqrt(2.0)));
}

TEST_CASE("orientation is repaired, also of a cavity")
{
    triSurface s = box({0, 0, 0}, {4, 4, 4});
    s.append(box({1, 1, 1}, {2, 2, 2}));
    for (label t = 0; t < s.size(); t += 3) std::swap(s.triangles[t][0], s.triangles[t][1]);
    CHECK_FALSE(checkClosed(s).closed());
    CHECK(orientOutward(s) > 0);
    CHECK(checkClosed(s).closed());
    CHECK(s.volume() == doctest::Approx(64 - 1).epsilon(1e-13));
    CHECK(orientOutward(s) == 0);
}

TEST_CASE("STL files give back solids, names and corners")
{
    const triSurface s = twoSolids();
    writeSTL(s, scratch("two.stl"));
    const triSurface ascii = readSTL(scratch("two.stl"));
    CHECK(ascii.patchNames == s.patchNames);
    CHECK(ascii.patchSurface("lower").volume() == doctest::Approx(6).epsilon(1e-14));
    CHECK(ascii.patchSurface("upper").volume() == doctest::Approx(1).epsilon(1e-14));
    for (label t = 0; t < s.size(); ++t)
        for (int k = 0; k < 3; ++k) CHECK((ascii.corner(t, k) - s.corner(t, k)).norm() == 0);

    std::filesystem::resize_file(scratch("two.stl"),
                                 std::filesystem::file_size(scratch("two.stl")) - 16);
    CHECK_THROWS_AS(readSTL(scratch("two.stl")), fatalError);  // without the last endsolid

    writeSTL(s, scratch("two.stlb"), true);
    const triSurface binary = readSTL(scratch("two.stlb"));
    CHECK(binary.patchNames == List<word>{"two"});
    CHECK(binary.volume() == doctest::Approx(7).epsilon(1e-6));
}

TEST_CASE("a binary STL file whose header says solid is binary, and a cut one is refused")
{
    const word path = scratch("trap.stl");
    writeSTL(box({0, 0, 0}, {1, 1, 1}), path, true);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.write("solid spring", 12);
    file.close();
    CHECK(readSTL(path).volume() == doctest::Approx(1));
    std::filesystem::resize_file(path, 84 + 50 * 11);
    CHECK_THROWS_AS(readSTL(path), fatalError);
    CHECK_THROWS_AS(readSTL(scratch("absent.stl")), fatalError);
}

TEST_CASE("volumes cut by planes are exact")
{
    const triSurface s = box({-1, -1, -1}, {1, 1, 1});
    const halfSpace x{vector(0.25, 0, 0), vector(1, 0, 0)}, y{vector(0, 0, 0), vector(0, -1, 0)};
    CHECK(clippedVolume(s, {x}) == doctest::Approx(1.25 * 4).epsilon(1e-12));
    CHECK(clippedVolume(s, {x, y}) == doctest::Approx(1.25 * 2).epsilon(1e-12));
    // x + y + z = 1 cuts off a corner: a tetrahedron of volume 2^3/6
    const halfSpace oblique{vector(1, 0, 0), vector(1, 1, 1).normalized()};
    CHECK(clippedVolume(s, {oblique}) == doctest::Approx(8 - 8.0 / 6).epsilon(1e-12));
    // a quarter and three oblique cuts of a polyhedron without symmetry: the parts add up to the whole
    const triSurface ball = sphere({0.1, -0.05, 0.02}, 1, 3);
    const halfSpace cut{vector(0.1, 0.2, 0), vector(1, 2, -1).normalized()};
    const halfSpace rest{cut.point, -cut.normal};
    for (const List<halfSpace>& others : {List<halfSpace>{}, List<halfSpace>{x, y, oblique}})
    {
        List<halfSpace> one = others, two = others;
        one.push_back(cut), two.push_back(rest);
        CHECK(clippedVolume(ball, one) + clippedVolume(ball, two) ==
              doctest::Approx(clippedVolume(ball, others)).epsilon(1e-10));
    }
}

TEST_CASE("the volume between a surface and planes in which it is open, in any order of the planes")
{
    const auto plane = [](const vector& point, const vector& outward) {
        return halfSpace{point, outward.normalized()};
    };
    const List<halfSpace> planes = {
        plane({0, 0, 0}, {-1, 0, 0}), plane({0.2, 0.1, 0}, {0.3, -1, 0.1}),
        plane({0, 0, -0.4}, {0, 0, -1}), plane({0, 0, 0.3}, {0, 0.1, 1})};
    std::array<int, 4> order = {0, 1, 2, 3};
    do {
        // a shell that all four planes cut, and a box of which they leave no face but two
        triSurface inner = sphere({0, 0.1, 0}, 0.6, 3), shell = sphere({0, 0, 0}, 1, 3);
        const triSurface outer = shell, whole = box({-2, -2, -2}, {0.5, 0.5, 2});
        inner.flip(), shell.append(inner);
        const auto cutBy = [&](triSurface s) {
            List<halfSpace> sorted;
            for (const int k : order) sorted.push_back(planes[k]), s = clipped(s, planes[k]);
            s.weld(1e-12);
            return std::make_pair(s, sorted);
        };
        inner.flip();
        const auto [s, sorted] = cutBy(shell);
        CHECK(openVolume(s, sorted, 1e-9, [&](const vector& x) {
                  const scalar r = (x - vector(0, 0.1, 0)).norm();
                  return r > 0.6 && x.norm() < 1;
              }) == doctest::Approx(clippedVolume(outer, sorted) - clippedVolume(inner, sorted)));
        const auto [b, others] = cutBy(whole);
        CHECK(openVolume(b, others, 1e-9, [&](const vector& x) {
                  return x[0] < 0.5 && x[1] < 0.5;
              }) == doctest::Approx(clippedVolume(whole, others)));
    } while (std::next_permutation(order.begin(), order.end()));
    // nothing but planes, and a hole in them that meets none
    List<halfSpace> cube;
    for (int a = 0; a < 3; ++a)
        for (const int sign : {-1, 1})
            cube.push_back(
                plane(2 * sign * vector(vector::Unit(a)), sign * vector(vector::Unit(a))));
    const auto all = [](const vector& x) { return x.cwiseAbs().maxCoeff() < 2; };
    CHECK(openVolume({}, cube, 1e-9, all) == doctest::Approx(64));
    triSurface hole = sphere({0, 0, 0}, 1, 2);
    const scalar ball = hole.volume();
    hole.flip();
    CHECK(openVolume(hole, cube, 1e-9, all) == doctest::Approx(64 - ball));
}

TEST_CASE("a half model's cut face is dropped and its images complete it")
{
    const halfSpace half{vector::Zero(), vector(-1, 0, 0)};
    triSurface s = box({0, 0, 0}, {1, 1, 1});
    s = clipped(s, half, 1e-9);
    CHECK(s.size() == 10);
    const triSurface whole = withImages(s, {half}, 2);
    CHECK(checkClosed(whole).closed());
    CHECK(whole.volume() == doctest::Approx(2).epsilon(1e-12));
    CHECK(withImages(s, {half}, 0.5).size() < whole.size());
}

TEST_CASE("refining divides long edges without a crack; volume, patches and normals stay")
{
    triSurface s = box({0, 0, 0}, {1, 0.3, 0.05}, "flat");
    s.append(sphere({0, 0, 5}, 0.4, 1));
    s.triangles.pop_back(), s.patch.pop_back();  // an open edge is halved as well
    const scalar volume = s.volume(), openLength = checkClosed(s).openLength;
    const triSurface before = s;
    refine(s, 0.1);
    scalar longest = 0;
    for (label t = 0; t < s.size(); ++t)
        for (int k = 0; k < 3; ++k)
        {
            longest = std::max(longest, (s.corner(t, k) - s.corner(t, (k + 1) % 3)).norm());
        }
    CHECK(longest <= 0.1);
    CHECK(s.size() < 5000);
    CHECK(s.volume() == relative(volume, 1e-12));
    CHECK(checkClosed(s).flippedPairs == 0);
    CHECK(checkClosed(s).openLength == relative(openLength, 1e-12));
    for (const char* patch : {"flat", "sphere"})
        CHECK(s.patchSurface(patch).area() == relative(before.patchSurface(patch).area(), 1e-12));

    const triSurface fine = s;
    refine(s, 0.1);
    CHECK(s.triangles == fine.triangles);
}

TEST_CASE("a needle is refined into about as many triangles as its length asks for")
{
    triSurface s;
    s.addPatch("");
    s.add({0, 0, 0}, {100, 0, 0}, {0, 0.02, 0}, 0);
    refine(s, 0.5);
    CHECK(s.size() < 1000);
    CHECK(s.area() == relative(1, 1e-12));
}
