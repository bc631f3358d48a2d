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

List<scalar> patchBalance::state() const
{
    return {swept, scalar(created), scalar(deleted), scalar(pushed), volume, flux};
}

void patchBalance::restore(const List<scalar>& s)
{
    if (s.size() < 4) return;
    swept = s[0], created = label(s[1]), deleted = label(s[2]), pushed = label(s[3]);
    if (s.size() == 6) volume = s[4], flux = s[5];
}

struct boundary::content
{
    scalar t0 = 0;  // start of the step
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
    List<std::pair<label, label>> clamped;  // solid particle, wall

    void addPatch(const word& name, const dictionary& dict, const word& caseFolder);
    faceMesh meshOf(const word& name, const dictionary& dict, const word& caseFolder,
                    const particleCloud& cloud) const;
    void addOpenFaces(const word& caseFolder, const dictionary& patches,
                      const particleCloud& cloud);
    void checkDrops(const dictionary& patches, const particleCloud& cloud, scalar support) const;
    void putBack(particleCloud& cloud);
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
                        nonZero(dict, "separation", dims::length),
                        dict.found("pressureDrop")
                            ? Function1::New("pressureDrop", dict, caseFolder, dims::pressure)
                            : nullptr);
    else if (type == "open") openIndex.push_back(index);
    else
    {
        wall w = wall::New(name, dict, caseFolder);
        w.index = index;
        walls.add(std::move(w));
    }
}

// The rows of the solid know nothing of a pressure that differs between a pair's sides
void boundary::content::checkDrops(const dictionary& patches, const particleCloud& cloud,
                                   scalar support) const
{
    for (const word& name : patches.dictKeys())
    {
        const dictionary& dict = patches.subDict(name);
        if (!dict.found("pressureDrop")) continue;
        const vector low = dict.get<vector>("point", dims::length),
                     separation = dict.get<vector>("separation", dims::length);
        for (label i = 0; i < cloud.nSolid(); ++i)
        {
            const scalar along = (cloud.x[i].xyz() - low).dot(separation.normalized());
            if (along > support && along < separation.norm() - support) continue;
            dict.fail(
                "pressureDrop",
                "A solid reaches over the cyclic patch " + name + " (" + cloud.describe(i) +
                    "): its load would not know of the pressure drop. Drive the fluid's zone "
                    "with bodyForce in constant/physicalProperties instead: pressureDrop over "
                    "rho times the length");
        }
    }
}

faceMesh boundary::content::meshOf(const word& name, const dictionary& dict, const word& caseFolder,
                                   const particleCloud& cloud) const
{
    const bool plane = dict.found("surface") && dict.get<word>("surface") == "plane";
    triSurface s = plane ? walls.rectangle(dict.get<vector>("point", dims::length),
                                           nonZero(dict, "normal").normalized())
                         : readPatch(caseFolder, name, dict);
    return s.empty() ? faceMesh() : faceMesh(std::move(s), group, cloud);
}

void boundary::content::addOpenFaces(const word& caseFolder, const dictionary& patches,
                                     const particleCloud& cloud)
{
    if (openIndex.empty()) return;
    const siteFile sites(caseFolder + "/constant/openSites.hdf");
    for (const label index : openIndex)
    {
        const word& name = balance[index].name;
        const dictionary& dict = patches.subDict(name);
        openFaces.emplace_back(name, dict, caseFolder,
                               openFace::setting{group, cloud, sites.stripLayers(),
                                                 meshOf(name, dict, caseFolder, cloud),
                                                 [&](const vector& x) { return walls.holds(x); }});
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
    c.checkDrops(patches, cloud, support);
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
    content_->t0 = t0;
    content_->walls.setStep(t0, t1), content_->group.setTime(t1);
    for (openFace& face : content_->openFaces) face.setStep(t0, t1);
}

void boundary::setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce) const
{
    std::fill(cloud.pFixed.begin(), cloud.pFixed.end(), 0);
    std::fill(cloud.uFixed.begin() + cloud.nSolid(), cloud.uFixed.end(), 0);
    for (const auto& [i, w] : content_->clamped)
        cloud.Up[i].setXyz(content_->walls.walls()[w].surfaceVelocity.at(cloud.x[i].xyz()));
    for (const openFace& face : content_->openFaces) face.setFlags(cloud, rho, bodyForce);
}

void boundary::clampSolids(particleCloud& cloud, const List<vec4>& x0, const dictionary& patches)
{
    const wallSet& walls = content_->walls;
    for (label w = 0; w < label(walls.walls().size()); ++w)
    {
        const wall& at = walls.walls()[w];
        for (const word& name : at.clamps)
        {
            const fileLocation where = patches.subDict(at.name).where("clamps");
            const label zone = cloud.zoneIndex(name, where);
            if (cloud.zones[zone].phase != phaseType::solid)
                throw fatalError("Zone " + name + " is fluid: a wall clamps solids only", where);
            const size_t before = content_->clamped.size();
            for (label i = 0; i < cloud.nSolid(); ++i)
                if (cloud.zone[i] == zone &&
                    walls.distance(w, x0[i].xyz()) < at.clampDepth * cloud.dx)
                    cloud.uFixed[i] = 1, content_->clamped.push_back({i, w});
            if (content_->clamped.size() == before)
                throw fatalError("No particle of zone " + name + " rests within " +
                                     str(at.clampDepth) + " dx of wall " + at.name +
                                     ": there is nothing to clamp. Do they touch?",
                                 where);
        }
    }
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
void boundary::content::putBack(particleCloud& cloud)
{
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        vector x = cloud.x[i].xyz(), u = cloud.Up[i].xyz();
        imageGroup::wayHome back = group.wayBack(x);
        if (!back.map) continue;
        for (int k = 0; back.map && k < 8; ++k)
        {
            const structureImage& map = *back.map;
            x = map(x), u = map.R * u, cloud.Up[i][3] += group.pressureOffset(map);
            for (patchBalance& b : balance)
                if (back.reflects && b.name == *back.patch) ++b.pushed;
            back = group.wayBack(x);
        }
        cloud.x[i].setXyz(x), cloud.Up[i].setXyz(u);
    }
}

label boundary::exchange(particleCloud& cloud, scalar t1)
{
    content& c = *content_;
    cloud.clearGhosts();
    c.guard.rememberWalls(c.walls);
    const List<scalar> swept = c.walls.moveTo(t1);
    const scalar dt = t1 - c.t0;
    label pushed = 0;
    if (!c.walls.empty())
    {
        const List<label> perWall = c.guard.apply(cloud, c.walls);
        for (const wall& w : c.walls.walls())
        {
            const size_t k = size_t(&w - c.walls.walls().data());
            patchBalance& b = c.balance[w.index];
            b.swept += swept[k], b.pushed += perWall[k], b.flux = -swept[k] / dt;
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
        b.flux = c.openFaces[k].flux(), b.volume += b.flux * dt;
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
        if (w.motion.moves() || w.motion.slides()) names.push_back(w.name);
    return names;
}

vector boundary::wallVelocity(const word& name, const vector& x) const
{
    return content_->walls.named(name).velocity.at(x);
}

scalar boundary::maxGivenSpeed() const
{
    scalar most = content_->walls.maxSpeed();
    for (const openFace& face : content_->openFaces) most = std::max(most, face.givenSpeed());
    return most;
}

sweptRates boundary::swept(const particleCloud& cloud) const
{
    sweptRates r = content_->wetted.rates(content_->walls, cloud);
    for (const openFace& face : content_->openFaces)
    {
        if (!face.givesVelocity()) continue;
        const List<scalar> q = face.givenFlux(cloud);
        for (size_t z = 0; z < q.size(); ++z)
            r.net[z] += q[z], r.gross[z] += std::abs(q[z]), r.faces[z] += std::abs(q[z]);
    }
    return r;
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

void boundary::printBalance(const particleCloud& cloud) const
{
    const List<patchBalance>& patches = content_->balance;
    const auto passes = [&](const patchBalance& b) {
        for (const wall& w : content_->walls.walls())
            if (w.name == b.name) return w.motion.moves();
        for (const openFace& face : content_->openFaces)
            if (face.name() == b.name) return true;
        return false;
    };
    word fluxes;
    scalar sum = 0;
    label created = 0, deleted = 0, pushed = 0;
    for (const patchBalance& b : patches)
    {
        created += b.created, deleted += b.deleted, pushed += b.pushed;
        if (!passes(b)) continue;
        const scalar flux = symmetryFactor() * b.flux;  // of the whole body, as in the ledger
        fluxes += (fluxes.empty() ? "" : ", ") + b.name + " " + str(flux), sum += flux;
    }
    if (!fluxes.empty())
        info() << "patch flux [m" << cloud.nDims << "/s, out]: " << fluxes << ", sum " << str(sum)
               << "\n";
    if (created + deleted + pushed > 0 || hasOpen())
        info() << "particles: " << cloud.n() << "; so far created " << created << ", deleted "
               << deleted << ", put back " << pushed << "\n";
}

void boundary::restoreBalance(const List<patchBalance>& balance)
{
    content_->balance = balance;
}

}  // namespace ispf
