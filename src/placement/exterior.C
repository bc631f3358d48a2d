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
}

bool exterior::findWall(const vector& x, exteriorPoint& wall) const
{
    const scalar tie = 1e-6 * geometry_.dx();
    bool found = false;
    for (size_t p = 0; p < search_.size(); ++p)
    {
        const patchInfo& patch = geometry_.patches()[p];
        if (patch.type != patchInfo::kind::wall) continue;
        const surfacePoint q = search_[p].nearest(x, wallThickness_);
        if (!q.found || q.signedDistance(x) <= 0) continue;
        const bool better = !found || q.distance < wall.depth - tie ||
                            (q.distance < wall.depth + tie && !patch.moving);
        if (!better) continue;
        found = true;
        wall = {exteriorPoint::kind::rigid, label(p), -1, q.distance, q.point, q.normal};
    }
    return found;
}

bool exterior::findOpen(const vector& x, exteriorPoint& open) const
{
    bool found = false;
    for (size_t p = 0; p < search_.size(); ++p)
    {
        if (geometry_.patches()[p].type != patchInfo::kind::open) continue;
        const surfacePoint q = search_[p].nearest(x, stripWidth_ * (1 + 1e-6));
        if (!q.found || q.signedDistance(x) <= 0 || (found && q.distance >= open.depth)) continue;
        found = true;
        const word& zone = search_[p].surface().patchNames[search_[p].patch(q)];
        label z = 0;
        while (geometry_.zones()[z].name != zone) ++z;
        open = {exteriorPoint::kind::strip, label(p), z, q.distance, q.point, q.normal};
    }
    return found;
}

exteriorPoint exterior::at(const vector& x) const
{
    exteriorPoint wall, open;
    const bool behindWall = findWall(x, wall);
    if (!findOpen(x, open)) return wall;
    // Where wall and open face meet, both are equally far: the wall's plane decides
    return behindWall && wall.depth <= open.depth * (1 + 1e-6) ? wall : open;
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
