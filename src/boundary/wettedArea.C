// SPDX-License-Identifier: GPL-3.0-or-later
#include "wettedArea.H"
#include "pointGrid.H"
#include "surfaceRefinement.H"

#include <limits>

namespace ispf
{

namespace
{

constexpr scalar sight = 2;  // [dx] before a wall's surface

class fluidPoints
{
public:
    explicit fluidPoints(const particleCloud& cloud) : cloud_(cloud), grid_(sight * cloud.dx)
    {
        for (label i = cloud.nSolid(); i < cloud.n(); ++i) grid_.add(cloud.x[i].xyz());
    }
    // Zone of the nearest particle before the surface at x with outward normal n; -1: none in sight
    label zoneBefore(const vector& x, const vector& n) const
    {
        scalar nearest = sight * cloud_.dx;
        label zone = -1;
        grid_.within(x, nearest, [&](label k, scalar r) {
            if (r < nearest && (grid_[k] - x).dot(n) < 0)
                nearest = r, zone = cloud_.zone[cloud_.nSolid() + k];
        });
        return zone;
    }

private:
    const particleCloud& cloud_;
    pointGrid grid_;
};

// Zone of the fluid particle nearest before a plane
label zoneBefore(const wall& w, const particleCloud& cloud)
{
    scalar nearest = std::numeric_limits<scalar>::max();
    label zone = -1;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        const scalar before = (w.point + w.offset - cloud.x[i].xyz()).dot(w.normal);
        if (before >= 0 && before < nearest) nearest = before, zone = cloud.zone[i];
    }
    return zone;
}

}  // namespace

void wettedArea::find(const wallSet& walls, const imageGroup& group, const particleCloud& cloud)
{
    nZones_ = cloud.zones.size();
    parts_.clear();
    std::unique_ptr<fluidPoints> fluid;  // made for the first wall that needs them
    for (const wallSet::body& b : walls.bodies())
    {
        const label index = b.walls.front();  // a moving wall is a body of its own
        const wall& w = walls.walls()[index];
        if (!w.motion.moves()) continue;
        if (w.plane)
        {
            if (const label zone = zoneBefore(w, cloud); zone >= 0)
                parts_.push_back({index, zone, vector::Zero()});
            continue;
        }
        if (!fluid) fluid = std::make_unique<fluidPoints>(cloud);
        List<vector> area(nZones_, vector::Zero());
        triSurface s = *b.surface->mesh();
        refine(s, 1.5 * cloud.dx);
        for (label t = 0; t < s.size(); ++t)
        {
            const vector centre = (s.corner(t, 0) + s.corner(t, 1) + s.corner(t, 2)) / 3;
            if (group.beyond(centre) > 0) continue;  // an image
            const vector a = walls.perDepth(*b.surface) * s.areaVector(t);
            for (const scalar side : {1, -1})
            {
                if (side < 0 && !b.twoSided) continue;
                const label zone = fluid->zoneBefore(centre + w.offset, side * s.normal(t));
                if (zone >= 0) area[zone] += side * a;
            }
        }
        for (label z = 0; z < label(nZones_); ++z)
            if (!area[z].isZero(0)) parts_.push_back({index, z, area[z]});
    }
}

List<scalar> wettedArea::sweptRate(const wallSet& walls) const
{
    List<scalar> rate(nZones_, 0);
    for (const part& p : parts_)
    {
        const wall& w = walls.walls()[p.wall];
        const vector motion = w.velocity - w.motion.slide();
        const vector area = w.plane ? walls.planeArea(w) : p.area;
        rate[p.zone] -=
            w.plane && area.isZero(0) ? std::numeric_limits<scalar>::quiet_NaN() : motion.dot(area);
    }
    return rate;
}

}  // namespace ispf
