// SPDX-License-Identifier: GPL-3.0-or-later
#include "wettedArea.H"
#include "pointGrid.H"
#include "surfaceRefinement.H"

#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

// [dx] distance before a part at which its fluid is searched, and radius of this search
constexpr scalar ahead = 0.7, sight = 1.2;

// Zone of the fluid particle nearest before a plane, -1 without fluid
label zoneBefore(const wall& w, const particleCloud& cloud)
{
    scalar nearest = std::numeric_limits<scalar>::max();
    label zone = -1;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        const scalar before = (w.frame.toSpace(w.point) - cloud.x[i].xyz()).dot(w.normal);
        if (before >= 0 && before < nearest) nearest = before, zone = cloud.zone[i];
    }
    return zone;
}

}  // namespace

void wettedArea::find(const wallSet& walls, const imageGroup& group, const particleCloud& cloud)
{
    for (const wallSet::body& b : walls.bodies())
    {
        const label index = b.walls.front();  // each moving wall is a body
        const wall& w = walls.walls()[index];
        if (!w.motion.moves()) continue;
        if (w.plane)
        {
            planes_.push_back(index);
            continue;
        }
        triSurface s = group.clipped(*b.surface->mesh());
        refine(s, 1.5 * cloud.dx);
        for (label t = 0; t < s.size(); ++t)
        {
            vector centre = (s.corner(t, 0) + s.corner(t, 1) + s.corner(t, 2)) / 3;
            if (cloud.nDims == 2) centre[2] = 0;
            const vector area = walls.perDepth(*b.surface) * s.areaVector(t);
            parts_.push_back({index, centre, s.normal(t), area});
            if (b.twoSided) parts_.push_back({index, centre, -s.normal(t), -area});
        }
    }
}

sweptRates wettedArea::rates(const wallSet& walls, const particleCloud& cloud) const
{
    sweptRates r;
    r.net.assign(cloud.zones.size(), 0), r.gross = r.faces = r.net;
    const auto add = [&](label zone, scalar rate) {
        r.net[zone] += rate, r.gross[zone] += std::abs(rate);
    };
    for (const label index : planes_)
    {
        const wall& w = walls.walls()[index];
        const scalar across = w.surfaceVelocity.u.dot(w.normal);
        const label zone = across == 0 ? -1 : zoneBefore(w, cloud);
        const scalar area = walls.planeArea(w).norm();
        if (zone >= 0)
            add(zone, area > 0 ? -across * area : std::numeric_limits<scalar>::quiet_NaN());
    }
    if (parts_.empty()) return r;

    const scalar dx = cloud.dx;
    boundBox near;
    for (const part& p : parts_) near.add(walls.walls()[p.wall].frame.toSpace(p.centre));
    pointGrid fluid(sight * dx);
    List<label> index;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (const vector x = cloud.x[i].xyz(); near.distSqr(x) < std::pow((ahead + sight) * dx, 2))
            fluid.add(x), index.push_back(i);
    for (const part& p : parts_)
    {
        const wall& w = walls.walls()[p.wall];
        const vector centre = w.frame.toSpace(p.centre);
        // mean of the areas before and after, as in wallSet::turnedVolume: chords alone would have a divergence
        const vector area = 0.5 * (w.frame.turn(p.area) + w.after.turn(p.area));
        const scalar rate = -w.surfaceVelocity.at(centre).dot(area);
        if (rate == 0) continue;
        const vector at = centre - ahead * dx * w.frame.turn(p.normal);
        if (const label k = fluid.nearestIndex(at, sight * dx); k >= 0)
            add(cloud.zone[index[k]], rate);
    }
    return r;
}

}  // namespace ispf
