// SPDX-License-Identifier: GPL-3.0-or-later
// Reading constant/boundary and the files that its patches need
#include "boundaryContent.H"

#include "fileNames.H"

#include <algorithm>

namespace ispf
{

void boundary::content::addPatch(const word& name, const dictionary& dict, const word& caseFolder)
{
    const word type = dict.choose("type", {"wall", "symmetryPlane", "cyclic", "open"});
    const label index = label(balance.size());
    balance.push_back({name});
    for (const word key : {"point", "normal"}) dict.found(key);  // generateParticles reads them
    if (type == "symmetryPlane")
        group.addSymmetryPlane(name, dict.get<vector>("point", dims::length),
                               nonZero(dict, "normal"));
    else if (type == "cyclic")
    {
        cyclic.push_back({name, dict.get<vector>("point", dims::length),
                          nonZero(dict, "separation", dims::length), index});
        group.addCyclic(name, cyclic.back().point, cyclic.back().separation,
                        dict.found("pressureDrop")
                            ? Function1::New("pressureDrop", dict, caseFolder, dims::pressure)
                            : nullptr);
    }
    else if (type == "open") openIndex.push_back(index);
    else
    {
        wall w = wall::New(name, dict, caseFolder);
        w.index = index;
        walls.add(std::move(w));
    }
}

// fatalError if a solid reaches over a pair with a pressure drop: its rows allow no difference of p between the sides
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

void boundary::content::findLeavingWalls(const dictionary& patches, scalar dx)
{
    for (const wallSet::body& b : walls.bodies())
        for (label k = 0; k < label(cyclic.size()); ++k)
        {
            const wall& w = b.carrier(walls);
            const vector n = cyclic[k].separation.normalized();
            if (!w.motion.movesAlong(n)) continue;
            const bool endless = w.plane && w.normal.cross(n).norm() > 1e-9;
            List<vector> nodes = w.plane ? List<vector>{w.point} : b.surface->mesh()->nodes;
            std::erase_if(nodes, [&](const vector& X) { return group.beyond(X) > 0.01 * dx; });
            leaving.push_back({b.walls.front(), k, endless, std::move(nodes),
                               patches.subDict(w.name).where("motion")});
        }
}

// fatalError if a moving wall passes a cyclic plane: it does not come back at the other plane, and fluid would leave by the
// gap
void boundary::content::checkLeavingWalls(scalar t, scalar dx) const
{
    for (const leavingWall& one : leaving)
    {
        const wall& w = walls.walls()[one.wall];
        const cyclicPair& pair = cyclic[one.pair];
        const bodyFrame frame = w.motion.frame(t);
        const bool reaches =
            one.endless || std::any_of(one.nodes.begin(), one.nodes.end(), [&](const vector& X) {
                return pair.depth(frame.toSpace(X)) < 0.5 * dx;
            });
        if (reaches)
            throw fatalError(
                "Wall " + w.name + " moves across the cyclic patch " + pair.name +
                    ", and at time " + str(t) +
                    " s its surface reaches one of the planes: a wall that leaves at one plane "
                    "does not enter at the other. If the surface slides or turns in itself, give "
                    "the wall a 'velocity' or 'rotation' instead of 'motion'; else keep it between "
                    "the planes",
                one.where);
    }
}

namespace
{

bool isPlane(const dictionary& dict)
{
    return dict.found("surface") && dict.get<word>("surface") == "plane";
}

}  // namespace

// The mesh of an open face.  A plane ends at walls, symmetry planes, cyclic sides and other open planes
faceMesh boundary::content::meshOf(const word& name, const dictionary& patches,
                                   const word& caseFolder, const particleCloud& cloud) const
{
    const auto placeOf = [](const dictionary& dict) {
        return std::make_pair(dict.get<vector>("point", dims::length),
                              vector(nonZero(dict, "normal").normalized()));
    };
    const dictionary& dict = patches.subDict(name);
    planeLattice::planes ends;
    for (const label index : openIndex)
        if (const word& other = balance[index].name; other != name)
            if (const dictionary& d = patches.subDict(other); isPlane(d))
                ends.push_back(placeOf(d));
    triSurface s = isPlane(dict) ? walls.rectangle(placeOf(dict).first, placeOf(dict).second, ends)
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
                                                 meshOf(name, patches, caseFolder, cloud),
                                                 [&](const vector& x) { return walls.holds(x); }});
    }
    const auto beside = [&](const vector& x, scalar distance) {
        for (const auto& [point, normal] : group.symmetryPlanes())
            if ((x - point).dot(normal) > -distance) return true;
        return !walls.clear(x, distance);
    };
    for (openFace& face : openFaces)
    {
        const fileLocation where = patches.subDict(face.name()).where("type");
        // applies to points in the strip of this face or before it, so the face itself is not asked
        const auto allowed = [&](const vector& x, scalar distance) {
            for (const openFace& other : openFaces)
                if (&other != &face && other.beyondStrip(x)) return false;
            return group.beyond(x) <= -distance && walls.clear(x, distance);
        };
        face.setSites(sites.positions(face.name(), where), cloud, allowed, beside);
    }
    findRims(patches, sites, cloud.dx);
}

namespace
{

// An open face that gives the velocity, with the sites of its strip
struct givingFace
{
    const openFace& face;
    List<vector> strip;
};

bool meets(const givingFace& g, const wallSet& walls, label w, scalar dx)
{
    const bodyFrame& frame = walls.walls()[w].frame;
    return std::any_of(g.strip.begin(), g.strip.end(),
                       [&](const vector& x) { return walls.distance(w, frame.toBody(x)) < dx; });
}

// True if the two faces meet and give velocities of different directions there
bool clash(const givingFace& g, const givingFace& other, scalar dx)
{
    pointGrid grid(2 * dx);
    for (const vector& x : other.strip) grid.add(x);
    return std::any_of(g.strip.begin(), g.strip.end(), [&](const vector& x) {
        const label near = grid.nearestIndex(x, 2 * dx);
        return near >= 0 && (g.face.givenDirection(x).normalized() -
                             other.face.givenDirection(grid[near]).normalized())
                                    .norm() > 0.1;
    });
}

}  // namespace

void boundary::content::findRims(const dictionary& patches, const siteFile& sites, scalar dx)
{
    List<givingFace> given;
    List<label> index;
    for (size_t k = 0; k < openFaces.size(); ++k)
        if (const openFace& face = openFaces[k]; face.givesVelocity())
        {
            given.push_back(
                {face, sites.positions(face.name(), patches.subDict(face.name()).where("type"))});
            index.push_back(label(k));
        }
    for (size_t k = 0; k < given.size(); ++k)
    {
        const word& name = given[k].face.name();
        for (label w = 0; w < label(walls.walls().size()); ++w)
            if (const wall& at = walls.walls()[w];
                at.motion.moves() && meets(given[k], walls, w, dx))
                patches.subDict(name).fail(
                    "type", "Wall " + at.name + " moves, and ends at the face " + name +
                                ", where the velocity is given: the wall would run into fluid "
                                "that enters. Give the pressure there; or, if the surface of the "
                                "wall stays in place, give the wall a 'velocity' or 'rotation'");
        for (size_t m = k + 1; m < given.size(); ++m)
            if (clash(given[k], given[m], dx))
                sharedRims.push_back({index[k], index[m], patches.subDict(name).where("type")});
    }
}

// fatalError if two faces that meet both bring fluid in: their particles would run into each other.  One may bring in what
// the other takes out
void boundary::content::setStep(const stepTimes& times)
{
    for (openFace& face : openFaces) face.setStep(times.start, times.end, times.pressures);
    for (const sharedRim& rim : sharedRims)
        if (const openFace& one = openFaces[rim.face], &other = openFaces[rim.other];
            one.bringsIn() && other.bringsIn())
            throw fatalError("The faces " + one.name() + " and " + other.name() +
                                 " meet, and at time " + str(times.end) +
                                 " s both bring fluid in, which runs into each other there. Give "
                                 "both one 'direction', one of them the pressure, or leave a "
                                 "piece of wall between them",
                             rim.where);
}

boundary::boundary(const word& caseFolder, const dictionary& patches, const particleCloud& cloud,
                   scalar support, scalar t0)
    : content_(std::make_unique<content>())
{
    content& c = *content_;
    c.support = support;
    for (const word& name : patches.dictKeys()) c.addPatch(name, patches.subDict(name), caseFolder);
    c.group.close(cloud, support);
    c.checkDrops(patches, cloud, support);
    c.walls.read(caseFolder, patches, c.group, cloud, support, t0);
    c.findLeavingWalls(patches, cloud.dx);
    c.checkLeavingWalls(t0, cloud.dx);
    c.wetted.find(c.walls, c.group, cloud);
    c.visibility.find(c.walls, support);
    c.mirror.find(c.walls, support);
    c.addOpenFaces(caseFolder, patches, cloud);
    c.setStep({t0, t0, t0, t0});
    for (const char* file : {"/constant/wallParticles.hdf", "/constant/openSites.hdf"})
        if (isFile(caseFolder + file)) siteFile(caseFolder + file).checkPatches(patches);
    patches.checkAllRead();
}

}  // namespace ispf
