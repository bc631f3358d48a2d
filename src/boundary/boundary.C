// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary.H"
#include "fileNames.H"
#include "openFace.H"
#include "siteFile.H"
#include "wallGuard.H"
#include "wallMirror.H"
#include "wallVisibility.H"
#include "wettedArea.H"

#include <algorithm>

namespace ispf
{

struct boundary::content
{
    imageGroup group;
    wallSet walls;
    wallGuard guard;
    wallVisibility visibility;
    wallMirror mirror;
    List<vector> facing;  // per ghost, see wallVisibility
    wettedArea wetted;
    List<openFace> openFaces;
    List<label> openIndex;  // of an open face in the balance
    List<patchBalance> balance;

    void addPatch(const word& name, const dictionary& dict, const word& caseFolder);
    void addOpenFaces(const word& caseFolder, const dictionary& patches,
                      const particleCloud& cloud);
    label putBack(particleCloud& cloud) const;
};

void boundary::content::addPatch(const word& name, const dictionary& dict, const word& caseFolder)
{
    const word type = dict.choose("type", {"wall", "symmetryPlane", "cyclic", "open"});
    const label index = label(balance.size());
    balance.push_back({name});
    for (const word key : {"point", "normal"}) dict.found(key);  // generateParticles asks for them
    if (type == "symmetryPlane")
        group.addSymmetryPlane(name, dict.get<vector>("point", dims::length),
                               nonZero(dict, "normal"));
    else if (type == "cyclic")
        group.addCyclic(name, dict.get<vector>("point", dims::length),
                        nonZero(dict, "separation", dims::length));
    else if (type == "open") openIndex.push_back(index);
    else
    {
        wall w = wall::New(name, dict, caseFolder);
        w.index = index;
        walls.add(std::move(w));
    }
}

void boundary::content::addOpenFaces(const word& caseFolder, const dictionary& patches,
                                     const particleCloud& cloud)
{
    if (openIndex.empty()) return;
    const siteFile sites(caseFolder + "/constant/openSites.hdf");
    for (const label index : openIndex)
    {
        const word& name = balance[index].name;
        openFaces.emplace_back(name, patches.subDict(name), caseFolder, group, cloud.dx,
                               sites.stripLayers());
    }
    const auto allowed = [&](const vector& x, scalar distance) {
        for (const openFace& face : openFaces)
            if (face.beyondStrip(x)) return false;
        return group.beyond(x) <= -distance && walls.clear(x, distance);
    };
    for (openFace& face : openFaces)
    {
        const fileLocation where = patches.subDict(face.name()).where("type");
        face.setSites(sites.positions(face.name(), where), cloud, allowed);
    }
}

boundary::boundary(const word& caseFolder, const dictionary& patches, const particleCloud& cloud,
                   scalar support, scalar t0)
    : content_(std::make_unique<content>())
{
    content& c = *content_;
    for (const word& name : patches.dictKeys()) c.addPatch(name, patches.subDict(name), caseFolder);
    c.group.close(cloud, support);
    c.walls.read(caseFolder, patches, c.group, cloud, support, t0);
    c.walls.setStep(0, 1);
    c.wetted.find(c.walls, c.group, cloud);
    c.visibility.find(c.walls, support);
    c.mirror.find(c.walls, support);
    c.addOpenFaces(caseFolder, patches, cloud);
    for (const char* file : {"/constant/wallParticles.hdf", "/constant/openSites.hdf"})
        if (isFile(caseFolder + file)) siteFile(caseFolder + file).checkPatches(patches);
    patches.checkAllRead();
}

boundary::~boundary() = default;

void boundary::setStep(scalar t0, scalar t1)
{
    content_->walls.setStep(t0, t1);
    for (openFace& face : content_->openFaces) face.setTime(t1);
}

void boundary::setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce) const
{
    std::fill(cloud.pFixed.begin(), cloud.pFixed.end(), 0);
    for (const openFace& face : content_->openFaces) face.setFlags(cloud, rho, bodyForce);
}

bool boundary::hasOpen() const
{
    return !content_->openFaces.empty();
}

void boundary::setOpenVelocity(particleCloud& cloud, const List<vec4>& friction, scalar rho,
                               scalar dt) const
{
    for (const openFace& face : content_->openFaces) face.followInside(cloud, friction, rho, dt);
}

void boundary::updateGhosts(particleCloud& cloud) const
{
    cloud.clearGhosts();
    content_->walls.addRigid(cloud);
    content_->facing.assign(cloud.nGhosts(), vector::Zero());
    content_->mirror.addImages(cloud, content_->walls, content_->facing);
    content_->group.addImages(cloud, content_->facing);
}

neighbourList::visibility boundary::visible(const particleCloud& cloud) const
{
    return content_->visibility.test(cloud, content_->walls, content_->facing);
}

// Fluid that stepped over a symmetry plane is reflected, over a cyclic side carried to the other
label boundary::content::putBack(particleCloud& cloud) const
{
    label n = 0;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        vector x = cloud.x[i].xyz(), u = cloud.Up[i].xyz();
        const structureImage* back = group.wayBack(x);
        if (!back) continue;
        for (int k = 0; back && k < 8; ++k)
            x = (*back)(x), u = back->R * u, back = group.wayBack(x);
        cloud.x[i].setXyz(x), cloud.Up[i].setXyz(u), ++n;
    }
    return n;
}

label boundary::exchange(particleCloud& cloud, scalar t1)
{
    content& c = *content_;
    cloud.clearGhosts();
    c.guard.rememberWalls(c.walls);
    const List<scalar> swept = c.walls.moveTo(t1);
    label pushed = 0;
    if (!c.walls.empty())
    {
        const List<label> perWall = c.guard.apply(cloud, c.walls);
        for (const wall& w : c.walls.walls())
        {
            const size_t k = size_t(&w - c.walls.walls().data());
            c.balance[w.index].swept += swept[k], c.balance[w.index].pushed += perWall[k];
            pushed += perWall[k];
        }
    }
    c.putBack(cloud);
    const auto movingWall = [&](const vector& x, scalar distance) {
        return c.walls.movingWithin(x, distance);
    };
    for (size_t k = 0; k < c.openFaces.size(); ++k)
    {
        patchBalance& b = c.balance[c.openIndex[k]];
        const openFace::change change = c.openFaces[k].exchange(cloud, movingWall);
        b.created += change.created, b.deleted += change.deleted;
    }
    // rounding errors of surfaces would grow: nothing else keeps a flat case flat
    for (label i = cloud.nSolid(); cloud.nDims == 2 && i < cloud.n(); ++i)
        cloud.x[i][2] = cloud.Up[i][2] = 0;
    if (!c.walls.empty()) c.guard.remember(cloud);
    c.walls.cover(cloud);
    return pushed;
}

List<structureImage> boundary::images() const
{
    return content_->group.maps();
}

List<std::pair<vector, vector>> boundary::symmetryPlanes() const
{
    return content_->group.symmetryPlanes();
}

scalar boundary::symmetryFactor() const
{
    return content_->group.symmetryFactor();
}

triSurface boundary::surfaceOf(const word& name, const particleCloud& cloud,
                               const fileLocation& where) const
{
    boundBox region;
    for (label i = 0; i < cloud.n(); ++i) region.add(cloud.x[i].xyz());
    region.min.array() -= 0.5 * cloud.dx, region.max.array() += 0.5 * cloud.dx;
    const wall& w = content_->walls.named(name, where);
    const triSurface s =
        content_->walls.surfaceOf(label(&w - content_->walls.walls().data()), region);
    return s.subset([&](label t) { return content_->group.beyond(s.centre(t)) < 1e-6 * cloud.dx; });
}

bool boundary::isTwoSided(const word& name) const
{
    return content_->walls.named(name).twoSided;
}

List<word> boundary::movingWalls() const
{
    List<word> names;
    for (const wall& w : content_->walls.walls())
        if (w.motion.moves() || !w.motion.slide().isZero(0)) names.push_back(w.name);
    return names;
}

vector boundary::wallVelocity(const word& name, const vector&) const
{
    return content_->walls.named(name).velocity;
}

scalar boundary::maxWallSpeed() const
{
    return content_->walls.maxSpeed();
}

sweptRates boundary::swept(const particleCloud& cloud) const
{
    return content_->wetted.rates(content_->walls, cloud);
}

bool boundary::inside(const vector& x) const
{
    return content_->group.beyond(x) <= 0 && content_->walls.inside(x);
}

bool boundary::nearOpen(label i) const
{
    for (const openFace& face : content_->openFaces)
        if (face.near(i)) return true;
    return false;
}

bool boundary::reachesBeyondOpen(label i, scalar reach) const
{
    for (const openFace& face : content_->openFaces)
        if (face.reachesBeyond(i, reach)) return true;
    return false;
}

const List<patchBalance>& boundary::balance() const
{
    return content_->balance;
}

void boundary::restoreBalance(const List<patchBalance>& balance)
{
    content_->balance = balance;
}

}  // namespace ispf
