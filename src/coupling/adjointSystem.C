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

scalar adjointSystem::viscousLoss(List<vec4>& u) const
{
    c_.cloud.fillGhosts(u, false);
    return c_.nu() * dt_ * rows_.viscous().dissipation(u);
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

void adjointSystem::rightHandSide(scalar theta, const List<vec4>& springForce,
                                  const List<scalar>& q, List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    // u = p = 0 with the boundary's values: what the rows give now belongs on the right
    phi_.assign(cloud.nAll(), vec4{});
    cloud.fillGhosts(phi_, false);
    rows_.viscous().apply(phi_, lap_);
    const List<std::pair<label, scalar>> drops = pressureOffsets();
    List<scalar> known(rows_.pair().wallFlux());
    List<vec4> drop;  // G p of the pressure drops
    if (!drops.empty())
    {
        rows_.gradient(phi_, drop);
        stabiliserGradient(drop, gs_);
        for (const auto& [g, offset] : drops) gs_[g][3] += offset;
        List<vec4> none(cloud.nAll());
        rows_.continuity(none, gs_, cp_);
        for (label i = cloud.nSolid(); i < cloud.n(); ++i) known[i] += cp_[i];
    }
    if (cloud.nSolid() > 0)  // the memory of the solid's stabiliser
    {
        gs_.assign(cloud.nAll(), vec4{});
        for (label i = 0; i < cloud.nSolid(); ++i) gs_[i][3] = theta * cloud.Up[i][3];
        cloud.fillGradientGhosts(gs_);
        rows_.solidStabiliser(gs_, cp_);
        for (label i = 0; i < cloud.nSolid(); ++i) known[i] += cp_[i];
    }
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

}  // namespace ispf
