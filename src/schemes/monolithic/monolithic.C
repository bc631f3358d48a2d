// SPDX-License-Identifier: GPL-3.0-or-later
// coupling monolithic; see monolithicSystem.H.  Entries of sphSolution:
//
//     monolithic
//     {
//         tolerance   1e-4;     // share of the step's initial residual
//         absTolerance 1e-5;    // times the velocity scale, per particle: a floor for warm starts
//         maxIter     150;
//         theta       0.95;     // memory of the pressure stabiliser; 0 for fluid alone, whose particles move on
//         volumeFeedback 0.1;   // share of J - 1 of the solid removed per step; the volume ledger books it
//         divergenceDefect yes; // the next step corrects what the rates of a step miss: for the area of the surface,
//                               // see enclosedFluid.H; for the volume of a solid that turns, volumeConstraint.H
//         newton { maxIter 1; tolerance 1e-5; }    // see elasticStep.H
//         beta 1; multigrid {..}
//     }
//     shifting { ... }     densityFeedback 0;
#include "closedBodies.H"
#include "couplingScheme.H"
#include "densityFeedback.H"
#include "elasticStep.H"
#include "FGMRES.H"
#include "monolithicPreconditioner.H"
#include "particleShifting.H"
#include "shiftingFrame.H"
#include "stepReport.H"
#include "timeScheme.H"
#include "volumeLedger.H"
#include "worstRow.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

// Field of the particles: error of J that the rate of J has left in the last step
const word missedField = "missedJ";

// Below this cell Reynolds number viscosity damps the scales that dx does not resolve
constexpr scalar resolved = 5;

struct monolithicEntries
{
    monolithicPreconditioner::entries preconditioner;
    elasticStep::entries newton;
    scalar theta, alpha, tolerance, absTolerance;
    label maxIter;
    bool makesGood;

    monolithicEntries(const dictionary& dict, bool hasSolid)
        : preconditioner(dict),
          newton(dict.subOrEmptyDict("newton")),
          theta(dict.getInRangeOrDefault("theta", 0, 1, hasSolid ? 0.95 : 0)),
          alpha(dict.getInRangeOrDefault("volumeFeedback", 0, 1, 0.1)),
          tolerance(dict.getInRangeOrDefault("tolerance", 1e-14, 0.1, 1e-4)),
          absTolerance(dict.getInRangeOrDefault("absTolerance", 0, 0.1, 1e-5)),
          maxIter(dict.getInRangeOrDefault<label>("maxIter", 1, 10000, 150)),
          makesGood(dict.getOrDefault("divergenceDefect", true))
    {
        if (hasSolid) return;
        for (const char* entry : {"theta", "volumeFeedback", "divergenceDefect", "newton"})
            if (dict.found(entry))
                dict.fail(entry, "It acts on a solid, and this case has none. Leave it away");
    }
    explicit monolithicEntries(const fsiCase& c)
        : monolithicEntries(c.solution.subOrEmptyDict("monolithic"), bool(c.structure))
    {
    }
};

class monolithic : public couplingScheme
{
public:
    explicit monolithic(fsiCase& c) : monolithic(c, monolithicEntries(c)) {}

    monolithic(fsiCase& c, const monolithicEntries& e)
        : couplingScheme(c),
          system_(c),
          preconditioner_(system_, e.preconditioner),
          elastic_(c.structure.get(), e.newton),
          theta_(e.theta),
          alpha_(e.alpha),
          tolerance_(e.tolerance),
          absTolerance_(e.absTolerance),
          maxIter_(e.maxIter),
          time_(c),
          makesGood_(e.makesGood),
          shifting_(c.solution.subOrEmptyDict("shifting"), shiftingFrame(c),
                    shiftStiffness::ofLattice(*c.kernel, c.cloud.nDims, c.cloud.dx)),
          density_(c.solution, c.cloud)
    {
        time_.keepLevels();
        system_.enclosed().makeGood(makesGood_);
        if (!c.structure) return;
        c.cloud.scalars[missedField].resize(c.cloud.n(), 0);
        volume_ = std::make_unique<volumeConstraint>(*c.structure);
    }

private:
    stepLimit admitted() const override;
    word attempt(scalar t, scalar dt) override;
    word advice() const override;

    void structureState();
    List<scalar> guess() const;
    scalar feedback(label i, scalar dt) const;
    scalar missed(label i, scalar dt) const;
    template <class Source>
    void book(const stateEntry<scalar>& entry, scalar dt, Source&& source);
    void accept(const List<scalar>& z);
    void account(scalar dt);
    void addWay(scalar dt);
    word solve(scalar dt, List<scalar>& z);
    word pass(FGMRES& solver, List<scalar>& b, List<scalar>& z);
    void keepContinuityErrors(const List<scalar>& b, const List<scalar>& z, scalar dt);
    scalar velocityScale() const;
    scalar cellReynolds(scalar speed) const;
    scalar rounding(scalar dt, const List<scalar>& z) const;

    coupledSystem system_;
    monolithicPreconditioner preconditioner_;
    elasticStep elastic_;
    scalar theta_, alpha_, tolerance_, absTolerance_;
    label maxIter_;
    timeScheme time_;
    bool makesGood_;
    particleShifting shifting_;
    densityFeedback density_;

    std::unique_ptr<volumeConstraint> volume_;
    solidSurface surface_;
    List<tensor> F_;
    List<scalar> q_;      // sources of the step [1/s]
    List<scalar> left_;   // residual of continuity after the solution [1/s]
    List<scalar> ahead_;  // J that the first step of DLN corrects in advance, else empty [1]
};

scalar monolithic::velocityScale() const
{
    return std::max(c_.cloud.maxSpeed(), c_.walls->maxGivenSpeed());
}

// Rounding error of a row: of the springs' positions and of the pressure gradient [m/s].  At rest
// no other scale exists
scalar monolithic::rounding(scalar dt, const List<scalar>& z) const
{
    const particleCloud& cloud = c_.cloud;
    scalar x = 0, p = 0;
    for (label i = 0; i < cloud.n(); ++i)
        x = std::max(x, cloud.x[i].xyz().norm()), p = std::max(p, std::abs(z[4 * i + 3]));
    return 16 * std::numeric_limits<scalar>::epsilon() * (x / dt + dt / (c_.rho * cloud.dx) * p);
}

// Stability sets no limit.  With adjustTimeStep the motion of the fluid sets one, for accuracy
couplingScheme::stepLimit monolithic::admitted() const
{
    const scalar u = velocityScale();
    if (!c_.time.adjustTimeStep() || u == 0) return {1e30, "no"};
    return {0.4 * c_.kernel->h() / u, "CFL"};
}

void monolithic::structureState()
{
    if (!c_.structure) return;
    elastic_.begin(time_.elasticStart(c_.cloud), time_.tau());
    c_.structure->deformationGradient(c_.cloud.x, F_);
    const List<isometry>& images = c_.structure->reference().images;
    surface_.initialise(c_.cloud, c_.list, F_, images);
    volume_->setup(F_);
    surface_.setup(c_.cloud, c_.list, *c_.kernel, volume_->cofactor(), images);
}

// Extrapolates the change of the last step.  If the pressure rises steadily, this guess is nearer to the
// solution than the present {u, p}, by a factor of ten and more
List<scalar> monolithic::guess() const
{
    const particleCloud& cloud = c_.cloud;
    const auto old = cloud.vectors.find(levelBefore);
    const auto lastDt = cloud.state.find(entries::levelBefore);
    const bool has = old != cloud.vectors.end() && lastDt;
    const scalar before = lastDt.value_or(1);
    const scalar u = has ? time_.velocitiesAhead() / before : 0;
    const scalar p = has ? time_.pressuresAhead() / before : 0;
    const simd4 ratio = {u, u, u, p};
    List<scalar> z(4 * cloud.n());
    for (label i = 0; i < cloud.n(); ++i)
    {
        simd4 up = time_.now()[i].s;
        if (has) up += ratio * (up - old->second[i].s);
        for (int a = 0; a < 3; ++a) z[4 * i + a] = cloud.uFixed[i] ? cloud.Up[i][a] : up[a];
        z[4 * i + 3] = cloud.pHeld(i) ? cloud.heldPressure(i) : up[3];
    }
    return z;
}

// Volume source of solid particle i that relaxes J to 1 [1/s]
scalar monolithic::feedback(label i, scalar dt) const
{
    return -alpha_ * (F_[i].determinant() - 1) / dt;
}

scalar monolithic::missed(label i, scalar dt) const
{
    return makesGood_ ? -c_.cloud.scalars.at(missedField)[i] / dt : 0;
}

template <class Source>
void monolithic::book(const stateEntry<scalar>& entry, scalar dt, Source&& source)
{
    scalar rate = 0;
    for (label i = 0; i < c_.cloud.nSolid(); ++i) rate += source(i);
    c_.cloud.state.add(entry, rate * c_.cloud.volume() * dt);
}

void monolithic::accept(const List<scalar>& z)
{
    particleCloud& cloud = c_.cloud;
    cloud.state.erase(entries::projectedStep);
    for (label i = 0; i < cloud.n(); ++i)
        cloud.Up[i].s = simd4{z[4 * i], z[4 * i + 1], z[4 * i + 2], z[4 * i + 3]};
}

// Books the volumes that the step's sources have added, and keeps the errors of its rates for the next step
void monolithic::account(scalar dt)
{
    density_.book(c_.cloud, dt);
    List<tensor> dF;
    if (c_.structure)
    {
        List<scalar> dJ;
        volume_->rate(c_.cloud.Up, dJ, dF);
        book(entries::solidFeedback, dt, [&](label i) { return feedback(i, dt); });
        book(entries::solidDefect, dt, [&](label i) { return missed(i, dt); });
        List<scalar> missed;
        volume_->overStep(c_.cloud.Up, time_.midway() ? 0 : dt, missed);
        for (size_t i = 0; i < ahead_.size(); ++i) missed[i] -= ahead_[i];
        // the solver's residual has changed J by this, doc/theory 5.6
        for (size_t i = 0; i < missed.size(); ++i) missed[i] += dt * left_[i];
        std::copy(missed.begin(), missed.end(), c_.cloud.scalars.at(missedField).begin());
    }
    // with forces at x_b the geometry is the mean over the step already
    system_.enclosed().account(c_.cloud, dt, dF, time_.midway() ? 0 : dt);
}

// Adds sources so that div u is zero at the next places of the particles, and J is one there
void monolithic::addWay(scalar dt)
{
    particleCloud& cloud = c_.cloud;
    if (c_.structure)
    {
        volume_->overStep(cloud.Up, dt, ahead_);
        for (label i = 0; i < cloud.nSolid(); ++i) q_[i] -= ahead_[i] / dt;
    }
    cloud.fillGhosts(cloud.Up, false);
    const List<scalar> loses = sphc::gradSquaredTrace({cloud, c_.list, c_.correction}, cloud.Up);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (!cloud.beyondOpen(i)) q_[i] += dt * loses[i];
}

// Solves for z = {u, v, w, p}.  Returns an empty text or the reason why the step cannot be accepted
word monolithic::solve(scalar dt, List<scalar>& z)
{
    const particleCloud& cloud = c_.cloud;
    List<scalar>& q = q_;
    q.assign(cloud.n(), 0);
    for (label i = 0; i < cloud.nSolid(); ++i) q[i] = feedback(i, dt) + missed(i, dt);
    for (label i = cloud.nSolid(); i < cloud.n() && !c_.source.empty(); ++i)
        q[i] = c_.source[cloud.zone[i]];
    ahead_.clear();
    if (time_.wellStarts()) addWay(dt);
    if (c_.structure) system_.setup(time_.tau(), volume_.get(), &surface_, &elastic_.tangent());
    else system_.setup(time_.tau(), nullptr, nullptr, nullptr);
    if (density_.on() && !c_.walls->hasCyclic())
        density_.addTo(q, system_.rows().pair(),
                       drainedFluid(cloud, c_.list, system_.enclosed().bodyOf()), dt);
    system_.enclosed().addDefect(q);
    preconditioner_.setup();

    z = guess();
    solverControls controls;
    const scalar least = rounding(time_.tau(), z);
    controls.tolerance = 0, controls.relTol = tolerance_, controls.maxIter = maxIter_;
    controls.absTol =
        std::sqrt(scalar(cloud.n())) * std::max(absTolerance_ * velocityScale(), least);
    FGMRES solver(controls, "Up", maxIter_);
    List<scalar> b;
    word fails;
    do fails = pass(solver, b, z);
    while (fails.empty() && elastic_.iterates() &&
           elastic_.again(z, system_.diagonal(), cloud, least));
    keepContinuityErrors(b, z, dt);
    return fails.empty() ? elastic_.failure() : fails;
}

// One pass of (7.7): sets b, and improves z.  Returns an empty text or the reason why the step cannot be accepted
word monolithic::pass(FGMRES& solver, List<scalar>& b, List<scalar>& z)
{
    system_.rightHandSide(theta_, elastic_.force(), q_, b);
    const solverPerformance result = solver.solve(system_, preconditioner_, b, z);
    system_.enclosed().keepLevel(c_.cloud, z);
    result.print();
    // measured: steps stay stable with far less reduction than the tolerance, but not without any
    if (!result.converged && !(result.finalResidual < 100 * tolerance_ * result.initialResidual))
        return "the coupled system did not converge (residual " + str(result.finalResidual, 3) +
               " of " + str(result.initialResidual, 3) + " after " +
               std::to_string(result.nIterations) + " iterations), worst at " +
               c_.cloud.describe(worstRow(system_, b, z) / 4);
    return "";
}

// Prints and keeps the residual of D u - C (p - theta p^n) = q; the rows of the system are scaled by dx
void monolithic::keepContinuityErrors(const List<scalar>& b, const List<scalar>& z, scalar dt)
{
    List<scalar> Az(b.size());
    left_.resize(b.size() / 4);
    system_.apply(z, Az);
    for (size_t i = 0; i < left_.size(); ++i)
        left_[i] = (Az[4 * i + 3] - b[4 * i + 3]) / c_.cloud.dx;
    ispf::printContinuityErrors(c_.cloud, left_, dt);
}

scalar monolithic::cellReynolds(scalar speed) const
{
    return c_.rho * speed * c_.cloud.dx / c_.mu;
}

word monolithic::advice() const
{
    const scalar Re = cellReynolds(velocityScale());
    if (!(Re >= resolved)) return couplingScheme::advice();
    return "At a cell Reynolds number U dx/nu of " + str(Re, 3) +
           " take a smaller dx, or a smaller deltaT from the start (CFL 0.1), or see whether a "
           "load or a "
           "motion jumps";
}

word monolithic::attempt(scalar t, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    time_.start(cloud, t, dt);
    c_.time.stages.in("neighbours", [&] { c_.updateNeighbours(time_.times()); });
    system_.setStep(t, t + dt);
    energy_.begin(time_.startPlaces(cloud));
    structureState();
    system_.hydrostatic().take(cloud);
    time_.begin(cloud);
    const List<vec4> start(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    List<scalar> z;
    const word fails = atTime(t + dt, [&] {
        return c_.time.stages.in("velocity and pressure", [&] { return solve(dt, z); });
    });
    if (!fails.empty()) return fails;
    accept(z);
    energy_.weigh(time_.weight(),
                  [&] { system_.book(start, theta_, elastic_.force(), q_, energy_); });
    if (outletsDiffer(time_.tau())) return outletsAsk;
    if (const word reason = tooFar(dt); !reason.empty()) return reason;
    account(dt);
    time_.end(cloud, energy_);
    system_.hydrostatic().giveBack(cloud);
    if (const word reason = tooRough(time_, dt); !reason.empty()) return reason;

    c_.followOpen(system_.rows().viscous(), dt);
    // shift with the present neighbours, then move
    shift(shifting_, dt);
    move(time_);
    energy_.end();
    if (const word reason = gains(dt); !reason.empty()) return reason;
    energy_.book();
    c_.walls->exchange(cloud, t + dt);
    return "";
}

}  // namespace

void checkMonolithicEntries(const fsiCase& c)
{
    monolithicEntries{c};
}

std::unique_ptr<couplingScheme> newMonolithic(fsiCase& c)
{
    return std::make_unique<monolithic>(c);
}

}  // namespace ispf
