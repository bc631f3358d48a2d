// SPDX-License-Identifier: GPL-3.0-or-later
// Start-up of plane Poiseuille and Couette flow compared with the series of Morris, Fox & Zhu 1997, for both
// kinds of wall: H = 1 mm, nu = 1e-6 m2/s, F = 1e-4 m/s2 or lid speed 1.25e-5 m/s.
#include "capturedLog.H"
#include "channel.H"
#include "viscousLoss.H"
#include "particleShifting.H"
#include "fractionalStep.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar H = 1e-3, nu = 1e-6, F = 1e-4, lid = 1.25e-5;

scalar poiseuille(scalar y, scalar t)
{
    scalar u = F * y * (H - y) / (2 * nu);
    for (int m = 1; m < 200; m += 2)
        u -= 4 * F * H * H / (nu * std::pow(m * M_PI, 3)) * std::sin(m * M_PI * y / H) *
             std::exp(-std::pow(m * M_PI / H, 2) * nu * t);
    return u;
}

scalar couette(scalar y, scalar t)
{
    scalar u = lid * y / H;
    for (int m = 1; m < 200; ++m)
        u += 2 * lid / (m * M_PI) * (m % 2 ? -1 : 1) * std::sin(m * M_PI * y / H) *
             std::exp(-std::pow(m * M_PI / H, 2) * nu * t);
    return u;
}

void advance(channel& ch, const word& viscosity, const vector& force, scalar dt, label nSteps)
{
    capturedLog log;
    fractionalStep step(1000, 1000 * nu, viscosity, dictionary::fromString(""));
    const particleShifting shifting(dictionary::fromString(""));
    const List<vec4> a(ch.cloud.n(), vec4::from(force));
    for (label n = 0; n < nSteps; ++n)
    {
        ch.update();
        step.setup(ch.cloud, ch.stencil(), *ch.kernel);
        step.predict(ch.cloud, ch.stencil(), a, dt);
        step.project(ch.cloud, ch.stencil(), {}, ch.kernel->support(), dt);
        shifting.shift(ch.cloud, ch.list, ch.B, dt, viscousLoss(ch.cloud, ch.stencil(), nu * dt),
                       nullptr);
        for (label i = 0; i < ch.cloud.n(); ++i)
            ch.cloud.x[i].s += dt * vec4::from(ch.cloud.Up[i].xyz()).s;
    }
}

// Largest error over the largest exact speed
template <class Exact>
scalar worst(const channel& ch, Exact&& exact, scalar t)
{
    scalar error = 0, top = 0;
    for (label i = 0; i < ch.cloud.n(); ++i)
    {
        const scalar u = exact(ch.cloud.x[i][1], t);
        error = std::max(error, (ch.cloud.Up[i].xyz() - vector(u, 0, 0)).norm());
        top = std::max(top, u);
    }
    return error / top;
}

}  // namespace

TEST_CASE("Poiseuille start-up with mirror and with rigid walls, 20 particles across")
{
    for (const channelWall wall : {channelWall::mirror, channelWall::rigid})
    {
        channel ch(20, 10, H, wall);
        // the profile bends most at first: 0.9 and 1.0 % of the present peak, in the layer beside
        // the wall, a quarter of that with twice the particles
        advance(ch, "explicit", {F, 0, 0}, 2e-4, 225);
        const scalar error = worst(ch, poiseuille, 0.045);
        CHECK(error < 0.01);
        channel fine(40, 5, H, wall);
        advance(fine, "explicit", {F, 0, 0}, 1e-4, 450);
        CHECK(worst(fine, poiseuille, 0.045) < 0.3 * error);
        advance(ch, "implicit", {F, 0, 0}, 5e-3, 91);
        CHECK(worst(ch, poiseuille, 0.5) < 0.01);
    }
}

TEST_CASE("Poiseuille flow converges with the second order, and does not slip")
{
    scalar error[2];
    for (const int fine : {0, 1})
    {
        channel ch(fine ? 32 : 16, 10, H, channelWall::mirror);
        advance(ch, "implicit", {F, 0, 0}, 0.05, 40);  // steady: the time step does not count
        error[fine] = worst(ch, poiseuille, 2.0);
    }
    CHECK(error[0] < 0.01);
    CHECK(error[1] < 0.3 * error[0]);
}

TEST_CASE("Couette start-up, disordered particles")
{
    for (const channelWall wall : {channelWall::mirror, channelWall::rigid})
    {
        channel ch(20, 10, H, wall, 0.1);
        ch.topVelocity = {lid, 0, 0};
        advance(ch, "implicit", vector::Zero(), 2e-3, 112);
        CHECK(worst(ch, couette, 0.224) < 0.02);
    }
}

TEST_CASE("explicit and implicit viscosity agree as the step shrinks")
{
    channel a(16, 10, H, channelWall::rigid), b(16, 10, H, channelWall::rigid);
    advance(a, "explicit", {F, 0, 0}, 1e-4, 50);
    advance(b, "implicit", {F, 0, 0}, 1e-4, 50);
    scalar most = 0, difference = 0;
    for (label i = 0; i < a.cloud.n(); ++i)
    {
        most = std::max(most, a.cloud.Up[i].xyz().norm());
        difference = std::max(difference, (a.cloud.Up[i].xyz() - b.cloud.Up[i].xyz()).norm());
    }
    CHECK(difference < 0.01 * most);
}
