// SPDX-License-Identifier: GPL-3.0-or-later
#include "monolithicSystem.H"

namespace ispf
{

std::unique_ptr<coupledSystem> newMonolithicSystem(fsiCase& c)
{
    return std::make_unique<monolithicSystem>(c);
}

const List<scalar>& monolithicSystem::setupRows(const volumeConstraint* volume,
                                                const solidSurface* surface)
{
    rows_.setup(c_.cloud, c_.list, c_.correction);
    rows_.setSolid(volume, surface);
    return rows_.sumF();
}

// In strips C takes the gradient given there for G p (monolithicRows.H)
void monolithicSystem::leaveToGiven(List<vec4>& gs) const
{
    const particleCloud& cloud = c_.cloud;
    if (!cloud.vectors.count(givenGradient)) return;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (cloud.velocityGiven(i)) gs[i].setXyz(vector::Zero());
}

void monolithicSystem::addGiven(List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
    const auto given = cloud.vectors.find(givenGradient);
    if (given == cloud.vectors.end()) return;
    gs_.assign(cloud.nAll(), vec4{});
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (cloud.velocityGiven(i)) gs_[i].setXyz(given->second[i].xyz());
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
        if (cloud.velocityGiven(i)) b[4 * i + 3] += cloud.dx * cp_[i];
}

void monolithicSystem::rightHandSide(scalar theta, const List<vec4>& springForce,
                                     const List<scalar>& q, List<scalar>& b) const
{
    const particleCloud& cloud = c_.cloud;
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
    momentumSide(springForce, lap_, drop, b);
    for (label i = 0; i < cloud.n(); ++i)
        if (!cloud.pFixed[i]) b[4 * i + 3] = cloud.dx * (q[i] - gp_[i][3] - cp_[i]);
    addGiven(b);
    enclosed_.balance(b);
}

void monolithicSystem::apply(const List<scalar>& x, List<scalar>& y) const
{
    const particleCloud& cloud = c_.cloud;
    phi_.resize(cloud.nAll());
    std::copy(x.begin(), x.end(), reinterpret_cast<scalar*>(phi_.data()));
    enclosed_.dropLevel(phi_);
    cloud.fillGhosts(phi_, true);
    rows_.firstPass(phi_, gp_, lap_, gs_);
    leaveToGiven(gs_);
    cloud.fillGradientGhosts(gs_);
    rows_.secondPass(gs_, cp_);
    for (label i = 0; i < cloud.n(); ++i) cp_[i] = gp_[i].s[3] - cp_[i];
    writeRows(phi_, lap_, gp_, cp_, y);
}

}  // namespace ispf
