// SPDX-License-Identifier: GPL-3.0-or-later
#include "fsiCase.H"
#include "pairViscosity.H"

#include "cloudIO.H"
#include "cutPlanes.H"
#include "patchDictionary.H"
#include "solidFriction.H"
#include "solidState.H"
#include "sphc.H"
#include "wallFriction.H"

#include <map>
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ispf
{

namespace
{

std::shared_ptr<vectorFunction1> acceleration(const dictionary& dict, const word& key,
                                              const fsiCase& c)
{
    std::shared_ptr<vectorFunction1> a =
        vectorFunction1::New(key, dict, c.caseFolder(), dims::acceleration);
    for (const vector& part : a->parts())
        if (c.cloud.nDims == 2 && part[2] != 0)
            dict.fail(key, "The case is two-dimensional, in x and y: '" + key +
                               "' must not have a component along z");
    return a;
}

}  // namespace

fsiCase::fsiCase(Time& t) : time(t)
{
    schemes = dictionary::fromFile(time.systemFile("sphSchemes"));
    solution = dictionary::fromFile(time.systemFile("sphSolution"));
    readCloud(time, cloud);
    readProperties();
    coupling = solution.chooseOrDefault("coupling", {"projection", "monolithic"},
                                        cloud.nSolid() > 0 ? "monolithic" : "projection");
    readKernel();
    readBoundary();
    readStructure();
    recallSolid(*this);
}

void fsiCase::readBoundary()
{
    const dictionary patches = readPatchDictionary(caseFolder(), cloud.zones);
    checkCuts(cloud, patches);
    walls = std::make_unique<boundary>(caseFolder(), patches, cloud, kernel->support(),
                                       time.value(), nu());
    const auto rest = cloud.vectors.find("x0");
    walls->clampSolids(cloud, rest == cloud.vectors.end() ? List<vec4>() : rest->second, patches);
    restoreBalance(cloud, *walls);
    walls->setStep(time.value(), stepEnd());
}

void fsiCase::read()
{
    particleCloud then;
    readCloud(time, then);
    const auto same = [](const zoneInfo& a, const zoneInfo& b) { return a.name == b.name; };
    if (then.nSolid() != cloud.nSolid() || then.nDims != cloud.nDims || then.dx != cloud.dx ||
        !std::equal(then.zones.begin(), then.zones.end(), cloud.zones.begin(), cloud.zones.end(),
                    same))
        throw fatalError(time.folder() +
                         " has another solid, other zones or another spacing "
                         "than the time before: it belongs to another case");
    const auto restOf = [](const particleCloud& c) {
        const auto found = c.vectors.find(restPlaces);
        return found == c.vectors.end() ? List<vec4>() : found->second;
    };
    const List<vec4> before = restOf(cloud), after = restOf(then);
    cloud = std::move(then);
    readBoundary();
    if (!std::equal(before.begin(), before.end(), after.begin(), after.end(),
                    [](const vec4& a, const vec4& b) { return a.xyz() == b.xyz(); }))
        makeStructure();  // a prestress has found the rest since
    recallSolid(*this);
}

void fsiCase::readProperties()
{
    physical = dictionary::fromFile(time.constantFile("physicalProperties"));
    rho = physical.getInRange("rho", 1e-30, 1e30, dims::density);
    const bool hasMu = physical.found("mu"), hasNu = physical.found("nu");
    if (hasMu == hasNu)
        throw fatalError("constant/physicalProperties wants exactly one of mu [Pa s] and nu [m2/s]",
                         physical.where(hasMu ? "mu" : "rho"));
    mu = hasMu ? physical.getInRange("mu", 0, 1e30, dims::dynamicViscosity)
               : rho * physical.getInRange("nu", 0, 1e30, dims::kinematicViscosity);
    viscosity = viscosityModel::New(physical, mu);
    if (!viscosity) cloud.scalars.erase(viscosityRatio);  // of an earlier run with a model
    else if (List<scalar>& of = cloud.scalars[viscosityRatio]; of.empty())
    {
        of.assign(cloud.n(), viscosity->ratio(0));  // until the first step
        std::fill_n(of.begin(), cloud.nSolid(), 1);
    }
    // all zones are one incompressible system with one density
    const dictionary zoneRho = physical.subOrEmptyDict("zoneDensities");
    for (const word& zone : zoneRho.keys())
    {
        cloud.zoneIndex(zone, zoneRho.where(zone));
        if (const scalar r = zoneRho.get<scalar>(zone, dims::density);
            std::abs(r - rho) > 1e-3 * rho)
            zoneRho.fail(zone,
                         "Zone " + zone + " has density " + str(r) + ", the fluid " + str(rho) +
                             ": one incompressible system solves fluid and solid together, so "
                             "their densities must be equal");
    }
    readBodyForce();
}

void fsiCase::readBodyForce()
{
    const dictionary g = dictionary::fromFileIfPresent(time.constantFile("g"));
    const dictionary perZone = physical.subOrEmptyDict("bodyForce");
    if (perZone.empty() && physical.found("bodyForce"))
        physical.fail("bodyForce", "It names no zone and has no effect");
    if (g.empty() && perZone.empty()) return;
    const scalar unit = g.found("dimensions") ? g.getUnit("dimensions", dims::acceleration) : 1;
    if (!g.empty()) drives_.push_back({-1, unit, acceleration(g, "value", *this)});
    g.checkAllRead();
    for (const word& zone : perZone.keys())
        drives_.push_back(
            {cloud.zoneIndex(zone, perZone.where(zone)), 1, acceleration(perZone, zone, *this)});
    bodyForce = bodyForceAt(time.value());
}

List<vector> fsiCase::bodyForceAt(scalar t) const
{
    if (drives_.empty()) return bodyForce;
    List<vector> b(cloud.zones.size(), vector::Zero());
    for (const drive& d : drives_)
        for (size_t zone = 0; zone < b.size(); ++zone)
            if (d.zone < 0 || d.zone == label(zone)) b[zone] += d.unit * d.acceleration->value(t);
    return b;
}

void fsiCase::readKernel()
{
    // 3D projection: h = dx, which the numbers of the paper imply; else Wendland C2 at h = 1.3 dx
    const bool paper = cloud.nDims == 3 && coupling == "projection";
    const word name =
        schemes.chooseOrDefault("kernel", smoothingKernel::valid(), paper ? "cubic" : "WendlandC2");
    const bool Wendland = name.rfind("Wendland", 0) == 0;
    const scalar hByDx =
        schemes.getInRangeOrDefault("hByDx", 0.5, 4, paper && !Wendland ? 1.0 : 1.3);
    if (Wendland && hByDx < 1.05)
        warning("kernel " + name + " with hByDx " + str(hByDx) +
                ": this pair is known to blow up; use hByDx 1.3, or the cubic kernel");
    kernel = smoothingKernel::New(name, cloud.nDims, hByDx * cloud.dx);
    if (kernel->support() < 1.8 * cloud.dx)
        schemes.fail("hByDx",
                     "The support would be " + str(kernel->support() / cloud.dx) +
                         " dx: too few neighbours. It must be 1.8 dx at least, better 2 to 3");
}

// Sets of particles that the pattern's entries join, without sets that have a clamped particle
static List<List<label>> freeBodies(const blockMatrix3& pattern, const List<char>& fixed)
{
    const List<label> setOf = pattern.connectedSets();
    std::map<label, List<label>> bodies;
    for (label i = 0; i < label(setOf.size()); ++i) bodies[setOf[i]].push_back(i);
    List<List<label>> free;
    for (auto& [first, body] : bodies)
        if (std::none_of(body.begin(), body.end(), [&](label i) { return fixed[i]; }))
            free.push_back(std::move(body));
    return free;
}

void fsiCase::readStructure()
{
    structureProperties = dictionary::fromFileIfPresent(time.constantFile("structureProperties"));
    const dictionary& properties = structureProperties;
    if (properties.empty())
    {
        if (cloud.nSolid() > 0)
            throw fatalError("There are " + std::to_string(cloud.nSolid()) +
                             " solid particles, but no constant/structureProperties with their "
                             "elastic model");
        return;
    }
    if (cloud.nSolid() == 0)
        throw fatalError(
            "constant/structureProperties describes an elastic solid, but no "
            "particle is solid. Remove the file, or give a zone phase solid",
            properties.where());
    makeStructure();
    if (walls->hasCyclic()) bodies_ = freeBodies(structure->tangentPattern(), cloud.uFixed);
}

void fsiCase::makeStructure()
{
    structureReference ref;
    ref.nDims = cloud.nDims, ref.dx = cloud.dx, ref.h = kernel->h();
    ref.support = kernel->support(), ref.rho = rho;
    const List<vec4>& rest = cloud.vectors.at("x0");
    for (label i = 0; i < cloud.nSolid(); ++i)
        ref.x0.push_back(rest[i].xyz()), ref.fixed.push_back(cloud.uFixed[i]),
            ref.zone.push_back(cloud.zone[i]);
    if (const auto free = cloud.vectors.find(restPlaces); free != cloud.vectors.end())
        for (label i = 0; i < cloud.nSolid(); ++i) ref.rest.push_back(free->second[i].xyz());
    for (const zoneInfo& z : cloud.zones) ref.zoneNames.push_back(z.name);
    for (const structureImage& m : walls->images()) ref.images.push_back({m.R, m.t});
    structure = structureModel::New(structureProperties, ref);
}

List<scalar> fsiCase::solidModuli() const
{
    const auto modulus = [&](label i) { return structure->shearModulus(i); };
    bool differ = false;
    for (label i = 1; structure && i < cloud.nSolid() && !differ; ++i)
        differ = modulus(i) != modulus(0);
    List<scalar> moduli(differ ? cloud.nSolid() : 0);
    for (label i = 0; i < label(moduli.size()); ++i) moduli[i] = modulus(i);
    return moduli;
}

scalar fsiCase::stepEnd(scalar now) const
{
    const scalar end = now + time.deltaT();
    return time.endTime() > now ? std::min(end, time.endTime()) : end;
}

namespace entries
{

const stateEntry<scalar> stepsSinceSort{"stepsSinceSort"};

}  // namespace entries

// Sorts fluid so that neighbours in space are neighbours in memory; this holds for ten steps.  The count is a part of the
// state, so that a continued run keeps the order
void fsiCase::sortParticles()
{
    constexpr scalar interval = 10;
    const scalar since = cloud.state.get(entries::stepsSinceSort, interval) + 1;
    if (since >= interval) cloud.sortFluid(kernel->support());
    cloud.state.set(entries::stepsSinceSort, since < interval ? since : 0);
    cloud.clearGhosts();
}

// Counts fluid without neighbours: it has left through a gap between patches and takes no part any more.  Warns
// whenever the number has grown
void fsiCase::countStrays()
{
    label n = 0, last = 0;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (list.start[i + 1] == list.start[i]) ++n, last = i;
    const scalar before = cloud.state.get(entries::strays, 0);
    if (n > before)
        warning("Fluid has left the case: " + std::to_string(n) +
                " particle(s) have no neighbours any more, the last is " + cloud.describe(last) +
                ". Is there a gap between the patches of constant/boundary, or is a wall missing?");
    if (n != before) cloud.state.set(entries::strays, n);
}

void fsiCase::updateNeighbours(const stepTimes& times)
{
    walls->setStep(times);
    if (times.at != times.start) walls->bringHome(cloud);
    carrySolids();
    sortParticles();
    bodyForce = bodyForceAt(0.5 * (times.start + times.end));
    walls->setFlags(cloud, rho, bodyForce);
    walls->updateGhosts(cloud);
    list.build(cloud, *kernel, walls->visible(cloud));
    correction.build(cloud, list);
    makeShearExact(cloud, list);
    stickToSolids(cloud, list);
    if (viscosity) viscosity->update(cloud, list, correction);
    countStrays();
}

scalar fsiCase::largestNu() const
{
    const pairViscosity ratio(cloud);
    if (!viscosity) return nu();
    return nu() * largestOf(0, cloud.n(), [&](label i) { return ratio.at(i); });
}

// A body whose centre has passed a cyclic plane is moved to the other plane as a whole.  Only differences of its positions
// matter, also for links to its own images
void fsiCase::carrySolids()
{
    for (const List<label>& body : bodies_)
    {
        vector centre = vector::Zero();
        for (const label i : body) centre += cloud.x[i].xyz() / scalar(body.size());
        const vector way = walls->wayOverCyclic(centre);
        if (way.isZero(0)) continue;
        if (walls->pressureOffset({tensor::Identity(), way}) != 0)
            throw fatalError("Time " + time.timeName() + " s: " + cloud.describe(body.front()) +
                             " and its body have passed a cyclic patch with a pressureDrop, of "
                             "which the body's load does not know. Drive the fluid's zone with "
                             "bodyForce in constant/physicalProperties instead");
        for (const label i : body) cloud.x[i].setXyz(cloud.x[i].xyz() + way);
    }
}

void fsiCase::followOpen(const viscousPairs& viscous, scalar dt)
{
    if (!walls->hasOpen()) return;
    cloud.fillGhosts(cloud.Up, false);
    List<vec4> friction;
    viscous.apply(cloud.Up, friction);
    for (vec4& f : friction) f.s *= -2 * mu;
    walls->setOpenVelocity(cloud, friction, rho, dt);
}

// Pairs of particles of different zones whose motion gives each other a force, a line for each two zones: solids that touch
// are one body
static word linksBetweenZones(const structureModel& structure, const particleCloud& cloud)
{
    const blockMatrix3 pattern = structure.tangentPattern();
    std::map<std::pair<label, label>, label> links;
    for (label i = 0; i < structure.n(); ++i)
        for (auto p = pattern.rowStart[i]; p < pattern.rowStart[i + 1]; ++p)
            if (const label j = pattern.column[p]; j > i && cloud.zone[i] != cloud.zone[j])
                ++links[std::minmax<label>(cloud.zone[i], cloud.zone[j])];
    word text;
    for (const auto& [zones, n] : links)
        text += "zones " + cloud.zones[zones.first].name + " and " +
                cloud.zones[zones.second].name + ": " + std::to_string(n) +
                (n == 1 ? " link\n" : " links\n");
    return text;
}

void fsiCase::report() const
{
    label nFluid = cloud.n() - cloud.nSolid();
    info() << "particles: " << cloud.n() << " (" << nFluid << " fluid, " << cloud.nSolid()
           << " solid), " << cloud.nDims << "D, dx = " << str(cloud.dx) << " m\n"
           << "kernel: " << kernel->name() << ", h = " << str(kernel->h()) << " m, support "
           << str(kernel->support() / cloud.dx) << " dx\n"
           << "coupling: " << coupling << "\n"
           << "fluid: rho = " << str(rho) << " kg/m3, mu = " << str(mu) << " Pa s"
           << (viscosity ? " at high shear rates, " + viscosity->description() : word()) << "\n"
           << "structure: " << (structure ? structure->description() : "none") << "\n"
           << (structure ? linksBetweenZones(*structure, cloud) : word())
           << "body force: " << (bodyForce.empty() ? "none" : "given") << "\n"
           << "threads: " << nThreads() << "\n";
    for (const dictionary* d : {&schemes, &solution, &physical}) d->checkAllRead();
}

void fsiCase::write()
{
    writeCloud(time, cloud, *walls);
}

}  // namespace ispf
