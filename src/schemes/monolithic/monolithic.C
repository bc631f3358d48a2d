// SPDX-License-Identifier: GPL-3.0-or-later
// coupling monolithic; see coupledSystem.H.  Entries of sphSolution:
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
#include "closedGaps.H"
#include "couplingScheme.H"
#include "elasticStep.H"
#include "FGMRES.H"
#include "fluidSources.H"
#include "monolithicPreconditioner.H"
#include "outsideWall.H"
#include "particleShifting.H"
#include "restSearch.H"
#include "shiftingFrame.H"
#include "softZones.H"
#include "stepReport.H"
#include "stepSources.H"
#include "worstRow.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

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
    monolithic(fsiCase& c, const monolithicEntries& e)
        : couplingScheme(c),
          system_(c),
          preconditioner_(system_, e.preconditioner),
          elastic_(c.structure.get(), e.newton),
          theta_(e.theta),
          tolerance_(e.tolerance),
          absTolerance_(e.absTolerance),
          maxIter_(e.maxIter),
          time_(c),
          shifting_(c.solution.subOrEmptyDict("shifting"), shiftingFrame(c),
                    shiftStiffness::ofLattice(*c.kernel, c.cloud.nDims, c.cloud.dx))
    {
        time_.keepLevels();
        if (c.structure)
        {
            volume_ = std::make_unique<volumeConstraint>(*c.structure);
            gaps_ = closedGaps::New(c.structureProperties);
            contact_ = std::make_unique<solidContact>(c, system_.bodies());
            energy_.addElastic([this](const List<vec4>& x) { return contact_->energy(x); });
            outside_ = std::make_unique<outsideWall>(c.structureProperties, c.caseFolder());
        }
        addSources(e);
    }

private:
    stepLimit admitted() const override;
    word attempt(scalar t, scalar dt) override;
    word advice() const override;

    void addSources(const monolithicEntries& e);
    void begin(scalar t, scalar dt);
    void structureState();
    void elasticState();
    bool outsideActs() { return outside_ && outside_->acts(system_.hydrostatic()); }
    void assemble();
    List<scalar> guess() const;
    void accept(const List<scalar>& z);
    word solve(scalar dt, List<scalar>& z);
    word pass(FGMRES& solver, List<scalar>& b, List<scalar>& z);
    void keepContinuityErrors(const List<scalar>& b, const List<scalar>& z, scalar dt);
    scalar velocityScale() const;
    scalar cellReynolds(scalar speed) const;
    scalar rounding(scalar dt, const List<scalar>& z) const;

    coupledSystem system_;
    monolithicPreconditioner preconditioner_;
    elasticStep elastic_;
    scalar theta_, tolerance_, absTolerance_;
    label maxIter_;
    timeScheme time_;
    particleShifting shifting_;

    std::unique_ptr<volumeConstraint> volume_;
    solidSurface surface_;
    std::unique_ptr<solidContact> contact_;
    std::unique_ptr<closedGaps> gaps_;  // null: fluid between solids is as elsewhere
    std::unique_ptr<outsideWall> outside_;
    softZones soft_;
    List<tensor> F_;
    volumeSources sources_;
    List<scalar> q_;     // their sum in the step [1/s]
    List<scalar> left_;  // residual of continuity after the solution [1/s]
};

void monolithic::addSources(const monolithicEntries& e)
{
    system_.enclosed().makeGood(e.makesGood);
    if (volume_)
    {
        sources_.add(std::make_unique<solidFeedback>(c_.cloud, F_, e.alpha));
        sources_.add(std::make_unique<solidDefect>(c_.cloud, *volume_, time_, left_, e.makesGood));
    }
    sources_.add(std::make_unique<zoneSource>(c_));
    sources_.add(std::make_unique<firstWaySource>(c_, time_));
    sources_.add(std::make_unique<drainedSource>(c_, system_.rows().pair()));
    sources_.add(
        std::make_unique<enclosedDefect>(c_.cloud, system_.enclosed(), volume_.get(), time_));
}

scalar monolithic::velocityScale() const
{
    return std::max(c_.cloud.maxSpeed(), c_.walls->maxGivenSpeed());
}

// Rounding error of a row: of the springs' positions and of the pressure gradient [m/s].  At rest
// no other scale exists
scalar monolithic::rounding(scalar dt, const List<scalar>& z) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar x = largestOf(0, cloud.n(), [&](label i) { return cloud.x[i].xyz().norm(); });
    const scalar p = largestOf(0, cloud.n(), [&](label i) { return std::abs(z[4 * i + 3]); });
    return 16 * std::numeric_limits<scalar>::epsilon() * (x / dt + dt / (c_.rho * cloud.dx) * p);
}

// Stability sets no limit.  With adjustTimeStep the motion sets one, for accuracy
couplingScheme::stepLimit monolithic::admitted() const
{
    return motionLimit();
}

void monolithic::structureState()
{
    if (!c_.structure) return;
    beginMemory(time_, time_.velocitiesAhead());
    c_.structure->deformationGradient(c_.cloud.x, F_);
    const List<isometry>& images = c_.structure->reference().images;
    surface_.initialise(c_.cloud, c_.list, F_, images);
    volume_->setup(F_);
    surface_.setup(c_.cloud, c_.list, *c_.kernel, volume_->cofactor(), images);
    outside_->find(c_, surface_);
    if (gaps_) gaps_->close(c_, surface_);
}

// Call once the hydrostatic part of p is known
void monolithic::elasticState()
{
    if (!c_.structure) return;
    const auto outsidePressure =
        outside_->pressureAt(time_.times().pressures, system_.hydrostatic());
    c_.cloud.fillGhosts(c_.cloud.Up, false);
    elastic_.begin(time_.elasticStart(c_.cloud), time_.tau(),
                   surface_.overSurface(c_.cloud.Up, *volume_, outsidePressure),
                   time_.midway() ? c_.cloud.x : List<vec4>());
    if (outsidePressure)
    {
        outside_->setStep(c_, surface_, system_.hydrostatic(),
                          {time_.tau(), time_.times().pressures, time_.elasticStart(c_.cloud)});
        elastic_.addOutside(outside_->force(), outside_->resistance());
    }
    if (!contact_->empty()) elastic_.addContact(*contact_, c_.cloud.Up);
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
    forEach(0, cloud.n(), [&](label i) {
        simd4 up = time_.now()[i].s;
        if (has) up += ratio * (up - old->second[i].s);
        for (int a = 0; a < 3; ++a) z[4 * i + a] = cloud.uFixed[i] ? cloud.Up[i][a] : up[a];
        const bool given = cloud.pHeld(i) && !system_.outlets().has(i);
        z[4 * i + 3] = given ? cloud.heldPressure(i) : up[3];
    });
    return z;
}

void monolithic::accept(const List<scalar>& z)
{
    particleCloud& cloud = c_.cloud;
    cloud.state.erase(entries::projectedStep);
    forEach(0, cloud.n(), [&](label i) {
        const scalar p = system_.rows().acts(i) ? z[4 * i + 3] : 0;
        cloud.Up[i].s = simd4{z[4 * i], z[4 * i + 1], z[4 * i + 2], p};
    });
    soft_.warn(c_);
}

// Coefficients of (7.1) and (7.2) for the present neighbours
void monolithic::assemble()
{
    c_.time.stages.in("operators", [&] {
        const List<scalar> chi = zones_ ? zones_->chi() : List<scalar>();
        if (c_.structure)
            system_.setup(time_.tau(), volume_.get(), &surface_, &elastic_.tangent(),
                          &elastic_.stiffness(), chi);
        else system_.setup(time_.tau(), nullptr, nullptr, nullptr, nullptr, chi);
    });
    c_.time.stages.in("preconditioner", [&] { preconditioner_.setup(); });
}

// Solves (7.7) and (7.2) for z = {u, v, w, p}.  Returns an empty text or the reason why the step cannot be accepted
word monolithic::solve(scalar dt, List<scalar>& z)
{
    const particleCloud& cloud = c_.cloud;
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
    system_.enclosed().keepLevel(c_.cloud, system_.hydrostatic().fall(), z);
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
    forEach(0, label(left_.size()),
            [&](label i) { left_[i] = (Az[4 * i + 3] - b[4 * i + 3]) / c_.cloud.dx; });
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

// Places of the forces, u_0, the neighbours and the state of the solid there
void monolithic::begin(scalar t, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    time_.start(cloud, t, dt);
    c_.time.stages.in("neighbours", [&] { c_.updateNeighbours(time_.times()); });
    system_.setStep(t, t + dt);
    if (contact_) contact_->find();
    energy_.begin(time_.startPlaces(cloud));
    structureState();
    if (outside_)
        system_.hydrostatic().take(cloud, outside_->mostlyWet(),
                                   outside_->level(t, time_.times().pressures));
    else system_.hydrostatic().take(cloud);
    elasticState();
    setResistance();  // (1.10)
    time_.begin(cloud);
}

word monolithic::attempt(scalar t, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    begin(t, dt);  // x_b and u_0 of (8.41), p' of (1.9)
    const List<vec4> start(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    List<scalar> z;
    const word fails = atTime(t + dt, [&] {
        return c_.time.stages.in("velocity and pressure", [&] {
            assemble();                        // rows of (7.1) and (7.2)
            q_ = sources_.sum(cloud.n(), dt);  // q of (7.2)
            return solve(dt, z);               // (7.7)
        });
    });
    if (!fails.empty()) return fails;
    accept(z);
    energy_.weigh(time_.weight(), [&] {  // (7.4)
        system_.book(start, theta_, elastic_.force(), q_, energy_);
        const scalar lost = elastic_.dissipated(cloud.Up);
        const scalar work = outsideActs() ? outside_->work(cloud, time_.tau()) : 0;
        energy_[energyLedger::springs] -= work + lost;
        energy_[energyLedger::viscosity] += lost;
        // what the level does outside it undoes at faces or walls, by the same volume
        const scalar ofLevel = outsideActs() ? outside_->workOfLevel(cloud, time_.tau()) : 0;
        energy_[energyLedger::forces] += work + ofLevel;
        energy_[c_.walls->hasOpen() ? energyLedger::faces : energyLedger::walls] -= ofLevel;
    });
    if (const word reason = tooFar(dt, c_.time.adjustTimeStep()); !reason.empty()) return reason;
    sources_.book(dt);                                                            // (5.12), (7.5)
    time_.end(cloud, energy_);                                                    // (8.42)
    system_.hydrostatic().giveBack(cloud);                                        // (1.9)
    if (const word reason = tooRough(time_, dt); !reason.empty()) return reason;  // (8.44)

    growThrombus(dt);                             // (1.13)
    c_.followOpen(system_.rows().viscous(), dt);  // strips follow the fluid, theory 4.2
    shift(shifting_, dt);                         // with the present neighbours, (8.30) to (8.36)
    move(time_);                                  // (8.42) with u_b for F
    endMemory(dt);                                // (5.35)
    energy_.end();
    if (const word reason = gains(dt); !reason.empty()) return reason;  // (8.40)
    energy_.book();
    c_.walls->exchange(cloud, t + dt);  // theory 4.2
    return "";
}

}  // namespace

void checkMonolithicEntries(const fsiCase& c)
{
    monolithicEntries{c};
}

std::unique_ptr<couplingScheme> newMonolithic(fsiCase& c)
{
    const monolithicEntries e(c);
    findRest(c, e.preconditioner, e.theta, e.alpha);
    return std::make_unique<monolithic>(c, e);
}

}  // namespace ispf
