// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellSamples.H"
#include "openFace.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Two unit vectors across n; in two dimensions one vector in the plane
List<vector> tangents(const vector& n, int nDims)
{
    if (nDims == 2) return {vector(-n[1], n[0], 0).normalized()};
    const vector across = n.unitOrthogonal();
    return {across, n.cross(across)};
}

// Keeps the depth at some points of a cell.  Another point that is outside the strip by these depths needs no search
class knownSides
{
public:
    knownSides(const patchSurface& surface, footSequence& near, const vector& inCell, scalar dx,
               int nDims)
    {
        vector centre = vector::Zero();
        for (int d = 0; d < nDims; ++d) centre[d] = dx * (std::floor(inCell[d] / dx) + 0.5);
        const surfaceFoot f = near.find(centre);
        // nothing in the cell is farther from the surface than this, seen from the centre
        const scalar farthest = std::abs(f.depth) + std::sqrt(scalar(nDims)) * dx;
        usable_ = f.found && f.aside == 0 && !surface.rimWithin(centre, farthest);
        add(centre, f);
    }
    void add(const vector& x, const surfaceFoot& f)
    {
        if (usable_ && f.found) known_.push_back({x, f.depth});
    }
    // True if the depth of x is surely negative or larger than `depth`.  Without a rim nearby, the depth changes by no
    // more than the way from a known point to x
    bool isOutside(const vector& x, scalar depth) const
    {
        constexpr scalar rounding = 1e-9;
        return std::any_of(known_.begin(), known_.end(), [&](const place& p) {
            const scalar way = (1 + rounding) * (x - p.x).norm();
            return p.depth + way < 0 || p.depth - way > depth;
        });
    }

private:
    struct place
    {
        vector x;
        scalar depth;
    };
    bool usable_ = false;
    List<place> known_;
};

}  // namespace

// Makes sample points that fill the strip: they give the sums of a full strip, wherever the sites lie.  Returns the
// sums over their feet.  Beside the rim of the surface the strip reaches as far as there are sites.
footSums openFace::sampleStrip(const List<vector>& sites, int nDims, const place& allowed)
{
    pointGrid known(dx_);
    for (const vector& x : sites) known.add(x);
    const List<vector> points = samplesAround(sites, dx_, nDims);
    const label perCell = samplesPerCell(nDims);
    const auto parts = parallelParts(label(points.size()) / perCell, [&](label begin, label end) {
        List<sample> kept;
        footSequence near(*surface_);
        for (label cell = begin; cell < end; ++cell)
        {
            knownSides sides(*surface_, near, points[cell * perCell], dx_, nDims);
            for (label k = cell * perCell; k < (cell + 1) * perCell; ++k)
            {
                const vector& x = points[k];
                if (sides.isOutside(x, depth_)) continue;
                const surfaceFoot f = near.find(x);
                sides.add(x, f);
                if (f.found && f.depth > 0 && f.depth <= depth_ && allowed(x, 0) &&
                    (f.aside == 0 || known.nearest(x, 0.7 * dx_) < 0.7 * dx_))
                    kept.push_back({x, f.foot});
            }
        }
        return kept;
    });
    List<vector> feet;
    for (const List<sample>& part : parts)
        for (const sample& s : part) feet.push_back(s.foot), samples_.push_back(s);
    return footSums(feet, region_);
}

void openFace::addSpot(const vector& x, const surfaceFoot& f, std::uint8_t zone)
{
    spots_.push_back({x, f.foot, f.normal, f.depth, 0, 0, zone}), spotGrid_.add(x);
}

void openFace::weighSpots(const footSums& full)
{
    parallelFor(
        label(spots_.size()),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                const auto [near, region] = full.at(spots_[k].foot, {near_, region_});
                spots_[k].fullNear = perSample_ * near, spots_[k].fullRegion = perSample_ * region;
            }
        },
        64);
}

void openFace::setSites(const List<vector>& sites, const particleCloud& cloud, const place& allowed,
                        const place& beside)
{
    List<surfaceFoot> feet;
    List<vector> kept;
    footSequence near(*surface_);
    for (const vector& x : sites)
    {
        const surfaceFoot f = near.find(x);
        if (!f.found || f.depth < 0 || f.depth > depth_) continue;
        feet.push_back(f), kept.push_back(x);
        betweenWalls_ = betweenWalls_ || beside(f.foot - 0.5 * dx_ * f.normal, 0.75 * dx_);
    }
    if (feet.empty() && isCovered(allowed)) throw covered(cloud.nDims);
    if (feet.empty())
        throw fatalError("Open patch " + name_ + " has no site within " + str(depth_ / dx_) +
                             " dx beyond its surface, of " + std::to_string(sites.size()) +
                             " in constant/openSites.hdf. Its normals must point out of the fluid",
                         where_);
    checkRim(kept, cloud);
    const footSums full = sampleStrip(kept, cloud.nDims, allowed);
    layer_ = openLayer(*deep_, kept, cloud, allowed);
    deep_.reset();
    perSample_ = 1.0 / samplesPerCell(cloud.nDims);

    pointGrid fluid(2 * dx_), taken(dx_);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i) fluid.add(cloud.x[i].xyz());
    for (size_t k = 0; k < feet.size(); ++k)
    {
        const label nearest = fluid.nearestIndex(kept[k], 2 * dx_);
        if (nearest < 0)
            throw fatalError("Open patch " + name_ +
                                 ": no fluid particle within 2 dx of the site (" + str(kept[k][0]) +
                                 " " + str(kept[k][1]) + " " + str(kept[k][2]) +
                                 "). The strip beyond the surface must be full at the start",
                             where_);
        const std::uint8_t zone = cloud.zone[cloud.nSolid() + nearest];
        const auto area = areas_.try_emplace(zone, vector::Zero()).first;
        area->second += cloud.volume() / depth_ * feet[k].normal;
        // sites of the outermost layer are replaced by places at the outer end
        if (feet[k].depth < depth_ - 0.75 * dx_) addSpot(kept[k], feet[k], zone);
        addOuterSpots(feet[k], zone, cloud.nDims, {taken, allowed});
    }
    weighSpots(full);
    if (areas_.size() == 1 && !mesh_.empty()) areas_.begin()->second = mesh_.areaVector();
    checkOuterEnd(feet, taken, cloud.nDims);
}

// True if no place at the outer end of the strip is free.  A wall continues past the rim; if an opening lies flush in a
// curved wall, the wall covers the whole outer end, and nothing could enter
bool openFace::isCovered(const place& allowed) const
{
    const triSurface& s = mesh_.surface();
    for (label t = 0; t < s.size(); ++t)
        if (allowed(s.centre(t) + depth_ * s.areaVector(t).normalized(), 0)) return false;
    return !mesh_.empty();
}

fatalError openFace::covered(int nDims) const
{
    return fatalError(
        "Open patch " + name_ + ": its walls, continued past its rim, cover all of the strip " +
            str(depth_ / dx_) + " dx beyond it, so that nothing could enter" + widthInWords(nDims) +
            ". Take half the dx, or prolong the vessel before the opening by " +
            str(depth_ / dx_ + 1) + " dx",
        where_);
}

// fatalError if no particle can be put at the outer end of the strip
void openFace::checkOuterEnd(const List<surfaceFoot>& feet, const pointGrid& places,
                             int nDims) const
{
    if (std::any_of(feet.begin(), feet.end(), [&](const surfaceFoot& f) {
            return places.any(f.foot + depth_ * f.normal, 0.75 * dx_);
        }))
        return;
    throw covered(nDims);
}

// A solid that holds the fluid before the face must also hold the fluid in the strip
void openFace::checkRim(const List<vector>& sites, const particleCloud& cloud) const
{
    const scalar beside = 1.2 * dx_, near = 2 * dx_;  // of the fluid before the face, of the site
    pointGrid solid(near);
    for (label i = 0; i < cloud.nSolid(); ++i) solid.add(cloud.x[i].xyz());
    for (const vector& x : sites)
    {
        const surfaceFoot f = surface_->find(x);
        const label at = solid.nearestIndex(f.foot - 0.5 * dx_ * f.normal, beside);
        if (at < 0 || solid.any(x, near)) continue;
        throw fatalError(
            "A solid ends at the open patch " + name_ + ", beside " + cloud.describe(at) +
                ": nothing holds the fluid beyond. Let its zone, or one of phase clamped, "
                "reach " +
                str(depth_ / dx_ + 1) +
                " dx beyond the face (the entry `beyond` of a zone made with `thickness`)",
            where_);
    }
}

// Places at the outer end of the strip, half a spacing apart
void openFace::addOuterSpots(const surfaceFoot& at, std::uint8_t zone, int nDims,
                             const spotContext& c)
{
    const List<vector> along = tangents(at.normal, nDims);
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < (nDims == 3 ? 2 : 1); ++b)
        {
            vector aim = at.foot + 0.5 * depth_ * at.normal + 0.5 * a * dx_ * along[0];
            if (b) aim += 0.5 * dx_ * along[1];
            surfaceFoot f = surface_->find(aim);
            if (!f.found || f.depth < 0.25 * depth_) continue;
            f.depth = 0.999 * depth_;
            const vector x = f.foot + f.depth * f.normal;
            if (c.taken.nearest(x, 0.3 * dx_) < 0.3 * dx_ || !c.allowed(x, 0.35 * dx_)) continue;
            c.taken.add(x);
            addSpot(x, f, zone);
        }
}

}  // namespace ispf
