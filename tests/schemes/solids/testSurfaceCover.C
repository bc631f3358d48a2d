// SPDX-License-Identifier: GPL-3.0-or-later
// Area vectors with errors of some per cent, on spheres, circles and surfaces with ends
#include "relative.H"
#include "surfaceCover.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.1;

struct surfaceOf
{
    List<vector> x, S;

    // adds a point with an area error of up to 15 %
    void add(const vector& point, const vector& area)
    {
        x.push_back(point), S.push_back((0.93 + 0.08 * std::sin(7.0 * scalar(x.size()))) * area);
    }
    List<scalar> factors(int nDims, const List<isometry>& images = {}) const
    {
        return coverFactors(x, S, nDims, dx, images);
    }
    scalar area(int nDims) const
    {
        const List<scalar> c = factors(nDims);
        scalar sum = 0;
        for (size_t i = 0; i < c.size(); ++i) sum += c[i] * S[i].norm();
        return sum;
    }
};

// The golden spiral, even to a few per cent.  keep(x): part of the sphere that is kept
template <class Keep>
surfaceOf sphere(scalar R, Keep&& keep)
{
    surfaceOf s;
    const label n = label(std::lround(4 * M_PI * R * R / (dx * dx)));
    for (label i = 0; i < n; ++i)
    {
        const scalar z = 1 - (2 * i + 1.0) / n, angle = M_PI * (3 - std::sqrt(5.0)) * i;
        const scalar rho = std::sqrt(1 - z * z);
        const vector x(rho * std::cos(angle), rho * std::sin(angle), z);
        if (keep(x)) s.add(R * x, 4 * M_PI * R * R / n * x);
    }
    return s;
}

surfaceOf circle(scalar R)
{
    surfaceOf s;
    const label n = label(std::lround(2 * M_PI * R / dx));
    for (label i = 0; i < n; ++i)
    {
        const vector x(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), 0);
        s.add(R * x, 2 * M_PI * R / n * x);
    }
    return s;
}

}  // namespace

TEST_CASE("area vectors that are off cover spheres and circles of any radius")
{
    for (const scalar R : {0.5, 1.0, 3.0})
    {
        CHECK(sphere(R, [](const vector&) { return true; }).area(3) ==
              relative(4 * M_PI * R * R, 0.003));
        CHECK(circle(R).area(2) == relative(2 * M_PI * R, 0.003));
    }
}

TEST_CASE("beyond a plane of symmetry the surface goes on")
{
    isometry mirror;
    mirror.R = vector(1, 1, -1).asDiagonal();
    const surfaceOf half = sphere(1, [](const vector& x) { return x[2] > 0; });
    surfaceOf whole = half;
    for (size_t i = 0; i < half.x.size(); ++i)
        whole.x.push_back(mirror.R * half.x[i]), whole.S.push_back(mirror.R * half.S[i]);
    const List<scalar> seen = half.factors(3, {mirror}), wanted = whole.factors(3);
    for (size_t i = 0; i < seen.size(); ++i) CHECK(seen[i] == relative(wanted[i], 1e-9));
}

TEST_CASE("where a surface ends its area vectors have the factor of those before the end")
{
    // a plate and its other side, 2 dx below
    surfaceOf plate;
    for (int side : {1, -1})
        for (int i = 0; i < 30; ++i)
            for (int j = 0; j < 20; ++j)
                plate.x.push_back(vector((i + 0.5) * dx, (j + 0.5) * dx, side * dx)),
                    plate.S.push_back(0.95 * side * dx * dx * vector(0, 0, 1));
    for (const scalar c : plate.factors(3)) CHECK(c == relative(1 / 0.95, 0.015));
}

TEST_CASE("a flag's end is too narrow to tell: it has the factor of the sides")
{
    surfaceOf flag;
    const auto add = [&](scalar x, scalar y, const vector& n) {
        flag.x.push_back(dx * vector(x, y, 0)), flag.S.push_back(0.94 * dx * n);
    };
    for (int i = 0; i < 30; ++i) add(i + 0.5, 0, {0, -1, 0}), add(i + 0.5, 4, {0, 1, 0});
    for (int j = 0; j < 4; ++j) add(30, j + 0.5, {1, 0, 0});
    const List<scalar> c = flag.factors(2);
    for (size_t i = 60; i < 64; ++i) CHECK(c[i] == relative(1 / 0.94, 0.02));
}

TEST_CASE("area vectors that are far off are not made good: no surface is as the points say")
{
    surfaceOf s = circle(1);
    for (vector& S : s.S) S *= 0.5;
    for (const scalar c : s.factors(2)) CHECK(c == 1.25);
    CHECK(coverFactors({}, {}, 3, dx, {}).empty());
    CHECK(coverFactors({vector::Zero()}, {dx * vector(1, 0, 0)}, 2, dx, {})[0] == 1.25);
}
