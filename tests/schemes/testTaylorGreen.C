// SPDX-License-Identifier: GPL-3.0-or-later
// Taylor-Green vortices in a periodic box compared with their exact decay:
//     u = -cos kx sin ky e, v = sin kx cos ky e, p = -rho/4 (cos 2kx + cos 2ky) e^2,
//     e = exp(-2 nu k^2 t), k = 2 pi
// and the same flow in three dimensions, uniform in z.
#include "capturedLog.H"
#include "particleShifting.H"
#include "viscousLoss.H"
#include "periodicBox.H"
#include "fractionalStep.H"

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
    scalar Co = 0.2;

    struct errors
    {
        scalar U, p, energy;  // relative; energy: signed, in kinetic energy
    };

    errors run(periodicBox& box, scalar endTime) const
    {
        capturedLog log;
        const label nSteps = label(std::ceil(endTime / (Co * box.cloud.dx)));
        begin(box.cloud);
        for (label n = 0; n < nSteps; ++n) advance(box, endTime / nSteps);
        return compare(box.cloud, endTime);
    }

    static void begin(particleCloud& cloud)
    {
        for (label i = 0; i < cloud.n(); ++i)
            cloud.Up[i] = vec4::from(exact(cloud.x[i].xyz(), 0).xyz());
    }

    void advance(periodicBox& box, scalar dt) const
    {
        particleCloud& cloud = box.cloud;
        fractionalStep step(1, 1 / Re, viscosity, dictionary::fromString(solution));
        const particleShifting shift(dictionary::fromString(shifting));
        box.update();
        step.setup(cloud, box.stencil(), *box.kernel);
        step.predict(cloud, box.stencil(), List<vec4>(cloud.n()), dt);
        step.project(cloud, box.stencil(), {}, box.kernel->support(), dt);
        step.settle(cloud, box.kernel->support(), dt);
        cloud.checkFinite(0);
        shift.shift(cloud, box.list, box.B, dt, viscousLoss(cloud, box.stencil(), dt / Re),
                    nullptr);
        for (label i = 0; i < cloud.n(); ++i)
            cloud.x[i].s += dt * simd4{cloud.Up[i][0], cloud.Up[i][1], cloud.Up[i][2], 0};
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
        return {std::sqrt(dU / U2), std::sqrt(dp / p2), energy / U2 - 1};
    }
};

}  // namespace

TEST_CASE("Taylor-Green in 2D at Re 100")
{
    periodicBox box(2, 50, 0, "WendlandC2", 1.3);
    vortexRun vortex;
    vortex.Co = 0.1;
    const auto e = vortex.run(box, 0.5);
    CHECK(e.U < 0.012);
    CHECK(e.p < 0.03);
    CHECK(std::abs(e.energy) < 0.016);
}

TEST_CASE("the error of Taylor-Green is of first order in time")
{
    scalar error[2];
    for (const int fine : {0, 1})
    {
        periodicBox box(2, 32, 0, "WendlandC2", 1.3);
        vortexRun vortex;
        vortex.Co = fine ? 0.1 : 0.2;
        error[fine] = vortex.run(box, 0.3).U;
    }
    CHECK(error[0] < 0.03);
    CHECK(error[1] < 0.6 * error[0]);
}

TEST_CASE("a reflection leaves the step's damping away: dt/2 |grad p|^2/rho of a projection")
{
    // of the kinetic energy e^2/4; the mean of |grad p|^2 is pi^2 e^4
    const scalar endTime = 0.3, rate = 2 * k * k / Re, Co = 0.1, dt = Co / 32;
    const scalar damping = 2 * dt * M_PI * M_PI * (1 - std::exp(-2 * rate * endTime)) / (2 * rate);
    scalar energy[3];
    for (const int halves : {0, 1, 2})
    {
        periodicBox box(2, 32, 0, "WendlandC2", 1.3);
        vortexRun vortex;
        vortex.Co = Co;
        vortex.solution = "projection { reflection " + std::to_string(0.5 * halves) + "; }";
        const auto e = vortex.run(box, endTime);
        CHECK(e.U < (halves ? 0.01 : 0.015));
        energy[halves] = e.energy;
    }
    CHECK(energy[1] - energy[0] == doctest::Approx(0.5 * damping).epsilon(0.15));
    CHECK(energy[2] - energy[0] == doctest::Approx(damping).epsilon(0.15));
}

TEST_CASE("p is that of the flow from the first step on, and the second after the step has changed")
{
    for (const word reflection : {"0", "0.5", "1"})
    {
        CAPTURE(reflection);
        capturedLog log;
        periodicBox box(2, 32, 0, "WendlandC2", 1.3);
        vortexRun vortex;
        vortex.solution = "projection { reflection " + reflection + "; }";
        vortexRun::begin(box.cloud);
        scalar t = 0, before = 2e-3;
        for (const scalar dt : {2e-3, 2e-3, 1e-3, 1e-3, 3e-3, 3e-3})
        {
            vortex.advance(box, dt);
            const scalar error = vortexRun::compare(box.cloud, t += dt).p;
            // p of a step belongs to the motion before it, divided by the length of this step
            CHECK(error < (dt == before ? 0.08 : 1.1 * std::abs(before / dt - 1)));
            before = dt;
        }
    }
}

TEST_CASE("Taylor-Green fails without shifting")
{
    periodicBox box(2, 32, 0, "WendlandC2", 1.3);
    vortexRun vortex;
    vortex.shifting = "type none;";
    CHECK(vortex.run(box, 0.5).U > 0.1);
}

TEST_CASE("Taylor-Green in 3D at Re 100, implicit viscosity, other solvers")
{
    periodicBox box(3, 24, 0.1, "cubic", 1);
    vortexRun vortex;
    vortex.viscosity = "implicit", vortex.Co = 0.1;
    vortex.solution =
        "solvers { p { solver PBiCGStab; preconditioner DILU; tolerance 1e-6; } "
        "U { solver PBiCGStab; tolerance 1e-8; } }";
    const auto e = vortex.run(box, 0.2);
    CHECK(e.U < 0.04);
    CHECK(e.p < 0.1);
    CHECK(std::abs(e.energy) < 0.05);
    scalar across = 0;
    for (label i = 0; i < box.cloud.n(); ++i)
        across += box.cloud.Up[i][2] * box.cloud.Up[i][2] / box.cloud.n();
    CHECK(std::sqrt(across) < 0.02);
}

TEST_CASE("a step does not depend on the number of threads")
{
    const int before = nThreads();
    List<vec4> Up[2];
    for (const int t : {0, 1})
    {
        setThreads(t + 1);
        periodicBox box(3, 16, 0.1, "cubic", 1);
        vortexRun vortex;
        vortex.viscosity = "implicit";
        vortex.run(box, 0.03);
        Up[t] = box.cloud.Up;
    }
    setThreads(before);
    for (size_t i = 0; i < Up[0].size(); ++i)
        for (int c = 0; c < 4; ++c) REQUIRE(Up[0][i][c] == Up[1][i][c]);
}
