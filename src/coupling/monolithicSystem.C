// SPDX-License-Identifier: GPL-3.0-or-later
#include "monolithicSystem.H"

#include <numeric>

namespace ispf
{

void monolithicSystem::setup(scalar dt, const volumeConstraint* volume, const solidSurface* surface,
                             const blockMatrix3* K)
{
    const particleCloud& cloud = c_.cloud;
    dt_ = dt, K_ = K;
    rows_.setup(cloud, c_.list, c_.correction);
    rows_.setSolid(volume, surface);
    const scalar inertia = c_.rho * cloud.volume() / dt;
    // clamped particles carry no tangent among themselves: they weigh as the mean free one does
    scalar meanTangent = 0;
    label nFree = 0;
    for (label i = 0; K && i < cloud.nSolid(); ++i)
        if (!cloud.uFixed[i]) meanTangent += K->diagonal[i].trace() / cloud.nDims, ++nFree;
    if (nFree > 0) meanTangent /= nFree;
    diagonal_.resize(cloud.n()), tau_.resize(cloud.n());
    for (label i = 0; i < cloud.n(); ++i)
    {
        diagonal_[i] = inertia - viscousFactor() * rows_.sumF()[i];
        if (K && i < cloud.nSolid())
            diagonal_[i] +=
                dt * (cloud.uFixed[i] ? meanTangent : K->diagonal[i].trace() / cloud.nDims);
        tau_[i] = cloud.volume() / diagonal_[i];
    }
    fluidTau_ = std::accumulate(tau_.begin() + cloud.nSolid(), tau_.end(), scalar(0)) /
                scalar(cloud.n() - cloud.nSolid());
    rows_.setTau(tau_, fluidTau_);
    enclosed_.setup(rows_, surface);
}

// Ghosts whose pressure is not that of their source: over a cyclic pair with a drop
List<std::pair<label, scalar>> monolithicSystem::pressureOffsets() const
{
    const particleCloud& cloud = c_.cloud;
    List<std::pair<label, scalar>> offsets;
    for (label g = cloud.n(); g < cloud.nAll(); ++g)
        if (const scalar p = cloud.ghostOffset(g)[3]; p != 0) offsets.push_back({g, p});
    return offsets;
}

// In strips C takes the gradient given there for G p (monolithicRows.H)
void monolithicSystem::leaveToGiven(List<vec4>& gs) const
{
    const particleCloud& cloud = c_.cloud;
    if (!cloud.vectors.count(givenGradient)) return;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (inStrip(i)) gs[i].setXyz(vector::Zero());
}

void monolithicSystem::addGiven(List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    const auto given = cloud.vectors.find(givenGradient);
    if (given == cloud.vectors.end()) return;
    gs_.assign(cloud.nAll(), vec4{});
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (inStrip(i)) gs_[i].setXyz(given->second[i].xyz());
    cloud.fillGradientGhosts(gs_);
    rows_.givenPart(gs_, cp_);
    for (label i = 0; i < cloud.n(); ++i)
        if (!cloud.pFixed[i]) b[4 * i + 3] += cloud.dx * cp_[i];

    // What is given is uniform along the face's normals and has no divergence.  At the strip's end and beside walls D
    // lacks neighbours on one side and finds one, of a parabola in a channel of 12 dx 2 % of the flow
    const List<vec4>& velocity = cloud.vectors.at(givenVelocity);
    const scalar tau = rows_.fluidAlone() ? fluidTau_ : 0;
    phi_.assign(cloud.nAll(), vec4{});
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        phi_[i].s = velocity[i].s + tau * given->second[i].s;
    cloud.fillGhosts(phi_, true);
    rows_.divergence(phi_, cp_);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (inStrip(i)) b[4 * i + 3] += cloud.dx * cp_[i];
}

void monolithicSystem::rightHandSide(scalar theta, const List<vec4>& springForce,
                                     const List<scalar>& q, List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar mass = c_.rho * cloud.volume();
    // u = 0, p = theta p^n with the boundary's values: what the rows give now belongs on the right
    phi_.resize(cloud.nAll());
    for (label i = 0; i < cloud.n(); ++i) phi_[i].s = simd4{0, 0, 0, theta * cloud.Up[i][3]};
    cloud.fillGhosts(phi_, false);
    const List<std::pair<label, scalar>> drops = pressureOffsets();
    // C (p - theta p^n): an offset that stays is there at both times
    for (const auto& [g, offset] : drops) phi_[g][3] += (theta - 2) * offset;
    rows_.firstPass(phi_, gp_, lap_, gs_);
    leaveToGiven(gs_);
    cloud.fillGradientGhosts(gs_);
    for (const auto& [g, offset] : drops) gs_[g][3] += (theta - 1) * offset;
    rows_.secondPass(gs_, cp_);

    List<vec4> drop;  // its G p
    if (!drops.empty())
    {
        List<vec4> none(cloud.nAll());
        cloud.fillGhosts(none, false);
        rows_.pressureGradient(none, drop);
    }
    b.resize(size());
    for (label i = 0; i < cloud.n(); ++i)
    {
        vector m = mass / dt_ * cloud.Up[i].xyz() - viscousFactor() * lap_[i].xyz();
        if (!c_.bodyForce.empty())
            m += mass * (c_.bodyForce[cloud.zone[i]] - hydrostatic_.acceleration());
        if (i < label(springForce.size())) m += springForce[i].xyz();
        if (!drop.empty()) m -= cloud.volume() * drop[i].xyz();
        if (cloud.nDims == 2) m[2] = 0;
        for (int a = 0; a < 3; ++a)
            b[4 * i + a] = cloud.uFixed[i] ? cloud.Up[i][a] : m[a] / diagonal_[i];
        b[4 * i + 3] = cloud.pFixed[i] ? cloud.pGiven[i] : cloud.dx * (q[i] - gp_[i][3] - cp_[i]);
    }
    addGiven(b);
    enclosed_.balance(b);
}

scalar monolithicSystem::workFromNothing(const vector& frame) const
{
    scalar sum = 0;
    for (label i = 0; i < c_.cloud.n(); ++i)
        sum += (phi_[i].xyz() - frame).dot(gp_[i].xyz()) + phi_[i][3] * gp_[i][3];
    return -dt_ * c_.cloud.volume() * sum;
}

void monolithicSystem::apply(const List<scalar>& x, List<scalar>& y) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar inertia = c_.rho * cloud.volume() / dt_, V = cloud.volume();
    const label n = cloud.n(), nSolid = cloud.nSolid();
    phi_.resize(cloud.nAll());
    std::copy(x.begin(), x.end(), reinterpret_cast<scalar*>(phi_.data()));
    enclosed_.dropLevel(phi_);
    cloud.fillGhosts(phi_, true);
    rows_.firstPass(phi_, gp_, lap_, gs_);
    leaveToGiven(gs_);
    cloud.fillGradientGhosts(gs_);
    rows_.secondPass(gs_, cp_);
    if (K_)
    {
        Ku_.resize(nSolid);
        K_->apply(phi_, Ku_);
    }

    y.resize(size());
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            simd4 m = inertia * phi_[i].s + viscousFactor() * lap_[i].s + V * gp_[i].s;
            if (K_ && i < nSolid) m += dt_ * Ku_[i].s;
            m /= diagonal_[i];
            if (cloud.uFixed[i]) m = phi_[i].s;
            if (cloud.nDims == 2) m[2] = phi_[i].s[2];  // no equation across the plane
            for (int a = 0; a < 3; ++a) y[4 * i + a] = m[a];
            y[4 * i + 3] = cloud.pFixed[i] ? phi_[i].s[3] : cloud.dx * (gp_[i].s[3] - cp_[i]);
        }
    });
    enclosed_.balance(y);
}

}  // namespace ispf
