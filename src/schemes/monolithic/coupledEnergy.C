// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupledSystem.H"

namespace ispf
{

void coupledSystem::book(const List<vec4>& before, scalar theta, const List<vec4>& springForce,
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

// Books (7.1) times dt u' over the rows that the ledger counts, without the first line of the step
void coupledSystem::bookMomentum(const List<vec4>& before, const List<vec4>& springForce,
                                 const List<vec4>& drop, energyLedger& energy) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar V = cloud.volume(), m = c_.rho * V;
    List<vec4> spring(springForce);
    if (K_)
    {
        Ku_.resize(cloud.nSolid());
        K_->apply(phi_, Ku_);
        forEach(0, cloud.nSolid(), [&](label i) { spring[i].s -= dt_ * Ku_[i].s; });
    }
    const auto [forced, left, resisted] =
        sumsOf(0, cloud.n(), [&](label i) -> std::array<scalar, 3> {
            if (!cloud.isFree(i)) return {};
            const vector u = phi_[i].xyz(), gained = u - before[i].xyz();
            vector force = vector::Zero();
            if (!c_.bodyForce.empty())
                force += m * (c_.bodyForce[cloud.zone[i]] - hydrostatic_.acceleration());
            if (!drop.empty()) force -= V * drop[i].xyz();
            vector rest = viscousFactor() * lap_[i].xyz() + V * gp_[i].xyz() - force;
            if (!drop.empty()) rest -= V * drop[i].xyz();  // gp_ contains it
            if (i < label(spring.size())) rest -= spring[i].xyz();
            const vector resists = chi_.empty() ? vector(vector::Zero()) : vector(V * chi_[i] * u);
            return {dt_ * u.dot(force), u.dot(m * gained + dt_ * (rest + resists)),
                    dt_ * u.dot(resists)};
        });
    energy.bookFriction(rows_.viscous().powerOf(phi_), dt_ * c_.mu * V);
    energy[energyLedger::viscosity] -= resisted;
    energy[energyLedger::forces] += forced;
    energy[energyLedger::solver] += left;
    energy.bookSprings(spring, dt_);
}

// Books (7.2) times p': the work of the pressure, continuity row by row
void coupledSystem::bookPressure(const List<vec4>& before, scalar theta, const List<scalar>& q,
                                 const List<vec4>& drop, energyLedger& energy) const
{
    particleCloud& cloud = c_.cloud;
    List<scalar> div, rows;
    rows_.divergence(phi_, div);
    List<vec4> gs;
    stabiliserGradient(gp_, gs);
    for (const auto& [g, offset] : pressureOffsets()) gs[g][3] += offset;
    rows_.continuity(phi_, gs, rows);
    addSolidMemory(before, theta, rows);
    const scalar level = energy.level(phi_);
    const List<scalar>&all = rows_.pair().wallFlux(), &faces = rows_.pair().faceFlux();
    cloud.takeIn([&](label i) { return rows[i] + all[i]; });
    energy.bookRows(level, dt_, [&](label i) -> energyLedger::continuityRow {
        const scalar face = faces.empty() ? 0 : faces[i];
        const vector g = gp_[i].xyz() - (drop.empty() ? vector(vector::Zero()) : drop[i].xyz());
        return {phi_[i][3], rows[i] - div[i], rows[i] + all[i], q[i], all[i], face, g};
    });
}

}  // namespace ispf
