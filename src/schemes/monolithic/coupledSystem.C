// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupledSystem.H"

namespace ispf
{

// Clamped particles have no tangent among themselves: they get the mean of free ones
template <class Entry>
scalar coupledSystem::meanOfFree(const Entry& entry, bool any) const
{
    const auto [n, sum] = sumsOf(0, any ? c_.cloud.nSolid() : 0, [&](label i) {
        return c_.cloud.uFixed[i] ? std::array<scalar, 2>{} : std::array<scalar, 2>{1, entry(i)};
    });
    return n > 0 ? sum / n : 0;
}

const solidBodies& coupledSystem::bodies()
{
    if (!bodies_) bodies_ = std::make_unique<solidBodies>(c_);
    return *bodies_;
}

void coupledSystem::setup(scalar dt, const volumeConstraint* volume, const solidSurface* surface,
                          const blockMatrix3* K, const List<scalar>* stiffness,
                          const List<scalar>& chi)
{
    const particleCloud& cloud = c_.cloud;
    dt_ = dt, K_ = K;
    rows_.setup(c_.cloud, c_.list, c_.correction, *c_.kernel, volume, surface);
    weaken(chi);
    const List<scalar>& viscous = rows_.viscous().sum();
    const scalar meanTangent =
        meanOfFree([&](label i) { return K->diagonal[i].trace() / cloud.nDims; }, K != nullptr);
    diagonal_.resize(cloud.n()), tau_.resize(cloud.n());
    forEach(0, cloud.n(), [&](label i) {
        diagonal_[i] = inertia(i) - viscousFactor() * viscous[i];
        if (K && i < cloud.nSolid())
            diagonal_[i] +=
                dt * (cloud.uFixed[i] ? meanTangent : K->diagonal[i].trace() / cloud.nDims);
        tau_[i] = cloud.volume() / diagonal_[i];
    });
    // without resistance, which weakens the stabiliser by itself
    const scalar inertiaAlone = c_.rho * cloud.volume() / dt;
    fluidTau_ = sumOf(cloud.nSolid(), cloud.n(),
                      [&](label i) {
                          return cloud.volume() / (inertiaAlone - viscousFactor() * viscous[i]);
                      }) /
                scalar(cloud.n() - cloud.nSolid());
    rows_.setTau(stabiliserTau(stiffness), fluidTau_, c_.solidModuli(),
                 volume ? &bodies() : nullptr);
    outlets_.setup(cloud, c_.walls->outletLinks(), dt / (c_.rho * cloud.dx));
    enclosed_.setup(surface);
}

// V/A_ii without the viscosity of the solid: at rest it has no stress, and the error that the stabiliser makes there must not
// depend on it, (7.22)
List<scalar> coupledSystem::stabiliserTau(const List<scalar>* stiffness) const
{
    List<scalar> tau = tau_;
    if (!stiffness) return tau;
    const scalar mean = meanOfFree([&](label i) { return (*stiffness)[i]; }, true);
    forEach(0, c_.cloud.nSolid(), [&](label i) {
        const scalar k = c_.cloud.uFixed[i] ? mean : (*stiffness)[i];
        tau[i] =
            c_.cloud.volume() / (inertia(i) - viscousFactor() * rows_.viscous().sum()[i] + dt_ * k);
    });
    return tau;
}

// Keeps chi, and weakens the fluid's stabiliser where it resists, (7.15)
void coupledSystem::weaken(const List<scalar>& chi)
{
    chi_ = chi, mobility_.resize(chi.size());
    forEach(0, label(chi.size()), [&](label i) { mobility_[i] = 1 / (1 + dt_ / c_.rho * chi[i]); });
    rows_.weaken(mobility_);
}

// Ghosts whose pressure differs from that of their source, by the drop of a cyclic pair
List<std::pair<label, scalar>> coupledSystem::pressureOffsets() const
{
    const particleCloud& cloud = c_.cloud;
    List<std::pair<label, scalar>> offsets;
    for (label g = cloud.n(); g < cloud.nAll(); ++g)
        if (const scalar p = cloud.ghostOffset(g)[3]; p != 0) offsets.push_back({g, p});
    return offsets;
}

void coupledSystem::momentumSide(const List<vec4>& springForce, const List<vec4>& lap,
                                 const List<vec4>& drop, List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar mass = c_.rho * cloud.volume();
    b.resize(size());
    forEach(0, cloud.n(), [&](label i) {
        vector m = mass / dt_ * cloud.Up[i].xyz() - viscousFactor() * lap[i].xyz();
        if (!c_.bodyForce.empty())
            m += mass * (c_.bodyForce[cloud.zone[i]] - hydrostatic_.acceleration());
        if (i < label(springForce.size())) m += springForce[i].xyz();
        if (!drop.empty()) m -= cloud.volume() * drop[i].xyz();
        if (cloud.nDims == 2) m[2] = 0;
        for (int a = 0; a < 3; ++a)
            b[4 * i + a] = cloud.uFixed[i] ? cloud.Up[i][a] : m[a] / diagonal_[i];
        if (cloud.pHeld(i)) b[4 * i + 3] = cloud.heldPressure(i);
    });
}

void coupledSystem::writeRows(const List<vec4>& phi, const List<vec4>& lap, const List<vec4>& gp,
                              const List<scalar>& continuity, List<scalar>& y) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar V = cloud.volume();
    const label nSolid = cloud.nSolid();
    if (K_)
    {
        Ku_.resize(nSolid);
        K_->apply(phi, Ku_);
    }
    y.resize(size());
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            simd4 m = inertia(i) * phi[i].s + viscousFactor() * lap[i].s + V * gp[i].s;
            if (K_ && i < nSolid) m += dt_ * Ku_[i].s;
            m /= diagonal_[i];
            if (cloud.uFixed[i]) m = phi[i].s;
            if (cloud.nDims == 2) m[2] = phi[i].s[2];  // no equation across the plane
            for (int a = 0; a < 3; ++a) y[4 * i + a] = m[a];
            y[4 * i + 3] = cloud.pHeld(i) ? phi[i].s[3] : cloud.dx * continuity[i];
        }
    });
    outlets_.apply(cloud, continuity, y);
    enclosed_.balance(y);
}

// gs = {G p, p} of the fluid, {0, p} of the solid, ghosts filled
void coupledSystem::stabiliserGradient(const List<vec4>& gp, List<vec4>& gs) const
{
    const particleCloud& cloud = c_.cloud;
    gs.resize(cloud.nAll());
    forEach(0, cloud.n(), [&](label i) {
        gs[i] = cloud.isFluid(i) ? gp[i] : vec4{};
        gs[i][3] = phi_[i][3];
    });
    cloud.fillGradientGhosts(gs);
}

// G p of the pressure drops over cyclic patches alone; empty if there are none
List<vec4> coupledSystem::gradientOfDrops() const
{
    List<vec4> drop;
    if (pressureOffsets().empty()) return drop;
    phi_.assign(c_.cloud.nAll(), vec4{});
    c_.cloud.fillGhosts(phi_, false);
    rows_.gradient(phi_, drop);
    return drop;
}

// Adds C (theta p^n) of the solid: the memory of its stabiliser
void coupledSystem::addSolidMemory(const List<vec4>& before, scalar theta, List<scalar>& rows) const
{
    const particleCloud& cloud = c_.cloud;
    if (cloud.nSolid() == 0) return;
    gs_.assign(cloud.nAll(), vec4{});
    forEach(0, cloud.nSolid(), [&](label i) { gs_[i][3] = theta * before[i][3]; });
    cloud.fillGradientGhosts(gs_);
    rows_.solidStabiliser(gs_, cp_);
    forEach(0, cloud.nSolid(), [&](label i) { rows[i] += cp_[i]; });
}

void coupledSystem::rightHandSide(scalar theta, const List<vec4>& springForce,
                                  const List<scalar>& q, List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    // u = p = 0 with the values of the boundary: the rows then give what belongs on the right side
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
        forEach(cloud.nSolid(), cloud.n(), [&](label i) { known[i] += cp_[i]; });
    }
    addSolidMemory(cloud.Up, theta, known);
    momentumSide(springForce, lap_, drop, b);
    forEach(0, cloud.n(), [&](label i) {
        if (!cloud.pHeld(i)) b[4 * i + 3] = rows_.acts(i) ? cloud.dx * (q[i] - known[i]) : 0;
    });
    outlets_.rightHandSide(cloud, known, b);
    enclosed_.balance(b);
}

void coupledSystem::apply(const List<scalar>& x, List<scalar>& y) const
{
    const particleCloud& cloud = c_.cloud;
    phi_.resize(cloud.nAll());
    forEach(0, cloud.n(), [&](label i) {
        phi_[i].s = simd4{x[4 * i], x[4 * i + 1], x[4 * i + 2], x[4 * i + 3]};
    });
    enclosed_.dropLevel(phi_);
    cloud.fillGhosts(phi_, true);
    rows_.gradient(phi_, gp_);
    rows_.viscous().apply(phi_, lap_);
    stabiliserGradient(gp_, gs_);
    rows_.continuity(phi_, gs_, cp_);
    writeRows(phi_, lap_, gp_, cp_, y);
}

}  // namespace ispf
