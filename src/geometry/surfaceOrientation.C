// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceSearch.H"
#include "surfaceSides.H"
#include "surfaceTopology.H"
#include "windingNumber.H"

#include <limits>
#include <numeric>

namespace ispf
{

namespace
{

void turn(triSurface& s, label t)
{
    std::swap(s.triangles[t][1], s.triangles[t][2]);
}

// Turns triangles so that they agree with the first triangle of their component
label makeConsistent(triSurface& s)
{
    const auto next = edgeNeighbours(s);
    List<char> state(s.size(), 0);  // 0 unseen, 1 keep, 2 turn
    label turned = 0;
    List<label> stack;
    for (label seed = 0; seed < s.size(); ++seed)
    {
        if (state[seed]) continue;
        state[seed] = 1;
        stack.push_back(seed);
        while (!stack.empty())
        {
            const label t = stack.back();
            stack.pop_back();
            for (const auto& [other, same] : next[t])
            {
                if (state[other]) continue;
                state[other] = same ? 3 - state[t] : state[t];
                stack.push_back(other);
            }
        }
    }
    for (label t = 0; t < s.size(); ++t)
        if (state[t] == 2) turn(s, t), ++turned;
    return turned;
}

// Calls f(first, last) for the sides of each patch p along each edge of it
template <class F>
void forOwnEdges(List<side> sides, const List<label>& patch, F&& f)
{
    std::stable_sort(sides.begin(), sides.end(), [&](const side& a, const side& b) {
        return std::tie(a.low, a.high, patch[a.triangle]) <
               std::tie(b.low, b.high, patch[b.triangle]);
    });
    for (size_t i = 0, j; i < sides.size(); i = j)
    {
        for (j = i + 1; j < sides.size() && sides[j].sameEdge(sides[i]) &&
                        patch[sides[j].triangle] == patch[sides[i].triangle];)
            ++j;
        f(&sides[i], &sides[i] + (j - i));
    }
}

label balance(const side* begin, const side* end)
{
    label sum = 0;
    for (const side* k = begin; k != end; ++k) sum += k->forward ? 1 : -1;
    return sum;
}

List<char> closedParts(const List<side>& sides, const List<label>& part, label n)
{
    List<char> closed(n, 1);
    forOwnEdges(sides, part, [&](const side* begin, const side* end) {
        if (balance(begin, end) != 0) closed[part[begin->triangle]] = 0;
    });
    return closed;
}

// Makes one part of components that close only together, along edges where more than two triangles meet
label joinOpenComponents(const List<side>& sides, List<label>& part, label n)
{
    const List<char> closed = closedParts(sides, part, n);
    List<label> first(n);
    std::iota(first.begin(), first.end(), 0);
    const auto root = [&](label c) {
        while (first[c] != c) c = first[c] = first[first[c]];
        return c;
    };
    forEdges(sides, [&](size_t i, size_t j) {
        label last = -1;
        for (size_t k = i; k < j; ++k)
        {
            const label c = part[sides[k].triangle];
            if (closed[c]) continue;
            if (last >= 0) first[std::max(root(c), root(last))] = std::min(root(c), root(last));
            last = c;
        }
    });
    List<label> number(n, -1);
    label count = 0;
    for (label c = 0; c < n; ++c)
        if (root(c) == c) number[c] = count++;
    for (label& p : part) p = number[root(p)];
    return count;
}

// The triangles of each part, with own nodes
List<triSurface> separated(const triSurface& s, const List<label>& part, label n)
{
    List<triSurface> parts(n);
    for (label t = 0; t < s.size(); ++t)
        parts[part[t]].add(s.corner(t, 0), s.corner(t, 1), s.corner(t, 2), 0);
    return parts;
}

// True if x is inside: a way out passes the surface an odd number of times.  The majority of three ways counts, because
// one may meet an edge
bool insideByCrossings(const surfaceSearch& search, const vector& x, scalar far)
{
    label votes = 0;
    for (const vector& way :
         {vector(0.536, 0.612, 0.581), vector(-0.713, 0.297, 0.635), vector(0.188, -0.844, 0.502)})
        votes += search.allHits(x, x + far * way).size() % 2;
    return votes >= 2;
}

// The largest facet of each component
List<label> largestFacets(const triSurface& s, const List<label>& component)
{
    List<label> largest;
    for (label t = 0; t < s.size(); ++t)
    {
        if (component[t] >= label(largest.size())) largest.resize(component[t] + 1, -1);
        label& at = largest[component[t]];
        if (at < 0 || s.areaVector(t).norm() > s.areaVector(at).norm()) at = t;
    }
    return largest;
}

vector offFacet(const triSurface& s, label t)
{
    return 1e-3 * std::sqrt(s.areaVector(t).norm()) * s.normal(t);
}

// True if an edge of four triangles continues straight in pairs: bodies cross there, or form a checkerboard
bool crossesAtEdges(const triSurface& s)
{
    constexpr scalar straight = -0.9;
    const List<side> sides = sortedSides(s);
    bool found = false;
    forEdges(sides, [&](size_t i, size_t j) {
        if (j - i != 4) return;
        const vector a = s.nodes[sides[i].low], along = (s.nodes[sides[i].high] - a).normalized();
        vector away[4];
        for (int k = 0; k < 4; ++k)
        {
            const vector d = s.centre(sides[i + k].triangle) - a;
            away[k] = (d - d.dot(along) * along).normalized();
        }
        for (int k = 1; k < 4; ++k)
            found = found || (away[0].dot(away[k]) < straight &&
                              away[k == 1 ? 2 : 1].dot(away[k == 3 ? 2 : 3]) < straight);
    });
    return found;
}

// For sides that make no sense: turns each component so that a way out from its inner side passes the surface
// an odd number of times
label turnByCrossings(triSurface& s)
{
    const List<label> component = connectedComponents(s);
    const surfaceSearch search(s);
    const boundBox box = s.bounds();
    const scalar far = 2 * (box.max - box.min).norm();
    List<char> wrong;
    for (const label t : largestFacets(s, component))
        wrong.push_back(insideByCrossings(search, s.centre(t) + offFacet(s, t), far) &&
                        !insideByCrossings(search, s.centre(t) - offFacet(s, t), far));
    label turned = 0;
    for (label t = 0; t < s.size(); ++t)
        if (wrong[component[t]]) turn(s, t), ++turned;
    return turned;
}

}  // namespace

bool sidesTell(const triSurface& s)
{
    const scalar sense = s.volume() < 0 ? -1 : 1;
    const windingNumber winding(s);
    for (const label t : largestFacets(s, connectedComponents(s)))
    {
        const scalar before = sense * winding.value(s.centre(t) + sense * offFacet(s, t));
        if (before < -0.5 || std::abs(before - std::round(before)) > 0.2) return false;
    }
    return true;
}

label orientOutward(triSurface& s)
{
    label turned = makeConsistent(s);
    List<label> part = connectedComponents(s);
    const label nComponents = s.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end());
    const label n = joinOpenComponents(sortedSides(s), part, nComponents);
    // the same triangles can bound bodies that cross and bodies that touch
    if (n < nComponents && !sidesTell(s) && !crossesAtEdges(s)) turned += turnByCrossings(s);
    const List<side> sides = sortedSides(s);
    const List<triSurface> parts = separated(s, part, n);
    const auto within = [](const boundBox& a, const boundBox& b) {
        return b.distSqr(a.min) == 0 && b.distSqr(a.max) == 0;
    };
    List<label> depth(n, 0);  // the wall of a cavity lies inside an odd number of parts
    List<boundBox> boxes;
    for (const triSurface& p : parts) boxes.push_back(p.bounds());
    const List<char> closed = closedParts(sides, part, n);
    for (label o = 0; o < n && n > 1; ++o)
    {
        if (!closed[o]) continue;
        const windingNumber winding(parts[o]);
        for (label c = 0; c < n; ++c)
            if (o != c && within(boxes[c], boxes[o]) &&
                std::abs(winding.value(parts[c].centre(0))) > 0.5)
                ++depth[c];
    }
    List<char> inward(n, 0);
    for (label c = 0; c < n; ++c) inward[c] = (parts[c].volume() < 0) != (depth[c] % 2 == 1);
    for (label t = 0; t < s.size(); ++t)
        if (inward[part[t]]) turn(s, t), ++turned;
    return turned;
}

List<triSurface> separateTouching(const triSurface& s, scalar reach)
{
    List<label> part = connectedComponents(s);
    const label n = joinOpenComponents(
        sortedSides(s), part, s.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end()));
    const List<triSurface> parts = separated(s, part, n);
    List<boundBox> boxes;
    for (const triSurface& p : parts) boxes.push_back(p.bounds());
    const auto meet = [&](label a, label b) {
        return ((boxes[a].min.array() - reach <= boxes[b].max.array()) &&
                (boxes[b].min.array() - reach <= boxes[a].max.array()))
            .all();
    };
    // each part goes into the first group where it touches nothing, the wall of a cavity into the group of its body
    List<label> group(n, -1);
    label groups = 0;
    for (label p = 0; p < n; ++p)
    {
        if (parts[p].volume() < 0) continue;
        for (group[p] = 0;; ++group[p])
        {
            bool room = true;
            for (label q = 0; q < p && room; ++q) room = group[q] != group[p] || !meet(p, q);
            if (room) break;
        }
        groups = std::max(groups, group[p] + 1);
    }
    if (groups < 2) return {s};
    for (label c = 0; c < n; ++c)
    {
        scalar least = std::numeric_limits<scalar>::max();
        for (label p = 0; p < n && parts[c].volume() < 0; ++p)
            if (const scalar v = parts[p].volume();
                v > 0 && v < least && windingNumber(parts[p]).value(parts[c].centre(0)) > 0.5)
                group[c] = group[p], least = v;
    }
    List<triSurface> apart;
    for (label g = 0; g < groups; ++g)
        apart.push_back(s.subset([&](label t) { return std::max(group[part[t]], 0) == g; }));
    return apart;
}

}  // namespace ispf
