// SPDX-License-Identifier: GPL-3.0-or-later
#include "loadedBody.H"

#include "surfaceRefinement.H"

#include <filesystem>

namespace ispf
{

namespace
{

constexpr scalar longestEdge = 1.5;  // [dx] the fluid is looked at in the middle of each triangle

List<char> allFluid(const particleCloud& cloud)
{
    List<char> zones;
    for (const zoneInfo& z : cloud.zones) zones.push_back(z.phase == phaseType::fluid);
    return zones;
}

void prepare(triSurface& s, scalar dx)
{
    s.weld(1e-4 * dx);
    refine(s, longestEdge * dx);
}

// In two dimensions the triangles of a slice stand for lengths in the plane z = 0
List<facet> facetsOf(const triSurface& s, int nDims)
{
    const boundBox box = s.bounds();
    List<facet> facets;
    for (label t = 0; t < s.size(); ++t)
    {
        facet f = {s.centre(t), s.areaVector(t)};
        if (nDims == 2) f.centre[2] = f.area[2] = 0, f.area /= box.max[2] - box.min[2];
        facets.push_back(f);
    }
    return facets;
}

}  // namespace

loadedBody loadedBody::wall(const word& patch, const fsiCase& c, const fileLocation& where)
{
    loadedBody b(patch, c);
    c.walls->surfaceOf(patch, c.cloud, where);  // is there such a wall?
    b.isWall_ = true;
    b.parts_.push_back({nullptr, allFluid(c.cloud)});
    return b;
}

loadedBody loadedBody::surface(const word& name, const fsiCase& c, const fileLocation& where)
{
    loadedBody b(name, c);
    b.rest_ = readSurface(name, c, where);
    prepare(b.rest_, c.cloud.dx);
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
        throw fatalError("Zone " + zone + " has no surface constant/triSurface/" + zone +
                             "_to_<fluid zone>.stl; generateParticles writes them",
                         where);
    return b;
}

List<loadedBody::side> loadedBody::sides() const
{
    List<side> all;
    for (const part& p : parts_)
    {
        triSurface s = rest_;
        if (p.tracked)
        {
            p.tracked->update(case_->cloud.x);
            s = p.tracked->now();
            s.flip();  // its normals point into the fluid
        }
        if (isWall_)
        {
            s = case_->walls->surfaceOf(name_, case_->cloud);
            prepare(s, case_->cloud.dx);
        }
        all.push_back(measured(s, p.zones));
        if (!isWall_ || !case_->walls->isTwoSided(name_)) continue;
        s.flip();
        all.push_back(measured(s, p.zones));
    }
    return all;
}

loadedBody::side loadedBody::measured(triSurface s, const List<char>& zones) const
{
    side result;
    result.facets = facetsOf(s, case_->cloud.nDims);
    result.fluid = surfaceFit(*case_, zones).at(result.facets);
    result.surface = std::move(s);
    return result;
}

tensor viscousStress(const fluidAt& f, scalar mu)
{
    return mu * (f.gradU + f.gradU.transpose());
}

}  // namespace ispf
