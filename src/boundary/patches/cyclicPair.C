// SPDX-License-Identifier: GPL-3.0-or-later
#include "cyclicPair.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

// With n the unit vector along the separation L n, d the distance from the first plane, along n,
//
//     Q = sum_i V u_i.n (w(d_i) + w(L - d_i)),   w(r) = max(0, 1 - |r|/a)/a,
//
// over the fluid that is not beyond open faces.  This is the flow through the sections within a of the plane, on both sides
// of it, averaged with the weight w, whose integral is 1.  A single section would be as uneven as the particles.  Far
// sections must not count: between moving walls, open faces and solids their flow differs.  a is two supports, or L if L is
// shorter: then Q is the mean over all sections, sum V u.n/L.
scalar cyclicPair::flux(const particleCloud& cloud, scalar support) const
{
    const scalar length = separation.norm(), a = std::min(2 * support, length);
    const vector n = separation / length;
    const auto w = [&](scalar r) { return std::max(0.0, 1 - std::abs(r) / a) / a; };
    scalar sum = 0;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        if (cloud.beyondOpen(i)) continue;
        const scalar d = (cloud.x[i].xyz() - point).dot(n);
        sum += cloud.Up[i].xyz().dot(n) * (w(d) + w(length - d));
    }
    return cloud.volume() * sum;
}

scalar cyclicPair::depth(const vector& x) const
{
    const scalar length = separation.norm(), d = (x - point).dot(separation) / length;
    return std::min(d, length - d);
}

}  // namespace ispf
