// SPDX-License-Identifier: GPL-3.0-or-later
#include "hydrostaticPart.H"

namespace ispf
{

hydrostaticPart::hydrostaticPart(const fsiCase& c) : rho_(c.rho), a_(vector::Zero())
{
    if (c.bodyForce.empty()) return;
    for (const vector& other : c.bodyForce)
        if (other != c.bodyForce[0]) return;
    a_ = c.bodyForce[0];
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
