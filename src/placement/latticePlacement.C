// SPDX-License-Identifier: GPL-3.0-or-later
#include "latticePoints.H"
#include "placedParticles.H"

#include "cellList.H"
#include <cmath>
#include <numeric>

namespace ispf
{

namespace
{

// Collects the lattice points of one plane that lie in a zone, or outside in rigid material or a strip
void sweepPlane(const zoneGeometry& geometry, const exterior& outside, const vector& first,
                const label (&n)[3], label k, List<latticePoint>& found)
{
    const scalar dx = geometry.dx();
    for (label j = 0; j < n[1]; ++j)
        for (label i = 0; i < n[0]; ++i)
        {
            latticePoint p{first + dx * vector(i, j, k), -1, {}};
            if (geometry.nDims() == 2) p.x[2] = 0;
            if (geometry.beyondSymmetry(p.x) >= 0) continue;
            p.zone = geometry.zoneAt(p.x);
            if (p.zone < 0) p.outside = outside.at(p.x);
            const auto type = p.outside.type;
            if (p.zone >= 0 || type == exteriorPoint::kind::rigid ||
                type == exteriorPoint::kind::strip)
                found.push_back(p);
        }
}

void add(placedParticles& placed, const latticePoint& p)
{
    if (p.outside.type == exteriorPoint::kind::rigid)
    {
        placed.rigid.push_back(p.x);
        placed.rigidPatch.push_back(p.outside.patch);
        return;
    }
    if (p.zone < 0 && p.outside.type != exteriorPoint::kind::strip) return;
    placed.x.push_back(p.x);
    placed.zone.push_back(p.zone >= 0 ? p.zone : p.outside.zone);
    placed.strip.push_back(p.zone >= 0 ? -1 : p.outside.patch);
}

}  // namespace

void sortByPhase(placedParticles& placed, const List<zoneInfo>& zones)
{
    List<label> order(placed.x.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](label i) {
        const zoneInfo& z = zones[placed.zone[i]];
        return z.phase == phaseType::fluid ? 2 : z.fixed ? 1 : 0;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](label a, label b) { return rank(a) < rank(b); });
    placedParticles sorted;
    for (const label i : order)
    {
        sorted.x.push_back(placed.x[i]);
        sorted.zone.push_back(placed.zone[i]);
        sorted.strip.push_back(placed.strip[i]);
    }
    std::swap(sorted.rigid, placed.rigid), std::swap(sorted.rigidPatch, placed.rigidPatch);
    placed = std::move(sorted);
}

void dropUnseenRigid(placedParticles& placed, const zoneGeometry& geometry, scalar support)
{
    List<vector> moving;
    for (size_t i = 0; i < placed.x.size(); ++i)
        if (!geometry.zones()[placed.zone[i]].fixed) moving.push_back(placed.x[i]);
    for (const halfSpace& plane : geometry.symmetryPlanes())  // images see walls too
        for (size_t i = 0, n = moving.size(); i < n; ++i)
            if (plane.distance(moving[i]) > -support) moving.push_back(plane.mirror(moving[i]));
    const cellList cells(moving, support);
    List<vector> x;
    List<label> patch;
    for (size_t i = 0; i < placed.rigid.size(); ++i)
        if (cells.anyWithin(placed.rigid[i], support))
        {
            x.push_back(placed.rigid[i]);
            patch.push_back(placed.rigidPatch[i]);
        }
    placed.rigid = std::move(x), placed.rigidPatch = std::move(patch);
}

placedParticles placeOnLattice(const zoneGeometry& geometry, const exterior& outside,
                               const vector& origin, scalar support)
{
    const scalar dx = geometry.dx();
    const boundBox box = outside.bounds();
    vector first;
    label n[3];
    for (int k = 0; k < 3; ++k)
    {
        const scalar low = std::floor((box.min[k] - origin[k]) / dx) + 0.5;
        first[k] = origin[k] + low * dx;
        n[k] = std::max<label>(1, label(std::ceil((box.max[k] - first[k]) / dx)) + 1);
    }
    if (geometry.nDims() == 2) n[2] = 1;
    List<List<latticePoint>> planes(n[2]);
    parallelFor(
        n[2],
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
                sweepPlane(geometry, outside, first, n, k, planes[k]);
        },
        1);
    List<latticePoint> points;
    for (const auto& plane : planes) points.insert(points.end(), plane.begin(), plane.end());
    planes.clear();
    matchCounts(points, geometry);
    placedParticles placed;
    for (const latticePoint& p : points) add(placed, p);
    sortByPhase(placed, geometry.zones());
    dropUnseenRigid(placed, geometry, support);
    return placed;
}

}  // namespace ispf
