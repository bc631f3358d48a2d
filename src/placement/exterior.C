// SPDX-License-Identifier: GPL-3.0-or-later
#include "exterior.H"

namespace ispf
{

exterior::exterior(const zoneGeometry& geometry, scalar wallThickness, scalar stripWidth)
    : geometry_(geometry), wallThickness_(wallThickness), stripWidth_(stripWidth)
{
    const scalar reach = 2 * (wallThickness + stripWidth);
    for (size_t p = 0; p < geometry.patches().size(); ++p)
    {
        if (geometry.patches()[p].type == patchInfo::kind::other) search_.emplace_back();
        else
            search_.emplace_back(
                withImages(geometry.patchSurface(label(p)), geometry.symmetryPlanes(), reach));
    }
    search_.emplace_back(withImages(geometry.freeSurface(), geometry.symmetryPlanes(), reach));
}

bool exterior::isWall(label patch) const
{
    return patch == label(geometry_.patches().size()) ||
           geometry_.patches()[patch].type == patchInfo::kind::wall;
}

exteriorPoint exterior::footOn(label patch, const vector& x, scalar radius) const
{
    exteriorPoint foot;
    const surfacePoint q = search_[patch].nearest(x, radius);
    if (!q.found) return foot;
    foot.type = exteriorPoint::kind::rigid;
    foot.patch = patch;
    foot.distance = q.distance;
    foot.depth = q.rim ? (x - q.point).dot(q.normal) : q.signedDistance(x);
    foot.normal = q.normal;
    if (!q.rim && q.distance > 1e-6 * geometry_.dx()) foot.normal = (x - q.point) / foot.depth;
    foot.foot = x - foot.depth * foot.normal;
    foot.triangle = q.triangle;
    return foot;
}

bool exterior::findWall(const vector& x, exteriorPoint& wall) const
{
    const scalar tie = 1e-6 * geometry_.dx();
    for (size_t p = 0; p < search_.size(); ++p)
    {
        if (!isWall(label(p))) continue;
        const bool isFree = p == geometry_.patches().size();
        const bool still = isFree || !geometry_.patches()[p].moving;
        // beside a rim a wall extends under the whole strip
        const exteriorPoint q = footOn(label(p), x, wallThickness_ + 2 * stripWidth_);
        if (q.type == exteriorPoint::kind::nothing || q.depth <= 0 || q.depth > wallThickness_)
            continue;
        // walls get all points within their reach; a free face only gives filler, which is not kept
        const bool better = wall.type == exteriorPoint::kind::nothing ||
                            (!isFree && (q.distance < wall.distance - tie ||
                                         (q.distance < wall.distance + tie && still)));
        if (!better) continue;
        wall = q;
        if (isFree) wall.type = exteriorPoint::kind::filler;
    }
    return wall.type != exteriorPoint::kind::nothing;
}

label exterior::zoneOf(label patch, label triangle) const
{
    const triSurface& s = search_[patch].surface();
    const word& name = s.patchNames[s.patch[triangle]];
    label zone = 0;
    while (geometry_.zones()[zone].name != name) ++zone;
    return zone;
}

label exterior::zoneBefore(label openPatch, const vector& x) const
{
    const exteriorPoint q = footOn(openPatch, x, 2 * (wallThickness_ + stripWidth_));
    if (q.type == exteriorPoint::kind::nothing)
        throw fatalError("No point of patch " + geometry_.patches()[openPatch].name + " is near (" +
                         str(x[0]) + " " + str(x[1]) + " " + str(x[2]) +
                         "), where the packing has put a particle of its strip");
    return zoneOf(openPatch, q.triangle);
}

bool exterior::findOpen(const vector& x, exteriorPoint& open) const
{
    const scalar strip = stripWidth_ * (1 + 1e-6);
    for (size_t p = 0; p < geometry_.patches().size(); ++p)
    {
        if (geometry_.patches()[p].type != patchInfo::kind::open) continue;
        const exteriorPoint q = footOn(label(p), x, strip + wallThickness_);
        const bool found = open.type != exteriorPoint::kind::nothing;
        if (q.type == exteriorPoint::kind::nothing || q.depth <= 0) continue;
        if (q.distance > q.depth * (1 + 1e-4)) continue;  // beside the rim: not beyond the face
        if (found && q.distance >= open.distance) continue;
        open = q;
        open.type = q.depth <= strip ? exteriorPoint::kind::strip : exteriorPoint::kind::filler;
        open.zone = zoneOf(label(p), q.triangle);
    }
    return open.type != exteriorPoint::kind::nothing;
}

exteriorPoint exterior::at(const vector& x) const
{
    exteriorPoint wall, open;
    const bool behindWall = findWall(x, wall);
    if (!findOpen(x, open)) return wall;
    // where wall and open face meet, both are equally far: the wall gets the point.  The free face of a solid leaves
    // it to the strip
    const bool rigid = behindWall && wall.type == exteriorPoint::kind::rigid;
    return rigid && wall.distance <= open.distance * (1 + 1e-6) ? wall : open;
}

boundBox exterior::bounds() const
{
    boundBox box = geometry_.bounds();
    const vector margin = vector::Constant(wallThickness_ + stripWidth_);
    box.min -= margin, box.max += margin;
    if (geometry_.nDims() == 2) box.min[2] = box.max[2] = 0;
    return box;
}

}  // namespace ispf
