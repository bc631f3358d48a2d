// SPDX-License-Identifier: GPL-3.0-or-later
#include "facetCrossings.H"

#include "execution.H"
#include "windingNumber.H"
#include <algorithm>
#include <atomic>

namespace ispf
{

namespace
{

bool hasNode(const triSurface& s, label t, label n)
{
    const auto& f = s.triangles[t];
    return f[0] == n || f[1] == n || f[2] == n;
}

// True for one of the two facets at an edge: this one tests the edge
bool ownsEdge(const triSurface& s, label t, int k)
{
    return s.triangles[t][k] < s.triangles[t][(k + 1) % 3];
}

// Distance of a point in the facet's plane from its border, positive inside
scalar fromBorder(const triSurface& s, label t, const vector& x)
{
    scalar least = std::numeric_limits<scalar>::max();
    for (int k = 0; k < 3; ++k)
    {
        const vector edge = s.corner(t, (k + 1) % 3) - s.corner(t, k);
        least = std::min(least, s.normal(t).cross(edge).normalized().dot(x - s.corner(t, k)));
    }
    return least;
}

void testEdge(const surfaceSearch& search, label t, int k, scalar depth, List<facetCrossing>& found)
{
    const triSurface& s = search.surface();
    const label a = s.triangles[t][k], b = s.triangles[t][(k + 1) % 3];
    for (const label other : search.allHits(s.nodes[a], s.nodes[b]))
    {
        if (hasNode(s, other, a) || hasNode(s, other, b)) continue;
        const vector n = s.normal(other), &o = s.corner(other, 0);
        const scalar da = (s.nodes[a] - o).dot(n), db = (s.nodes[b] - o).dot(n);
        if (std::min(da, db) > -depth || std::max(da, db) < depth) continue;
        const vector at = s.nodes[a] + da / (da - db) * (s.nodes[b] - s.nodes[a]);
        if (fromBorder(s, other, at) > depth) found.push_back({t, other, at});
    }
}

}  // namespace

List<facetCrossing> facetCrossings(const surfaceSearch& search, scalar depth, label most)
{
    const triSurface& s = search.surface();
    constexpr label block = 4096;
    const label nBlocks = (s.size() + block - 1) / block;
    List<List<facetCrossing>> perBlock(nBlocks);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                for (label t = i * block; t < std::min(s.size(), (i + 1) * block); ++t)
                    for (int k = 0; k < 3 && label(perBlock[i].size()) < most; ++k)
                        if (ownsEdge(s, t, k)) testEdge(search, t, k, depth, perBlock[i]);
        },
        1);
    List<facetCrossing> all;
    for (const auto& part : perBlock)
        for (const facetCrossing& c : part)
            if (label(all.size()) < most) all.push_back(c);
    return all;
}

label facetWithin(const triSurface& s, scalar probe)
{
    const windingNumber winding(s);
    std::atomic<label> least = s.size();
    parallelFor(
        s.size(),
        [&](label begin, label end) {
            for (label t = begin; t < end; ++t)
            {
                const vector c = s.centre(t), step = probe * s.normal(t);
                if (winding.value(c - step) < 1.5 && winding.value(c + step) > -0.5) continue;
                label now = least;
                while (t < now && !least.compare_exchange_weak(now, t)) {}
                return;
            }
        },
        1024);
    return least == s.size() ? -1 : least.load();
}

}  // namespace ispf
