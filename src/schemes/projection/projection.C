// SPDX-License-Identifier: GPL-3.0-or-later
// coupling projection: the algorithm of the paper for fluid and soft walls, with explicit springs.  Entries
// of system/sphSolution:
//
//     projection
//     {
//         viscosity      implicit;     // or explicit
//         positionUpdate symplectic;   // or mean, x += dt (u^n + u^{n+1})/2 as in the paper
//         reflection     0;            // to 1: less damping by the step, fractionalStep.H
//         limits { CFL 0.4; force 0.25; viscous 0.125; }
//     }
//     shifting { ... }     densityFeedback 0;     solvers { p { ... } U { ... } }
//
#include "closedBodies.H"
#include "fluidSources.H"
#include "fractionalStep.H"
#include "hydrostaticPart.H"
#include "projectionLimits.H"
#include "shiftingFrame.H"
#include "solidSides.H"
#include "solverPerformance.H"
#include "stepReport.H"
#include "timeScheme.H"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ispf
{

namespace entries
{

// Slope of p along cyclic patches in the last step, absent if it is zero [Pa/m]
const stateEntry<vector> pressureSlope{"pressureSlope"};

}  // namespace entries

namespace
{

// Open surface of a solid over that before fluid from which on the solid is bare: a few particles in the midst of packed ones
// count as open by mistake
constexpr scalar someOpen = 0.1;

struct projectionEntries
{
    dictionary dict;
    bool explicitViscosity, mean;
    projectionLimits limits;

    explicit projectionEntries(const fsiCase& c)
        : dict(c.solution.subOrEmptyDict("projection")),
          explicitViscosity(dict.chooseOrDefault("viscosity", {"implicit", "explicit"},
                                                 "implicit") == "explicit"),
          mean(dict.chooseOrDefault("positionUpdate", {"symplectic", "mean"}, "symplectic") ==
               "mean"),
          limits(c, explicitViscosity, mean, dict.subOrEmptyDict("limits"))
    {
    }
};

class projection : public couplingScheme
{
public:
    explicit projection(fsiCase& c) : projection(c, projectionEntries(c)) {}

    projection(fsiCase& c, const projectionEntries& e)
        : couplingScheme(c),
          dict_(e.dict),
          explicit_(e.explicitViscosity),
          mean_(e.mean),
          time_(c),
          limits_(e.limits),
          step_(c.rho, c.mu, explicit_ ? "explicit" : "implicit", c.solution, time_.secondOrder()),
          shifting_(c.solution.subOrEmptyDict("shifting"), shiftingFrame(c),
                    shiftStiffness::ofLattice(*c.kernel, c.cloud.nDims, c.cloud.dx)),
          hydrostatic_(c)
    {
        if (zones_ && zones_->needsSpeed()) time_.keepLevels();
        sources_.add(std::make_unique<zoneSource>(c));
        sources_.add(std::make_unique<drainedSource>(c, step_.pair()));
        const auto refuse = [&](const word& key) {
            dict_.fail(key,
                       "With ddtScheme DLN, which is of second order, nothing is left for this "
                       "entry to do. "
                       "Leave it away, or take ddtScheme Euler in system/sphSchemes");
        };
        const dictionary& solid = c.structureProperties;
        const auto unknown = [&](const word& key, const word& what) {
            solid.fail(key,
                       "coupling projection knows nothing " + what + ". Take coupling monolithic");
        };
        if (solid.found("outside")) unknown("outside", "outside the solid");
        if (solid.found("contact")) unknown("contact", "of solids in contact");
        if (solid.found("prestress")) unknown("prestress", "of a load at the start");
        if (c.structure && c.structure->damps())
            c.structureProperties.fail(
                "structureModel",
                "The solid has a viscosity, for which coupling projection, with its explicit "
                "forces of the solid, has no term. Take coupling monolithic, or 'relaxation' in "
                "place of 'viscosity'");
        if (time_.secondOrder() && mean_) refuse("positionUpdate");
        if (time_.secondOrder() && dict_.getOrDefault<scalar>("reflection", 0) > 0)
            refuse("reflection");
        info() << "projection: ddtScheme " << time_.name() << ", viscosity "
               << (explicit_ ? "explicit" : "implicit") << ", positionUpdate "
               << (mean_ ? "mean" : "symplectic") << ", shifting " << shifting_.describe()
               << std::endl;
    }

private:
    stepLimit admitted() const override;
    word attempt(scalar t, scalar dt) override;
    void keep() override { limits_.keep(c_.cloud); }

    List<vec4> accelerations(const vector& slope, List<vec4>& spring) const;
    void checkPushed() const;
    void refuseBareWalls();
    void addSlope(scalar sign, const vector& ofState);
    void begin(scalar t, scalar dt);
    void solve(const stencil& s, scalar dt);
    List<scalar> resists(scalar dt) const;

    dictionary dict_;
    bool explicit_, mean_;
    timeScheme time_;
    projectionLimits limits_;
    fractionalStep step_;
    particleShifting shifting_;
    volumeSources sources_;
    hydrostaticPart hydrostatic_;
    bool looked_ = false;            // for bare walls
    vector slope_ = vector::Zero();  // of p along cyclic patches with a pressureDrop [Pa/m]
};

couplingScheme::stepLimit projection::admitted() const
{
    List<vec4> spring;
    return limits_.ruling(accelerations(c_.walls->pressureSlope(), spring));
}

// Accelerations by the body force of each zone, by springs (Eq. (2) of the paper) and by the slope of p along cyclic patches
List<vec4> projection::accelerations(const vector& slope, List<vec4>& spring) const
{
    const particleCloud& cloud = c_.cloud;
    List<vec4> a(cloud.n());
    if (c_.structure)
    {
        const scalar perMass = 1 / (c_.rho * cloud.volume());
        c_.structure->force(cloud.x, spring);
        for (label i = 0; i < cloud.nSolid(); ++i) a[i].s = perMass * spring[i].s;
    }
    if (!c_.bodyForce.empty())
        forEach(0, cloud.n(), [&](label i) {
            a[i].s += vec4::from(c_.bodyForce[cloud.zone[i]] - hydrostatic_.acceleration()).s;
        });
    forEach(0, cloud.n(), [&](label i) {
        if (cloud.uFixed[i]) a[i] = vec4{};
        else a[i].s -= vec4::from(slope / c_.rho).s;
    });
    return a;
}

// Refuses walls that push into closed fluid.  solve() calls it without a structure only: an elastic wall gives way
void projection::checkPushed() const
{
    const List<label> bodyOf = closedBodies(c_.cloud, c_.list);
    if (std::all_of(bodyOf.begin(), bodyOf.end(), [](label b) { return b < 0; })) return;
    const sweptRates pushed = c_.walls->swept(c_.cloud);
    for (label b = 0; b < label(bodyOf.size()); ++b)
    {
        List<label> zones;
        for (label z = 0; z < label(bodyOf.size()); ++z)
            if (bodyOf[z] == b) zones.push_back(z);
        if (!zones.empty()) refusePush(c_, pushed, zones);
    }
}

// A pressure that falls from period to period acts as a body force; p less this slope is periodic.  Adds sign times the
// slope: ofState to p of the particles, slope_ of the step to given pressures and ghosts
void projection::addSlope(scalar sign, const vector& ofState)
{
    if (slope_.isZero(0) && ofState.isZero(0)) return;
    particleCloud& cloud = c_.cloud;
    const auto part = [&](label j) { return sign * slope_.dot(cloud.x[j].xyz()); };
    for (label i = 0; i < cloud.n(); ++i)
        cloud.Up[i][3] += sign * ofState.dot(cloud.x[i].xyz()), cloud.pGiven[i] += part(i);
    for (label g = cloud.n(); g < cloud.nAll(); ++g)
        if (const label source = cloud.ghostSource(g); source >= 0)
            cloud.addToGhostPressure(g, part(g) - part(source));
}

// dt chi/rho of (6.15), empty without zones of resistance
List<scalar> projection::resists(scalar dt) const
{
    if (!zones_) return {};
    List<scalar> of(zones_->chi());
    for (scalar& chi : of) chi *= dt / c_.rho;
    return of;
}

// Solves for {u, v, w, p}, and books the energies and volumes of the step
void projection::solve(const stencil& s, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    if (!c_.structure) checkPushed();
    hydrostatic_.take(cloud);  // (1.9)
    addSlope(-1, cloud.state.get(entries::pressureSlope, vector::Zero()));
    c_.time.stages.in("operators",
                      [&] { step_.setup(cloud, s, *c_.kernel, resists(dt)); });  // (6.4)
    const List<scalar> q = sources_.sum(cloud.n(), dt);                          // q of (6.2)
    List<vec4> spring;
    c_.time.stages.in("velocity",  // (6.1)
                      [&] { step_.predict(cloud, s, accelerations(slope_, spring), dt); });
    c_.time.stages.in("pressure",  // (6.2), (6.3)
                      [&] { step_.project(cloud, s, q, c_.kernel->support(), dt); });
    energy_.weigh(time_.weight(), [&] {  // (6.10) to (6.12)
        step_.book(cloud, dt, energy_);
        energy_[energyLedger::forces] -= energy_.bookSprings(spring, dt);
    });
    step_.settle(cloud, c_.kernel->support(), dt);
    hydrostatic_.giveBack(cloud), addSlope(1, slope_);
    if (slope_.isZero(0)) cloud.state.erase(entries::pressureSlope);
    else cloud.state.set(entries::pressureSlope, slope_);
    step_.printContinuityErrors(cloud, q, dt);
    sources_.book(dt);
}

// No equation has p = 0 where neither fluid nor wall is before a solid: the fluid on its other side would not load it
void projection::refuseBareWalls()
{
    looked_ = true;
    const particleCloud& cloud = c_.cloud;
    const solidSides all(cloud, c_.list, c_.structure->reference().images);
    const label nothing = label(cloud.zones.size());
    scalar wet = 0, open = 0;
    label first = -1;
    for (label i = 0; i < cloud.nSolid(); ++i)
    {
        if (cloud.uFixed[i]) continue;
        const solidSides::sides s = all.of(i);
        for (const int k : {0, 1})
        {
            if (s.zone[k] < 0) continue;
            (s.zone[k] == nothing ? open : wet) += s.area[k].norm();
            if (s.zone[k] == nothing && first < 0) first = i;
        }
    }
    if (!(wet > 0) || !(open > someOpen * wet)) return;
    c_.structureProperties.fail(
        "structureModel",
        "Neither fluid nor wall is before the solid at " + cloud.describe(first) +
            ", and other parts of it have fluid. Coupling projection has no pressure there, and "
            "the fluid would not load the solid. Take coupling monolithic, or put fluid on both "
            "sides");
}

// Places of the forces, u_0 and the neighbours there
void projection::begin(scalar t, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    time_.start(cloud, t, dt);
    c_.time.stages.in("neighbours", [&] { c_.updateNeighbours(time_.times()); });
    if (c_.structure && !looked_) refuseBareWalls();
    hydrostatic_.setStep(t, t + dt);
    slope_ = c_.walls->pressureSlope();
    energy_.begin(time_.startPlaces(cloud));
    beginMemory(time_, 0);
    setResistance();  // (1.10)
    time_.begin(cloud);
}

word projection::attempt(scalar t, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    begin(t, dt);  // x_b and u_0 of (8.41)
    const word fails = atTime(t + dt, [&]() -> word {
        try
        {
            solve({cloud, c_.list, c_.correction}, time_.tau());  // (6.1) to (6.3)
            return "";
        }
        catch (const notConverged& e)
        {
            return e.what();
        }
    });
    if (!fails.empty()) return fails;
    if (c_.walls->hasOpen() && !c_.walls->outletsAgree(cloud, c_.rho, time_.tau()))
        return outletsAsk;  // (4.15)
    if (const word reason = tooFar(dt); !reason.empty()) return reason;
    time_.end(cloud, energy_);                                                           // (8.42)
    if (const word reason = tooRough(time_, dt, mean_); !reason.empty()) return reason;  // (8.44)

    growThrombus(dt);                    // (1.13)
    c_.followOpen(step_.viscous(), dt);  // strips follow the fluid, theory 4.2
    shift(shifting_, dt);                // with the present neighbours, (8.30) to (8.36)
    move(time_, mean_);                  // (8.42) with u_b for F
    endMemory(dt);                       // (5.35)
    energy_.end();
    if (const word reason = gains(dt); !reason.empty()) return reason;  // (8.40)
    energy_.book();
    c_.walls->exchange(cloud, t + dt);  // theory 4.2
    return "";
}

}  // namespace

void checkProjectionEntries(const fsiCase& c)
{
    projectionEntries{c};
    fractionalStep(c.rho, c.mu, "implicit", c.solution);
}

std::unique_ptr<couplingScheme> newProjection(fsiCase& c)
{
    return std::make_unique<projection>(c);
}

}  // namespace ispf
