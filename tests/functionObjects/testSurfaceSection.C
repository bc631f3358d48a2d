// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceSection.H"
#include "roundSurfaces.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

TEST_CASE("a prism of n sides: the radius of its polygon at every angle")
{
    const label n = 12;
    const triSurface prism = tube(2, 5, n, 3);
    const axisFrame frame({0, 0, 2.1}, {0, 0, 3});
    CHECK(std::abs(frame.e1.dot(frame.axis)) < 1e-15);
    CHECK(frame.e1.cross(frame.e2).dot(frame.axis) == relative(1));
    const label angles = 360;
    const List<scalar> r = sectionRadii(prism, {}, frame, 0, angles);
    const scalar side = 2 * M_PI / n, turn = std::atan2(frame.e1[1], frame.e1[0]);
    for (label k = 0; k < angles; ++k)
    {
        const scalar angle = (k + 0.5) * 2 * M_PI / angles + turn;
        const scalar inSide = angle - side * std::floor(angle / side) - side / 2;
        CHECK(r[k] == relative(2 * std::cos(side / 2) / std::cos(inSide), 1e-12));
    }
}

TEST_CASE("a sphere, an oblique axis, heights")
{
    triSurface s = dome(3, 40, 80);
    const tensor turn = Eigen::AngleAxisd(0.7, vector(1, 2, 3).normalized()).toRotationMatrix();
    const vector shift(5, 6, 7);
    for (vector& x : s.nodes) x = turn * x + shift;
    const axisFrame frame(shift, turn.col(2));
    for (const scalar height : {0.5, 1.0, 2.0})
    {
        const diameterRange d = diametersOf(sectionRadii(s, {}, frame, height, 180));
        const scalar exact = 2 * std::sqrt(9 - height * height);
        CHECK(d.mean == relative(exact, 1e-3));  // facets of 4.5 degrees: sag 8e-4
        CHECK(d.max <= exact * (1 + 1e-12));
    }
    const diameterRange above = diametersOf(sectionRadii(s, {}, frame, 3.1, 180));
    CHECK(std::isnan(above.mean));
}

TEST_CASE("symmetry planes complete a quarter; others do not matter")
{
    const triSurface whole = tube(2, 5, 48, 3);
    const triSurface quarter =
        whole.subset([&](label t) { return whole.centre(t)[0] > 0 && whole.centre(t)[1] > 0; });
    const axisFrame frame({0, 0, 2.1}, {0, 0, 1});
    const tensor mx = vector(-1, 1, 1).asDiagonal(), my = vector(1, -1, 1).asDiagonal();
    const tensor mz = vector(1, 1, -1).asDiagonal();
    const List<structureImage> maps = {{mx, vector::Zero()},
                                       {my, vector::Zero()},
                                       {mx * my, vector::Zero()},
                                       {mz, vector::Zero()},
                                       {tensor::Identity(), vector(9, 0, 0)}};
    const List<structureImage> about = imagesAboutAxis(maps, frame);
    CHECK(about.size() == 3);
    const List<scalar> a = sectionRadii(whole, {}, frame, 0, 90);
    const List<scalar> b = sectionRadii(quarter, about, frame, 0, 90);
    for (size_t k = 0; k < a.size(); ++k) CHECK(b[k] == relative(a[k], 1e-12));
    CHECK(std::isnan(diametersOf(sectionRadii(quarter, {}, frame, 0, 90)).mean));
}

TEST_CASE("of two walls the inner one is met; an ellipse has a least and a greatest diameter")
{
    triSurface both = tube(3, 5, 64, 3);
    both.append(tube(2, 5, 64, 3));
    for (vector& x : both.nodes) x[1] *= 0.5;
    const diameterRange d =
        diametersOf(sectionRadii(both, {}, axisFrame({0, 0, 2.1}, {0, 0, 1}), 0, 720));
    CHECK(d.max == relative(4, 2e-3));
    CHECK(d.min == relative(2, 2e-3));
    CHECK(d.mean < 3.2);
    CHECK(d.mean > 2.2);
}

TEST_CASE("diameters skip angles without an opposite side")
{
    const scalar nan = std::nan("");
    const diameterRange d = diametersOf({1, 2, nan, 3, 5, 6});  // pairs (1 3), (2 5), (nan 6)
    CHECK(d.mean == 5.5);
    CHECK(d.min == 4);
    CHECK(d.max == 7);
}
