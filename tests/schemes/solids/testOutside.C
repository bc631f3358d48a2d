// SPDX-License-Identifier: GPL-3.0-or-later
// A ring of neo-Hookean solid, inflated by the fluid inside, with nothing but a pressure and tissue around it
#include "elasticRing.H"
#include "core/errorOf.H"
#include "energyLedger.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::elasticRing;

namespace
{

constexpr scalar G = 1e4, area = M_PI * innerRadius * innerRadius, dt = 0.01;

word solid(const word& outside)
{
    return "structureModel totalLagrangian; material { type neoHookean; G 1e4; } " + outside;
}

struct inflation
{
    scalar pressure;   // of the inner fluid [Pa]
    scalar mostMoved;  // of the solid's particles [m]
};

// Adds the share of the inner area at a constant rate in 50 steps
inflation inflate(const word& outside, scalar share, const word& files = "outside")
{
    const ringCase ring(files, solid(outside), false);
    capturedLog log;
    Time time(ring.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    for (int step = 0; step < 50; ++step)
    {
        if (share != 0) addArea(c, share * area / 50 / dt);
        runSteps(c, *scheme, dt, 1);
    }
    scalar most = 0;
    for (label i = 0; i < c.cloud.nSolid(); ++i)
        most = std::max(most, (c.cloud.x[i].s - c.cloud.vectors.at("x0")[i].s)[0]);
    return {innerPressure(c.cloud), most};
}

// Outer radius once `share` of the inner area has been added
scalar outer(scalar share)
{
    return std::sqrt(outerRadius * outerRadius + share * innerRadius * innerRadius);
}

}  // namespace

TEST_CASE(
    "the same pressure outside a closed ring: it is that of the fluid inside, and nothing moves")
{
    const inflation r = inflate("outside { pressure 5000; }", 0);
    CHECK(r.pressure == relative(5000, 0.01));
    CHECK(r.mostMoved < 0.05 * dx);  // a circle of lattice places: its area vectors do not close
}

TEST_CASE(
    "an inflated ring: a pressure, springs and dampers outside add what they should to the "
    "pressure inside")
{
    const scalar share = 0.25, r = outer(share);
    const scalar alone = inflate("", share).pressure;
    const scalar pressed = inflate("outside { pressure 4000; }", share).pressure;
    CHECK(pressed - alone == relative(4000, 0.02));
    // tissue holds the surface itself, per area at rest: it works as p dV there
    const scalar atRest = outerRadius / r, lattice = 0.05;  // a lattice ring is no circle
    const scalar held = inflate("outside { stiffness 5e4; }", share).pressure;
    CHECK(held - alone == relative(5e4 * (r - outerRadius) * atRest, lattice));
    const scalar damped = inflate("outside { damping 5e4; }", share).pressure;
    CHECK(damped - alone ==
          relative(5e4 * share * area / (50 * dt) / (2 * M_PI * r) * atRest, lattice));
}

// The level of the given p is taken off before the step: the area vectors of the ring do not add up to zero exactly
TEST_CASE("a soft ring in a bath: the level of the pressure, 5 G, neither moves nor strains it")
{
    const auto shape = [](const word& p) {
        ringCase ring("level", solid(""));
        ring.files.boundary = "outside { type open; p " + p + "; }";
        ring.files.write();
        setContent(ring.files.path() + "/constant/structureProperties", solid(""));
        capturedLog log;
        Time time(ring.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        for (int step = 0; step < 20; ++step)
        {
            addArea(c, 0.1 * area / 20 / dt);
            runSteps(c, *scheme, dt, 1);
        }
        return std::make_pair(List<vec4>(c.cloud.x.begin(), c.cloud.x.begin() + c.cloud.nSolid()),
                              innerPressure(c.cloud));
    };
    const auto [zero, p0] = shape("0");
    for (const word& p : {word("5e4"), word("table ((0 0) (0.1 5e4) (0.2 3e4))")})
    {
        CAPTURE(p);
        const auto [x, inner] = shape(p);
        scalar most = 0;
        for (size_t i = 0; i < x.size(); ++i)
            most = std::max(most, (x[i].xyz() - zero[i].xyz()).norm());
        CHECK(most < 1e-3 * dx);
        CHECK(inner - (p == "5e4" ? 5e4 : 3e4) == relative(p0, 0.01));
    }
}

TEST_CASE("an entry outside that has no effect is refused")
{
    for (const bool bath : {true, false})
    {
        const ringCase ring("effect", solid(bath ? "outside { pressure 1; }" : "outside {}"), bath);
        capturedLog log;
        Time time(ring.files.path());
        fsiCase c(time);
        CHECK_ERROR(runSteps(c, *couplingScheme::New(c), dt, 1),
                    bath ? "there is no such place here" : "It has no entry and no effect", 1);
    }
}

TEST_CASE("projection refuses a solid with fluid on one side and nothing on the other")
{
    for (const bool bath : {true, false})
    {
        ringCase ring("bare", "structureModel springNetwork; E 100; links radius; radius 2.1;",
                      bath);
        ring.files.solution = "coupling projection;";
        ring.files.write();
        setContent(ring.files.path() + "/constant/structureProperties",
                   "structureModel springNetwork; E 100; links radius; radius 2.1;");
        capturedLog log;
        Time time(ring.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        CHECK_ERROR(runSteps(c, *scheme, 1e-4, 1),
                    bath ? "no error" : "Neither fluid nor wall is before the solid", 0);
    }
}

// The pressure of the fluid is counted from its hydrostatic part; nothing around the ring is a pressure of zero all the same
TEST_CASE("gravity: a ring with nothing around it is as one with no pressure around it")
{
    const auto fall = [](const word& outside) {
        ringCase ring("gravity", solid(outside), false);
        ring.files.g = "(0 -50 0)";
        ring.files.write();
        setContent(ring.files.path() + "/constant/structureProperties", solid(outside));
        capturedLog log;
        Time time(ring.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, dt, 10);
        return c.cloud.Up[0][1];
    };
    const scalar fallen = fall("");
    CHECK(fallen == relative(-50 * 10 * dt, 0.02));
    CHECK(fallen == relative(fall("outside { pressure 0; }"), 1e-6));
}

// Viscosity eta in a wall that is inflated at the rate A of the inner area: the integral of 4 eta v/r dr/r with v = A/(2 pi r).  A ring
// of four layers on a lattice has a tenth less pressure than a round one, of either kind: the test is of their ratio
TEST_CASE("a viscous wall: the pressure that its inflation needs beside that of the elastic wall")
{
    constexpr scalar share = 0.2, eta = 2e3, rate = share * area / (50 * dt);
    const auto pressure = [&](const word& viscosity) {
        const ringCase ring(
            "viscousWall",
            "structureModel totalLagrangian; material { type neoHookean; G 1e4; " + viscosity + "}",
            false);
        capturedLog log;
        Time time(ring.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        for (int step = 0; step < 50; ++step)
        {
            addArea(c, rate);
            runSteps(c, *scheme, dt, 1);
        }
        return innerPressure(c.cloud);
    };
    const scalar in = std::sqrt(1 + share), out = outer(share);
    const scalar viscous = eta * rate / M_PI * (1 / (in * in) - 1 / (out * out));
    const auto law = [](scalar stretch) {
        return 1e4 * (std::log(stretch) - 0.5 / (stretch * stretch));
    };
    const scalar elastic = law(in / innerRadius) - law(out / outerRadius);
    const scalar found = pressure(""), both = pressure("viscosity 2e3;");
    CHECK(found == relative(elastic, 0.1));
    CHECK((both - found) / found == relative(viscous / elastic, 0.05));
}

TEST_CASE("a pressure outside that changes over time does its work: the energy ledger has it")
{
    const ringCase ring("outsideWork", solid("outside { pressure table ((0 0) (0.5 3000)); }"),
                        false);
    capturedLog log;
    Time time(ring.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    for (int step = 0; step < 50; ++step)
    {
        addArea(c, 0.2 * area / 50 / dt);
        runSteps(c, *scheme, dt, 1);
    }
    // - p dV over the outer area, which grows by as much as the inner one: p rises linearly, so does V
    const List<scalar> sums = c.cloud.state.values().at("energyLedger");
    CHECK(sums.at(3 + energyLedger::forces) == relative(-0.5 * 3000 * 0.2 * area, 0.04));
}

TEST_CASE("outside: a wrong entry and the wrong coupling are told")
{
    CHECK_ERROR(inflate("outside { stiffness -1; }", 0, "outsideWrong"), "stiffness", 0);
    CHECK_ERROR(inflate("outside { presure 1; }", 0, "outsideWrong"), "Valid are: pressure", 0);
    const auto projected = [] {
        const ringCase r("outsideProjection", solid("outside { pressure 1; }"), false);
        setContent(r.files.path() + "/system/sphSolution", "coupling projection;");
        capturedLog quiet;
        Time t(r.files.path());
        fsiCase cc(t);
        couplingScheme::New(cc);
    };
    CHECK_ERROR(projected(), "coupling monolithic", 0);
}
