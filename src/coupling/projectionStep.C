// SPDX-License-Identifier: GPL-3.0-or-later
#include "projectionStep.H"

#include "worstRow.H"

#include <ostream>

namespace ispf
{

namespace
{

// Cell Reynolds number at which half of u^n is mirrored in walls
constexpr scalar smoothed = 10;

// Step [dx^2/nu] at which walls go ahead of p by half
constexpr scalar farthest = 12;

const char* const defaultPressureSolver =
    "solver PCG; preconditioner multigrid; tolerance 1e-6; relTol 0; maxIter 200;";

// Largest, of what sees rigid particles, relative to them
scalar speedAlongWalls(const stencil& s)
{
    const particleCloud& cloud = s.cloud;
    return std::sqrt(maxOf(cloud.n(), [&](label begin, label end) {
        scalar m = 0;
        for (label i = begin; i < end; ++i)
            for (std::int64_t k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
                if (const label j = s.list.index[k]; cloud.phase[j] == phaseType::rigid)
                    m = std::max(m, (cloud.Up[i].xyz() - cloud.Up[j].xyz()).squaredNorm());
        return m;
    }));
}

scalar maxSpeed(const particleCloud& cloud)
{
    return std::sqrt(maxOf(cloud.nAll(), [&](label begin, label end) {
        scalar m = 0;
        for (label i = begin; i < end; ++i) m = std::max(m, cloud.Up[i].xyz().squaredNorm());
        return m;
    }));
}

List<vector> points(const particleCloud& cloud)
{
    List<vector> x(cloud.n());
    for (label i = 0; i < cloud.n(); ++i) x[i] = cloud.x[i].xyz();
    return x;
}

}  // namespace

projectionStep::projectionStep(scalar rho, scalar mu, const word& viscosity,
                               const operatorSchemes& schemes, const dictionary& solution)
    : rho_(rho), nu_(mu / rho), schemes_(schemes)
{
    const scalar reflection =
        solution.subOrEmptyDict("projection").getInRangeOrDefault("reflection", 0, 1, 0);
    leaves_ = reflection / (1 + reflection);
    const dictionary solvers = solution.subOrEmptyDict("solvers");
    const dictionary p = solvers.subOrEmptyDict("p");
    pressureSolver_ = linearSolver::New(
        "p", p.empty() ? dictionary::fromString(defaultPressureSolver, "default of solvers.p") : p);
    if (viscosity == "implicit")
        viscous_ = std::make_unique<projectionViscosity>(solvers.subOrEmptyDict("U"));
}

// What p as it stands takes from u* in a step
List<vec4> projectionStep::corrected(const stencil& s, scalar dt) const
{
    List<vec4> change = sphc::grad(s, s.cloud.Up, schemes_.gradient);
    for (vec4& u : change) u.s *= dt / rho_;
    return change;
}

// By how much walls go faster, per row next to them; p is that of the step before.  Empty: not at all
List<vec4> projectionStep::aheadAtWalls(const stencil& s, scalar dt) const
{
    const particleCloud& cloud = s.cloud;
    if (!(behind(cloud) > 0) || !sphc::anySticks(cloud)) return {};
    List<vec4> ahead = sphc::alongWalls(s, corrected(s, dt));
    const scalar steps = nu_ * dt / (farthest * cloud.dx * cloud.dx),
                 part = 1 / (1 + std::pow(steps, 4));
    for (vec4& u : ahead) u.s *= part;
    return ahead;
}

void projectionStep::predict(particleCloud& cloud, const stencil& s, const List<vec4>& a, scalar dt)
{
    before_.assign(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    cloud.fillGhosts(cloud.Up, false);
    if (viscous_)
    {
        List<vec4> dtA(a);
        for (vec4& v : dtA) v.s *= dt;
        solveViscous(cloud, s, dtA, dt);
        return;
    }
    const List<vec4> lap = sphc::laplacian(s, cloud.Up);
    parallelFor(cloud.n(), [&](label begin, label end) {
        const simd4 velocity = {dt, dt, dt, 0};
        for (label i = begin; i < end; ++i)
            if (!cloud.uFixed[i]) cloud.Up[i].s += velocity * (nu_ * lap[i].s + a[i].s);
    });
}

// The walls' going ahead is known and belongs to what the step adds
void projectionStep::solveViscous(particleCloud& cloud, const stencil& s, List<vec4>& added,
                                  scalar dt)
{
    const List<scalar> scale = sphc::laplacianScale(s);
    const List<vec4> fromWalls = sphc::laplacianAtWalls(s, aheadAtWalls(s, dt), scale);
    projectionViscosity::laplacian lap;
    lap.of = [&](const List<vec4>& u, List<vec4>& result) {
        result = sphc::laplacian(s, u, scale);
    };
    lap.diagonal.assign(cloud.n(), 0);
    for (label i = 0; i < cloud.n(); ++i)
    {
        for (auto k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
            lap.diagonal[i] +=
                2 * cloud.friction(i, s.list.index[k]) * sphc::viscousF(cloud, s.list, k);
        added[i].s += dt * nu_ * fromWalls[i].s;
    }
    viscous_->solve(cloud, lap, added, dt * nu_);
}

// Residual of the pressure equation when the divergence is round-off: fluid at rest, a flow that is
// free of divergence on a lattice
scalar projectionStep::floor(const particleCloud& cloud, scalar dt) const
{
    return 1e-9 * rho_ / dt * maxSpeed(cloud) / cloud.dx * std::sqrt(scalar(cloud.n()));
}

// What goes with a velocity that is prescribed is its value less what the pressure is going to do, like u* of all
// other particles: else they part by the splitting error dt grad p/rho.  Returns the velocities before
List<vec4> projectionStep::addGivenGradient(particleCloud& cloud, scalar dt) const
{
    const auto gradient = cloud.vectors.find(givenGradient);
    if (gradient == cloud.vectors.end()) return {};
    List<vec4> before(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (cloud.uFixed[i]) cloud.Up[i].s += dt / rho_ * gradient->second[i].s;
    return before;
}

// Where the prescribed fluid ends its support is truncated: p goes on there with the gradient given, not level
void projectionStep::endGivenGradient(const stencil& s, List<scalar>& f) const
{
    const List<vec4>& gradient = s.cloud.vectors.at(givenGradient);
    for (label i = s.cloud.nSolid(); i < s.cloud.n(); ++i)
    {
        if (!s.cloud.uFixed[i]) continue;
        vector sum = vector::Zero();
        for (std::int64_t k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
            if (const label j = s.list.index[k]; s.cloud.phase[j] != phaseType::rigid)
                sum -= 2 * s.list.F[k] * (s.cloud.x[i].xyz() - s.cloud.x[j].xyz());
        f[i] += sum.dot(gradient[i].xyz());
    }
}

// What is given is uniform along the face's normals and has no divergence.  At the strip's end and beside walls the
// difference divergence lacks neighbours on one side and finds one, of a parabola in a channel of 12 dx 2 % of the flow
void projectionStep::leaveOutGiven(const stencil& s, scalar dt, List<scalar>& div) const
{
    const List<vec4>&velocity = s.cloud.vectors.at(givenVelocity),
          &gradient = s.cloud.vectors.at(givenGradient);
    List<vec4> given(s.cloud.n());
    for (label i = s.cloud.nSolid(); i < s.cloud.n(); ++i)
        given[i].s = velocity[i].s + dt / rho_ * gradient[i].s;
    s.cloud.fillGradientGhosts(given);  // of walls at rest
    const List<scalar> found = sphc::div(s, given, schemes_.divergence);
    for (label i = s.cloud.nSolid(); i < s.cloud.n(); ++i)
        if (s.cloud.uFixed[i]) div[i] -= found[i];
}

// What mirrors in walls add to div u*: all of what the step adds to u is seen in them, and a part of what was there.  The
// first step takes all for what was there
void projectionStep::addReflection(const stencil& s, List<scalar>& div) const
{
    const particleCloud& cloud = s.cloud;
    if (!cloud.hasRigid()) return;
    List<vec4> change(cloud.nAll()), before(cloud.Up);
    if (behind(cloud) > 0)
    {
        const scalar Re = speedAlongWalls(s) * cloud.dx,
                     part = nu_ > 0 ? Re / (Re + smoothed * nu_) : 1;
        for (label i = 0; i < cloud.n(); ++i)
            change[i].s = cloud.Up[i].s - before_[i].s, before[i].s = before_[i].s;
        cloud.fillContinuityGhosts(before);
        for (label g = cloud.n(); g < cloud.nAll(); ++g)
        {
            if (cloud.ghostSource(g) >= 0) continue;
            change[g].setXyz(cloud.ghostGained(g));
            before[g].s -= change[g].s;
        }
        for (vec4& u : before) u.s *= part;
    }
    const List<scalar> reflected = sphc::wallReflection(s, change, before, schemes_.divergence);
    for (label i = 0; i < cloud.n(); ++i)
        if (!cloud.uFixed[i]) div[i] += reflected[i];
}

// div u* as the pressure's Laplacian answers it
List<scalar> projectionStep::divergence(particleCloud& cloud, const stencil& s, scalar dt,
                                        bool anyGiven) const
{
    cloud.fillContinuityGhosts(cloud.Up);
    List<scalar> div = sphc::div(s, cloud.Up, schemes_.divergence);
    addReflection(s, div);
    if (anyGiven) leaveOutGiven(s, dt, div);
    return div;
}

void projectionStep::project(particleCloud& cloud, const stencil& s, const List<scalar>& q,
                             scalar cellSize, scalar dt)
{
    const label n = cloud.n();
    const List<vec4> given = addGivenGradient(cloud, dt);
    List<scalar> f = divergence(cloud, s, dt, !given.empty());
    const bool first = !(behind(cloud) > 0);
    const List<scalar> loses =
        leaves_ > 0 || first ? sphc::gradSquaredTrace(s, cloud.Up) : List<scalar>();
    for (label i = 0; i < label(given.size()); ++i)
        if (cloud.uFixed[i]) cloud.Up[i].setXyz(given[i].xyz());
    for (label i = 0; i < n; ++i) f[i] = -rho_ / dt * (f[i] - (q.empty() ? 0 : q[i]));
    if (!given.empty()) endGivenGradient(s, f);
    const auto addWay = [&](scalar part) {
        for (label i = 0; i < n; ++i)
            if (!cloud.uFixed[i]) f[i] += part * rho_ * loses[i];
    };
    if (leaves_ > 0) addWay(leaves_);

    sphm::laplacian(s, equation_);
    solvePressure(cloud, f, cellSize, dt);
    correct(cloud, s, dt);
    cloud.history[projected] = {dt};
    if (!first) return;
    addWay(1 - leaves_);
    solvePressure(cloud, f, cellSize, dt);
}

void projectionStep::correct(particleCloud& cloud, const stencil& s, scalar dt) const
{
    cloud.fillGhosts(cloud.Up, false);
    const List<vec4> change = corrected(s, dt);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (!cloud.uFixed[i]) cloud.Up[i].s -= change[i].s;
    });
}

// p of -lap p = f, from the p that it finds
void projectionStep::solvePressure(particleCloud& cloud, const List<scalar>& f, scalar cellSize,
                                   scalar dt)
{
    equation_.setSource(f);
    p_.resize(cloud.n());
    for (label i = 0; i < cloud.n(); ++i)
        p_[i] = cloud.pFixed[i] ? cloud.pGiven[i] : cloud.Up[i][3];
    const List<vector> x = points(cloud);
    const solverPerformance result = pressureSolver_->solve(
        {equation_.A, true, &x, cellSize, nullptr, floor(cloud, dt)}, equation_.source, p_);
    result.print();
    if (!result.converged && !(result.finalResidual < 1e-2))
        throw notConverged(
            "The pressure equation did not converge, worst at " +
            cloud.describe(worstRow(equation_.A, equation_.source, p_)) + ": " + result.line() +
            ". Raise maxIter in solvers.p of system/sphSolution, or reduce deltaT, and "
            "see whether a load or a motion jumps; the last written time is intact");
    for (label i = 0; i < cloud.n(); ++i) cloud.Up[i][3] = p_[i];
}

void projectionStep::printContinuityErrors(particleCloud& cloud, const stencil& s,
                                           const List<scalar>& q, scalar dt)
{
    cloud.fillContinuityGhosts(cloud.Up);
    List<scalar> div = sphc::div(s, cloud.Up, schemes_.divergence);
    if (cloud.vectors.count(givenVelocity)) leaveOutGiven(s, 0, div);
    List<scalar> left(cloud.n());
    for (label i = 0; i < cloud.n(); ++i) left[i] = div[i] - (q.empty() ? 0 : q[i]);
    ispf::printContinuityErrors(cloud, left, dt);
}

}  // namespace ispf
