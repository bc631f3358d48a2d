// SPDX-License-Identifier: GPL-3.0-or-later
#include "fractionalStep.H"

#include "worstRow.H"

#include <ostream>

namespace ispf
{

namespace
{

const char* const defaultPressureSolver = "solver PCG; preconditioner multigrid;";

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
    forEach(0, cloud.n(), [&](label i) { x[i] = cloud.x[i].xyz(); });
    return x;
}

}  // namespace

fractionalStep::fractionalStep(scalar rho, scalar mu, const word& viscosity,
                               const dictionary& solution, bool wellStarted)
    : rho_(rho), nu_(mu / rho)
{
    const scalar reflection =
        solution.subOrEmptyDict("projection").getInRangeOrDefault("reflection", 0, 1, 0);
    leaves_ = reflection / (1 + reflection);
    leavesAtFirst_ = wellStarted ? 1 : leaves_;
    pair_.setTolerance(closureTolerance(solution));
    const dictionary solvers = solution.subOrEmptyDict("solvers");
    const dictionary p = solvers.subOrEmptyDict("p");
    pressureSolver_ = linearSolver::New(
        "p", p.empty() ? dictionary::fromString(defaultPressureSolver, "default of solvers.p") : p);
    if (viscosity == "implicit")
        implicit_ = std::make_unique<projectionViscosity>(solvers.subOrEmptyDict("U"));
}

void fractionalStep::setup(particleCloud& cloud, const stencil& s, const smoothingKernel& kernel,
                           const List<scalar>& resists)
{
    resists_ = resists, mobility_.resize(resists.size());
    forEach(0, label(resists.size()), [&](label i) { mobility_[i] = 1 / (1 + resists[i]); });
    pair_.setup(cloud, s.list, kernel, medium::all(cloud, s.list, s.B));
    pair_.weaken(mobility_);
    viscous_.setup(s);
    List<scalar> stiffness = pair_.stiffness();
    forEach(0, label(resists.size()), [&](label i) { stiffness[i] *= mobility_[i]; });
    sphm::laplacian(s, stiffness, compact_);
    operator_.setup(cloud, pair_, compact_, mobility_);
}

// beta dt/rho G p, zero where the velocity is prescribed
List<vec4> fractionalStep::corrected(const particleCloud& cloud, scalar dt)
{
    List<scalar> p(cloud.n());
    forEach(0, cloud.n(), [&](label i) { p[i] = cloud.Up[i][3]; });
    operator_.gradient(p, gradient_);
    List<vec4> change(gradient_.begin(), gradient_.begin() + cloud.n());
    const simd4 part = {dt / rho_, dt / rho_, dt / rho_, 0};
    forEach(0, cloud.n(),
            [&](label i) { change[i].s *= cloud.uFixed[i] ? simd4{} : yields(i) * part; });
    return change;
}

void fractionalStep::predict(particleCloud& cloud, const stencil&, const List<vec4>& a, scalar dt)
{
    first_ = !(behind(cloud) > 0);
    added_ = a, before_.assign(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    if (implicit_) return stickImplicitly(cloud, a, dt);
    sticks_ = before_;
    cloud.fillGhosts(cloud.Up, false);
    List<vec4> lap;
    viscous_.apply(cloud.Up, lap);
    const simd4 velocity = {1, 1, 1, 0};
    forEach(0, cloud.n(), [&](label i) {
        if (cloud.uFixed[i]) return;
        const simd4 u = cloud.Up[i].s + velocity * (dt * (a[i].s - 2 * nu_ * lap[i].s));
        cloud.Up[i].setXyz(yields(i) * vec4{u}.xyz());
    });
}

// (6.15)
void fractionalStep::stickImplicitly(particleCloud& cloud, const List<vec4>& a, scalar dt)
{
    // the first p of a case is a guess
    List<vec4> change(cloud.n(), vec4{});
    if (!first_) change = corrected(cloud, dt);
    const simd4 velocity = {dt, dt, dt, 0};
    List<vec4> added(a);
    forEach(0, cloud.n(),
            [&](label i) { added[i].s = velocity * a[i].s - change[i].s / yields(i); });
    projectionViscosity::laplacian lap;
    lap.of = [&](const List<vec4>& u, List<vec4>& result) {
        viscous_.apply(u, result);
        forEach(0, label(result.size()), [&](label i) { result[i].s *= -2; });
    };
    lap.diagonal = viscous_.sum(), lap.resists = resists_;
    for (scalar& d : lap.diagonal) d *= 2;
    implicit_->solve(cloud, lap, added, dt * nu_);
    sticks_.assign(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    forEach(0, cloud.n(), [&](label i) { cloud.Up[i].s += change[i].s; });
}

// Floor of the residual of the pressure equation: its value when the divergence is only rounding, as in fluid at rest or in
// a flow on a lattice that is free of divergence
scalar fractionalStep::floor(const particleCloud& cloud, scalar dt) const
{
    return 1e-9 * rho_ / dt * maxSpeed(cloud) / cloud.dx * std::sqrt(scalar(cloud.n()));
}

List<scalar> fractionalStep::divergence(particleCloud& cloud) const
{
    cloud.fillGhosts(cloud.Up, false);
    List<scalar> div(cloud.n(), 0);
    pair_.divergence(cloud.Up, div);
    const List<scalar>& walls = pair_.wallFlux();
    forEach(0, cloud.n(), [&](label i) { div[i] += walls[i]; });
    return div;
}

void fractionalStep::project(particleCloud& cloud, const stencil& s, const List<scalar>& q,
                             scalar cellSize, scalar dt)
{
    const label n = cloud.n();
    f_ = divergence(cloud), source_ = q;
    source_.resize(n, 0);
    loses_ = leaves() > 0 || first_ ? sphc::gradSquaredTrace(s, cloud.Up) : List<scalar>();
    forEach(0, n, [&](label i) {
        if (leaves() > 0 && !cloud.uFixed[i]) source_[i] += dt * leaves() * loses_[i];
        f_[i] = -rho_ / dt * (f_[i] - source_[i]);
    });
    if (first_) startPressure(cloud);
    solvePressure(cloud, f_, cellSize, dt);
    correct(cloud, dt);
    cloud.state.set(entries::projectedStep, dt);
}

// No motion precedes the first step of a run: the p that this step leaves gets the rest of s
void fractionalStep::settle(particleCloud& cloud, scalar cellSize, scalar dt)
{
    if (!first_ || leaves() == 1) return;
    for (label i = 0; i < cloud.n(); ++i)
        if (!cloud.uFixed[i]) f_[i] += (1 - leaves()) * rho_ * loses_[i];
    solvePressure(cloud, f_, cellSize, dt);
}

// Needs gradient_ of the correction
void fractionalStep::book(particleCloud& cloud, scalar dt, energyLedger& energy)
{
    bookMomentum(cloud, dt, energy);
    bookPressure(cloud, dt, energy);
}

// Books (6.10) and (6.12) over the rows that the ledger counts, without the first line of the step
void fractionalStep::bookMomentum(particleCloud& cloud, scalar dt, energyLedger& energy)
{
    List<vec4> lap;
    sticks_.resize(cloud.nAll());
    cloud.fillGhosts(sticks_, false);
    viscous_.apply(sticks_, lap);
    const auto [crossed, forced, left,
                resisted] = sumsOf(0, cloud.n(), [&](label i) -> std::array<scalar, 4> {
        if (!cloud.isFree(i)) return {};
        const vector u = cloud.Up[i].xyz(), gained = u - before_[i].xyz();
        const vector viscous = -2 * dt * nu_ * lap[i].xyz(), a = dt * added_[i].xyz();
        const vector resist = resists_.empty() ? vector(vector::Zero()) : vector(-resists_[i] * u);
        return {(u - sticks_[i].xyz()).dot(viscous), u.dot(a),
                u.dot(gained + dt / rho_ * gradient_[i].xyz() - a - viscous - resist),
                u.dot(resist)};
    });
    const scalar m = rho_ * cloud.volume();
    energy.bookFriction(viscous_.powerOf(sticks_), m * dt * nu_);
    energy[energyLedger::viscosity] += m * resisted;
    energy[energyLedger::step] += m * crossed;
    energy[energyLedger::forces] += m * forced;
    energy[energyLedger::solver] += m * left;
}

// Books (6.11) and (6.6): the work of p, continuity row by row
void fractionalStep::bookPressure(particleCloud& cloud, scalar dt, energyLedger& energy)
{
    List<vec4> m(cloud.nAll());
    List<scalar> damps(cloud.n()), direct(cloud.n(), 0);
    pair_.remainder(gradient_, m, direct);
    cloud.fillGradientGhosts(m);
    pair_.divergence(m, damps);
    const scalar level = energy.level(cloud.Up);
    const List<scalar>&all = pair_.wallFlux(), &faces = pair_.faceFlux();
    div_ = divergence(cloud);
    const auto takes = [&](label i) { return dt / rho_ * (direct[i] - damps[i]); };
    cloud.takeIn([&](label i) { return div_[i] + takes(i); });
    energy.bookRows(level, dt, [&](label i) -> energyLedger::continuityRow {
        const scalar S = takes(i), face = faces.empty() ? 0 : faces[i];
        return {cloud.Up[i][3], S, div_[i] + S, source_[i], all[i], face, gradient_[i].xyz()};
    });
}

void fractionalStep::correct(particleCloud& cloud, scalar dt)
{
    const List<vec4> change = corrected(cloud, dt);
    forEach(0, cloud.n(), [&](label i) { cloud.Up[i].s -= change[i].s; });
}

// Mean of the given pressures, 0 if there are none
scalar fractionalStep::givenLevel(const particleCloud& cloud) const
{
    const auto [n, sum] = sumsOf(0, cloud.n(), [&](label i) {
        return cloud.pFixed[i] ? std::array<scalar, 2>{1, cloud.pGiven[i]}
                               : std::array<scalar, 2>{};
    });
    return n > 0 ? sum / n : 0;
}

// The first p of a case is a guess: all particles get the level of the given pressures
void fractionalStep::startPressure(particleCloud& cloud) const
{
    const scalar level = givenLevel(cloud);
    forEach(0, cloud.n(), [&](label i) { cloud.Up[i][3] = level; });
}

// Solves M p = f for p, from the present p on.  The level of the given pressures is subtracted: the tolerance must not
// depend on it
void fractionalStep::solvePressure(particleCloud& cloud, const List<scalar>& f, scalar cellSize,
                                   scalar dt)
{
    const scalar level = givenLevel(cloud);
    List<scalar> b;
    operator_.rightHandSide(f, level, b);
    p_.resize(cloud.n());
    forEach(0, cloud.n(), [&](label i) { p_[i] = cloud.heldPressure(i) - level; });
    const List<vector> x = points(cloud);
    const solverPerformance result = pressureSolver_->solve(
        {compact_, true, &x, cellSize, nullptr, floor(cloud, dt), &operator_}, b, p_);
    result.print();
    if (!result.converged && !(result.finalResidual < 1e-2))
        throw notConverged(
            "The pressure equation did not converge, worst at " +
            cloud.describe(worstRow(operator_, b, p_)) + ": " + result.line() +
            ". Raise maxIter in solvers.p of system/sphSolution, or reduce deltaT, and "
            "see whether a load or a motion jumps; the last written time is intact");
    forEach(0, cloud.n(), [&](label i) { cloud.Up[i][3] = p_[i] + level; });
}

// bookPressure has stored the divergence of the final velocities in div_
void fractionalStep::printContinuityErrors(particleCloud& cloud, const List<scalar>& q, scalar dt)
{
    for (label i = 0; i < cloud.n(); ++i) div_[i] -= q.empty() ? 0 : q[i];
    ispf::printContinuityErrors(cloud, div_, dt);
}

}  // namespace ispf
