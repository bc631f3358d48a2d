// SPDX-License-Identifier: GPL-3.0-or-later
#include "polygonFilling.H"

#include <algorithm>
#include <numeric>

namespace ispf
{

namespace
{

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

// True if no other corner of the polygon is in the triangle at its corner k
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

// True if the segments ab and cd touch, except in an end that both share
bool touch(const point2& a, const point2& b, const point2& c, const point2& d)
{
    if (a == c || a == d || b == c || b == d) return false;
    const auto between = [](scalar one, scalar other) {
        return (one <= 0) == (other >= 0) || one == 0;
    };
    return between(turn(a, b, c), turn(a, b, d)) && between(turn(c, d, a), turn(c, d, b));
}

// Joins the holes to the outer ring by cuts, each along the shortest line that meets no edge (Held 2001).  The result
// is one ring, which contains the ends of each cut twice
List<label> cutOpen(const List<point2>& p, const List<List<label>>& rings)
{
    List<label> ring = rings[0];
    for (size_t h = 1; h < rings.size(); ++h)
    {
        struct cut
        {
            scalar length;
            size_t i, j;
        };
        List<cut> cuts;
        for (size_t i = 0; i < ring.size(); ++i)
            for (size_t j = 0; j < rings[h].size(); ++j)
            {
                const point2 &a = p[ring[i]], &b = p[rings[h][j]];
                cuts.push_back({std::hypot(a[0] - b[0], a[1] - b[1]), i, j});
            }
        std::stable_sort(cuts.begin(), cuts.end(),
                         [](const cut& a, const cut& b) { return a.length < b.length; });
        const auto isFree = [&](const cut& c) {
            const auto meets = [&](const List<label>& edges) {
                for (size_t k = 0; k < edges.size(); ++k)
                    if (touch(p[ring[c.i]], p[rings[h][c.j]], p[edges[k]],
                              p[edges[(k + 1) % edges.size()]]))
                        return true;
                return false;
            };
            return !meets(ring) && std::none_of(rings.begin() + long(h), rings.end(), meets);
        };
        const auto found = std::find_if(cuts.begin(), cuts.end(), isFree);
        if (found == cuts.end()) return {};
        List<label> detour(rings[h].begin() + long(found->j), rings[h].end());
        detour.insert(detour.end(), rings[h].begin(), rings[h].begin() + long(found->j) + 1);
        detour.push_back(ring[found->i]);
        ring.insert(ring.begin() + long(found->i) + 1, detour.begin(), detour.end());
    }
    return ring;
}

}  // namespace

List<std::array<scalar, 2>> flattened(const List<vector>& points, const vector& normal)
{
    const vector u = normal.unitOrthogonal(), v = normal.cross(u);
    List<std::array<scalar, 2>> flat;
    for (const vector& p : points) flat.push_back({u.dot(p - points[0]), v.dot(p - points[0])});
    return flat;
}

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
        // corners in line with their neighbours come last, when no other corner remains
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
        k = k % n + 1;  // leaves out the next corner: better shapes
        failed = 0, strict = true;
    }
    return triangles;
}

List<std::array<label, 3>> fillPolygon(const List<List<vector>>& rings, const vector& normal)
{
    List<vector> points;
    List<List<label>> indices;
    for (const List<vector>& ring : rings)
    {
        indices.emplace_back(ring.size());
        std::iota(indices.back().begin(), indices.back().end(), label(points.size()));
        points.insert(points.end(), ring.begin(), ring.end());
    }
    const List<label> ring = cutOpen(flattened(points, normal), indices);
    List<vector> corners;
    for (const label k : ring) corners.push_back(points[k]);
    auto triangles = fillPolygon(corners, normal);
    for (auto& t : triangles) t = {ring[t[0]], ring[t[1]], ring[t[2]]};
    return triangles;
}

}  // namespace ispf
