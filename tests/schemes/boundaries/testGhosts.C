// SPDX-License-Identifier: GPL-3.0-or-later
// Compares every kind of ghost with the equivalent problem without a boundary: the rows of all
// operators equal those of a cloud in which the images are ordinary particles.
#include "boundary/scene.H"
#include "pairSums.H"
#include "viscousPairs.H"
#include "smoothingKernel.H"

#include <doctest/doctest.h>

using namespace scene;

namespace
{

constexpr scalar dx = 0.1, side = 0.8;

// Position, velocity and pressure of a copy
struct copyMap
{
    tensor R, M;  // of positions and of velocities
    vector t = vector::Zero(), b = vector::Zero();
};

copyMap same()
{
    return {tensor::Identity(), tensor::Identity()};
}
tensor reflection(const vector& n)
{
    return tensor::Identity() - 2 * n * n.transpose();
}
copyMap symmetric(const vector& unitNormal)  // plane through the origin
{
    return {reflection(unitNormal), reflection(unitNormal)};
}
copyMap noSlip(const vector& unitNormal, const vector& wallVelocity = vector::Zero())
{
    return {reflection(unitNormal), -tensor::Identity(), vector::Zero(), 2 * wallVelocity};
}
copyMap shifted(const vector& t)
{
    return {tensor::Identity(), tensor::Identity(), t};
}

// All products of one member of each list
List<copyMap> products(const List<List<copyMap>>& lists)
{
    List<copyMap> all = {same()};
    for (const List<copyMap>& list : lists)
    {
        List<copyMap> next;
        for (const copyMap& a : all)
            for (const copyMap& b : list)
                next.push_back({b.R * a.R, b.M * a.M, b.R * a.t + b.t, b.M * a.b + b.b});
        all = next;
    }
    return all;
}

struct rows
{
    List<scalar> div;
    List<vec4> grad, lap;
};

rows rowsOf(particleCloud& cloud, const neighbourList::visibility& visible)
{
    const auto kernel = smoothingKernel::New("WendlandC2", cloud.nDims, 1.3 * dx);
    cloud.fillGhosts(cloud.Up, false);
    neighbourList list;
    list.build(cloud, *kernel, visible);
    kernelCorrection B;
    B.build(cloud, list);
    const stencil s{cloud, list, B};
    rows result;
    for (label i = 0; i < cloud.n(); ++i)
    {
        pairSums sums;
        sums.add(list, cloud.x.data(), cloud.Up.data(), i, rowOf<among::all>(list, i));
        result.div.push_back(sums.divergence(B.all[i]));
        result.grad.push_back(vec4::from(B.all[i] * sums.gradient(3)));
    }
    viscousPairs viscous;
    viscous.setup(s);
    viscous.apply(cloud.Up, result.lap);
    return result;
}

bool everywhere(const vector&)
{
    return true;
}

List<vector> disordered(int nDims, const region& inside)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<scalar> shift(-0.2 * dx, 0.2 * dx);
    List<vector> points = lattice(
        dx, vector::Zero(), vector::Constant(side),
        [&](const vector& x) {
            return x.head(nDims).minCoeff() > 0 && x.head(nDims).maxCoeff() < side && inside(x);
        },
        nDims);
    for (vector& x : points)
        for (int d = 0; d < nDims; ++d) x[d] += shift(random);
    return points;
}

void setField(particleCloud& cloud)
{
    for (label i = 0; i < cloud.n(); ++i)
    {
        const vector x = cloud.x[i].xyz();
        cloud.Up[i] =
            vec4{{std::sin(3 * x[0]) + x[1], std::cos(2 * x[1]) * x[0],
                  cloud.nDims == 3 ? x[2] * x[0] + 0.3 : 0, 2 + std::sin(x[0] + 2 * x[1])}};
    }
}

// Largest difference of any row, over the largest row of its kind
scalar difference(const List<vector>& points, int nDims, const boundary* walls,
                  particleCloud& cloud, const List<copyMap>& copies)
{
    setField(cloud);
    walls->updateGhosts(cloud);
    const rows mine = rowsOf(cloud, walls->visible(cloud));

    particleCloud full = fluid(points, dx, nDims);
    setField(full);
    for (size_t k = 1; k < copies.size(); ++k)
        for (label i = 0; i < label(points.size()); ++i)
        {
            const copyMap& c = copies[k];
            full.append(c.R * points[i] + c.t, 0,
                        vec4::from(c.M * full.Up[i].xyz() + c.b, full.Up[i][3]), full.nextId());
        }
    const rows exact = rowsOf(full, nullptr);
    scalar error[3] = {}, size[3] = {};
    for (label i = 0; i < label(points.size()); ++i)
    {
        const scalar e[3] = {std::abs(mine.div[i] - exact.div[i]),
                             (mine.grad[i].xyz() - exact.grad[i].xyz()).norm(),
                             std::abs(mine.lap[i][3] - exact.lap[i][3]) +
                                 (mine.lap[i].xyz() - exact.lap[i].xyz()).norm()};
        const scalar s[3] = {std::abs(exact.div[i]), exact.grad[i].xyz().norm(),
                             exact.lap[i].xyz().norm()};
        for (int q = 0; q < 3; ++q)
            error[q] = std::max(error[q], e[q]), size[q] = std::max(size[q], s[q]);
    }
    return std::max({error[0] / size[0], error[1] / size[1], error[2] / size[2]});
}

scalar against(int nDims, const word& patches, const List<copyMap>& copies,
               const std::map<word, triSurface>& surfaces = {}, const region& inside = everywhere)
{
    folder files;
    for (const auto& [name, surface] : surfaces) files.surface(name, surface);
    const List<vector> points = disordered(nDims, inside);
    particleCloud cloud = fluid(points, dx, nDims);
    boundary walls(files.path, dictionary::fromString(patches), cloud, 2.6 * dx);
    walls.setStep(0, 1);
    return difference(points, nDims, &walls, cloud, copies);
}

const vector ex = vector::UnitX(), ey = vector::UnitY(), ez = vector::UnitZ();

// A wide sheet in the plane across axis d, normal towards -d
triSurface low(int d, scalar reach = 2)
{
    const vector u = vector::Unit((d + 1) % 3), v = vector::Unit((d + 2) % 3);
    return sheet(-reach * (u + v), 2 * reach * v, 2 * reach * u, 3);
}

}  // namespace

TEST_CASE("symmetry planes: half, quarter, sixth and eighth of a mirrored cloud")
{
    const word x0 = "x0 { type symmetryPlane; point (0 0 0); normal (-1 0 0); }";
    const word y0 = "y0 { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
    const word z0 = "z0 { type symmetryPlane; point (0 0 0); normal (0 0 -1); }";
    const List<copyMap> mx = {same(), symmetric(ex)}, my = {same(), symmetric(ey)},
                        mz = {same(), symmetric(ez)};
    CHECK(against(2, x0, mx) < 1e-11);
    CHECK(against(3, z0, mz) < 1e-11);
    CHECK(against(2, x0 + y0, products({mx, my})) < 1e-11);
    CHECK(against(3, y0 + z0, products({my, mz})) < 1e-11);
    CHECK(against(3, x0 + y0 + z0, products({mx, my, mz})) < 1e-11);

    const copyMap a = symmetric({-0.5 * std::sqrt(3), 0.5, 0}), b = symmetric(ey);
    const copyMap turn = {a.R * b.R, a.M * b.M}, back = {b.R * a.R, b.M * a.M};
    const auto wedge = [](const vector& x) {
        return x[1] > 0.3 * dx && std::sqrt(3) * x[0] - x[1] > 0.6 * dx;
    };
    CHECK(against(2,
                  y0 + "slope { type symmetryPlane; point (0 0 0); normal (" +
                      str(-0.5 * std::sqrt(3), 17) + " 0.5 0); }",
                  products({{same(), turn, back}, {same(), b}}), {}, wedge) < 1e-11);
}

TEST_CASE("cyclic pairs: one, two and three against the repeated cloud")
{
    const auto pair = [](const word& name, const vector& e) {
        const vector s = side * e;
        return name + " { type cyclic; point (0 0 0); separation (" + str(s[0], 17) + " " +
               str(s[1], 17) + " " + str(s[2], 17) + "); }";
    };
    const auto repeated = [](const vector& e) -> List<copyMap> {
        return {same(), shifted(side * e), shifted(-side * e)};
    };
    CHECK(against(2, pair("x", ex), repeated(ex)) < 1e-11);
    CHECK(against(2, pair("x", ex) + pair("y", ey), products({repeated(ex), repeated(ey)})) <
          1e-11);
    CHECK(against(3, pair("x", ex) + pair("y", ey) + pair("z", ez),
                  products({repeated(ex), repeated(ey), repeated(ez)})) < 1e-11);
    CHECK(against(3, pair("x", ex) + "y0 { type symmetryPlane; point (0 0 0); normal (0 -1 0); }",
                  products({repeated(ex), {same(), symmetric(ey)}})) < 1e-11);
}

TEST_CASE("mirror walls: flat, moving, in concave corners, as planes and as triangles")
{
    const word mirror = "type wall; representation mirror;";
    const List<copyMap> nx = {same(), noSlip(ex)}, ny = {same(), noSlip(ey)},
                        nz = {same(), noSlip(ez)};
    const std::map<word, triSurface> surfaces = {{"x", low(0)}, {"y", low(1)}, {"z", low(2)}};
    for (const bool planes : {true, false})
    {
        CAPTURE(planes);
        const auto wall = [&](const word& name, const word& normal) {
            return name + " { " + mirror +
                   (planes ? " surface plane; point (0 0 0); normal " + normal + ";" : "") + " }";
        };
        const word x = wall("x", "(-1 0 0)"), y = wall("y", "(0 -1 0)"), z = wall("z", "(0 0 -1)");
        CHECK(against(2, y, ny, surfaces) < 1e-11);
        CHECK(against(3, z, nz, surfaces) < 1e-11);
        CHECK(against(2, x + y, products({nx, ny}), surfaces) < 1e-11);
        CHECK(against(3, x + y + z, products({nx, ny, nz}), surfaces) < 1e-11);
        CHECK(against(3, y + "z0 { type symmetryPlane; point (0 0 0); normal (0 0 -1); }",
                      products({ny, {same(), symmetric(ez)}}), surfaces) < 1e-11);
        const word around =
            "x0 { type cyclic; point (0 0 0); separation (" + str(side, 17) + " 0 0); }";
        CHECK(against(2, y + around,
                      products({ny, {same(), shifted(side * ex), shifted(-side * ex)}}),
                      {{"y", sheet({0, 0, -1}, side * ex, 2 * ez, 3)}}) < 1e-11);
    }
    CHECK(against(3, "y { " + mirror + " motion { velocity (0 0.3 -1); } }",
                  {same(), noSlip(ey, {0, 0.3, -1})}, surfaces) < 1e-11);
    CHECK(against(3, "y { " + mirror + " velocity (0.5 0 -1); }",
                  {same(), noSlip(ey, {0.5, 0, -1})}, surfaces) < 1e-11);
}
