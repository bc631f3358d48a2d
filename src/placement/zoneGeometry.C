// SPDX-License-Identifier: GPL-3.0-or-later
#include "zoneGeometry.H"

#include "cutFacets.H"
#include "openVolume.H"
#include "surfaceTopology.H"
#include "execution.H"
#include <algorithm>
#include <cmath>
#include <set>

namespace ispf
{

namespace
{

constexpr label few = 20000, many = 300000;  // points of sampled(): to check, to measure
constexpr scalar mostDifference = 0.01;      // of the two ways to a volume, doc/constants.md
constexpr scalar mostParticles = 5e8;        // labels, those of images included, can number so many

}  // namespace

// The part of a box that planes along the axes leave
static boundBox withinPlanes(boundBox box, const List<halfSpace>& planes)
{
    for (const halfSpace& plane : planes)
        for (int a = 0; a < 3; ++a)
        {
            if (plane.normal[a] == 1) box.max[a] = std::min(box.max[a], plane.point[a]);
            if (plane.normal[a] == -1) box.min[a] = std::max(box.min[a], plane.point[a]);
        }
    return box;
}

zoneGeometry::zoneGeometry(List<zoneInfo> zones, List<patchInfo> patches, List<body> bodies,
                           List<halfSpace> symmetryPlanes, const word& defaultPatch, scalar dx,
                           int nDims)
    : zones_(std::move(zones)),
      patches_(std::move(patches)),
      bodies_(std::move(bodies)),
      planes_(std::move(symmetryPlanes)),
      defaultPatch_(defaultPatch),
      dx_(dx),
      nDims_(nDims)
{
    checkPlanes();
    for (body& b : bodies_)
    {
        checkClosed(b);
        winding_.emplace_back(b.surface);
        bodyBounds_.push_back(b.surface.bounds());
    }
    classify();
    for (size_t z = 0; z < zones_.size(); ++z)
    {
        // a zone with planes on all sides has no face
        if (boundary_[z].empty() && !withinPlanesAlone(label(z)))
            throw fatalError("Zone " + zones_[z].name +
                             " is empty: no body belongs to it, or later bodies cover it, or the "
                             "symmetry planes cut it away");
        bounds_.add(boundary_[z].bounds());
    }
    // zones that planes on three sides bound have hardly a face
    for (const boundBox& body : bodyBounds_)
        if (const boundBox box = withinPlanes(body, planes_);
            (box.min.array() <= box.max.array()).all())
            bounds_.add(box);
    if (nDims_ == 2) bounds_.min[2] = bounds_.max[2] = 0;
    checkContacts();
    checkPatchNames();
    gatherPatches();
    setVolumes();
    checkCount();
}

bool zoneGeometry::isPrismEnd(const triSurface& s, label t)
{
    return std::abs(s.normal(t)[2]) > 0.9;
}

word zoneGeometry::nameOf(const body& b) const
{
    return b.zone >= 0 ? zones_[b.zone].name : join(b.surface.patchNames) + " (rigid)";
}

void zoneGeometry::checkClosed(const body& b) const
{
    const word name = nameOf(b);
    if (b.surface.empty()) throw fatalError("A body of zone " + name + " has no triangles");
    const closednessReport report = ispf::checkClosed(b.surface);
    if (!report.closed())
        throw fatalError("The surface of zone " + name + " is not closed: " + report.describe() +
                         ". Close the gap in the CAD program, or raise weldTolerance if the "
                         "faces only fail to meet exactly");
    // of a plate with the same volume and surface; the ends of a prism are none of it
    scalar area = 0;
    for (label t = 0; t < b.surface.size(); ++t)
        if (nDims_ == 3 || !isPrismEnd(b.surface, t)) area += b.surface.areaVector(t).norm();
    const scalar thickness = 2 * b.surface.volume() / area;
    if (thickness < dx_ / 3)
        throw fatalError("Zone " + name + " is about " + str(thickness) +
                         " m thick and the particle spacing dx is " + str(dx_) +
                         " m: it could not hold a particle. Is the unit of its file right?");
}

List<label> zoneGeometry::claims(const vector& x) const
{
    List<label> zones;
    for (size_t b = 0; b < bodies_.size(); ++b)
        if (bodyBounds_[b].distSqr(x) == 0 && winding_[b].inside(x))
            zones.push_back(bodies_[b].zone);
    return zones;
}

bool zoneGeometry::inBodies(const vector& x, label& zone) const
{
    for (size_t b = bodies_.size(); b-- > 0;)
        if (bodyBounds_[b].distSqr(x) == 0 && winding_[b].inside(x))
        {
            zone = bodies_[b].zone;
            return true;
        }
    return false;
}

scalar zoneGeometry::beyondSymmetry(const vector& x) const
{
    scalar most = -std::numeric_limits<scalar>::max();
    for (const halfSpace& plane : planes_) most = std::max(most, plane.distance(x));
    return most;
}

label zoneGeometry::zoneAt(const vector& x) const
{
    label zone = -1;
    if (beyondSymmetry(x) >= 0 || inBodies(x, zone)) return zone;
    // touching faces are meshed differently: x may lie in the sliver between them
    scalar least = probe * dx_;
    for (size_t z = 0; z < contact_.size(); ++z)
        if (const surfacePoint q = contact_[z].nearest(x, least); q.found && q.distance < least)
            zone = label(z), least = q.distance;
    return zone;
}

word zoneGeometry::patchOf(label zone, const word& asked, label other) const
{
    if (other >= 0) return towards(zones_[other].name);
    if (asked.empty() && zones_[zone].phase == phaseType::fluid) return defaultPatch_;
    return asked;
}

void zoneGeometry::addBoundary(label zone, const triSurface& from, label t, label other,
                               bool turned)
{
    triSurface& to = boundary_[zone];
    const label p = to.addPatch(patchOf(zone, from.patchNames[from.patch[t]], other));
    to.add(from.corner(t, 0), from.corner(t, turned ? 2 : 1), from.corner(t, turned ? 1 : 2), p);
}

void zoneGeometry::classify()
{
    const scalar tiny = 1e-6 * dx_;
    List<triSurface> skin;  // of each body: inside the symmetry planes, without prism ends
    List<surfaceSearch> own(zones_.size()), whole;
    for (const body& b : bodies_) whole.emplace_back(b.surface);
    List<triSurface> zoneSkin(zones_.size());
    for (const body& b : bodies_)
    {
        triSurface s = b.surface;
        if (nDims_ == 2) s = s.subset([&](label t) { return !isPrismEnd(s, t); });
        for (const halfSpace& plane : planes_) s = clipped(s, plane, tiny);
        if (b.zone >= 0) zoneSkin[b.zone].append(s);
        skin.push_back(std::move(s));
    }
    for (size_t z = 0; z < zones_.size(); ++z) own[z] = surfaceSearch(zoneSkin[z]);
    boundary_.resize(zones_.size());
    for (size_t k = 0; k < bodies_.size(); ++k)
    {
        List<const surfaceSearch*> others;
        for (size_t b = 0; b < bodies_.size(); ++b)
            if (b != k) others.push_back(&whole[b]);
        const triSurface s = cutFacets(skin[k], others, 0.3 * dx_, probe * dx_);
        for (label t = 0; t < s.size(); ++t)
        {
            vector c = s.centre(t);
            if (nDims_ == 2) c[2] = 0;
            const vector step = probe * dx_ * s.normal(t);
            label inner = -1, outer = -1;
            inBodies(c - step, inner), inBodies(c + step, outer);
            if (inner == outer || inner != bodies_[k].zone) continue;
            if (inner >= 0) addBoundary(inner, s, t, outer, false);
            // a shape inside another bounds it too, unless the other has its own face there
            if (outer >= 0 && !own[outer].within(c, 2 * probe * dx_))
                addBoundary(outer, s, t, inner, true);
        }
    }
    for (triSurface& s : boundary_) s.weld(tiny);
    for (const triSurface& s : boundary_)
        contact_.emplace_back(s.subset([&](label t) {
            for (const zoneInfo& z : zones_)
                if (s.patchNames[s.patch[t]] == towards(z.name)) return true;
            return false;
        }));
}

// fatalError for a face whose patch does not exist: it would be a hole
void zoneGeometry::checkPatchNames() const
{
    List<word> valid;
    for (const patchInfo& p : patches_) valid.push_back(p.name);
    for (size_t z = 0; z < zones_.size(); ++z)
        for (label t = 0; t < boundary_[z].size(); ++t)
        {
            const triSurface& s = boundary_[z];
            const word& name = s.patchNames[s.patch[t]];
            const bool known = std::find(valid.begin(), valid.end(), name) != valid.end();
            if (known || name.empty() || name.rfind("to:", 0) == 0) continue;
            const vector c = s.centre(t);
            throw fatalError("A face of zone " + zones_[z].name + " at (" + str(c[0]) + " " +
                             str(c[1]) + " " + str(c[2]) + ") belongs to patch " + name +
                             ", which constant/boundary lacks." + didYouMean(name, valid) + "\n" +
                             validWords("patch", valid) +
                             "\nGive it an entry (a rigid zone's patch has its name), or name the "
                             "face in 'patches' or by 'defaultPatch' "
                             "of system/particleDict");
        }
}

// Names of the patches that outer faces of fluid zones have
word zoneGeometry::patchesWithFaces() const
{
    std::set<word> names;
    for (size_t z = 0; z < zones_.size(); ++z)
        for (label t = 0; t < boundary_[z].size(); ++t)
            if (const word& name = boundary_[z].patchNames[boundary_[z].patch[t]];
                zones_[z].phase == phaseType::fluid && !name.empty() && name.rfind("to:", 0) != 0)
                names.insert(name);
    return names.empty() ? "none" : join(List<word>(names.begin(), names.end()));
}

void zoneGeometry::gatherPatches()
{
    for (const patchInfo& patch : patches_)
    {
        triSurface all;
        for (size_t z = 0; z < zones_.size(); ++z)
        {
            const triSurface& s = boundary_[z];
            const auto at = std::find(s.patchNames.begin(), s.patchNames.end(), patch.name);
            if (at == s.patchNames.end() || zones_[z].phase != phaseType::fluid) continue;
            triSurface part = s.patchSurface(patch.name);
            part.patchNames = {zones_[z].name};
            all.append(part);
        }
        all.weld(1e-6 * dx_);
        if (all.empty() && patch.type != patchInfo::kind::other)
            throw fatalError(
                "Patch " + patch.name +
                " has no face: no outer face of a fluid zone was given that name. Patches with "
                "faces: " +
                patchesWithFaces() +
                ". Choose faces for it in 'patches' of system/particleDict, or "
                "remove it from constant/boundary");
        if (all.empty())
            warning("Patch " + patch.name + ": no face of a fluid zone lies in its planes");
        patchSurface_.push_back(std::move(all));
    }
    for (const triSurface& s : boundary_)
        freeSurface_.append(s.subset([&](label t) { return s.patchNames[s.patch[t]].empty(); }));
    freeSurface_.weld(1e-6 * dx_);
}

// True if symmetry planes alone bound the zone within one of its bodies
bool zoneGeometry::withinPlanesAlone(label zone) const
{
    for (size_t k = 0; k < bodies_.size(); ++k)
        if (bodies_[k].zone == zone &&
            zoneAt(withinPlanes(bodyBounds_[k], planes_).centre()) == zone)
            return true;
    return false;
}

void zoneGeometry::checkPlanes() const
{
    for (size_t k = 0; k < planes_.size(); ++k)
        for (size_t m = 0; m < k; ++m)
            if ((planes_[k].normal - planes_[m].normal).norm() < 1e-9 &&
                std::abs(planes_[k].distance(planes_[m].point)) < 1e-6 * dx_)
                throw fatalError("Two symmetry planes are the same, with the normal (" +
                                 str(planes_[k].normal[0]) + " " + str(planes_[k].normal[1]) + " " +
                                 str(planes_[k].normal[2]) +
                                 "): leave one away, it holds for all faces in it");
}

// Volume of what bounds a zone together with the planes.  In two dimensions per height: a prism without ends
scalar zoneGeometry::boundedVolume(label zone) const
{
    const triSurface& s = boundary_[zone];
    List<halfSpace> planes = planes_;
    scalar height = 1;
    if (nDims_ == 2)
    {
        const vector top = s.empty() ? vector(0, 0, dx_) : s.bounds().max;
        planes.push_back({top, vector::UnitZ()}), planes.push_back({-top, -vector::UnitZ()});
        height = 2 * top[2];
    }
    return openVolume(s, planes, 1e-5 * dx_, [&](const vector& x) { return zoneAt(x) == zone; }) /
           height;
}

void zoneGeometry::setVolumes()
{
    for (size_t z = 0; z < zones_.size(); ++z)
    {
        const scalar bounded = boundedVolume(label(z));
        if (nDims_ == 2)
        {
            volume_.push_back(sameAsSampled(label(z), bounded));
            continue;
        }
        scalar true_ = 0, meshed = 0, cut = 0;
        for (const body& b : bodies_)
            if (b.zone == label(z))
            {
                const scalar v = b.surface.volume();
                true_ += b.volume > 0 ? b.volume : v, meshed += v;
                cut += clippedVolume(b.surface, planes_);
            }
        // facets lie inside a convex surface: scaled to the volume known from CAD
        const bool whole = boundary_[z].empty() || std::abs(bounded - cut) < 1e-3 * cut;
        volume_.push_back(sameAsSampled(label(z), whole ? cut * true_ / meshed : bounded));
    }
}

// Counts points that fill the box around the zone evenly
zoneGeometry::sampledSize zoneGeometry::sampled(label zone, label samples) const
{
    boundBox box = boundary_[zone].bounds();
    for (size_t k = 0; k < bodies_.size(); ++k)
        if (bodies_[k].zone == zone) box.add(withinPlanes(bodyBounds_[k], planes_));
    const vector size = box.max - box.min;
    const scalar all = size.head(nDims_).prod();
    // fractions of multiples of the roots: a sequence that fills a box evenly in every direction (Roberts 2018)
    const vector step = nDims_ == 3 ? vector(0.8191725134, 0.6710436067, 0.5497004779)
                                    : vector(0.7548776662, 0.5698402910, 0);
    const scalar inside = sumOf(0, samples, [&](label i) -> scalar {
        vector x = vector::Zero();
        for (int a = 0; a < nDims_; ++a)
            x[a] = box.min[a] + std::fmod((i + 0.5) * step[a], 1) * size[a];
        label found = -1;
        return beyondSymmetry(x) < 0 && inBodies(x, found) && found == zone;
    });
    return {inside / samples * all, inside};
}

// The volume that the faces give, or that of the samples with a warning: faces that touch without meeting, as a ball does a
// wall, leave a gap in what bounds the zone
scalar zoneGeometry::sameAsSampled(label zone, scalar volume) const
{
    // the error of a count is at most that of points at random
    const auto fits = [&](const sampledSize& s) {
        const scalar uncertain = mostDifference + 1 / std::sqrt(std::max(s.points, scalar(1)));
        return std::abs(volume - s.volume) < uncertain * s.volume || s.points < 100;
    };
    if (fits(sampled(zone, few))) return volume;
    const sampledSize measured = sampled(zone, many);
    if (fits(measured)) return volume;
    const scalar found = measured.volume;
    warning(
        "Zone " + zones_[zone].name + ": its faces enclose " + str(volume, 4) + " m" +
        std::to_string(nDims_) + ", but " + str(found, 4) + " m" + std::to_string(nDims_) +
        " lie in it, counted with points, and that is what it gets. Do faces "
        "touch there without meeting, as a ball does a wall? Let them overlap, or keep them apart");
    return found;
}

void zoneGeometry::checkCount() const
{
    scalar n = 0;
    for (const scalar v : volume_) n += v / std::pow(dx_, nDims_);
    if (n > mostParticles)
        throw fatalError("The zones have room for " + str(n, 3) +
                         " particles of spacing dx = " + str(dx_) + " m, but a case can hold " +
                         str(mostParticles) + ". Are dx and the units of the geometry right?");
}

}  // namespace ispf
