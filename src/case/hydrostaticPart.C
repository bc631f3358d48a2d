// SPDX-License-Identifier: GPL-3.0-or-later
#include "hydrostaticPart.H"

namespace ispf
{

namespace
{

// Mean over the fluid zones: a solid carries its own force, and a solid alone has nothing to float in.  Equal values
// give that value itself, without rounding.
vector meanOfFluid(const fsiCase& c, const List<vector>& bodyForce)
{
    List<vector> a;
    for (size_t zone = 0; zone < bodyForce.size(); ++zone)
        if (c.cloud.zones[zone].phase == phaseType::fluid) a.push_back(bodyForce[zone]);
    if (a.empty()) return vector::Zero();
    vector excess = vector::Zero();
    for (const vector& other : a) excess += other - a[0];
    return a[0] + excess / scalar(a.size());
}

}  // namespace

hydrostaticPart::hydrostaticPart(const fsiCase& c) : c_(c)
{
    for (const structureImage& image : c.walls->images())
    {
        if (!image.R.isIdentity(1e-9)) continue;
        vector t = image.t;
        for (const vector& e : cyclic_) t -= t.dot(e) * e;
        if (t.norm() > 1e-6 * image.t.norm()) cyclic_.push_back(t.normalized());
    }
    before_ = during_ = after_ = part(c.bodyForce);
}

vector hydrostaticPart::part(const List<vector>& bodyForce) const
{
    vector a = meanOfFluid(c_, bodyForce);
    for (const vector& e : cyclic_) a -= a.dot(e) * e;
    return a;
}

void hydrostaticPart::setStep(scalar t0, scalar t1)
{
    during_ = part(c_.bodyForce);
    before_ = part(c_.bodyForceAt(t0)), after_ = part(c_.bodyForceAt(t1));
}

// Mean of p - rho a.x over particles with given p; 0 without a body force
scalar hydrostaticPart::givenLevel(const particleCloud& cloud) const
{
    if (during_.isZero(0)) return 0;
    const auto [n, sum] = sumsOf(0, cloud.n(), [&](label i) -> std::array<scalar, 2> {
        if (!cloud.pFixed[i]) return {};
        return {1, cloud.pGiven[i] - c_.rho * during_.dot(cloud.x[i].xyz())};
    });
    return n > 0 ? sum / n : 0;
}

void hydrostaticPart::take(particleCloud& cloud)
{
    level_ = givenLevel(cloud);
    add(cloud, before_, level_, -1);
}

void hydrostaticPart::add(particleCloud& cloud, const vector& toState, scalar level,
                          scalar sign) const
{
    if (toState.isZero(0) && during_.isZero(0)) return;
    forEach(0, cloud.n(), [&](label i) {
        const vector x = cloud.x[i].xyz();
        cloud.Up[i][3] += sign * (c_.rho * toState.dot(x) + level);
        cloud.pGiven[i] += sign * (c_.rho * during_.dot(x) + level);
    });
}

}  // namespace ispf
