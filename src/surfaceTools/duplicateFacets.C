// SPDX-License-Identifier: GPL-3.0-or-later
#include "duplicateFacets.H"

#include <algorithm>
#include <map>
#include <numeric>

namespace ispf
{

namespace
{

using triple = triSurface::triangle;
using edge = std::array<label, 2>;

triple sorted(triple f)
{
    std::sort(f.begin(), f.end());
    return f;
}

edge edgeOf(const triple& f, int k)
{
    return {std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])};
}

bool turnedAsSorted(const triple& f)
{
    return (f[0] < f[1]) + (f[1] < f[2]) + (f[2] < f[0]) == 2;
}

// Two facets with the same nodes, in any orientation
struct facetPair
{
    label first, second;
    size_t part;  // connected pairs have one part: the index of one of them
};

// If the given sides make sense, facets of equal orientation are reduced to one; of the rest at most two facets are
// kept
List<facetPair> findPairs(const triSurface& s, bool sidesTell, List<char>& keep)
{
    List<triple> key;
    for (const triple& f : s.triangles) key.push_back(sorted(f));
    List<label> order(s.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](label a, label b) { return key[a] < key[b]; });
    List<facetPair> pairs;
    for (size_t i = 0, j; i < order.size(); i = j)
    {
        label kept[2] = {-1, -1};
        for (j = i; j < order.size() && key[order[j]] == key[order[i]]; ++j)
        {
            label& own = kept[sidesTell ? turnedAsSorted(s.triangles[order[j]]) : kept[0] >= 0];
            if (own < 0) own = order[j];
            else keep[order[j]] = 0;
        }
        if (kept[0] >= 0 && kept[1] >= 0)
            pairs.push_back({std::min(kept[0], kept[1]), std::max(kept[0], kept[1]), pairs.size()});
    }
    return pairs;
}

size_t partOf(List<facetPair>& pairs, size_t k)
{
    while (pairs[k].part != k) k = pairs[k].part = pairs[pairs[k].part].part;
    return k;
}

// Numbers of pairs and single facets at an edge of a pair
struct edgeCount
{
    label pairs = 0, singles = 0;
    size_t aPair = 0;
};

// Decides which pairs are removed; returns one facet of each
List<label> judge(const triSurface& s, List<facetPair>& pairs, List<char>& keep)
{
    List<label> gone;
    std::map<edge, edgeCount> edges;
    List<char> isPaired(s.size(), 0);
    for (size_t k = 0; k < pairs.size(); ++k)
    {
        isPaired[pairs[k].first] = isPaired[pairs[k].second] = 1;
        for (int e = 0; e < 3; ++e)
        {
            edgeCount& count = edges[edgeOf(s.triangles[pairs[k].first], e)];
            if (count.pairs++ > 0) pairs[partOf(pairs, k)].part = partOf(pairs, count.aPair);
            count.aPair = k;
        }
    }
    for (label t = 0; t < s.size(); ++t)
        for (int e = 0; e < 3 && keep[t] && !isPaired[t]; ++e)
            if (const auto at = edges.find(edgeOf(s.triangles[t], e)); at != edges.end())
                ++at->second.singles;
    List<char> alone(pairs.size(), 1), needed(pairs.size(), 0);  // by part
    for (const auto& [where, count] : edges)
    {
        const size_t part = partOf(pairs, count.aPair);
        if (count.singles > 0) alone[part] = 0;
        if (count.singles % 2 == 1) needed[part] = 1;
    }
    for (size_t k = 0; k < pairs.size(); ++k)
    {
        const size_t part = partOf(pairs, k);
        keep[pairs[k].second] = 0;
        if (alone[part] || needed[part]) continue;
        keep[pairs[k].first] = 0, gone.push_back(pairs[k].first);
    }
    return gone;
}

}  // namespace

duplicatesDropped dropDuplicates(triSurface& s, bool sidesTell)
{
    duplicatesDropped dropped;
    List<char> keep(s.size(), 1);
    List<facetPair> pairs = findPairs(s, sidesTell, keep);
    for (const label t : pairs.empty() ? List<label>() : judge(s, pairs, keep))
        dropped.walls.add(s.corner(t, 0), s.corner(t, 1), s.corner(t, 2), 0);
    dropped.count = s.size();
    if (std::find(keep.begin(), keep.end(), 0) != keep.end())
        s = s.subset([&](label t) { return keep[t] != 0; });
    dropped.count -= s.size();
    return dropped;
}

}  // namespace ispf
