// SPDX-License-Identifier: GPL-3.0-or-later
#include "packing.H"

#include <cmath>
#include <map>

namespace ispf
{

namespace
{

constexpr scalar longestMove = 0.15;  // in dx, per move
constexpr scalar longestDrift = 0.5;  // in dx, of particles outside the zones, whose edges are free
// Mean cosine between the normals of an open face and of the walls at its rim
constexpr scalar flush = 0.2;

}  // namespace

packingGuides::packingGuides(const zoneGeometry& geometry, const exterior& outside)
    : geometry_(geometry), outside_(outside)
{
    const scalar reach = 8 * geometry.dx();
    for (size_t z = 0; z < geometry.zones().size(); ++z)
        zoneSurface_.emplace_back(
            withImages(geometry.boundary(label(z)), geometry.symmetryPlanes(), reach));
    for (size_t p = 0; p < geometry.patches().size(); ++p)
        flush_.push_back(geometry.patches()[p].type == patchInfo::kind::open &&
                         leanOf(label(p)) > flush);
}

// Mean over the rim of the cosine between the normals of the face and of the wall there.  It is 0 at the end of a pipe, also
// of one that is cut obliquely
scalar packingGuides::leanOf(label openPatch) const
{
    const scalar near = zoneGeometry::probe * geometry_.dx();
    triSurface face = geometry_.patchSurface(openPatch);
    face.weld(1e-3 * near);
    std::map<std::pair<label, label>, int> edges;  // number of triangles of each
    for (const triSurface::triangle& t : face.triangles)
        for (int k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    scalar sum = 0, length = 0;
    for (const auto& [edge, n] : edges)
    {
        if (n > 1) continue;
        const vector &a = face.nodes[edge.first], &b = face.nodes[edge.second];
        const vector x = 0.5 * (a + b);
        for (size_t w = 0; w < geometry_.patches().size(); ++w)
        {
            if (geometry_.patches()[w].type != patchInfo::kind::wall) continue;
            const exteriorPoint q = outside_.footOn(label(w), x, near);
            if (q.type == exteriorPoint::kind::nothing) continue;
            const scalar side = (b - a).norm();
            sum += side * q.normal.dot(outside_.footOn(openPatch, x, near).normal), length += side;
            break;
        }
    }
    return length > 0 ? sum / length : 0;
}

void packingGuides::move(packedParticle& p, vector by, bool exactly) const
{
    if (p.fixed) return;
    const scalar length = by.norm(), most = longestMove * geometry_.dx();
    if (length > most) by *= most / length;
    if (geometry_.nDims() == 2) by[2] = 0;
    if (p.where != packedParticle::place::zone)
    {
        const vector drift = p.x + by - p.seed;
        const scalar far = longestDrift * geometry_.dx();
        if (drift.norm() > far) by = p.seed + far / drift.norm() * drift - p.x;
    }
    hold(p, by, exactly);
}

void packingGuides::hold(packedParticle& p, const vector& by, bool exactly) const
{
    const scalar dx = geometry_.dx();
    p.x += by;
    if (!p.bound()) p.clearance -= by.norm(), holdFree(p);
    else
    {
        // the tangent plane is good enough for a tenth of a spacing
        const bool known = p.normal.squaredNorm() > 0.5;
        const vector off = p.x - p.foot;
        if (exactly || !known || (off - off.dot(p.normal) * p.normal).norm() > 0.1 * dx)
            p.where == packedParticle::place::zone ? searchZone(p) : searchPatch(p);
        else p.x += (p.depth - off.dot(p.normal)) * p.normal;
    }
    if (p.guard >= 0) keepOffWall(p);
    // an own image nearer than 0.8 dx would be as bad as a neighbour
    const scalar clear = 0.4 * dx;
    for (const halfSpace& plane : geometry_.symmetryPlanes())
    {
        const scalar d = plane.distance(p.x);
        if (d > -clear) p.x -= (d + clear) * plane.normal, p.clearance -= d + clear;
    }
    if (geometry_.nDims() == 2) p.x[2] = 0;  // normals of slices are exact to rounding errors only
}

void packingGuides::keepOffWall(packedParticle& p) const
{
    const scalar dx = geometry_.dx();
    const exteriorPoint q = outside_.footOn(p.guard, p.x, 6 * dx);
    if (q.type != exteriorPoint::kind::nothing && q.depth > -0.45 * dx)
        p.x -= (q.depth + 0.45 * dx) * q.normal;
}

// A wall in which the face lies flush does not lead on beside the strip: its plane would cover the face
label packingGuides::wallBeside(const vector& x, label openPatch) const
{
    if (flush_[openPatch]) return -1;
    for (size_t w = 0; w < geometry_.patches().size(); ++w)
    {
        if (geometry_.patches()[w].type != patchInfo::kind::wall) continue;
        const exteriorPoint q = outside_.footOn(label(w), x, 5 * geometry_.dx());
        if (q.type == exteriorPoint::kind::nothing || q.depth < -1.5 * geometry_.dx()) continue;
        // an oblique face extends no farther than this behind the end of the wall
        if (q.depth > outside_.stripWidth() + 0.5 * geometry_.dx())
            throw fatalError(
                "Open patch " + geometry_.patches()[openPatch].name + " meets the back of wall " +
                geometry_.patches()[w].name + " near (" + str(q.foot[0]) + " " + str(q.foot[1]) +
                " " + str(q.foot[2]) +
                "): the strip of fluid beyond it would lie behind that wall. Let the "
                "open faces end where the wall does, or make the face at that edge a wall");
        return label(w);
    }
    return -1;
}

void packingGuides::holdFree(packedParticle& p) const
{
    const scalar dx = geometry_.dx(), want = 0.5 * dx, look = 2 * dx;
    if (p.clearance >= want) return;
    for (int pass = 0; pass < 2; ++pass)  // twice: in a corner two faces push
    {
        const surfacePoint q = zoneSurface_[p.owner].nearest(p.x, look);
        p.clearance = q.found ? q.distance : look;
        const bool inside = !q.found || (p.x - q.point).dot(q.normal) < 0;
        if (inside && p.clearance >= want) return;
        const vector inward =
            inside && q.distance > 1e-3 * dx ? vector((p.x - q.point) / q.distance) : -q.normal;
        p.x = q.point + want * inward;
        p.clearance = want;
    }
}

void packingGuides::searchZone(packedParticle& p) const
{
    const scalar dx = geometry_.dx();
    for (int pass = 0; pass < 2; ++pass)
    {
        const surfacePoint q = zoneSurface_[p.owner].nearest(p.x, 3 * dx);
        if (!q.found) return;
        const bool inside = (p.x - q.point).dot(q.normal) < 0;
        p.normal =
            inside && q.distance > 1e-3 * dx ? vector((p.x - q.point) / q.distance) : -q.normal;
        p.foot = q.point;
        p.x = q.point + p.depth * p.normal;
    }
}

void packingGuides::searchPatch(packedParticle& p) const
{
    const exteriorPoint q =
        outside_.footOn(p.owner, p.x, 2 * (outside_.wallThickness() + outside_.stripWidth()));
    if (q.type == exteriorPoint::kind::nothing) return;
    p.foot = q.foot, p.normal = q.normal;
    p.x = q.foot + p.depth * q.normal;
}

scalar packingGuides::zoneThickness(label zone, const vector& foot, const vector& inward,
                                    scalar reach) const
{
    const vector from = foot + 1e-3 * geometry_.dx() * inward;
    const surfaceHit hit = zoneSurface_[zone].firstHit(from, foot + reach * inward);
    return hit.found ? (hit.point - foot).norm() : std::numeric_limits<scalar>::infinity();
}

scalar packingGuides::rigidThickness(const vector& foot, const vector& outward, scalar reach) const
{
    const vector from = foot + 1e-3 * geometry_.dx() * outward;
    scalar least = std::numeric_limits<scalar>::infinity();
    for (size_t p = 0; p < geometry_.patches().size(); ++p)
    {
        if (geometry_.patches()[p].type != patchInfo::kind::wall) continue;
        const surfaceHit hit = outside_.search(label(p)).firstHit(from, foot + reach * outward);
        if (hit.found) least = std::min(least, (hit.point - foot).norm());
    }
    return least;
}

}  // namespace ispf
