// SPDX-License-Identifier: GPL-3.0-or-later
#include "faceMesh.H"

#include "surfaceRefinement.H"
#include "surfaceTopology.H"

#include <cmath>

namespace ispf
{

faceMesh::faceMesh(triSurface surface, const imageGroup& group, const particleCloud& cloud)
    : tiny_(1e-4 * cloud.dx), slice_(cloud.nDims == 2), planes_(group.planes())
{
    surface = group.clipped(std::move(surface));
    surface.weld(tiny_);
    refine(surface, 0.5 * cloud.dx);
    search_ = surfaceSearch(std::move(surface));
    if (slice_)
    {
        const boundBox box = this->surface().bounds();
        perDepth_ = 1 / (box.max[2] - box.min[2]);
    }
    for (label t = 0; t < this->surface().size(); ++t)
        area_.sum += area(t), area_.directed += this->surface().areaVector(t);
}

// True if an edge of the rim only ends the slice of a two-dimensional case
bool faceMesh::endsSlice(const vector& a, const vector& b) const
{
    return slice_ && std::abs(a[2] - b[2]) < tiny_;
}

List<char> faceMesh::heldNodes(const heldRim& isHeld) const
{
    const triSurface& s = surface();
    List<char> held(s.nodes.size(), 0);
    for (const auto& [a, b] : openHalfEdges(s))
    {
        const vector &from = s.nodes[a], &to = s.nodes[b];
        bool onPlane = endsSlice(from, to);
        for (const auto& [point, normal] : planes_)
            onPlane = onPlane || (std::abs((from - point).dot(normal)) < tiny_ &&
                                  std::abs((to - point).dot(normal)) < tiny_);
        if (!onPlane && isHeld(0.5 * (from + to))) held[a] = held[b] = 1;
    }
    return held;
}

scalar faceMesh::interpolate(const List<scalar>& values, const vector& x) const
{
    const surfacePoint p = search_.nearest(x);
    const triSurface& s = surface();
    const vector n = s.areaVector(p.triangle);
    scalar value = 0;
    for (int k = 0; k < 3; ++k)
    {
        const vector &a = s.corner(p.triangle, (k + 1) % 3), &b = s.corner(p.triangle, (k + 2) % 3);
        const scalar share = 0.5 * (a - p.point).cross(b - p.point).dot(n) / n.squaredNorm();
        value += share * values[s.triangles[p.triangle][k]];
    }
    return value;
}

scalar faceMesh::mean(const List<scalar>& values) const
{
    const triSurface& s = surface();
    scalar sum = 0;
    for (label t = 0; t < s.size(); ++t)
        for (const label node : s.triangles[t]) sum += area(t) * values[node] / 3;
    return sum / area_.sum;
}

}  // namespace ispf
