// SPDX-License-Identifier: GPL-3.0-or-later
#include "openVolume.H"

#include "surfaceTopology.H"

#include <cmath>
#include <map>

namespace ispf
{

namespace
{

class openingMeasure
{
public:
    openingMeasure(const triSurface& s, const List<halfSpace>& planes, scalar tolerance,
                   const std::function<bool(const vector&)>& inside)
        : s_(s),
          planes_(planes),
          tolerance_(tolerance),
          inside_(inside),
          c_(s.empty() ? vector(vector::Zero()) : s.bounds().centre()),
          open_(openHalfEdges(s))
    {
    }

    scalar volume() const
    {
        scalar sum = 0;
        for (label t = 0; t < s_.size(); ++t) sum += (s_.corner(t, 0) - c_).dot(s_.areaVector(t));
        for (const halfSpace& k : planes_) sum -= k.distance(c_) * area(k);
        return sum / 3;
    }

private:
    bool lies(const vector& x, const halfSpace& k) const
    {
        return std::abs(k.distance(x)) <= tolerance_;
    }

    // Area of the opening in plane k.  Its rim runs against the surface's open edges
    scalar area(const halfSpace& k) const
    {
        scalar sum = 0;
        std::map<label, int> surplus;  // of edges that arrive at a node over those that leave it
        for (const auto& [b, a] : open_)
        {
            const vector &p = s_.nodes[a], &q = s_.nodes[b];
            if (!lies(p, k) || !lies(q, k)) continue;
            sum += k.normal.dot((p - c_).cross(q - p));
            --surplus[a], ++surplus[b];
        }
        for (const halfSpace& m : planes_)
        {
            const vector across = k.normal.cross(m.normal);
            const scalar sine = across.norm();
            if (sine < 1e-9) continue;
            const scalar d = (k.normal.dot(m.normal) * k.distance(c_) - m.distance(c_)) / sine;
            sum += d * length(k, m, across / sine, surplus);
        }
        return sum / 2;
    }

    // Length of the rim along t, the direction of the line in which k meets m
    scalar length(const halfSpace& k, const halfSpace& m, const vector& t,
                  const std::map<label, int>& surplus) const
    {
        scalar sum = 0;
        for (const auto& [node, n] : surplus)
            if (lies(s_.nodes[node], m)) sum -= n * t.dot(s_.nodes[node]);
        for (const halfSpace& l : planes_)
        {
            if (std::abs(t.dot(l.normal)) < 1e-9) continue;
            tensor normals;
            normals << k.normal.transpose(), m.normal.transpose(), l.normal.transpose();
            const vector corner =
                normals.inverse() *
                vector(k.normal.dot(k.point), m.normal.dot(m.point), l.normal.dot(l.point));
            // moved by the same way from all three
            const vector step = normals.inverse() * vector(-1, -1, -1);
            if (inside_(corner + 100 * tolerance_ * step))
                sum += (t.dot(l.normal) > 0 ? 1 : -1) * t.dot(corner);
        }
        return sum;
    }

    const triSurface& s_;
    const List<halfSpace>& planes_;
    const scalar tolerance_;
    const std::function<bool(const vector&)>& inside_;
    const vector c_;
    const List<std::array<label, 2>> open_;
};

}  // namespace

scalar openVolume(const triSurface& surface, const List<halfSpace>& planes, scalar tolerance,
                  const std::function<bool(const vector&)>& inside)
{
    return openingMeasure(surface, planes, tolerance, inside).volume();
}

}  // namespace ispf
