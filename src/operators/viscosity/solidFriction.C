// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidFriction.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

namespace
{

// Least |sum F x| over sum |F x| with which the solid neighbours are on one side
constexpr scalar oneSided = 0.8;
// [dx] Way from the first particles of a solid to its surface, and least distance of fluid from the surface
constexpr scalar surfaceAt = 0.5, nearest = 0.1;

bool isSolid(const particleCloud& cloud, label j)
{
    return cloud.isMedium(j) && !cloud.isFluid(cloud.ownerOf(j));
}

// {n/d, s} of fluid particle i; zero without a solid in reach
vec4 viewOf(const particleCloud& cloud, const neighbourList& list, label i)
{
    vector out = vector::Zero(), next = vector::Zero();
    scalar size = 0, least = std::numeric_limits<scalar>::max();
    bool wall = false;
    forNeighbours<among::others>(list, i, [&](pairIndex k, label j) {
        if (!cloud.isMedium(j)) wall = true;
        if (!isSolid(cloud, j)) return;
        const vector way = cloud.x[i].xyz() - cloud.x[j].xyz();
        out -= list.F[k] * way, size -= list.F[k] * way.norm();
        if (way.norm() < least) least = way.norm(), next = way;
    });
    if (size == 0) return vec4{};
    if (out.norm() < oneSided * size) return vec4{simd4{0, 0, 0, 1}};
    const vector n = out.normalized();
    const scalar d = std::max(n.dot(next) - surfaceAt * cloud.dx, nearest * cloud.dx);
    vec4 view = vec4::from(n / d, 1);
    if (wall) return view;
    scalar others = 0, solid = 0;
    forNeighbours<among::all>(list, i, [&](pairIndex k, label j) {
        const vector way = cloud.x[i].xyz() - cloud.x[j].xyz();
        if (isSolid(cloud, j)) solid += list.F[k] * particleCloud::wayOverFluid(view, way) * d;
        else others += list.F[k] * n.dot(way);
    });
    if (solid < 0) view[3] = std::clamp(-others / solid, 0.5, 2.0);
    return view;
}

}  // namespace

void stickToSolids(particleCloud& cloud, const neighbourList& list)
{
    if (cloud.nSolid() == 0 || cloud.nSolid() == cloud.n()) return;
    List<vec4> views(cloud.nAll());
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
            views[i] = viewOf(cloud, list, i);
    });
    cloud.fillGradientGhosts(views);
    cloud.setSolidFriction(std::move(views));
}

}  // namespace ispf
