// SPDX-License-Identifier: GPL-3.0-or-later
#include "facets.H"

#include "surfaceRefinement.H"

#include <algorithm>
#include <cmath>
#include <map>

namespace ispf
{

namespace
{

constexpr scalar longestEdge = 1.5;  // [dx] the fluid is taken at the middle of each triangle
constexpr scalar slender = 8;        // longest over shortest edge: halving would also cut the width
constexpr scalar small = 0.25;   // [dx^2] in three dimensions; in two dimensions edges are cheap
constexpr scalar alike = 0.9;    // least cosine between normals of pieces that are joined
constexpr scalar offset = 0.37;  // [dx] of the cells, because walls often lie on multiples of dx

using corners = std::array<vector, 3>;

corners cornersOf(const triSurface& s, label t)
{
    return {s.corner(t, 0), s.corner(t, 1), s.corner(t, 2)};
}

scalar edge(const corners& t, int k)
{
    return (t[(k + 1) % 3] - t[k]).norm();
}

bool isSlender(const corners& t, scalar dx)
{
    const auto [least, most] = std::minmax({edge(t, 0), edge(t, 1), edge(t, 2)});
    return most > longestEdge * dx && most > slender * least;
}

// Cuts a slender triangle along its shortest edge into slices of 1.5 dx; into four triangles while that edge is longer
void cut(const corners& t, scalar dx, List<facet>& facets)
{
    int shortest = 0;
    scalar most = 0;
    for (int k = 0; k < 3; ++k)
    {
        if (edge(t, k) < edge(t, shortest)) shortest = k;
        most = std::max(most, edge(t, k));
    }
    if (edge(t, shortest) > longestEdge * dx)
    {
        const vector ab = 0.5 * (t[0] + t[1]), bc = 0.5 * (t[1] + t[2]), ca = 0.5 * (t[2] + t[0]);
        for (const corners& part : {corners{t[0], ab, ca}, corners{ab, t[1], bc},
                                    corners{ca, bc, t[2]}, corners{ab, bc, ca}})
            cut(part, dx, facets);
        return;
    }
    const vector& tip = t[(shortest + 2) % 3];
    const vector way = 0.5 * (t[shortest] + t[(shortest + 1) % 3]) - tip;
    const vector area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
    const int n = int(std::ceil(most / (longestEdge * dx)));
    for (int k = 0; k < n; ++k)
    {
        const scalar a = scalar(k) / n, b = scalar(k + 1) / n, share = b * b - a * a;
        const scalar along = 2 * (b * b * b - a * a * a) / (3 * share);
        facets.push_back({tip + along * way, share * area});
    }
}

List<facet> gathered(const List<facet>& facets, scalar dx)
{
    List<facet> result;
    std::map<std::array<std::int64_t, 3>, List<size_t>> inCell;
    for (const facet& f : facets)
    {
        std::array<std::int64_t, 3> cell;
        for (int a = 0; a < 3; ++a) cell[a] = std::int64_t(std::floor(f.centre[a] / dx + offset));
        List<size_t>& there = inCell[cell];
        const auto same = std::find_if(there.begin(), there.end(), [&](size_t k) {
            return result[k].area.dot(f.area) > alike * result[k].area.norm() * f.area.norm();
        });
        if (same == there.end())
        {
            there.push_back(result.size()), result.push_back(f);
            continue;
        }
        facet& sum = result[*same];
        const scalar own = f.area.norm(), before = sum.area.norm();
        sum.centre += own / (own + before) * (f.centre - sum.centre), sum.area += f.area;
    }
    return result;
}

void flatten(List<facet>& facets, scalar depth)
{
    for (facet& f : facets) f.centre[2] = f.area[2] = 0, f.area /= depth;
}

}  // namespace

void prepare(triSurface& s, scalar dx)
{
    s.weld(1e-4 * dx);
    refine(s, longestEdge * dx);
}

List<facet> trianglesOf(const triSurface& s, int nDims)
{
    List<facet> facets;
    for (label t = 0; t < s.size(); ++t) facets.push_back({s.centre(t), s.areaVector(t)});
    if (nDims == 2) flatten(facets, s.bounds().max[2] - s.bounds().min[2]);
    return facets;
}

List<facet> facetsOf(triSurface s, scalar dx, int nDims)
{
    s.weld(1e-4 * dx);
    const boundBox box = s.bounds();
    triSurface stout = s.subset([&](label t) { return !isSlender(cornersOf(s, t), dx); });
    refine(stout, longestEdge * dx);
    List<facet> facets = trianglesOf(stout, 3), parts;
    for (label t = 0; t < s.size(); ++t)
        if (isSlender(cornersOf(s, t), dx)) cut(cornersOf(s, t), dx, parts);
    if (nDims == 2)
        for (List<facet>* all : {&facets, &parts}) flatten(*all, box.max[2] - box.min[2]);
    const auto rest = std::stable_partition(facets.begin(), facets.end(), [&](const facet& f) {
        return nDims == 2 || f.area.norm() > small * dx * dx;
    });
    parts.insert(parts.end(), rest, facets.end());
    facets.erase(rest, facets.end());
    for (const facet& f : gathered(parts, dx)) facets.push_back(f);
    return facets;
}

}  // namespace ispf
