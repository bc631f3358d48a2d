// SPDX-License-Identifier: GPL-3.0-or-later
#include "couplingScheme.H"

#include "shiftingFrame.H"
#include "stepReport.H"

#include <cmath>

namespace ispf
{

namespace
{

constexpr int mostHalvings = 4;
// Way of a particle in one step [dx]
constexpr scalar farthest = 0.6;
// Share of the energies at hand that a step may gain from nothing
constexpr scalar mostGained = 0.05;
// Way of the fastest particle in one step [dx] below which what is gained is rounding
constexpr scalar atRest = 1e-9;

}  // namespace

couplingScheme::couplingScheme(fsiCase& c) : c_(c), energy_(c), endless_(shiftingFrame(c) == "mean")
{
}

std::unique_ptr<couplingScheme> couplingScheme::New(fsiCase& c)
{
    return c.coupling == "monolithic" ? newMonolithic(c) : newProjection(c);
}

word couplingScheme::advice() const
{
    return "Run checkParticles, and see whether a load or a motion jumps";
}

void couplingScheme::step(scalar t, scalar dt)
{
    printCourant(c_.cloud, dt);
    advance(t, dt, 0);
    if (c_.structure && c_.time.writeTime()) keep();
}

void couplingScheme::advance(scalar t, scalar dt, int depth)
{
    const particleCloud before = c_.cloud;
    const word reason = attempt(t, dt);
    if (reason.empty()) return;
    if (depth == mostHalvings)
        throw fatalError("Time " + str(t) + " s: a step of " + str(dt) +
                         " s is refused: " + reason + ". Sixteenths of deltaT do not help. " +
                         advice() + ". The last written time is intact");
    warning("time " + str(t) + " s: step of " + str(dt) + " s halved: " + reason, 20);
    c_.cloud = before;
    advance(t, 0.5 * dt, depth + 1);
    advance(t + 0.5 * dt, 0.5 * dt, depth + 1);
}

// Mean velocity where an observer may move along (shiftingFrame.H), or zero
vector couplingScheme::frame() const
{
    vector sum = vector::Zero();
    for (label i = 0; endless_ && i < c_.cloud.n(); ++i) sum += c_.cloud.Up[i].xyz();
    return sum / scalar(c_.cloud.n());
}

word couplingScheme::tooFar(scalar dt) const
{
    const particleCloud& cloud = c_.cloud;
    const vector along = frame();
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar way = dt * (cloud.Up[i].xyz() - along).norm();
        if (way < farthest * cloud.dx && std::isfinite(cloud.Up[i][3])) continue;
        return cloud.describe(i) + " would move " + str(way / cloud.dx, 3) + " dx";
    }
    return "";
}

void couplingScheme::shift(const particleShifting& shifting, scalar dt)
{
    energy_.shifts([&] {
        shifting.shift(c_.cloud, c_.list, c_.correction, dt, energy_.heated(),
                       [&](label i) { return c_.walls->nearOpen(i); });
        if (const scalar gap = 0.5 * shifting.closest(); gap > 0)
            c_.walls->limitApproach(c_.cloud, gap * c_.cloud.dx, dt);
    });
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
