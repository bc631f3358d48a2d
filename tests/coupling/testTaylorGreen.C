// SPDX-License-Identifier: GPL-3.0-or-later
// Taylor-Green vortices in a periodic box against their exact decay:
//     u = -cos kx sin ky e, v = sin kx cos ky e, p = -rho/4 (cos 2kx + cos 2ky) e^2,
//     e = exp(-2 nu k^2 t), k = 2 pi
// and the same flow uniform in z in three dimensions.
#include "particleShifting.H"
#include "periodicBox.H"
#include "projectionStep.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar k = 2 * M_PI, Re = 100;

vec4 exact(const vector& x, scalar t)
{
    const scalar e = std::exp(-2 * k * k * t / Re);
    return vec4{simd4{-std::cos(k * x[0]) * std::sin(k * x[1]) * e,
                      std::sin(k * x[0]) * std::cos(k * x[1]) * e, 0,
                      -0.25 * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1])) * e * e}};
}

struct vortexRun
{
    word viscosity = "explicit", shifting = "type Xu;", solution;
    operatorSchemes schemes;
    scalar Co = 0.2;

    struct errors
    {
        scalar U, p, energy;  // relative; energy: signed, in kinetic energy
    };

    errors run(periodicBox& box, scalar endTime) const
    {
        particleCloud& cloud = box.cloud;
        const label nSteps = label(std::ceil(endTime / (Co * cloud.dx)));
        const scalar dt = endTime / nSteps;
        for (label i = 0; i < cloud.n(); ++i)
            cloud.Up[i] = vec4::from(exact(cloud.x[i].xyz(), 0).xyz());
        projectionStep step(1, 1 / Re, viscosity, schemes, dictionary::fromString(solution));
        const particleShifting shift(dictionary::fromString(shifting));
        for (label n = 0; n < nSteps; ++n)
        {
            box.update();
            step.predict(cloud, box.stencil(), List<vec4>(cloud.n()), dt);
            step.project(cloud, box.stencil(), {}, box.kernel->support(), dt);
            cloud.checkFinite(n * dt);
            shift.shift(cloud, box.list, box.B, dt, nullptr);
            for (label i = 0; i < cloud.n(); ++i)
                cloud.x[i].s += dt * simd4{cloud.Up[i][0], cloud.Up[i][1], cloud.Up[i][2], 0};
        }
        return compare(cloud, endTime);
    }

    static errors compare(const particleCloud& cloud, scalar t)
    {
        scalar pMean = 0, dU = 0, U2 = 0, dp = 0, p2 = 0, energy = 0;
        for (label i = 0; i < cloud.n(); ++i) pMean += cloud.Up[i][3] / cloud.n();
        for (label i = 0; i < cloud.n(); ++i)
        {
            const vec4 e = exact(cloud.x[i].xyz(), t);
            dU += (cloud.Up[i].xyz() - e.xyz()).squaredNorm(), U2 += e.xyz().squaredNorm();
            dp += std::pow(cloud.Up[i][3] - pMean - e[3], 2), p2 += e[3] * e[3];
            energy += cloud.Up[i].xyz().squaredNorm();
        }
        MESSAGE("L2 U " << std::sqrt(dU / U2) << ", p " << std::sqrt(dp / p2) << ", energy "
                        << energy / U2 - 1);
        return {std::sqrt(dU / U2), std::sqrt(dp / p2), energy / U2 - 1};
    }
};

}  // namespace

TEST_CASE("Taylor-Green in 2D at Re 100, 32 x 32")
{
    periodicBox box(2, 32, 0, "WendlandC2", 1.3);
    const auto e = vortexRun().run(box, 0.5);
    CHECK(e.U < 0.025);
    CHECK(e.p < 0.05);
}
