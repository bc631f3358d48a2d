// SPDX-License-Identifier: GPL-3.0-or-later
#include "hydrostaticPart.H"

namespace ispf
{

namespace
{

// Over the fluid zones: a solid carries its own force, and alone it has nothing to float in.  Equal ones
// give that value itself, without round-off.
vector meanOfFluid(const fsiCase& c)
{
    List<vector> a;
    for (size_t zone = 0; zone < c.bodyForce.size(); ++zone)
        if (c.cloud.zones[zone].phase == phaseType::fluid) a.push_back(c.bodyForce[zone]);
    if (a.empty()) return vector::Zero();
    vector excess = vector::Zero();
    for (const vector& other : a) excess += other - a[0];
    return a[0] + excess / scalar(a.size());
}

}  // namespace

hydrostaticPart::hydrostaticPart(const fsiCase& c) : rho_(c.rho), a_(meanOfFluid(c))
{
    List<vector> along;
    for (const structureImage& image : c.walls->images())
    {
        if (!image.R.isIdentity(1e-9)) continue;
        vector t = image.t;
        for (const vector& e : along) t -= t.dot(e) * e;
        if (t.norm() > 1e-6 * image.t.norm()) along.push_back(t.normalized());
    }
    for (const vector& e : along) a_ -= a_.dot(e) * e;
}

void hydrostaticPart::add(particleCloud& cloud, scalar sign) const
{
    if (a_.isZero(0)) return;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar p = sign * rho_ * a_.dot(cloud.x[i].xyz());
        cloud.Up[i][3] += p, cloud.pGiven[i] += p;
    }
}

}  // namespace ispf
