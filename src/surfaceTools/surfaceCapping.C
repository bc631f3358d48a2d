// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceCapping.H"

#include "polygonFilling.H"
#include <algorithm>

namespace ispf
{

namespace
{

bool isInside(const vector& x, const boundaryLoop& loop, const triSurface& s)
{
    List<vector> points = {x};
    for (const label n : loop.nodes) points.push_back(s.nodes[n]);
    const List<std::array<scalar, 2>> p = flattened(points, loop.normal());
    bool inside = false;  // counts crossings of a ray along the first axis
    for (size_t i = 1, j = p.size() - 1; i < p.size(); j = i++)
        if ((p[i][1] > 0) != (p[j][1] > 0) &&
            p[i][0] < (p[j][0] - p[i][0]) * p[i][1] / (p[i][1] - p[j][1]))
            inside = !inside;
    return inside;
}

bool liesWithin(const triSurface& s, const boundaryLoop& inner, const boundaryLoop& outer,
                scalar dx)
{
    return std::abs((inner.centre - outer.centre).dot(outer.normal())) < dx &&
           isInside(s.nodes[inner.nodes[0]], outer, s);
}

word listed(const List<boundaryLoop>& loops, scalar dx)
{
    word text;
    for (const boundaryLoop& loop : loops) text += "\n    " + loop.describe(dx);
    return text;
}

// Number of other rims in its plane around each rim.  A rim within one is the inner edge of a ring; a rim within
// two is the outer edge of another end
List<int> depths(const triSurface& s, const List<boundaryLoop>& loops, scalar dx)
{
    List<int> depth(loops.size(), 0);
    for (size_t k = 0; k < loops.size(); ++k)
        for (size_t m = 0; m < loops.size(); ++m)
            depth[k] += m != k && liesWithin(s, loops[k], loops[m], dx);
    return depth;
}

// Name of each end
List<word> namesFor(const List<boundaryLoop>& loops, const List<capRequest>& requests, scalar dx)
{
    List<word> names(loops.size());
    for (size_t k = 0; k < loops.size() && requests.empty(); ++k)
        names[k] = "cap" + std::to_string(k);
    for (const capRequest& request : requests)
    {
        size_t best = 0;
        for (size_t k = 1; k < loops.size(); ++k)
            if ((loops[k].centre - request.place).norm() <
                (loops[best].centre - request.place).norm())
                best = k;
        if (!names[best].empty())
            throw fatalError("The caps " + names[best] + " and " + request.name +
                             " are nearest to the same open end. The open ends are" +
                             listed(loops, dx));
        names[best] = request.name;
    }
    for (size_t k = 0; k < loops.size(); ++k)
        if (names[k].empty())
            throw fatalError("No cap is asked for over the open end " + loops[k].describe(dx) +
                             ". The open ends are" + listed(loops, dx));
    return names;
}

void checkPlane(const boundaryLoop& loop, const word& name, scalar tolerance, scalar dx)
{
    if (!(loop.offPlane <= tolerance) || loop.area.norm() == 0)
        throw fatalError("The open end " + loop.describe(dx) + ", to be capped as " + name +
                         ", is not plane: its rim lies up to " + str(loop.offPlane, 3) +
                         " m = " + str(loop.offPlane / dx, 3) +
                         " dx off the plane fitted to it, more than " + str(tolerance, 3) +
                         " m. Cut the vessel there by a plane, or raise 'tolerance' in 'capping'");
}

// The rim's nodes in the direction of the lid: counter-clockwise about n, or clockwise if the rim is a hole in the lid.
// Starts from the first node in space and moves the nodes into the plane
List<label> ringOf(triSurface& s, const boundaryLoop& loop, const boundaryLoop& plane, bool isHole)
{
    const vector n = plane.normal();
    List<label> ring(loop.nodes.rbegin(), loop.nodes.rend());
    if ((loop.area.dot(n) > 0) == isHole) std::reverse(ring.begin(), ring.end());
    const auto before = [&](label a, label b) {
        return std::lexicographical_compare(s.nodes[a].begin(), s.nodes[a].end(),
                                            s.nodes[b].begin(), s.nodes[b].end());
    };
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), before), ring.end());
    for (const label node : ring) s.nodes[node] -= (s.nodes[node] - plane.centre).dot(n) * n;
    return ring;
}

void addLid(triSurface& s, const List<List<label>>& rings, const boundaryLoop& loop,
            const word& name, scalar dx)
{
    List<label> nodes;
    List<List<vector>> points;
    for (const List<label>& ring : rings)
    {
        nodes.insert(nodes.end(), ring.begin(), ring.end());
        points.emplace_back();
        for (const label node : ring) points.back().push_back(s.nodes[node]);
    }
    const auto triangles = fillPolygon(points, loop.normal());
    if (triangles.empty())
        throw fatalError("The rim of the open end " + loop.describe(dx) + " crosses itself");
    const label patch = s.addPatch(name);
    for (const auto& [a, b, c] : triangles)
    {
        s.triangles.push_back({nodes[a], nodes[b], nodes[c]});
        s.patch.push_back(patch);
    }
}

}  // namespace

List<std::pair<word, boundaryLoop>> capEnds(triSurface& s, const List<capRequest>& requests,
                                            scalar tolerance, scalar dx)
{
    const List<boundaryLoop> all = boundaryLoops(s);
    if (all.empty()) throw fatalError("'capping' is asked for, but the surface has no open end");
    const List<int> depth = depths(s, all, dx);
    List<boundaryLoop> ends, holes;
    List<int> endDepth, holeDepth;
    for (size_t k = 0; k < all.size(); ++k)
    {
        (depth[k] % 2 ? holes : ends).push_back(all[k]);
        (depth[k] % 2 ? holeDepth : endDepth).push_back(depth[k]);
    }
    const List<word> names = namesFor(ends, requests, dx);
    List<std::pair<word, boundaryLoop>> capped;
    for (size_t k = 0; k < ends.size(); ++k)
    {
        checkPlane(ends[k], names[k], tolerance, dx);
        List<List<label>> rings = {ringOf(s, ends[k], ends[k], false)};
        for (size_t m = 0; m < holes.size(); ++m)
            if (holeDepth[m] == endDepth[k] + 1 && liesWithin(s, holes[m], ends[k], dx))
            {
                checkPlane(holes[m], names[k], tolerance, dx);
                rings.push_back(ringOf(s, holes[m], ends[k], true));
            }
        addLid(s, rings, ends[k], names[k], dx);
        capped.emplace_back(names[k], ends[k]);
    }
    return capped;
}

}  // namespace ispf
