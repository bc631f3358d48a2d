// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceCapping.H"

#include <algorithm>
#include <numeric>

namespace ispf
{

namespace
{

// A rim's corners in its plane, counter-clockwise
List<std::array<scalar, 2>> flattened(const List<vector>& points, const vector& normal)
{
    const vector u = normal.unitOrthogonal(), v = normal.cross(u);
    List<std::array<scalar, 2>> flat;
    for (const vector& p : points) flat.push_back({u.dot(p - points[0]), v.dot(p - points[0])});
    return flat;
}

using point2 = std::array<scalar, 2>;

// Twice the area, positive if counter-clockwise
scalar turn(const point2& a, const point2& b, const point2& c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool holds(const point2& a, const point2& b, const point2& c, const point2& p)
{
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

// Is no other corner of the polygon in the triangle at its corner k?
bool isEar(const List<point2>& p, const List<label>& ring, size_t k, scalar flat)
{
    const size_t n = ring.size();
    const label a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n];
    if (turn(p[a], p[b], p[c]) <= flat) return false;
    for (const label other : ring)
        if (other != a && other != b && other != c && p[other] != p[a] && p[other] != p[b] &&
            p[other] != p[c] && holds(p[a], p[b], p[c], p[other]))
            return false;
    return true;
}

bool isInside(const vector& x, const boundaryLoop& loop, const triSurface& s)
{
    List<vector> points = {x};
    for (const label n : loop.nodes) points.push_back(s.nodes[n]);
    const List<point2> p = flattened(points, loop.normal());
    bool inside = false;  // a ray along the first axis
    for (size_t i = 1, j = p.size() - 1; i < p.size(); j = i++)
        if ((p[i][1] > 0) != (p[j][1] > 0) &&
            p[i][0] < (p[j][0] - p[i][0]) * p[i][1] / (p[i][1] - p[j][1]))
            inside = !inside;
    return inside;
}

word listed(const List<boundaryLoop>& loops, scalar dx)
{
    word text;
    for (const boundaryLoop& loop : loops) text += "\n    " + loop.describe(dx);
    return text;
}

// The name of each rim
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

void checkPlane(const triSurface& s, const List<boundaryLoop>& loops, size_t k, const word& name,
                scalar tolerance, scalar dx)
{
    const boundaryLoop& loop = loops[k];
    const word end = "The open end " + loop.describe(dx) + ", to be capped as " + name + ", ";
    if (!(loop.offPlane <= tolerance) || loop.area.norm() == 0)
        throw fatalError(end + "is not plane: its rim lies up to " + str(loop.offPlane, 3) +
                         " m = " + str(loop.offPlane / dx, 3) +
                         " dx off the plane fitted to it, more than " + str(tolerance, 3) +
                         " m. Cut the vessel there by a plane, or raise 'tolerance' in 'capping'");
    for (size_t m = 0; m < loops.size(); ++m)
        if (m != k && std::abs((loops[m].centre - loop.centre).dot(loop.normal())) < dx &&
            isInside(s.nodes[loops[m].nodes[0]], loop, s))
            throw fatalError(
                end + "surrounds another open end, " + loops[m].describe(dx) +
                ": a ring between two rims must be closed in the program that made the file");
}

}  // namespace

List<std::array<label, 3>> fillPolygon(const List<vector>& points, const vector& normal)
{
    const List<point2> p = flattened(points, normal);
    List<label> ring(points.size());
    std::iota(ring.begin(), ring.end(), 0);
    boundBox box;
    for (const vector& x : points) box.add(x);
    const scalar flat = 1e-12 * box.diagonal() * box.diagonal();
    List<std::array<label, 3>> triangles;
    size_t k = 0, failed = 0;
    for (bool strict = true; ring.size() > 2;)
    {
        const size_t n = ring.size();
        // corners in line with their neighbours are left for last, where nothing else remains
        if (!isEar(p, ring, k % n, strict ? flat : -flat))
        {
            ++k;
            if (++failed <= n) continue;
            if (!strict) return {};
            strict = false, failed = 0;
            continue;
        }
        triangles.push_back({ring[(k + n - 1) % n], ring[k % n], ring[(k + 1) % n]});
        ring.erase(ring.begin() + long(k % n));
        k = k % n + 1;  // not the next one: better shapes
        failed = 0, strict = true;
    }
    return triangles;
}

List<std::pair<word, boundaryLoop>> capEnds(triSurface& s, const List<capRequest>& requests,
                                            scalar tolerance, scalar dx)
{
    const List<boundaryLoop> loops = boundaryLoops(s);
    List<std::pair<word, boundaryLoop>> capped;
    if (loops.empty()) throw fatalError("'capping' is asked for, but the surface has no open end");
    const List<word> names = namesFor(loops, requests, dx);
    for (size_t k = 0; k < loops.size(); ++k) checkPlane(s, loops, k, names[k], tolerance, dx);
    for (size_t k = 0; k < loops.size(); ++k)
    {
        const boundaryLoop& loop = loops[k];
        List<label> ring(loop.nodes.rbegin(), loop.nodes.rend());  // as the lid runs
        const auto before = [&](label a, label b) {
            return std::lexicographical_compare(s.nodes[a].begin(), s.nodes[a].end(),
                                                s.nodes[b].begin(), s.nodes[b].end());
        };
        std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), before), ring.end());
        const vector n = loop.normal();
        List<vector> points;
        for (const label node : ring)
        {
            s.nodes[node] -= (s.nodes[node] - loop.centre).dot(n) * n;
            points.push_back(s.nodes[node]);
        }
        const auto triangles = fillPolygon(points, n);
        if (triangles.empty())
            throw fatalError("The rim of the open end " + loop.describe(dx) + " crosses itself");
        const label patch = s.addPatch(names[k]);
        capped.emplace_back(names[k], loop);
        for (const auto& [a, b, c] : triangles)
        {
            s.triangles.push_back({ring[a], ring[b], ring[c]});
            s.patch.push_back(patch);
        }
    }
    return capped;
}

}  // namespace ispf
