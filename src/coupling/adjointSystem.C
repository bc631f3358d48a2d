// SPDX-License-Identifier: GPL-3.0-or-later
#include "adjointSystem.H"

namespace ispf
{

std::unique_ptr<coupledSystem> newAdjointSystem(fsiCase& c)
{
    return std::make_unique<adjointSystem>(c);
}

const List<scalar>& adjointSystem::setupRows(const volumeConstraint* volume,
                                             const solidSurface* surface)
{
    rows_.setup(c_.cloud, c_.list, c_.correction, *c_.kernel, volume, surface);
    return rows_.viscous().sum();
}

// {G p, p} of the fluid, {0, p} of the solid, ghosts filled
void adjointSystem::stabiliserGradient(const List<vec4>& gp, List<vec4>& gs) const
{
    const particleCloud& cloud = c_.cloud;
    gs.resize(cloud.nAll());
    for (label i = 0; i < cloud.n(); ++i)
    {
        gs[i] = cloud.isFluid(i) ? gp[i] : vec4{};
        gs[i][3] = phi_[i][3];
    }
    cloud.fillGradientGhosts(gs);
}

// G p of the pressure drops alone over cyclic patches, empty without
List<vec4> adjointSystem::gradientOfDrops() const
{
    List<vec4> drop;
    if (pressureOffsets().empty()) return drop;
    phi_.assign(c_.cloud.nAll(), vec4{});
    c_.cloud.fillGhosts(phi_, false);
    rows_.gradient(phi_, drop);
    return drop;
}

// The memory of the solid's stabiliser
void adjointSystem::addSolidMemory(const List<vec4>& before, scalar theta, List<scalar>& rows) const
{
    const particleCloud& cloud = c_.cloud;
    if (cloud.nSolid() == 0) return;
    gs_.assign(cloud.nAll(), vec4{});
    for (label i = 0; i < cloud.nSolid(); ++i) gs_[i][3] = theta * before[i][3];
    cloud.fillGradientGhosts(gs_);
    rows_.solidStabiliser(gs_, cp_);
    for (label i = 0; i < cloud.nSolid(); ++i) rows[i] += cp_[i];
}

void adjointSystem::rightHandSide(scalar theta, const List<vec4>& springForce,
                                  const List<scalar>& q, List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    // u = p = 0 with the boundary's values: what the rows give now belongs on the right
    phi_.assign(cloud.nAll(), vec4{});
    cloud.fillGhosts(phi_, false);
    rows_.viscous().apply(phi_, lap_);
    List<scalar> known(rows_.pair().wallFlux());
    const List<vec4> drop = gradientOfDrops();
    if (!drop.empty())
    {
        stabiliserGradient(drop, gs_);
        for (const auto& [g, offset] : pressureOffsets()) gs_[g][3] += offset;
        const List<vec4> none(cloud.nAll());
        rows_.continuity(none, gs_, cp_);
        for (label i = cloud.nSolid(); i < cloud.n(); ++i) known[i] += cp_[i];
    }
    addSolidMemory(cloud.Up, theta, known);
    momentumSide(springForce, lap_, drop, b);
    for (label i = 0; i < cloud.n(); ++i)
        if (!cloud.pHeld(i)) b[4 * i + 3] = cloud.dx * (q[i] - known[i]);
    enclosed_.balance(b);
}

void adjointSystem::apply(const List<scalar>& x, List<scalar>& y) const
{
    const particleCloud& cloud = c_.cloud;
    phi_.resize(cloud.nAll());
    std::copy(x.begin(), x.end(), reinterpret_cast<scalar*>(phi_.data()));
    enclosed_.dropLevel(phi_);
    cloud.fillGhosts(phi_, true);
    rows_.gradient(phi_, gp_);
    rows_.viscous().apply(phi_, lap_);
    stabiliserGradient(gp_, gs_);
    rows_.continuity(phi_, gs_, cp_);
    writeRows(phi_, lap_, gp_, cp_, y);
}

void adjointSystem::book(const List<vec4>& before, scalar theta, const List<vec4>& springForce,
                         const List<scalar>& q, energyLedger& energy) const
{
    const List<vec4> drop = gradientOfDrops();
    phi_ = c_.cloud.Up;
    phi_.resize(c_.cloud.nAll());
    enclosed_.dropLevel(phi_);
    c_.cloud.fillGhosts(phi_, false);
    rows_.gradient(phi_, gp_);
    rows_.viscous().apply(phi_, lap_);
    bookMomentum(before, springForce, drop, energy);
    bookPressure(before, theta, q, drop, energy);
}

// (7.1) times dt u', over the rows that the ledger counts, without the step's first line
void adjointSystem::bookMomentum(const List<vec4>& before, const List<vec4>& springForce,
                                 const List<vec4>& drop, energyLedger& energy) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar V = cloud.volume(), m = c_.rho * V;
    List<vec4> spring(springForce);
    if (K_)
    {
        Ku_.resize(cloud.nSolid());
        K_->apply(phi_, Ku_);
        for (label i = 0; i < cloud.nSolid(); ++i) spring[i].s -= dt_ * Ku_[i].s;
    }
    scalar forced = 0, left = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        if (!cloud.isFree(i)) continue;
        const vector u = phi_[i].xyz(), gained = u - before[i].xyz();
        vector force = vector::Zero();
        if (!c_.bodyForce.empty())
            force += m * (c_.bodyForce[cloud.zone[i]] - hydrostatic_.acceleration());
        if (!drop.empty()) force -= V * drop[i].xyz();
        vector rest = viscousFactor() * lap_[i].xyz() + V * gp_[i].xyz() - force;
        if (!drop.empty()) rest -= V * drop[i].xyz();  // it is in gp_ already
        if (i < label(spring.size())) rest -= spring[i].xyz();
        forced += dt_ * u.dot(force);
        left += u.dot(m * gained + dt_ * rest);
    }
    energy.bookFriction(rows_.viscous().powerOf(phi_), dt_ * c_.mu * V);
    energy[energyLedger::forces] += forced;
    energy[energyLedger::solver] += left;
    energy.bookSprings(spring, dt_);
}

// (7.2) times p': what the pressure does, row by row of continuity
void adjointSystem::bookPressure(const List<vec4>& before, scalar theta, const List<scalar>& q,
                                 const List<vec4>& drop, energyLedger& energy) const
{
    const particleCloud& cloud = c_.cloud;
    List<scalar> div, rows;
    rows_.divergence(phi_, div);
    List<vec4> gs;
    stabiliserGradient(gp_, gs);
    for (const auto& [g, offset] : pressureOffsets()) gs[g][3] += offset;
    rows_.continuity(phi_, gs, rows);
    addSolidMemory(before, theta, rows);
    const scalar level = energy.level(phi_);
    const List<scalar>&all = rows_.pair().wallFlux(), &faces = rows_.pair().faceFlux();
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar face = faces.empty() ? 0 : faces[i];
        const vector g = gp_[i].xyz() - (drop.empty() ? vector(vector::Zero()) : drop[i].xyz());
        energy.bookRow(i, {phi_[i][3], rows[i] - div[i], rows[i] + all[i], q[i], all[i], face, g},
                       level, dt_);
    }
}

}  // namespace ispf
