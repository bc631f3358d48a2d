// SPDX-License-Identifier: GPL-3.0-or-later
// The coupled system compared with a direct solution, and a thick ring inflated by its inner fluid
#include "FGMRES.H"
#include "elasticRing.H"
#include "luSolver.H"
#include "monolithicPreconditioner.H"
#include "coupledSystem.H"
#include "relative.H"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::elasticRing;

namespace
{

word ofModulus(scalar G)
{
    return "structureModel springNetwork; E " + str(3 * G, 17) + "; links radius; radius 2.6;";
}

// Mean of r^2 - R^2 over the layer of solids with rest radius in [from, to]
scalar areaChange(const particleCloud& cloud, scalar from, scalar to)
{
    scalar sum = 0;
    label n = 0;
    for (label i = 0; i < cloud.nSolid(); ++i)
    {
        const scalar R = cloud.vectors.at("x0")[i].xyz().norm();
        if (R < from || R > to) continue;
        sum += cloud.x[i].xyz().squaredNorm() - R * R, ++n;
    }
    return M_PI * sum / n;
}

struct inflated
{
    scalar inner, outer;  // area added, as a part of the stroke
    scalar wall;          // mean J - 1
    scalar pressure;      // of the inner fluid over the law of such a ring
};

// The modulus that springs of few layers reach, from their description: 0.978 of the requested one with four
scalar modulusOf(const structureModel& structure)
{
    const word text = structure.description(), before = "mean modulus ";
    return structure.shearModulus() * std::stod(text.substr(text.find(before) + before.size()));
}

// Adds 25 % to the inner area in 50 steps at constant rate, with the given c_s dt/dx and volumeFeedback
inflated inflate(const word& name, scalar courant, const word& feedback)
{
    constexpr scalar dt = 0.01, stroke = 0.25 * M_PI * innerRadius * innerRadius;
    ringCase ring(name, ofModulus(std::pow(courant * dx / dt, 2)));
    setContent(ring.files.path() + "/system/sphSolution",
               "coupling monolithic; monolithic { volumeFeedback " + feedback + "; }");
    capturedLog log;
    Time time(ring.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    for (int step = 0; step < 50; ++step)
    {
        addArea(c, stroke / 50 / dt);
        runSteps(c, *scheme, dt, 1);
    }
    List<tensor> F;
    c.structure->deformationGradient(c.cloud.x, F);
    scalar J = 0;
    for (const tensor& f : F) J += f.determinant() / scalar(F.size());
    return {areaChange(c.cloud, innerRadius, innerRadius + 0.08) / stroke,
            areaChange(c.cloud, outerRadius - 0.08, outerRadius) / stroke, J - 1,
            innerPressure(c.cloud) / neoHookean(modulusOf(*c.structure), stroke)};
}

// The system of the ring in the first step
struct firstStep
{
    capturedLog log;
    Time time;
    fsiCase c;
    List<tensor> F;
    blockMatrix3 K;
    List<scalar> stiffness;
    solidSurface surface;
    volumeConstraint volume;
    coupledSystem system;

    explicit firstStep(const ringCase& ring)
        : time(ring.files.path()), c(time), volume(*c.structure), system(c)
    {
        c.updateNeighbours(0, 0.01);
        c.structure->deformationGradient(c.cloud.x, F);
        K = c.structure->tangentPattern();
        c.structure->assembleTangent(c.cloud.x, tangentKind::positive, K);
        for (const tensor& diagonal : K.diagonal)
            stiffness.push_back(diagonal.trace() / c.cloud.nDims);
        surface.initialise(c.cloud, c.list, F);
        volume.setup(F);
        surface.setup(c.cloud, c.list, *c.kernel, volume.cofactor());
        setup();
    }
    void setup() { system.setup(0.01, &volume, &surface, &K, &stiffness); }
};

}  // namespace

TEST_CASE("the coupled system solved by FGMRES agrees with a direct solution")
{
    const ringCase ring("monolithicDirect", ofModulus(1e4));
    firstStep first(ring);
    fsiCase& c = first.c;
    coupledSystem& system = first.system;
    List<vec4> force;
    c.structure->force(c.cloud.x, force);
    monolithicPreconditioner M(system, monolithicPreconditioner::entries(dictionary()));
    M.setup();
    List<scalar> q(c.cloud.n(), 0), b;
    for (label i = 0; i < c.cloud.n(); ++i)
        if (c.cloud.zone[i] >= ringZone) q[i] = profile(c.cloud.zone[i] - ringZone);
    system.rightHandSide(0.95, force, q, b);

    luSolver direct;
    direct.factorise(csrMatrix::fromOperator(system));
    List<scalar> exact(b.size()), x(b.size(), 0);
    direct.apply(b, exact);
    solverControls controls;
    controls.tolerance = 1e-10, controls.maxIter = 200;
    FGMRES solver(controls, "Up", 200);
    const solverPerformance result = solver.solve(system, M, b, x);
    CHECK(result.converged);
    CHECK(result.nIterations < 80);
    scalar error[2] = {}, size[2] = {};  // of velocity and pressure
    for (size_t k = 0; k < x.size(); ++k)
    {
        const bool isP = k % 4 == 3;
        error[isP] = std::max(error[isP], std::abs(x[k] - exact[k]));
        size[isP] = std::max(size[isP], std::abs(exact[k]));
    }
    CHECK(error[0] < 1e-6 * size[0]);
    CHECK(error[1] < 1e-6 * size[1]);
}

TEST_CASE(
    "what the surface's areas miss over a step is put in in the next, within the ring and evenly")
{
    const ringCase ring("enclosedRing", ofModulus(1e4));
    firstStep first(ring);
    fsiCase& c = first.c;
    enclosedFluid& enclosed = first.system.enclosed();
    const auto inner = [&](label i) { return c.cloud.isFluid(i) && c.cloud.zone[i] >= ringZone; };
    label n = 0;
    for (label i = 0; i < c.cloud.n(); ++i) n += inner(i);

    // u = x: in the time dt the radius of the ring grows by the factor 1 + dt, the mean of its area by 1 + dt/2
    constexpr scalar dt = 0.1;
    for (label i = 0; i < c.cloud.nSolid(); ++i) c.cloud.Up[i] = vec4::from(c.cloud.x[i].xyz());
    List<scalar> q(c.cloud.n(), 0), dJ;
    List<tensor> dF;
    first.volume.rate(c.cloud.Up, dJ, dF);
    List<char> within(c.cloud.zones.size(), 0);
    for (size_t z = 0; z < within.size(); ++z)
        within[z] = label(z) >= ringZone && c.cloud.zones[z].phase == phaseType::fluid;
    scalar gives = 0;
    List<scalar> div(c.cloud.n(), 0);
    first.surface.addFlux(c.cloud.Up, dF, div);
    for (label i = 0; i < c.cloud.n(); ++i)
        if (within[c.cloud.zone[i]] && c.cloud.isFluid(i)) gives += div[i] * c.cloud.volume();
    CHECK(std::abs(gives) > 0.1);
    CHECK(std::abs(first.surface.missed(c.cloud.Up, dF, 0, within)) < 1e-9 * std::abs(gives));
    CHECK(first.surface.missed(c.cloud.Up, dF, dt, within) == relative(-dt / 2 * gives, 1e-9));
    enclosed.addDefect(q);
    enclosed.account(c.cloud, dt, dF, dt);
    CHECK(enclosedFluid::added(c.cloud) == 0);  // nothing yet

    first.setup();
    q.assign(c.cloud.n(), 0);
    enclosed.addDefect(q);
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        if (inner(i)) CHECK(q[i] * n * dx * dx == relative(-dt / 2 * gives, 1e-9));
        else CHECK(q[i] == 0);
    }
    enclosed.account(c.cloud, dt, dF, 0);
    CHECK(enclosedFluid::added(c.cloud) == relative(-dt / 2 * gives * dt, 1e-9));
    enclosed.makeGood(false);
    q.assign(c.cloud.n(), 0);
    enclosed.addDefect(q);
    CHECK(*std::max_element(q.begin(), q.end()) == 0);
    CHECK(*std::min_element(q.begin(), q.end()) == 0);
}

TEST_CASE(
    "a thick ring inflated by a quarter: same shape at c_s dt/dx = 1 and 300, wall volume kept")
{
    // volumes are tested without feedback, because a controlled volume proves nothing; the stiff wall's pressure is tested
    // with it, as in cases: without it the error is 2.9 %
    const inflated soft = inflate("ringSoft", 1, "0"), stiff = inflate("ringStiff", 300, "0");
    CHECK(std::abs(soft.wall) < 0.005);
    CHECK(std::abs(stiff.wall) < 0.005);
    for (const scalar area : {soft.inner, soft.outer, stiff.inner, stiff.outer})
        CHECK(std::abs(area - 1) < 0.015);
    const scalar stiffPressure = inflate("ringFeedback", 300, "0.1").pressure;
    for (const scalar pressure : {soft.pressure, stiffPressure})
        CHECK(std::abs(pressure - 1) < 0.01);
    // single layers of a lattice ring scatter by 1 %, and its surface is extrapolated from them
    CHECK(std::abs(soft.inner - stiff.inner) < 0.01);
    CHECK(std::abs(soft.outer - stiff.outer) < 0.01);
}
