// SPDX-License-Identifier: GPL-3.0-or-later
#include "loadedBody.H"

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

void loadedBody::eachSide(const std::function<void(triSurface, const List<char>&)>& visit) const
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
        visit(s, p.zones);
        if (!isWall_ || !case_->walls->isTwoSided(name_)) continue;
        s.flip();
        visit(std::move(s), p.zones);
    }
}

List<loadedBody::side> loadedBody::sides() const
{
    List<side> all;
    eachSide([&](triSurface s, const List<char>& zones) {
        known_.resize(std::max(known_.size(), all.size() + 1));
        auto& [nodes, facets] = known_[all.size()];
        if (nodes != s.nodes)
        {
            nodes = s.nodes;
            facets = facetsOf(std::move(s), case_->cloud.dx, case_->cloud.nDims);
        }
        all.push_back({facets, surfaceFit(*case_, zones, facets).of(facets)});
    });
    return all;
}

List<loadedBody::triangulation> loadedBody::triangulated() const
{
    List<triangulation> all;
    eachSide([&](triSurface s, const List<char>& zones) {
        prepare(s, case_->cloud.dx);
        const List<facet> facets = trianglesOf(s, case_->cloud.nDims);
        all.push_back({{facets, surfaceFit(*case_, zones, facets).of(facets)}, std::move(s)});
    });
    return all;
}

tensor viscousStress(const fluidAt& f, const fsiCase& c)
{
    const tensor twiceD = f.gradU + f.gradU.transpose();
    const scalar rate = std::sqrt(0.5) * twiceD.norm();
    return c.mu * (c.viscosity ? c.viscosity->ratio(rate) : 1) * twiceD;
}

}  // namespace ispf
