// SPDX-License-Identifier: GPL-3.0-or-later
#include "loadedBody.H"

#include "surfaceRefinement.H"

#include <algorithm>
#include <filesystem>

namespace ispf
{

namespace
{

List<char> allFluid(const particleCloud& cloud)
{
    List<char> zones;
    for (const zoneInfo& z : cloud.zones) zones.push_back(z.phase == phaseType::fluid);
    return zones;
}

// Unit vectors of a triangle: along its first edge, across it, and its normal
tensor frameOf(const triSurface& s, label t)
{
    tensor e;
    e.col(0) = (s.corner(t, 1) - s.corner(t, 0)).normalized();
    e.col(2) = s.areaVector(t).normalized();
    e.col(1) = e.col(2).cross(e.col(0));
    return e;
}

label largestOf(const triSurface& s)
{
    label largest = 0;
    for (label t = 1; t < s.size(); ++t)
        if (s.areaVector(t).norm() > s.areaVector(largest).norm()) largest = t;
    return largest;
}

}  // namespace

loadedBody loadedBody::wall(const word& patch, const fsiCase& c, const fileLocation& where)
{
    loadedBody b(patch, c);
    c.walls->surfaceOf(patch, c.cloud, where);  // fatalError if there is no such wall
    b.isWall_ = true;
    b.parts_.push_back({nullptr, allFluid(c.cloud)});
    return b;
}

loadedBody loadedBody::surface(const word& name, const fsiCase& c, const fileLocation& where)
{
    loadedBody b(name, c);
    b.rest_ = readSurface(name, c, where);
    b.parts_.push_back({nullptr, allFluid(c.cloud)});
    return b;
}

loadedBody loadedBody::openFace(const word& face, const fsiCase& c)
{
    loadedBody b(face, c);
    b.rest_ = c.walls->openSurface(face);
    if (!b.rest_.empty()) b.parts_.push_back({nullptr, allFluid(c.cloud)});
    return b;
}

List<loadedBody> loadedBody::chosen(const dictionary& dict, const fsiCase& c)
{
    List<loadedBody> all;
    const List<word> open = c.walls->openFaces(), walls = c.walls->wallNames();
    const auto isIn = [](const List<word>& names, const word& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const word& b : dict.getOrDefault<List<word>>("patches", {}))
        if (isIn(open, b)) all.push_back(openFace(b, c));
        else if (isIn(walls, b)) all.push_back(wall(b, c, dict.where("patches")));
        else
        {
            List<word> valid = walls;
            valid.insert(valid.end(), open.begin(), open.end());
            throw fatalError("There is no wall or open face '" + b + "'." + didYouMean(b, valid) +
                                 "\n" + validWords("patch", valid),
                             dict.where("patches"));
        }
    for (const word& b : dict.getOrDefault<List<word>>("zones", {}))
        all.push_back(solid(b, c, dict.where("zones")));
    for (const word& b : dict.getOrDefault<List<word>>("surfaces", {}))
        all.push_back(surface(b, c, dict.where("surfaces")));
    if (all.empty())
        throw fatalError(
            "This wants patches, walls or open faces, zones, of solids, or surfaces, of "
            "constant/triSurface.",
            dict.where());
    return all;
}

loadedBody loadedBody::solid(const word& zone, const fsiCase& c, const fileLocation& where)
{
    loadedBody b(zone, c);
    if (c.cloud.zones[c.cloud.zoneIndex(zone, where)].phase != phaseType::solid)
        throw fatalError("Zone " + zone + " is not solid: fluid does not press on fluid", where);
    for (size_t z = 0; z < c.cloud.zones.size(); ++z)
    {
        const word surface = zone + "_to_" + c.cloud.zones[z].name;
        if (!std::filesystem::exists(c.time.constantFile("triSurface/" + surface + ".stl")))
            continue;
        List<char> one(c.cloud.zones.size(), 0);
        one[z] = 1;
        b.parts_.push_back({std::make_shared<trackedSurface>(surface, c, where), one});
    }
    if (b.parts_.empty())
        throw fatalError(
            "Zone " + zone + " has no surface constant/triSurface/" + zone +
                "_to_<fluid zone>.stl. generateParticles writes one for each zone of fluid that "
                "the solid touches: does it touch none?",
            where);
    return b;
}

void loadedBody::eachSide(const visitor& visit) const
{
    for (const part& p : parts_)
    {
        triSurface s = rest_;
        if (p.tracked)
        {
            p.tracked->update(case_->cloud.x);
            s = p.tracked->now();
            s.flip();  // the normals of tracked surfaces point into the fluid
        }
        if (isWall_) s = case_->walls->surfaceOf(name_, case_->cloud);
        visit(s, p);
        if (!isWall_ || !case_->walls->isTwoSided(name_)) continue;
        s.flip();
        visit(std::move(s), p);
    }
}

List<loadedBody::side> loadedBody::sides() const
{
    List<side> all;
    eachSide([&](triSurface s, const part& p) {
        known_.resize(std::max(known_.size(), all.size() + 1));
        auto& [nodes, facets] = known_[all.size()];
        if (nodes != s.nodes)
        {
            nodes = s.nodes;
            facets = facetsOf(std::move(s), case_->cloud.dx, case_->cloud.nDims);
        }
        all.push_back(fitted(facets, p));
    });
    return all;
}

List<loadedBody::triangulation> loadedBody::triangulated() const
{
    List<triangulation> all;
    eachSide([&](triSurface s, const part& p) {
        prepare(s, case_->cloud.dx);
        const List<facet> facets = trianglesOf(s, case_->cloud.nDims);
        all.push_back({fitted(facets, p), std::move(s)});
    });
    return all;
}

List<loadedBody::triangulation> loadedBody::lasting() const
{
    List<triangulation> all;
    eachSide([&](triSurface s, const part& p) {
        if (!p.tracked) s = carried(all.size(), s);
        const List<facet> facets = trianglesOf(s, case_->cloud.nDims);
        all.push_back({fitted(facets, p), std::move(s)});
    });
    return all;
}

// The triangles of the first call at the place of the wall `now`
triSurface loadedBody::carried(size_t side, const triSurface& now) const
{
    if (first_.size() <= side)
    {
        triSurface fine = now;
        const scalar dx = case_->cloud.dx;
        fine.weld(1e-4 * dx);
        // walls often measure whole spacings: rounding must not decide whether their edges are cut
        refine(fine, 1.500001 * dx);
        first_.emplace_back(now, std::move(fine));
    }
    const auto& [then, fine] = first_[side];
    if (then.size() != now.size())
        throw fatalError("Time " + case_->time.timeName() + " s: wall " + name_ + " has " +
                         std::to_string(now.size()) + " triangles within the symmetry planes, at " +
                         "the start it had " + std::to_string(then.size()) +
                         ": nothing can be summed on its triangles. Leave out this wall.");
    triSurface s = fine;
    const label t = largestOf(then);
    const tensor R = frameOf(now, t) * frameOf(then, t).transpose();
    for (vector& x : s.nodes) x = now.corner(t, 0) + R * (x - then.corner(t, 0));
    return s;
}

// The fit passes through the velocity of a wall that the fluid sticks to.  That of a solid's surface is known no better than the
// fluid's there
loadedBody::side loadedBody::fitted(const List<facet>& facets, const part& p) const
{
    List<vector> U;
    const List<word> sticky = case_->walls->noSlipWalls();
    if (isWall_ && std::find(sticky.begin(), sticky.end(), name_) != sticky.end())
        for (const facet& f : facets) U.push_back(case_->walls->wallVelocity(name_, f.centre));
    return {facets, surfaceFit(*case_, p.zones, facets).of(facets, U)};
}

tensor viscousStress(const fluidAt& f, const fsiCase& c)
{
    const tensor twiceD = f.gradU + f.gradU.transpose();
    const scalar rate = std::sqrt(0.5) * twiceD.norm();
    return c.mu * (c.viscosity ? c.viscosity->ratio(rate) : 1) * twiceD;
}

}  // namespace ispf
