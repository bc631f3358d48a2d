// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallShares.H"
#include "pointGrid.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Owned particles beside a wall, then their images in symmetry planes and cyclic patches
List<label> besideWalls(const particleCloud& cloud, const neighbourList& list)
{
    List<char> sees(cloud.n(), 0);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) sees[i] = list.wall[i] < list.start[i + 1];
    });
    List<label> found;
    for (label i = 0; i < cloud.n(); ++i)
        if (sees[i]) found.push_back(i);
    for (label g = cloud.n(); g < cloud.nAll(); ++g)
        if (cloud.isMedium(g) && sees[cloud.ghostSource(g)]) found.push_back(g);
    return found;
}

// phi of (3.16): the part of an element before fluid, where a solid ends at the wall.  The solid's surface lies halfway
// between solid and fluid particles.  toFluid, toSolid: distances to the nearest of both [m]
scalar beforeFluid(const particleCloud& cloud, const surfaceElement& e, scalar toFluid,
                   scalar toSolid)
{
    const scalar before = (toSolid * toSolid - toFluid * toFluid) / (2 * cloud.dx);
    const scalar across = cloud.nDims == 3 ? std::sqrt(e.S.norm()) : e.S.norm();
    return std::clamp(0.5 + before / across, 0.0, 1.0);
}

}  // namespace

void wallShares::build(const particleCloud& cloud, const neighbourList& list,
                       const smoothingKernel& kernel, bool withSolid)
{
    const label n = cloud.n();
    shares.clear();
    b.assign(n, vec4{}), drag.assign(n, vec4{}), flux.assign(n, 0);
    moment.assign(n, tensor::Zero()), linear.assign(n, tensor::Zero());
    if (cloud.surface.empty()) return;

    const List<label> beside = besideWalls(cloud, list);
    pointGrid grid(kernel.support());
    for (const label j : beside) grid.add(cloud.x[j].xyz());
    const label nElements = label(cloud.surface.size());
    List<List<share>> found(nElements);
    parallelFor(
        nElements,
        [&](label begin, label end) {
            for (label s = begin; s < end; ++s)
            {
                const surfaceElement& e = cloud.surface[s];
                scalar sum = 0, toFluid = kernel.support(), toSolid = 2 * kernel.support();
                grid.within(e.x, kernel.support(), [&](label k, scalar r) {
                    const label j = beside[k];
                    const bool isSolid = !withSolid && cloud.phase[j] == phaseType::solid;
                    if ((cloud.x[j].xyz() - e.x).dot(e.S) >= 0) return;
                    scalar& nearest = isSolid ? toSolid : toFluid;
                    nearest = std::min(nearest, r);
                    if (isSolid) return;
                    const scalar W = kernel.W(r);
                    if (W > 0) found[s].push_back({s, j, W}), sum += W;
                });
                const scalar free = beforeFluid(cloud, e, toFluid, toSolid);
                if (free == 0) found[s].clear();
                for (share& part : found[s]) part.weight = free * part.weight / sum;
            }
        },
        64);
    const scalar perVolume = 1 / cloud.volume();
    for (const List<share>& ofElement : found)
        for (const share& part : ofElement)
        {
            shares.push_back(part);
            const surfaceElement& e = cloud.surface[part.element];
            const label j = part.particle, i = cloud.ownerOf(j);
            const scalar w = part.weight * perVolume;
            vector S = e.S, way = e.x - cloud.x[j].xyz();
            if (j >= n)
            {
                const tensor back = cloud.ruleOf(j).R.transpose();
                S = back * S, way = back * way;
            }
            const scalar through = w * e.S.dot(e.u);
            b[i].s += 0.5 * w * vec4::from(S).s;
            flux[i] += through;
            const tensor M = w * S * way.transpose();
            moment[i] += M;
            if (!e.sticks) continue;
            linear[i] += M;
            drag[i].s += through * vec4::from(way).s;
        }
}

}  // namespace ispf
