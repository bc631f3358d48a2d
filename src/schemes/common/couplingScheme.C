// SPDX-License-Identifier: GPL-3.0-or-later
#include "couplingScheme.H"

#include "approachLimit.H"
#include "deformation.H"
#include "execution.H"
#include "shiftingFrame.H"
#include "solidState.H"
#include "stepReport.H"

#include <cmath>

namespace ispf
{

namespace
{

// Greatest number of halvings of a step of the user's length, and of an adjusted step
constexpr int mostHalvings = 4, mostShortenings = 12;
// Greatest number of repeated solutions of a step for its outlets
constexpr int mostAsked = 20;
// Largest ratio of an adjusted step to the step before
constexpr scalar fastestGrowth = 2;
// A step is refused if a particle moves farther [dx] and a pair changes more than this
constexpr scalar farthest = 0.6, mostDeformed = 0.6;
// The next step aims at this way of a particle [h] or, if that gives a longer step, at this change of a pair
constexpr scalar aimedWay = 0.4, aimedDeformation = 0.4;
// Largest local error of a particle's way in one step [dx]; the share of it at which the next step aims
constexpr scalar roughest = 0.2, aimedAt = 0.8;
// Largest share of the energies at hand that a step may gain from nothing
constexpr scalar mostGained = 0.05;
// A gain of energy is rounding if the fastest particle moves less than this in one step [dx]
constexpr scalar atRest = 1e-6;
}  // namespace

namespace entries
{

// With adjustTimeStep: largest local error of a way in the last step, over dt^2 [m/s^2]
const stateEntry<scalar> wayError{"wayError"};
// With adjustTimeStep: length of the last accepted step [s]
const stateEntry<scalar> acceptedStep{"acceptedStep"};
// With adjustTimeStep, of the last step: largest change of a pair over the largest way of a particle [1/m], and the largest
// way of a particle beyond open faces over the largest way of all
const stateEntry<std::array<scalar, 2>> deformation{"deformation"};

}  // namespace entries

couplingScheme::couplingScheme(fsiCase& c)
    : c_(c), energy_(c), zones_(resistanceZones::New(c)), endless_(shiftingFrame(c) == "mean")
{
}

word couplingScheme::advice() const
{
    return "Run checkParticles, and see whether a load or a motion jumps";
}

couplingScheme::stepLimit couplingScheme::limit() const
{
    return adjusted(limitAt(c_.time.value()));
}

couplingScheme::stepLimit couplingScheme::limitAt(scalar t) const
{
    c_.walls->setStep(t, c_.stepEnd(t));
    return admitted();
}

bool couplingScheme::step(scalar t, scalar dt)
{
    printCourant(c_.cloud, dt);
    if (c_.time.adjustTimeStep())
    {
        if (!accepted(t, dt, refusals_, mostShortenings))
        {
            ++refusals_;
            return false;
        }
        refusals_ = 0;
        c_.cloud.state.set(entries::acceptedStep, dt);
    }
    else advance(t, dt, 0);
    if (c_.structure && c_.time.writeTime()) keep();
    return true;
}

void couplingScheme::advance(scalar t, scalar dt, int depth)
{
    if (accepted(t, dt, depth, mostHalvings)) return;
    advance(t, 0.5 * dt, depth + 1);
    advance(t + 0.5 * dt, 0.5 * dt, depth + 1);
}

// Takes the step, or undoes it and prints the reason.  fatalError if it is refused after `most` halvings
bool couplingScheme::accepted(scalar t, scalar dt, int halvings, int most)
{
    before_ = c_.cloud;
    word reason = attempt(t, dt);
    for (int k = 0; reason == outletsAsk && k < mostAsked; ++k) undo(), reason = attempt(t, dt);
    if (reason.empty()) return true;
    if (halvings == most)
        throw fatalError("Time " + str(t) + " s: a step of " + str(dt) +
                         " s is refused: " + reason + ". Before it " + std::to_string(most) +
                         " steps, each twice as long as the next, were refused. " + advice() +
                         ". The last written time is intact");
    warning("time " + str(t) + " s: step of " + str(dt) + " s halved: " + reason, 20);
    undo();
    return false;
}

// The state before the attempted step
void couplingScheme::undo()
{
    c_.cloud = before_;
    recallSolid(c_);
}

// Mean velocity if only cyclic patches bound the case (shiftingFrame.H), else zero
vector couplingScheme::frame() const
{
    if (!endless_) return vector::Zero();
    const label n = c_.cloud.n();
    const auto sum = sumsOf(0, n, [&](label i) {
        const vec4& u = c_.cloud.Up[i];
        return std::array<scalar, 3>{u[0], u[1], u[2]};
    });
    return vector(sum[0], sum[1], sum[2]) / scalar(n);
}

word couplingScheme::tooFar(scalar dt, bool keeps)
{
    const particleCloud& cloud = c_.cloud;
    const vector along = frame();
    const auto wayOf = [&](label i) { return dt * (cloud.Up[i].xyz() - along).norm(); };
    // p counts too, so that a p that is not finite is found
    const scalar most =
        largestOf(0, cloud.n(), [&](label i) { return wayOf(i) + 0 * cloud.Up[i][3]; });
    const scalar mostInStrip = largestOf(
        0, cloud.n(), [&](label i) { return cloud.beyondOpen(i) ? wayOf(i) : scalar(0); });
    if (!std::isfinite(most) || mostInStrip > farthest * cloud.dx)
        for (label i = 0; i < cloud.n(); ++i)
            if (const scalar way = wayOf(i); !std::isfinite(way + 0 * cloud.Up[i][3]) ||
                                             (cloud.beyondOpen(i) && way > farthest * cloud.dx))
                return cloud.describe(i) + " would move " + str(way / cloud.dx, 3) + " dx";
    const bool far = most > farthest * cloud.dx;
    if (!far && !keeps) return "";
    const auto [rate, i, j] = fastestDeformation(cloud, c_.list);
    if (far && !(dt * rate <= mostDeformed))
        return cloud.describe(i) + " and " + (j < cloud.n() ? cloud.describe(j) : "an image") +
               " would move against each other by " + str(dt * rate, 3) + " of their distance";
    if (keeps && most > 0)
        c_.cloud.state.set(entries::deformation, {dt * rate / most, mostInStrip / most});
    return "";
}

couplingScheme::stepLimit couplingScheme::motionLimit() const
{
    const vector along = frame();
    const scalar given = c_.walls->maxGivenSpeed();
    const scalar u = std::max(given, largestOf(0, c_.cloud.n(), [&](label i) {
                                  return (c_.cloud.Up[i].xyz() - along).norm();
                              }));
    if (!c_.time.adjustTimeStep() || u == 0) return {1e30, "no"};
    const scalar way = aimedWay * c_.kernel->h();
    const auto last = c_.cloud.state.find(entries::deformation);
    if (!last || !((*last)[0] * way < aimedDeformation)) return {way / u, "CFL"};
    const auto [change, stripShare] = *last;
    const scalar dt = aimedDeformation / (change * u), own = std::max(given, stripShare * u);
    if (own * dt > way) return {way / own, "CFL"};
    return {dt, "deformation"};
}

word couplingScheme::tooRough(const timeScheme& time, scalar dt, bool mean)
{
    const particleCloud& cloud = c_.cloud;
    const auto errorOf = [&](label i) {
        return cloud.isFree(i) ? time.errorOfWay(cloud, i, mean) : 0;
    };
    const scalar worst = largestOf(0, cloud.n(), errorOf);
    for (label i = 0; worst > roughest * cloud.dx && i < cloud.n(); ++i)
        if (errorOf(i) == worst)
            return "the way of " + cloud.describe(i) + " is uncertain by " +
                   str(worst / cloud.dx, 3) + " dx, so fast does its velocity change";
    if (c_.time.adjustTimeStep()) c_.cloud.state.set(entries::wayError, worst / (dt * dt));
    return "";
}

couplingScheme::stepLimit couplingScheme::adjusted(const stepLimit& own) const
{
    if (!c_.time.adjustTimeStep()) return own;
    stepLimit least = own;
    const auto within = [&](const stateEntry<scalar>& entry, const word& rule, auto&& stepOf) {
        const scalar known = c_.cloud.state.get(entry, 0);
        if (!(known > 0)) return;
        if (const scalar dt = stepOf(known); dt < least.dt) least = {dt, rule};
    };
    within(entries::wayError, "local error",
           [&](scalar error) { return std::sqrt(aimedAt * roughest * c_.cloud.dx / error); });
    within(entries::acceptedStep, "growth", [](scalar dt) { return fastestGrowth * dt; });
    return least;
}

void couplingScheme::shift(const particleShifting& shifting, scalar dt)
{
    energy_.shifts([&] {
        const scalar closest = shifting.on() ? shifting.closest() * c_.cloud.dx : 0;
        shifting.shift(
            c_.cloud, c_.list, c_.correction, dt, energy_.taken(),
            [&](label i, vector& dr) { c_.walls->limitShift(c_.cloud, i, 0.5 * closest, dr); });
        toSolid_.clear();
        if (closest > 0)
        {
            limitApproach(c_.cloud, c_.list, closest, shifting.closestToSolid() * c_.cloud.dx, dt,
                          toSolid_);
            c_.walls->limitApproach(c_.cloud, 0.5 * closest, dt);
        }
    });
}

void couplingScheme::move(const timeScheme& time, bool mean)
{
    time.move(c_.cloud, mean);
    energy_.shifts([&] {
        for (size_t i = 0; i < toSolid_.size(); ++i) c_.cloud.Up[i].s += toSolid_[i].s;
    });
}

void couplingScheme::setResistance()
{
    if (!zones_) return;
    const auto before = c_.cloud.vectors.find(levelBefore);
    zones_->setStep(before == c_.cloud.vectors.end() ? nullptr : &before->second);
}

void couplingScheme::growThrombus(scalar dt)
{
    if (zones_) zones_->grow(dt);
}

void couplingScheme::beginMemory(const timeScheme& time, scalar ahead)
{
    if (solidMemory* memory = c_.structure ? c_.structure->memory() : nullptr)
        memory->begin(time.startPlaces(c_.cloud), ahead);
}

void couplingScheme::endMemory(scalar dt)
{
    solidMemory* memory = c_.structure ? c_.structure->memory() : nullptr;
    if (!memory) return;
    const scalar lost = memory->end(c_.cloud.x, dt);
    energy_[energyLedger::viscosity] -= lost, energy_[energyLedger::springs] += lost;
    keepSolid(c_);
}

word couplingScheme::gains(scalar dt) const
{
    if (!(c_.cloud.maxSpeed() * dt > atRest * c_.cloud.dx)) return "";
    const auto [gained, of] = energy_.fromNothing();
    if (!(gained > mostGained * of)) return "";
    return "in it the flow gains " + str(gained, 3) + " J from nothing, " +
           str(100 * gained / of, 3) + " % of the energies at hand (" + energy_.largest() + ")";
}

}  // namespace ispf
