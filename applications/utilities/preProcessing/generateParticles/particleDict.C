// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleDict.H"

#include "faceSelector.H"
#include "shapes.H"
#include "surfaceTopology.H"
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

word coloursOf(const cadModel& model)
{
    List<word> seen;
    for (const cadFace& f : model.faces)
    {
        const word c = word("(") + std::to_string(f.colour[0]) + " " + std::to_string(f.colour[1]) +
                       " " + std::to_string(f.colour[2]) + ")";
        if (f.coloured && std::find(seen.begin(), seen.end(), c) == seen.end()) seen.push_back(c);
    }
    return seen.empty() ? word("no colours") : "the colours " + join(seen);
}

}  // namespace

particleDict::particleDict(const word& caseFolder)
    : caseFolder_(caseFolder), dict_(dictionary::fromFile(caseFolder + "/system/particleDict"))
{
    dx = dict_.getInRange("dx", 1e-12, 1e12);
    nDims = dict_.getOrDefault<label>("nDims", 3);
    if (nDims != 2 && nDims != 3) dict_.fail("nDims", "nDims must be 2 or 3");
    support = dx * dict_.getInRangeOrDefault("support", 1, 10, 2.6);
    origin = dict_.getOrDefault<vector>("origin", vector::Zero());
    stripLayers = dict_.getOrDefault<label>("stripLayers", 2);
    defaultPatch_ = dict_.getOrDefault<word>("defaultPatch", "walls");
    readBoundary();
}

void particleDict::readBoundary()
{
    const dictionary boundary = dictionary::fromFile(caseFolder_ + "/constant/boundary");
    for (const word& name : boundary.dictKeys())
    {
        const dictionary& patch = boundary.subDict(name);
        const word type = patch.choose("type", {"wall", "open", "symmetryPlane", "cyclic"});
        patchInfo info{name, patchInfo::kind::other, patch.found("motion")};
        if (type == "wall") info.type = patchInfo::kind::wall;
        if (type == "open") info.type = patchInfo::kind::open;
        if (type == "symmetryPlane" || type == "cyclic" || patch.found("point"))
        {
            halfSpace side;
            side.point = patch.get<vector>("point");
            side.normal = patch.get<vector>(type == "cyclic" ? "separation" : "normal");
            if (side.normal.norm() == 0) patch.fail("normal", "the normal must not be zero");
            const vector shift = side.normal;
            side.normal.normalize();
            if (type == "symmetryPlane") planes_.push_back(side);
            else flatPatches_.push_back({name, side});
            if (type == "cyclic") flatPatches_.push_back({name, {side.point + shift, side.normal}});
        }
        if (type != "symmetryPlane") patches_.push_back(info);
    }
}

const cadModel& particleDict::model(const dictionary& dict)
{
    const word file = dict.get<word>("file");
    const auto known = models_.find(file);
    if (known != models_.end()) return known->second;
    cadSettings settings;
    settings.meshSize = dict_.getOrDefault<scalar>("surfaceSize", dx);
    settings.unit = dict.getOrDefault<word>("unit", "");
    settings.timeLimit = dict_.getOrDefault<scalar>("timeLimit", 600);
    const word path = file.front() == '/' ? file : caseFolder_ + "/" + file;
    cadModel read = readCad(path, settings);
    sources.push_back(file);
    namePatches(read);
    return models_.emplace(file, std::move(read)).first->second;
}

// Writes the patch asked for into each face's surface
void particleDict::namePatches(cadModel& model) const
{
    const dictionary patches = dict_.subOrEmptyDict("patches");
    List<word> valid;
    for (const patchInfo& p : patches_) valid.push_back(p.name);
    for (const word& name : patches.dictKeys())
    {
        if (std::find(valid.begin(), valid.end(), name) == valid.end())
            patches.fail(
                name, "constant/boundary has no patch " + name + ". " + validWords("name", valid));
        const faceSelector selector(patches.subDict(name));
        if (!selector.any()) patches.fail(name, "Say which faces: colour, faces, group or box");
        bool found = false;
        for (cadFace& face : model.faces)
            if (selector.matches(face)) face.surface.patchNames = {name}, found = true;
        if (!found)
            patches.fail(name, "No face of " + model.path + " has " + selector.describe() +
                                   "; the file has " + std::to_string(model.faces.size()) +
                                   " faces with " + coloursOf(model));
    }
}

// Faces in the plane of a flat patch belong to it without being named
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

body particleDict::cadBody(const word& zone, const dictionary& dict)
{
    const cadModel& cad = model(dict);
    const faceSelector selector(dict);
    List<label> tags;
    scalar volume = 0;
    for (const cadVolume& v : cad.volumes)
    {
        bool taken = !selector.any() || selector.matches(v);
        for (const label f : v.faces) taken = taken || selector.matches(cad.face(f));
        if (!taken) continue;
        tags.insert(tags.end(), v.faces.begin(), v.faces.end());
        volume += v.volume;
    }
    if (tags.empty())
        for (const cadFace& f : cad.faces)
            if (!selector.any() || selector.matches(f)) tags.push_back(f.tag);
    if (tags.empty())
        dict.fail("file", "No face of " + cad.path + " has " + selector.describe() + " for zone " +
                              zone + "; the file has " + std::to_string(cad.faces.size()) +
                              " faces with " + coloursOf(cad));
    body b{-1, {}, volume};
    for (const label tag : tags) b.surface.append(cad.face(tag).surface);
    b.surface.weld(dict_.getOrDefault<scalar>("weldTolerance", 1e-3 * dx));
    orientOutward(b.surface);
    const scalar meshed = b.surface.volume();
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
    return b;
}

void particleDict::addZone(const word& name, List<body>& bodies)
{
    const dictionary& dict = dict_.subDict("zones").subDict(name);
    if (dict.found("file") == dict.found("shape"))
        dict.fail("phase", "Zone " + name + " needs either a file or a shape");
    body b = dict.found("file") ? cadBody(name, dict) : shapeBody(dict);
    nameByPlane(b.surface);
    const zoneInfo zone = readZone(name, dict);
    if (zone.phase == phaseType::rigid)
    {
        b.surface.patchNames.assign(b.surface.patchNames.size(), name);
    }
    else
    {
        b.zone = label(zones_.size());
        zones_.push_back(zone);
        initial_.emplace_back(dict, dx);
    }
    bodies.push_back(std::move(b));
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
    if (zones_.empty()) dict_.fail("zones", "At least one zone of phase fluid or solid is needed");
    const word word_ = dict_.chooseOrDefault("placement", {"lattice", "bodyFitted"},
                                             mustFit(bodies) ? "bodyFitted" : "lattice");
    bodyFitted = word_ == "bodyFitted";
    for (const word& key : dict_.keys())  // what an included file holds for other programs
        if (dict_.where(key).file != dict_.path()) dict_.tokens(key);
    dict_.checkAllRead();
    return zoneGeometry(zones_, patches_, std::move(bodies), planes_, defaultPatch_, dx, nDims);
}

}  // namespace ispf
