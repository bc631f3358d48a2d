// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceTopology.H"

#include "surfaceSearch.H"
#include "windingNumber.H"
#include <algorithm>
#include <map>
#include <numeric>

namespace ispf
{

namespace
{

// One side of a triangle, sorted so that the sides of one edge stand together
struct side
{
    label low, high;  // nodes of the edge, low < high
    label triangle;
    bool forward;  // runs from low to high

    bool sameEdge(const side& o) const { return low == o.low && high == o.high; }
    bool operator<(const side& o) const
    {
        return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle);
    }
};

List<side> sortedSides(const triSurface& s)
{
    List<side> sides;
    sides.reserve(3 * s.triangles.size());
    for (label t = 0; t < s.size(); ++t)
        for (int k = 0; k < 3; ++k)
        {
            const label a = s.triangles[t][k], b = s.triangles[t][(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

// Calls f(first, last) for the range of sides of each edge
template <class F>
void forEdges(const List<side>& sides, F&& f)
{
    for (size_t i = 0, j; i < sides.size(); i = j)
    {
        for (j = i + 1; j < sides.size() && sides[j].sameEdge(sides[i]);) ++j;
        f(i, j);
    }
}

// Neighbours over edges shared by exactly two triangles; second: the two run the same way
List<List<std::pair<label, bool>>> neighbours(const triSurface& s)
{
    List<List<std::pair<label, bool>>> next(s.size());
    const List<side> sides = sortedSides(s);
    forEdges(sides, [&](size_t i, size_t j) {
        if (j - i != 2) return;
        const bool same = sides[i].forward == sides[i + 1].forward;
        next[sides[i].triangle].push_back({sides[i + 1].triangle, same});
        next[sides[i + 1].triangle].push_back({sides[i].triangle, same});
    });
    return next;
}

void turn(triSurface& s, label t)
{
    std::swap(s.triangles[t][1], s.triangles[t][2]);
}

// Turns triangles so that they agree with the first one of their component
label makeConsistent(triSurface& s)
{
    const auto next = neighbours(s);
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

}  // namespace

List<std::array<label, 2>> openHalfEdges(const triSurface& s)
{
    List<std::array<label, 2>> open;
    const List<side> sides = sortedSides(s);
    forEdges(sides, [&](size_t i, size_t j) {
        label balance = 0;
        for (size_t k = i; k < j; ++k) balance += sides[k].forward ? 1 : -1;
        for (; balance > 0; --balance) open.push_back({sides[i].low, sides[i].high});
        for (; balance < 0; ++balance) open.push_back({sides[i].high, sides[i].low});
    });
    return open;
}

closednessReport checkClosed(const triSurface& s)
{
    closednessReport report;
    const List<side> sides = sortedSides(s);
    forEdges(sides, [&](size_t i, size_t j) {
        if (j - i == 2 && sides[i].forward == sides[i + 1].forward) ++report.flippedPairs;
    });
    scalar longest = -1;
    for (const auto& [a, b] : openHalfEdges(s))
    {
        const scalar length = (s.nodes[b] - s.nodes[a]).norm();
        ++report.openEdges;
        report.openLength += length;
        if (length > longest) longest = length, report.openAt = 0.5 * (s.nodes[a] + s.nodes[b]);
    }
    return report;
}

word closednessReport::describe(scalar unit) const
{
    if (closed()) return "closed";
    const vector at = openAt / unit;
    word text;
    if (openEdges > 0)
        text = std::to_string(openEdges) + " open edges of total length " + str(openLength / unit) +
               ", the longest at (" + str(at[0]) + " " + str(at[1]) + " " + str(at[2]) + ")";
    if (flippedPairs > 0)
        text += (text.empty() ? "" : "; ") + std::to_string(flippedPairs) +
                " edges whose two triangles disagree on the outside";
    return text;
}

List<label> connectedComponents(const triSurface& s)
{
    const auto next = neighbours(s);
    List<label> component(s.size(), -1), stack;
    label count = 0;
    for (label seed = 0; seed < s.size(); ++seed)
    {
        if (component[seed] >= 0) continue;
        stack.push_back(seed);
        component[seed] = count;
        while (!stack.empty())
        {
            const label t = stack.back();
            stack.pop_back();
            for (const auto& [other, same] : next[t])
                if (component[other] < 0) component[other] = count, stack.push_back(other);
        }
        ++count;
    }
    return component;
}

namespace
{

// Calls f(first, last) for the sides that patch p has in common with itself along each of its edges
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

// Components that close only together, along edges where more than two triangles meet, become one part
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

// A part's triangles with nodes of their own
List<triSurface> separated(const triSurface& s, const List<label>& part, label n)
{
    List<triSurface> parts(n);
    for (label t = 0; t < s.size(); ++t)
        parts[part[t]].add(s.corner(t, 0), s.corner(t, 1), s.corner(t, 2), 0);
    return parts;
}

// Is x inside by the number of times that a way out passes the surface?  The majority of three ways: one may
// meet an edge
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

// Edges of four triangles that go on straight in pairs: of bodies that cross there, or of a checkerboard
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

// Where the sides given do not tell, each component is turned so that a way out from its inner side passes the
// surface an odd number of times
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
    List<label> depth(n, 0);  // the wall of a cavity lies inside an odd number
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

}  // namespace ispf
