// SPDX-License-Identifier: GPL-3.0-or-later
#include "periodicBox.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// {u, v, w, p} = A x with div u = trace, the gradient of p the last row; periodic up to its jump
struct linearField
{
    Eigen::Matrix<scalar, 4, 3> A;

    explicit linearField(int nDims)
    {
        A << 1.5, -2, 0.25, 0.5, 3, -1, -0.75, 2, 4, 5, -6, 7;
        if (nDims == 2) A.row(2).setZero(), A.col(2).setZero();
    }
    vec4 operator()(const vector& x) const
    {
        const Eigen::Vector4d f = A * x;
        return vec4{simd4{f[0], f[1], f[2], f[3]}};
    }
    scalar trace() const { return A(0, 0) + A(1, 1) + A(2, 2); }
    vector slope() const { return A.row(3).transpose(); }
};

periodicBox linearBox(int nDims, int n, const linearField& f)
{
    periodicBox box(nDims, n, 0.2, "WendlandC2", 1.3);
    box.jump = f.A;
    box.update();
    return box;
}

}  // namespace

TEST_CASE("corrected divergence and gradient are exact on linear fields, disordered, over images")
{
    for (const int nDims : {2, 3})
    {
        const linearField f(nDims);
        const periodicBox box = linearBox(nDims, nDims == 2 ? 16 : 9, f);
        const List<vec4> phi = box.field(f);
        for (const pairFilter filter : {pairFilter::all, pairFilter::samePhase})
        {
            const auto div = sphc::div(box.stencil(), phi, divergenceScheme::corrected, filter);
            const auto grad =
                sphc::grad(box.stencil(), phi, gradientScheme::correctedDifference, filter);
            for (label i = 0; i < box.cloud.n(); ++i)
            {
                CHECK(div[i] == doctest::Approx(f.trace()).epsilon(1e-11));
                CHECK((grad[i].xyz() - f.slope()).norm() < 1e-10);
            }
        }
    }
}

TEST_CASE("plain forms err by the disorder; the symmetric one keeps the total force at zero")
{
    const linearField f(2);
    const periodicBox box = linearBox(2, 16, f);
    const List<vec4> phi = box.field(f);
    const auto plain = sphc::grad(box.stencil(), phi, gradientScheme::difference);
    scalar worst = 0;
    for (const vec4& g : plain) worst = std::max(worst, (g.xyz() - f.slope()).norm());
    CHECK(worst > 0.01 * f.slope().norm());

    const periodicBox still(2, 16, 0.2, "WendlandC2", 1.3);
    const List<vec4> p = still.field([](const vector& x) {
        return vec4{{0, 0, 0, 3 + std::sin(2 * M_PI * x[0])}};
    });
    vector force = vector::Zero();
    for (const vec4& g : sphc::grad(still.stencil(), p, gradientScheme::symmetric))
        force += g.xyz();
    CHECK(force.norm() < 1e-9);
}

TEST_CASE("Laplacian of a wave converges to minus k squared times the wave")
{
    scalar error[2] = {};
    for (const int fine : {0, 1})
    {
        const periodicBox box(2, fine ? 48 : 24, 0, "WendlandC2", 1.3);
        const scalar k = 2 * M_PI;
        const auto wave = [&](const vector& x) {
            return vec4{{std::sin(k * x[0]), std::cos(k * x[1]), 0, std::sin(k * (x[0] + x[1]))}};
        };
        const List<vec4> phi = box.field(wave);
        const List<vec4> lap = sphc::laplacian(box.stencil(), phi);
        const simd4 exact = {-k * k, -k * k, 0, -2 * k * k};
        for (label i = 0; i < box.cloud.n(); ++i)
            for (int c = 0; c < 4; ++c)
                error[fine] = std::max(error[fine], std::abs(lap[i][c] - exact[c] * phi[i][c]));
        error[fine] /= k * k;
    }
    CHECK(error[0] < 0.04);
    CHECK(error[1] < 0.3 * error[0]);
}

TEST_CASE("operators do not depend on the number of threads")
{
    const int before = nThreads();
    List<vec4> grad[2];
    List<scalar> div[2];
    for (const int t : {0, 1})
    {
        setThreads(t + 1);
        const periodicBox box(3, 16, 0.2, "cubic", 1);
        const List<vec4> phi = box.field([](const vector& x) {
            return vec4{{std::sin(x[0]), x[1] * x[2], x[2], x[0] * x[1]}};
        });
        grad[t] = sphc::grad(box.stencil(), phi, gradientScheme::correctedDifference);
        div[t] = sphc::div(box.stencil(), phi, divergenceScheme::corrected);
    }
    setThreads(before);
    CHECK(div[0] == div[1]);
    for (size_t i = 0; i < grad[0].size(); ++i)
        for (int c = 0; c < 3; ++c) REQUIRE(grad[0][i][c] == grad[1][i][c]);
}

TEST_CASE("a flow that sticks to a wall has no divergence next to it, and little of it is mirrored")
{
    // u = y (x, -y/2): shear that grows along the wall y = 0
    constexpr scalar dx = 0.1;
    particleCloud cloud;
    cloud.nDims = 2, cloud.dx = dx;
    cloud.zones = {{"fluid", phaseType::fluid, false}};
    for (int row = 0; row < 8; ++row)
        for (int column = -10; column < 10; ++column)
        {
            const scalar x = (column + 0.5) * dx, y = (row + 0.5) * dx;
            cloud.append({x, y, 0}, 0, vec4::from({x * y, -0.5 * y * y, 0}), cloud.nextId());
        }
    for (int row = 0; row < 3; ++row)
        for (int column = -10; column < 10; ++column)
        {
            const scalar x = (column + 0.5) * dx;
            cloud.addRigid({x, -(row + 0.5) * dx, 0}, {0, 0, 0}, {x, 0, 0});
        }
    neighbourList list;
    kernelCorrection B;
    list.build(cloud, *smoothingKernel::New("WendlandC2", 2, 1.3 * dx)), B.build(cloud, list);
    cloud.fillGhosts(cloud.Up, false);
    const auto corrected = divergenceScheme::corrected;
    const List<vec4> none(cloud.nAll());
    const List<scalar> div = sphc::div({cloud, list, B}, cloud.Up, corrected),
                       sticks = sphc::wallReflection({cloud, list, B}, none, cloud.Up, corrected);
    // towards the wall, with all its speed
    List<vec4> towards(cloud.nAll());
    for (label i = 0; i < cloud.n(); ++i) towards[i] = vec4::from({0, -1, 0});
    const List<scalar> once = sphc::div({cloud, list, B}, towards, corrected),
                       again = sphc::wallReflection({cloud, list, B}, none, towards, corrected),
                       change = sphc::wallReflection({cloud, list, B}, towards, none, corrected);
    for (label i = 0; i < cloud.n(); ++i)
    {
        if (std::abs(cloud.x[i][0]) > 7 * dx || cloud.x[i][1] > 5 * dx)
            continue;  // beside the ends
        CHECK(std::abs(div[i]) < 0.025 * dx);
        CHECK(std::abs(sticks[i]) < 0.035 * dx);  // 0.06 dx if all of it were mirrored
        CHECK(again[i] == doctest::Approx(once[i]));
        CHECK(change[i] == doctest::Approx(once[i]));
        if (cloud.x[i][1] < dx) CHECK(once[i] < -0.3 / dx);
    }
}
