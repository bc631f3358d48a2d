// SPDX-License-Identifier: GPL-3.0-or-later
#include "openFace.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// slowest: a small flow [dx of the face's area per step].  inertia: length of fluid that a pressure moves at least [dx]
constexpr scalar slowest = 0.01, inertia = 10;

}  // namespace

openFace::openFace(const word& name, const dictionary& dict, const word& caseFolder, setting s)
    : name_(name),
      where_(dict.where("type")),
      dx_(s.cloud.dx),
      near_(2.5 * dx_),
      region_(6 * dx_),
      depth_(s.stripLayers * dx_),
      mesh_(std::move(s.mesh)),
      spotGrid_(1.5 * dx_)
{
    const scalar near = std::max(depth_ + dx_, before * dx_),
                 far = std::max(near, openLayer::reach * dx_);
    vector outward;
    if (dict.chooseOrDefault("surface", {"triSurface", "plane"}, "triSurface") == "plane")
    {
        const vector point = dict.get<vector>("point", dims::length),
                     normal = nonZero(dict, "normal");
        surface_ = patchSurface::plane(point, normal, near);
        deep_ = patchSurface::plane(point, normal, far);
        outward = normal.normalized();
    }
    else
    {
        const triSurface mesh = readPatch(caseFolder, name, dict);
        surface_ = patchSurface::triangles(mesh, s.group, near);
        deep_ = patchSurface::triangles(mesh, s.group, far);
        outward = mesh_.normal();
    }
    images_ = s.group.symmetryFactor();
    const dimensionSet& flow = s.cloud.nDims == 3 ? dims::flowRate : dims::kinematicViscosity;
    if (inflow::given(dict))
    {
        inflow_ = std::make_unique<inflow>(
            dict, caseFolder, inflow::place{mesh_, s.isHeld, images_, outward, flow, s.nu});
        return;
    }
    p_ = std::make_unique<outletPressure>(outlet::New(dict, caseFolder, flow));
    backflow_ = dict.getInRangeOrDefault("backflow", 0, 1, 0.5);
}

void openFace::setStep(scalar t0, scalar t1, scalar pressures)
{
    step_ = {t0, pressures};
    if (inflow_) inflow_->setStep(t0, t1);
}

// Flow out of the face: - sum V r_i of (4.4) over the strip
scalar openFace::outflow(const particleCloud& cloud) const
{
    scalar sum = 0;
    for (size_t k = 0; k < areas_.size(); ++k) sum -= cloud.stripIntake[firstStrip_ + k];
    return sum;
}

scalar openFace::area() const
{
    scalar sum = 0;
    for (const auto& [zone, A] : areas_) sum += A.norm();
    return images_ * sum;
}

void openFace::addOutlet(const particleCloud& cloud, scalar rho, scalar dt,
                         List<outletPressure::solved>& all) const
{
    if (p_)
        all.push_back({p_.get(), images_ * outflow(cloud), area() * slowest * dx_ / dt,
                       -area() * dt / (rho * inertia * dx_)});
}

void openFace::addLink(List<outletLink>& all) const
{
    if (p_ && p_->slope() != 0)
        all.push_back({firstStrip_, firstStrip_ + label(areas_.size()), images_ * p_->slope(),
                       p_->flow() / images_, area() / images_});
}

void openFace::accept(particleCloud& cloud, scalar t0, scalar t1) const
{
    if (p_) cloud.state.set(outletState(), p_->accept({t0, t1}, images_ * flux_));
    if (!developed_.empty()) cloud.state.set(profileState(), developed_);
}

scalar openFace::weight(scalar q)
{
    const scalar a = 1 - q * q;
    return q < 1 ? a * a : 0;
}

// Finds the foot of each particle.  Called several times a step, so it searches only where a particle has moved
// or another one has its index
void openFace::findFeet(const particleCloud& cloud) const
{
    constexpr scalar nowhere = std::numeric_limits<scalar>::quiet_NaN();
    known_.resize(cloud.n(), {vector::Constant(nowhere), {}});
    parallelFor(cloud.n(), [&](label begin, label end) {
        footSequence near(*surface_);
        for (label i = begin; i < end; ++i)
            if (const vector x = cloud.x[i].xyz(); known_[i].x != x) known_[i] = {x, near.find(x)};
    });
}

std::uint8_t openFace::zoneOf(const particleCloud& cloud, label i) const
{
    const surfaceFoot& f = known_[i].foot;
    if (areas_.count(cloud.zone[i]) || areas_.empty() || !f.found || f.aside > 0)
        return cloud.zone[i];
    if (areas_.size() == 1) return areas_.begin()->first;
    const auto distance = [&](const spot& s) { return (s.foot - f.foot).squaredNorm(); };
    return std::min_element(spots_.begin(), spots_.end(),
                            [&](const spot& a, const spot& b) { return distance(a) < distance(b); })
        ->zone;
}

bool openFace::beyondStrip(const vector& x) const
{
    const surfaceFoot f = surface_->find(x);
    return f.found && f.aside == 0 && f.depth > depth_;  // beside the rim the face says nothing
}

bool openFace::near(label i) const
{
    return reachesBeyond(i, depth_ + 0.6 * dx_);
}

bool openFace::reachesBeyond(label i, scalar reach) const
{
    const surfaceFoot& f = known_[i].foot;
    return f.found && f.depth + reach > depth_;
}

}  // namespace ispf
