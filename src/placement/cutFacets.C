// SPDX-License-Identifier: GPL-3.0-or-later
#include "cutFacets.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Cosine: touching faces are meshed differently and cross a little
constexpr scalar parallel = 0.9;

using facet = std::array<vector, 3>;

facet facetOf(const triSurface& s, label t)
{
    return {s.corner(t, 0), s.corner(t, 1), s.corner(t, 2)};
}

struct plane
{
    vector point, normal;
    scalar operator()(const vector& x) const { return (x - point).dot(normal); }
};

plane planeOf(const facet& f)
{
    return {f[0], (f[1] - f[0]).cross(f[2] - f[0]).normalized()};
}

// The part of facet f within `tolerance` of plane p, as the ends of a segment on the common line of both planes.  A face
// that only touches p, meshed differently, lies sometimes above and sometimes below it
bool trace(const facet& f, const plane& p, scalar tolerance, std::array<vector, 2>& ends)
{
    const plane own = planeOf(f);
    const vector along = own.normal.cross(p.normal).normalized();
    // from p's side of f to the common line, in the plane of f
    const vector across = along.cross(own.normal);
    const scalar slope = across.dot(p.normal);
    int n = 0;
    const auto reach = [&](const vector& x) {
        const vector on = x - p(x) / slope * across;
        if (n == 0) ends = {on, on};
        else if ((on - ends[0]).dot(along) < 0) ends[0] = on;
        else if ((on - ends[1]).dot(along) > 0) ends[1] = on;
        ++n;
    };
    for (int k = 0; k < 3; ++k)
    {
        const vector &a = f[k], &b = f[(k + 1) % 3];
        const scalar da = p(a), db = p(b);
        if (std::abs(da) <= tolerance) reach(a);
        for (const scalar level : {-tolerance, tolerance})
            if ((da - level) * (db - level) < 0) reach(a + (level - da) / (db - da) * (b - a));
    }
    return n > 1;
}

// Length of a segment inside a facet of the same plane
scalar lengthInside(std::array<vector, 2> s, const facet& f)
{
    const vector normal = planeOf(f).normal;
    for (int k = 0; k < 3; ++k)
    {
        const plane edge = {f[k], (f[(k + 1) % 3] - f[k]).cross(normal)};  // outward
        const scalar a = edge(s[0]), b = edge(s[1]);
        if (a >= 0 && b >= 0) return 0;
        if (a > 0) s[0] += a / (a - b) * (s[1] - s[0]);
        else if (b > 0) s[1] += b / (b - a) * (s[0] - s[1]);
    }
    return (s[1] - s[0]).norm();
}

void split(const facet& f, const plane& p, List<facet>& parts)
{
    for (const scalar side : {1.0, -1.0})
    {
        List<vector> polygon;
        for (int k = 0; k < 3; ++k)
        {
            const vector &a = f[k], &b = f[(k + 1) % 3];
            const scalar da = side * p(a), db = side * p(b);
            if (da >= 0) polygon.push_back(a);
            if (da * db < 0) polygon.push_back(a + da / (da - db) * (b - a));
        }
        for (size_t k = 2; k < polygon.size(); ++k)
            parts.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
}

bool parts(const plane& p, const facet& f, scalar tolerance)
{
    scalar low = 0, high = 0;
    for (const vector& x : f) low = std::min(low, p(x)), high = std::max(high, p(x));
    return low < -tolerance && high > tolerance;
}

class cutter
{
public:
    cutter(const facet& f, scalar tolerance) : plane_(planeOf(f)), tolerance_(tolerance)
    {
        pieces_ = {f};
        for (const vector& x : f) box_.add(x);
        box_.min.array() -= tolerance, box_.max.array() += tolerance;
    }

    void cutBy(const facet& other)
    {
        const plane p = planeOf(other);
        std::array<vector, 2> ends = {vector::Zero(), vector::Zero()};
        if (std::abs(p.normal.dot(plane_.normal)) > parallel ||
            !trace(other, plane_, tolerance_, ends))
            return;
        List<facet> kept;
        for (const facet& piece : pieces_)
            if (parts(p, piece, tolerance_) && lengthInside(ends, piece) > 1e-3 * tolerance_)
                split(piece, p, kept);
            else kept.push_back(piece);
        pieces_ = std::move(kept);
    }

    const boundBox& box() const { return box_; }
    const List<facet>& pieces() const { return pieces_; }

private:
    plane plane_;
    scalar tolerance_;
    boundBox box_;
    List<facet> pieces_;
};

}  // namespace

triSurface cutFacets(const triSurface& surface, const List<const surfaceSearch*>& others,
                     scalar large, scalar tolerance)
{
    triSurface result;
    result.patchNames = surface.patchNames;
    for (label t = 0; t < surface.size(); ++t)
    {
        const facet f = facetOf(surface, t);
        cutter cut(f, tolerance);
        if (std::max({(f[1] - f[0]).norm(), (f[2] - f[1]).norm(), (f[0] - f[2]).norm()}) > large)
            for (const surfaceSearch* other : others)
                for (const label u : other->inBox(cut.box()))
                    cut.cutBy(facetOf(other->surface(), u));
        for (const facet& piece : cut.pieces())
            result.add(piece[0], piece[1], piece[2], surface.patch[t]);
    }
    return result;
}

}  // namespace ispf
