// SPDX-License-Identifier: GPL-3.0-or-later
#include "boxWorld.H"
#include "relative.H"
#include "viscousPairs.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// {u, v, w, p} = A x, periodic except for its jump
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
    scalar squaredTrace() const
    {
        const tensor gradU = A.topRows<3>();
        return (gradU * gradU).trace();
    }
};

periodicBox linearBox(int nDims, int n, const linearField& f)
{
    periodicBox box(nDims, n, 0.2, "WendlandC2", 1.3);
    box.jump = f.A;
    box.update();
    return box;
}

List<vec4> laplacian(const periodicBox& box, const List<vec4>& phi)
{
    viscousPairs viscous;
    viscous.setup(box.stencil());
    List<vec4> lap;
    viscous.apply(phi, lap);
    for (vec4& a : lap) a.s *= -2;
    return lap;
}

}  // namespace

TEST_CASE("the trace of (grad u)^2 is exact on linear fields, disordered, over images")
{
    for (const int nDims : {2, 3})
    {
        const linearField f(nDims);
        const periodicBox box = linearBox(nDims, nDims == 2 ? 16 : 9, f);
        for (const scalar trace : sphc::gradSquaredTrace(box.stencil(), box.field(f)))
            CHECK(trace == relative(f.squaredTrace(), 1e-11));
    }
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
        const List<vec4> lap = laplacian(box, phi);
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
    List<vec4> lap[2], grad[2];
    List<scalar> div[2], trace[2];
    for (const int t : {0, 1})
    {
        setThreads(t + 1);
        const auto box = std::make_shared<periodicBox>(3, 16, 0.2, "cubic", 1);
        boxWorld::world w = boxWorld::world::of("", nullptr, box, *box);
        w.setup();
        const List<vec4> phi = box->field([](const vector& x) {
            return vec4{{std::sin(x[0]), x[1] * x[2], x[2], x[0] * x[1]}};
        });
        lap[t] = laplacian(*box, phi);
        grad[t] = w.gradient(phi), div[t] = w.divergence(phi);
        trace[t] = sphc::gradSquaredTrace(box->stencil(), phi);
    }
    setThreads(before);
    CHECK(div[0] == div[1]);
    CHECK(trace[0] == trace[1]);
    for (size_t i = 0; i < grad[0].size(); ++i)
        for (int c = 0; c < 3; ++c)
        {
            REQUIRE(grad[0][i][c] == grad[1][i][c]);
            REQUIRE(lap[0][i][c] == lap[1][i][c]);
        }
}
