// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleDict.H"

#include "bodySurface.H"
#include "fileNames.H"
#include "lumenWall.H"
#include "patchDictionary.H"
#include "shapes.H"
#include "siteFile.H"
#include "surfaceTopology.H"
#include "surfaceRepair.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

zoneInfo readZone(const word& name, const dictionary& dict)
{
    const word phase = dict.choose("phase", {"fluid", "solid", "clamped", "rigid"});
    if (phase == "fluid") return {name, phaseType::fluid, false};
    if (phase == "rigid") return {name, phaseType::rigid, true};
    return {name, phaseType::solid, phase == "clamped"};
}

// A name is used as a word in lists and as a name of files
void checkName(const dictionary& dict, const word& name)
{
    const auto fine = [](unsigned char c) { return std::isalnum(c) || word("_-.").find(c) < 3; };
    if (!std::all_of(name.begin(), name.end(), fine))
        dict.fail(name, "'" + name + "' cannot be a name here: use letters, digits, _ - and .");
}

// Describes the faces: "6 faces with the colours (255 0 0) (0 0 255) and the groups inlet"
word facesOf(const cadModel& model)
{
    List<word> seen;
    std::set<word> groups;
    for (const cadVolume& v : model.volumes) groups.insert(v.groups.begin(), v.groups.end());
    for (const cadFace& f : model.faces)
    {
        groups.insert(f.groups.begin(), f.groups.end());
        const word c = word("(") + std::to_string(f.colour[0]) + " " + std::to_string(f.colour[1]) +
                       " " + std::to_string(f.colour[2]) + ")";
        if (f.coloured && std::find(seen.begin(), seen.end(), c) == seen.end()) seen.push_back(c);
    }
    return std::to_string(model.faces.size()) + " faces with " +
           (seen.empty() ? word("no colours") : "the colours " + join(seen)) + " and " +
           (groups.empty() ? word("no groups")
                           : "the groups " + join(List<word>(groups.begin(), groups.end())));
}

}  // namespace

particleDict::particleDict(const word& caseFolder)
    : caseFolder_(caseFolder), dict_(dictionary::fromFile(caseFolder + "/system/particleDict"))
{
    dx = dict_.getInRange("dx", 1e-12, 1e12, dims::length);
    nDims = dict_.getOrDefault<label>("nDims", 3);
    if (nDims != 2 && nDims != 3) dict_.fail("nDims", "nDims must be 2 or 3");
    support = dx * dict_.getInRangeOrDefault("support", 1, 10, 2.6);
    origin = dict_.getOrDefault<vector>("origin", vector::Zero(), dims::length);
    stripLayers = dict_.getInRangeOrDefault<label>("stripLayers", siteFile::leastStripLayers,
                                                   siteFile::mostStripLayers, stripLayers);
    cad_.meshSize =
        dict_.getInRangeOrDefault("surfaceSize", 0.01 * dx, 1000 * dx, dx, dims::length);
    if (dict_.found("timeLimit"))
        cad_.timeLimit = dict_.getInRange("timeLimit", 1, 1e6, dims::time);
    weldTolerance_ =
        dict_.getInRangeOrDefault("weldTolerance", 0, 0.5 * dx, 1e-3 * dx, dims::length);
    closeHoles_ = dict_.getInRangeOrDefault("closeHoles", 0, 1e3 * dx, dx, dims::length);
    defaultPatch_ = dict_.getOrDefault<word>("defaultPatch", "walls");
    readBoundary();
    readPatches();
}

void particleDict::readBoundary()
{
    boundary_ = dictionary::fromFile(caseFolder_ + "/constant/boundary");
    for (const word& name : boundary_.dictKeys()) addPatch(name);
    // patches that a pattern names: those of the particleDict here, others once the surfaces are known
    for (const word& name : dict_.subOrEmptyDict("patches").dictKeys()) addByPattern(name);
}

void particleDict::addByPattern(const word& name)
{
    if (resolvePattern(boundary_, name)) addPatch(name);
}

void particleDict::addByPatterns(const List<body>& bodies)
{
    for (const body& b : bodies)
        for (label t = 0; t < b.surface.size(); ++t)
        {
            const word& name = b.surface.patchNames[b.surface.patch[t]];
            addByPattern(name.empty() ? defaultPatch_ : name);
        }
}

void particleDict::addPatch(const word& name)
{
    const dictionary& patch = boundary_.subDict(name);
    checkName(boundary_, name);
    if (patch.found("clamps"))
        for (const word& zone : patch.get<List<word>>("clamps")) clamped_.insert(zone);
    const word type = patch.choose("type", {"wall", "open", "symmetryPlane", "cyclic"});
    patchInfo info{name, patchInfo::kind::other, patch.found("motion")};
    if (type == "wall") info.type = patchInfo::kind::wall;
    if (type == "open") info.type = patchInfo::kind::open;
    if (type == "symmetryPlane" || type == "cyclic" || patch.found("point"))
    {
        halfSpace side;
        side.point = patch.get<vector>("point", dims::length);
        const word key = type == "cyclic" ? "separation" : "normal";
        side.normal = patch.get<vector>(key, type == "cyclic" ? dims::length : dims::none);
        if (side.normal.norm() == 0) patch.fail(key, key + " must not be zero");
        const vector shift = side.normal;
        side.normal.normalize();
        if (type == "symmetryPlane") planes_.push_back(side);
        else flatPatches_.push_back({name, side});
        if (type == "cyclic") flatPatches_.push_back({name, {side.point + shift, side.normal}});
    }
    if (type != "symmetryPlane") patches_.push_back(info);
}

const cadModel& particleDict::model(const dictionary& dict)
{
    if (const List<word> names = dict.tokens("file"); names.size() > 1)
        dict.fail("file", "A zone has one file, but 'file' holds '" + join(names) +
                              "'. Give each file a zone of its own: zones of the same phase that "
                              "touch act as one body");
    const word file = dict.get<word>("file"), unit = dict.getOrDefault<word>("unit", "");
    if (const auto known = models_.find(file); known != models_.end())
    {
        if (!unit.empty() && unit != known->second.unit)
            dict.fail("unit", "An earlier zone reads the same file in " + known->second.unit);
        return known->second;
    }
    cadSettings settings = cad_;
    settings.unit = unit;
    try
    {
        cadModel read = readCad(fromFolder(caseFolder_, file), settings);
        sources.push_back(file);
        namePatches(read);
        return models_.emplace(file, std::move(read)).first->second;
    }
    catch (const fatalError& error)
    {
        if (error.hasLocation()) throw;
        dict.fail("file", error.what());
    }
}

void particleDict::readPatches()
{
    const dictionary patches = dict_.subOrEmptyDict("patches");
    List<word> valid;
    for (const patchInfo& p : patches_) valid.push_back(p.name);
    for (const word& name : patches.dictKeys())
    {
        if (std::find(valid.begin(), valid.end(), name) == valid.end())
            patches.fail(
                name, "constant/boundary has no patch " + name + ". " + validWords("name", valid));
        selectors_.emplace_back(name, faceSelector(patches.subDict(name)));
        if (!selectors_.back().second.any())
            patches.fail(name, "Say which faces: colour, faces, group or box");
    }
}

// fatalError if a face belongs to two patches
void particleDict::checkUnnamed(const word& earlier, const word& name, const word& what,
                                const vector& at) const
{
    if (!earlier.empty() && earlier != name)
        dict_.subDict("patches").fail(name, "The patches " + earlier + " and " + name +
                                                " both choose " + what + ", around (" + str(at[0]) +
                                                " " + str(at[1]) + " " + str(at[2]) +
                                                "): name it in one of them alone");
}

// Writes the selected patch into the surface of each face
void particleDict::namePatches(cadModel& model)
{
    for (const auto& [name, selector] : selectors_)
        for (cadFace& face : model.faces)
            if (selector.matches(face))
            {
                checkUnnamed(face.surface.patchNames[0], name,
                             "face " + std::to_string(face.tag) + " of " + model.path,
                             face.surface.bounds().centre());
                face.surface.patchNames = {name}, foundPatches_.insert(name);
            }
}

// The triangles of a shape have no face, colour or group: only boxes select them
void particleDict::namePatches(triSurface& shape)
{
    for (const auto& [name, selector] : selectors_)
        for (label t = 0; t < shape.size(); ++t)
        {
            boundBox b;
            for (int k = 0; k < 3; ++k) b.add(shape.corner(t, k));
            if (nDims == 2) b.min[2] = b.max[2] = 0;
            if (!selector.holds(b)) continue;
            checkUnnamed(shape.patchNames[shape.patch[t]], name, "the facet of a shape",
                         b.centre());
            shape.patch[t] = shape.addPatch(name), foundPatches_.insert(name);
        }
}

void particleDict::checkPatchesFound() const
{
    List<word> where;
    for (const auto& [file, model] : models_) where.push_back(file + " has " + facesOf(model));
    if (where.empty()) where.push_back("the faces of shapes are chosen by a box that holds them");
    for (const auto& [name, selector] : selectors_)
        if (!foundPatches_.count(name))
            dict_.subDict("patches").fail(
                name, "No face has " + selector.describe() + "; " + join(where, ", "));
}

// Faces in the plane of a flat patch belong to it without a selector
void particleDict::nameByPlane(triSurface& surface) const
{
    for (const cyclicPlane& flat : flatPatches_)
        for (label t = 0; t < surface.size(); ++t)
        {
            scalar off = 0;
            for (int k = 0; k < 3; ++k)
                off = std::max(off, std::abs(flat.side.distance(surface.corner(t, k))));
            if (off < 1e-6 * dx && surface.patchNames[surface.patch[t]].empty())
                surface.patch[t] = surface.addPatch(flat.patch);
        }
}

// Makes a body per volume of the file: volumes that touch have no common closed surface
List<body> particleDict::cadBodies(const word& zone, const dictionary& dict)
{
    const cadModel& cad = model(dict);
    const faceSelector selector(dict);
    selector.checkFaces(cad);
    std::map<label, int> owners;  // of a face between two volumes: both
    for (const cadVolume& v : cad.volumes)
        for (const label f : v.faces) ++owners[f];
    const auto ofFaces = [&](const cadVolume& v, auto&& wanted) {
        return std::any_of(v.faces.begin(), v.faces.end(),
                           [&](label f) { return owners[f] == 1 && wanted(cad.face(f)); });
    };
    const auto named = [&](const cadVolume& v) {
        boundBox bounds;
        for (const label f : v.faces) bounds.add(cad.face(f).surface.bounds());
        return !selector.any() || selector.matches(v) || selector.holds(bounds) ||
               ofFaces(v, [&](const cadFace& f) { return selector.marks(f); });
    };
    // a box selects the volumes inside it; only if there are none, those with a face in it (neighbours have one too)
    const auto touched = [&](const cadVolume& v) {
        return ofFaces(v, [&](const cadFace& f) { return selector.matches(f); });
    };
    List<body> bodies;
    const auto take = [&](auto&& wanted) {
        for (const cadVolume& v : cad.volumes)
            if (wanted(v)) bodies.push_back(cadBody(zone, dict, cad, v.faces, v.volume));
        return !bodies.empty();
    };
    if (take(named) || take(touched))
    {
        if (bodies.size() > 1 && dict.found("thickness"))
            dict.fail("thickness",
                      "The wall of one lumen is made, but zone " + zone + " takes " +
                          std::to_string(bodies.size()) + " volumes of " + cad.path +
                          ". Choose one by colour, faces, group or box, or unite them");
        return bodies;
    }
    List<label> faces;
    for (const cadFace& f : cad.faces)
        if (!selector.any() || selector.matches(f)) faces.push_back(f.tag);
    if (faces.empty())
        dict.fail("file", "No face of " + cad.path + " has " + selector.describe() + " for zone " +
                              zone + "; the file has " + facesOf(cad));
    // facets without volumes: bodies that touch are separated by their surfaces
    const body all = cadBody(zone, dict, cad, faces, 0);
    for (triSurface& part : separateTouching(all.surface, 1e-3 * dx))
        bodies.push_back({all.zone, std::move(part), 0});
    return bodies;
}

// Moves the middle of the body's height to z = 0 for two dimensions
void particleDict::cutHalfWay(const word& file, triSurface& s) const
{
    const boundBox box = s.bounds();
    if (box.max[2] - box.min[2] < 1e-6 * dx)
        throw fatalError(file +
                         " is flat. In two dimensions a file's bodies are prisms along z: "
                         "give them a height along z, any will do");
    for (vector& x : s.nodes) x[2] -= 0.5 * (box.min[2] + box.max[2]);
}

// Patches that fluid passes through
std::set<word> particleDict::patchesWithFlow() const
{
    std::set<word> names;
    for (const patchInfo& p : patches_)
        if (p.type != patchInfo::kind::wall) names.insert(p.name);
    return names;
}

body particleDict::cadBody(const word& zone, const dictionary& dict, const cadModel& cad,
                           const List<label>& faces, scalar volume) const
{
    body b{-1, {}, volume};
    lumenWall wall(dict, patchesWithFlow(), dx, nDims, cad_.meshSize);
    for (const label tag : faces) b.surface.append(wall.faceSurface(cad.face(tag)));
    if (nDims == 2) cutHalfWay(cad.path, b.surface);
    if (cad.givenFacets) sortByPlace(b.surface);
    bodySurfaceSettings settings = {
        dx, nDims, weldTolerance_, closeHoles_, &dict, dict.get<word>("file"), cad.origin};
    scalar meshed = 0;
    try
    {
        const List<word> caps = prepareBodySurface(b.surface, zone, settings);
        meshed = b.surface.volume();
        if (wall.asked())
        {
            nameByPlane(b.surface);
            b.surface = wall.around(b.surface, caps);
            b.volume = 0;
        }
        if (nDims == 2) stretchToPrism(b.surface, cad.path, dx);
    }
    catch (const fatalError& error)
    {
        if (error.hasLocation()) throw;
        dict.fail("file", error.what());
    }
    if (cad.givenFacets) sortByPlace(b.surface);
    if (volume > 0 && std::abs(meshed / volume - 1) > 0.01)
    {
        warning("The CAD kernel gives zone " + zone + " a volume of " + str(volume) +
                " m3, its mesh " + str(meshed) + " m3. The mesh counts.");
        b.volume = 0;
    }
    return b;
}

body particleDict::shapeBody(const dictionary& dict)
{
    body b{-1, makeShape(dict, dx, nDims), 0};
    b.volume = nDims == 3 ? shapeVolume(dict) : 0;
    namePatches(b.surface);
    return b;
}

void particleDict::addZone(const word& name, List<body>& bodies)
{
    const dictionary& dict = dict_.subDict("zones").subDict(name);
    checkName(dict_.subDict("zones"), name);
    if (dict.found("file") == dict.found("shape"))
        dict.fail("phase", "Zone " + name + " needs either a file or a shape");
    if (dict.found("shape") && dict.found("thickness"))
        dict.fail("thickness",
                  "Zone " + name +
                      " has a shape and so no lumen: 'thickness' makes the wall around "
                      "the lumen of a file. Use 'shape annulus', or give the file");
    List<body> own = dict.found("file") ? cadBodies(name, dict) : List<body>{shapeBody(dict)};
    const zoneInfo zone = readZone(name, dict);
    const bool rigid = zone.phase == phaseType::rigid;
    if (rigid && dict.found("mayOverlap"))
        dict.fail("mayOverlap", "Zone " + name +
                                    " is rigid: it is a hole in the zones before it, and may lie "
                                    "partly in them as it is. Remove the entry");
    if (dict.getOrDefault("mayOverlap", false)) mayOverlap_.insert(name);
    for (body& b : own)
    {
        nameByPlane(b.surface);
        if (rigid) b.surface.patchNames.assign(b.surface.patchNames.size(), name);
        else b.zone = label(zones_.size());
        bodies.push_back(std::move(b));
    }
    if (rigid) return;
    zones_.push_back(zone);
    initial_.emplace_back(dict, dx, nDims, zone.phase == phaseType::solid);
    if (initial_.back().restsElsewhere() && clamped_.count(name))
        dict.fail("rest", "A wall of constant/boundary clamps zone " + name +
                              ": clamped particles must rest where they are placed. Make the "
                              "clamped part a zone of phase clamped, with the same formulas");
}

bool particleDict::mustFit(const List<body>& bodies) const
{
    for (const zoneInfo& z : zones_)
        if (z.phase == phaseType::solid) return true;
    for (const body& b : bodies)
        for (label t = 0; t < b.surface.size(); ++t)
            if (b.surface.normal(t).cwiseAbs().maxCoeff() < 1 - 1e-9) return true;
    return false;
}

zoneGeometry particleDict::geometry()
{
    List<body> bodies;
    for (const word& name : dict_.subDict("zones").dictKeys()) addZone(name, bodies);
    checkPatchesFound();
    if (zones_.empty()) dict_.fail("zones", "At least one zone of phase fluid or solid is needed");
    const word word_ = dict_.chooseOrDefault("placement", {"lattice", "bodyFitted"},
                                             mustFit(bodies) ? "bodyFitted" : "lattice");
    bodyFitted = word_ == "bodyFitted";
    for (const word& key : dict_.keys())  // an included file may have entries for others
        if (dict_.where(key).file != dict_.path()) dict_.tokens(key);
    dict_.checkAllRead();
    addByPatterns(bodies);
    return zoneGeometry(zones_, patches_, std::move(bodies), planes_, defaultPatch_, dx, nDims);
}

void particleDict::checkOverlaps(const List<zoneOverlap>& overlaps) const
{
    for (const zoneOverlap& o : overlaps)
        if (const word& name = zones_[o.zone].name; o.crosses && !mayOverlap_.count(name))
            dict_.subDict("zones").fail(
                name, "Zone " + name + " lies partly in zone " + zones_[o.of].name +
                          ", which comes before it, and takes " + str(o.volume, 4) +
                          (nDims == 3 ? " m3" : " m2") + " of it around (" + str(o.middle[0], 4) +
                          " " + str(o.middle[1], 4) + " " + str(o.middle[2], 4) +
                          "). Let them meet without overlap, or lie one within the other; or say "
                          "'mayOverlap yes;' in zone " +
                          name);
}

}  // namespace ispf
