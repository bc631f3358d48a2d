// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams.H"

#include <algorithm>
#include <map>
#include <tuple>

namespace ispf
{

namespace
{

struct rimEdge
{
    label low, high;  // nodes
    label facet;
    bool sameAs(const rimEdge& o) const { return low == o.low && high == o.high; }
};

// Edges that belong to one facet only, in any orientation
List<rimEdge> findRim(const triSurface& s)
{
    List<rimEdge> all, rim;
    all.reserve(3 * s.triangles.size());
    for (label t = 0; t < s.size(); ++t)
        for (int k = 0; k < 3; ++k)
        {
            const label a = s.triangles[t][k], b = s.triangles[t][(k + 1) % 3];
            all.push_back({std::min(a, b), std::max(a, b), t});
        }
    std::sort(all.begin(), all.end(), [](const rimEdge& a, const rimEdge& b) {
        return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
    });
    for (size_t i = 0, j; i < all.size(); i = j)
    {
        for (j = i + 1; j < all.size() && all[j].sameAs(all[i]);) ++j;
        if (j == i + 1) rim.push_back(all[i]);
    }
    return rim;
}

// Rim nodes sorted by x, so that the search beside an edge is short
class rimNodes
{
public:
    rimNodes(const triSurface& s, const List<rimEdge>& rim) : s_(s)
    {
        for (const rimEdge& e : rim) nodes_.insert(nodes_.end(), {e.low, e.high});
        std::sort(nodes_.begin(), nodes_.end());
        nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
        std::stable_sort(nodes_.begin(), nodes_.end(),
                         [&](label a, label b) { return s.nodes[a][0] < s.nodes[b][0]; });
    }

    // Nodes strictly between a and b, in the order along the edge
    List<label> on(label a, label b, label apex, scalar tolerance) const
    {
        const vector &p = s_.nodes[a], &q = s_.nodes[b];
        const scalar low = std::min(p[0], q[0]) - tolerance,
                     high = std::max(p[0], q[0]) + tolerance;
        const vector along = q - p;
        std::map<scalar, label> found;
        auto it = std::lower_bound(nodes_.begin(), nodes_.end(), low,
                                   [&](label n, scalar x) { return s_.nodes[n][0] < x; });
        for (; it != nodes_.end() && s_.nodes[*it][0] <= high; ++it)
        {
            const vector d = s_.nodes[*it] - p;
            const scalar f = d.dot(along) / along.squaredNorm();
            if (*it != a && *it != b && *it != apex && f > 0 && f < 1 &&
                (d - f * along).norm() <= tolerance)
                found.emplace(f, *it);
        }
        List<label> nodes;
        for (const auto& [f, n] : found) nodes.push_back(n);
        return nodes;
    }

private:
    const triSurface& s_;
    List<label> nodes_;
};

// Cuts the facet at nodes of the rim on its edge; true if there was one
bool cutFacet(triSurface& s, const rimEdge& edge, const rimNodes& rim, scalar tolerance)
{
    const triSurface::triangle f = s.triangles[edge.facet];
    int k = 0;
    while (std::min(f[k], f[(k + 1) % 3]) != edge.low ||
           std::max(f[k], f[(k + 1) % 3]) != edge.high)
        ++k;
    const label a = f[k], b = f[(k + 1) % 3], apex = f[(k + 2) % 3];
    List<label> nodes = rim.on(a, b, apex, tolerance);
    if (nodes.empty()) return false;
    nodes.push_back(b);
    s.triangles[edge.facet] = {a, nodes[0], apex};
    for (size_t m = 0; m + 1 < nodes.size(); ++m)
    {
        s.triangles.push_back({nodes[m], nodes[m + 1], apex});
        s.patch.push_back(s.patch[edge.facet]);
    }
    return true;
}

constexpr int mostRounds = 10;  // a facet has three edges, its parts seldom more

}  // namespace

label sewSeams(triSurface& s, scalar tolerance)
{
    label cut = 0;
    for (int round = 0; round < mostRounds; ++round)
    {
        const List<rimEdge> rim = findRim(s);
        if (rim.empty()) return cut;
        const rimNodes nodes(s, rim);
        List<char> changed(s.size(), 0);
        const label before = cut;
        for (const rimEdge& edge : rim)
            if (!changed[edge.facet] && cutFacet(s, edge, nodes, tolerance))
                changed[edge.facet] = 1, ++cut;
        if (cut == before) return cut;
    }
    return cut;
}

}  // namespace ispf
