// SPDX-License-Identifier: GPL-3.0-or-later
#include "latticePoints.H"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ispf
{

namespace
{

constexpr scalar nearFace = 0.5;    // in dx
constexpr scalar alongAxis = 0.99;  // cosine between a face's normal and the lattice

// Neighbour behind a face, or owner of a point, seen from the zone that is filled
constexpr label nothing = -1, rigid = -2, untouchable = -3;

class exchange
{
public:
    exchange(List<latticePoint>& points, const zoneGeometry& geometry, label zone,
             const List<char>& settled)
        : points_(points),
          geometry_(geometry),
          settled_(settled),
          zone_(zone),
          surface_(geometry.boundary(zone))
    {
    }

    void run()
    {
        label n = 0;
        for (const latticePoint& p : points_) n += p.zone == zone_;
        const scalar cell = std::pow(geometry_.dx(), geometry_.nDims());
        const label wanted = label(std::lround(geometry_.volume(zone_) / cell));
        find(n > wanted);
        const size_t change = std::min(found_.size(), size_t(std::abs(n - wanted)));
        for (size_t k = 0; k < change; ++k) n > wanted ? give(found_[k]) : take(found_[k]);
    }

private:
    struct candidate
    {
        scalar depth;
        label point, behind, patch;
    };

    label holderOf(const latticePoint& p) const
    {
        if (p.zone >= 0) return p.zone;
        return p.outside.type == exteriorPoint::kind::rigid ? rigid : untouchable;
    }

    // Neighbour behind the triangle.  patch: set to its number if rigid material lies behind it
    label behind(label triangle, label& patch) const
    {
        const triSurface& s = surface_.surface();
        const word& name = s.patchNames[s.patch[triangle]];
        if (name.empty()) return nothing;
        for (size_t z = 0; z < geometry_.zones().size(); ++z)
            if (name == zoneGeometry::towards(geometry_.zones()[z].name))
                return settled_[z] ? untouchable : label(z);
        for (size_t p = 0; p < geometry_.patches().size(); ++p)
            if (geometry_.patches()[p].name == name &&
                geometry_.patches()[p].type == patchInfo::kind::wall)
            {
                patch = label(p);
                return rigid;
            }
        return untouchable;
    }

    // Collects the points of this zone beside curved faces (own), or those of its neighbours
    void find(bool own)
    {
        for (size_t i = 0; i < points_.size(); ++i)
        {
            const label holder = holderOf(points_[i]);
            if (holder == untouchable || (holder == zone_) != own) continue;
            const surfacePoint q = surface_.nearest(points_[i].x, nearFace * geometry_.dx());
            if (!q.found || q.normal.cwiseAbs().maxCoeff() > alongAxis) continue;
            label patch = -1;
            const label other = behind(q.triangle, patch);
            if (other == untouchable || (!own && other != holder)) continue;
            found_.push_back({q.distance, label(i), other, patch});
        }
        std::stable_sort(found_.begin(), found_.end(),
                         [](const candidate& a, const candidate& b) { return a.depth < b.depth; });
    }

    void give(const candidate& c)
    {
        latticePoint& p = points_[c.point];
        p.zone = c.behind >= 0 ? c.behind : -1;
        if (c.behind != rigid) return;
        p.outside.type = exteriorPoint::kind::rigid, p.outside.patch = c.patch;
    }

    void take(const candidate& c)
    {
        points_[c.point].zone = zone_;
        points_[c.point].outside = exteriorPoint();
    }

    List<latticePoint>& points_;
    const zoneGeometry& geometry_;
    const List<char>& settled_;
    label zone_;
    surfaceSearch surface_;
    List<candidate> found_;
};

// Per zone: number of zones between it and a wall
List<label> zonesToWall(const zoneGeometry& geometry)
{
    const label n = label(geometry.zones().size());
    List<label> steps(n, n);
    for (label sweep = 0; sweep < n; ++sweep)
        for (label z = 0; z < n; ++z)
            for (const word& name : geometry.boundary(z).patchNames)
            {
                for (label other = 0; other < n; ++other)
                    if (name == zoneGeometry::towards(geometry.zones()[other].name))
                        steps[z] = std::min(steps[z], steps[other] + 1);
                for (const patchInfo& p : geometry.patches())
                    if (p.name == name && p.type == patchInfo::kind::wall) steps[z] = 0;
            }
    return steps;
}

}  // namespace

void matchCounts(List<latticePoint>& points, const zoneGeometry& geometry)
{
    // enclosed zones first, against those around them; at equal depth solids before fluids
    const List<label> steps = zonesToWall(geometry);
    const auto isFluid = [&](label z) { return geometry.zones()[z].phase == phaseType::fluid; };
    List<label> order(geometry.zones().size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](label a, label b) {
        return steps[a] != steps[b] ? steps[a] > steps[b] : isFluid(a) < isFluid(b);
    });
    List<char> settled(order.size(), 0);
    for (const label z : order)
    {
        exchange(points, geometry, z, settled).run();
        settled[z] = 1;
    }
}

}  // namespace ispf
