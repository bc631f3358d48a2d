// SPDX-License-Identifier: GPL-3.0-or-later
#include "hydrostaticPart.H"

#include <algorithm>

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

// Mean of p(i) - rho a.x over particles with given p, 0 if there are none
template <class Pressure>
scalar hydrostaticPart::meanOfGiven(const particleCloud& cloud, const vector& a,
                                    const Pressure& p) const
{
    const auto [n, sum] = sumsOf(0, cloud.n(), [&](label i) -> std::array<scalar, 2> {
        if (!cloud.pFixed[i]) return {};
        return {1, p(i) - c_.rho * a.dot(cloud.x[i].xyz())};
    });
    return n > 0 ? sum / n : 0;
}

scalar hydrostaticPart::setLevel(const particleCloud& cloud, bool level,
                                 const std::optional<outerPressure>& outer)
{
    level_ = levelBefore_ = 0;
    const auto given = [&] {
        return std::any_of(cloud.pFixed.begin(), cloud.pFixed.begin() + cloud.n(),
                           [](char fixed) { return fixed; });
    };
    if (outer && !(level && given()))
    {
        level_ = outer->during - c_.rho * during_.dot(outer->at);
        levelBefore_ = outer->before - c_.rho * before_.dot(outer->at);
    }
    else if (level || outer || !during_.isZero(0))
    {
        level_ = meanOfGiven(cloud, during_, [&](label i) { return cloud.pGiven[i]; });
        levelBefore_ = meanOfGiven(cloud, before_, [&](label i) { return cloud.Up[i][3]; });
    }
    return level_;
}

// p loses the level that it has at the step's start.  Else a change of the given pressures would change all p' at once, and what
// the solver leaves is in proportion to the error of its guess
void hydrostaticPart::take(particleCloud& cloud, bool level,
                           const std::optional<outerPressure>& outer)
{
    setLevel(cloud, level, outer);
    if (!level && !outer && during_.isZero(0) && before_.isZero(0)) return;
    forEach(0, cloud.n(), [&](label i) {
        const vector x = cloud.x[i].xyz();
        cloud.Up[i][3] -= c_.rho * before_.dot(x) + levelBefore_;
        cloud.pGiven[i] -= c_.rho * during_.dot(x) + level_;
    });
}

void hydrostaticPart::giveBack(particleCloud& cloud) const
{
    if (!acts() && after_.isZero(0)) return;
    forEach(0, cloud.n(), [&](label i) {
        const vector x = cloud.x[i].xyz();
        cloud.Up[i][3] += c_.rho * after_.dot(x) + level_;
        cloud.pGiven[i] += c_.rho * during_.dot(x) + level_;
    });
}

}  // namespace ispf
