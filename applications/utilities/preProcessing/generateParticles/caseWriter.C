// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseWriter.H"

#include "heldSignals.H"
#include "particleTable.H"
#include "restState.H"
#include "stlWriter.H"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace ispf
{

namespace
{

// In two dimensions surfaces are prisms of any height: writes a slice of the height dx
triSurface forDisk(const triSurface& surface, const zoneGeometry& geometry)
{
    if (geometry.nDims() == 3) return surface;
    const vector up = 0.5 * geometry.dx() * vector::UnitZ();
    return clipped(clipped(surface, {up, vector::UnitZ()}), {-up, -vector::UnitZ()});
}

word phaseWord(const zoneInfo& zone)
{
    return zone.phase == phaseType::fluid ? "fluid" : zone.fixed ? "clamped" : "solid";
}

particleTable emptyTable(const zoneGeometry& geometry, const List<word>& sources)
{
    particleTable table;
    table.setAttribute("time", 0);
    table.setAttribute("dx", geometry.dx());
    table.setAttribute("nDims", geometry.nDims());
    table.attributes["source"] = join(sources);
    return table;
}

// Point and normal of each, six numbers
word planesText(const zoneGeometry& geometry)
{
    List<word> numbers;
    for (const halfSpace& plane : geometry.symmetryPlanes())
        for (const vector& v : {plane.point, plane.normal})
            for (const scalar x : v) numbers.push_back(str(x, 17));
    return join(numbers);
}

List<word> patchNames(const zoneGeometry& geometry)
{
    List<word> names;
    for (const patchInfo& p : geometry.patches()) names.push_back(p.name);
    return names;
}

List<namedText> surfaceTexts(const word& caseFolder, const zoneGeometry& geometry,
                             const List<initialFields>& initial)
{
    List<namedText> files;
    const word folder = caseFolder + "/constant/triSurface/";
    for (size_t p = 0; p < geometry.patches().size(); ++p)
    {
        if (geometry.patchSurface(label(p)).empty()) continue;
        triSurface s = forDisk(geometry.patchSurface(label(p)), geometry);
        s.patchNames = {geometry.patches()[p].name};
        s.patch.assign(s.patch.size(), 0);
        files.push_back(stlText(s, folder + geometry.patches()[p].name + ".stl"));
    }
    for (size_t a = 0; a < geometry.zones().size(); ++a)
        for (const zoneInfo& fluid : geometry.zones())
        {
            const zoneInfo& solid = geometry.zones()[a];
            const triSurface& s = geometry.boundary(label(a));
            const word side = zoneGeometry::towards(fluid.name);
            const bool touch =
                std::find(s.patchNames.begin(), s.patchNames.end(), side) != s.patchNames.end();
            if (solid.phase != phaseType::solid || fluid.phase != phaseType::fluid || !touch)
                continue;
            triSurface part = atRest(forDisk(s.patchSurface(side), geometry), initial[a], geometry);
            const word name = solid.name + "_to_" + fluid.name;
            part.patchNames = {name};
            files.push_back(stlText(part, folder + name + ".stl"));
        }
    return files;
}

// Names of the surfaces that generateParticles has made, one a line
word listOf(const word& caseFolder)
{
    return caseFolder + "/constant/triSurface/.generated";
}

// Surfaces of an earlier run that are not among the present ones.  A pattern of constant/boundary would match them
List<word> oldSurfaces(const word& caseFolder, const List<namedText>& present)
{
    List<word> old;
    std::ifstream list(listOf(caseFolder));
    for (word name; std::getline(list, name);)
    {
        const word path = caseFolder + "/constant/triSurface/" + name + ".stl";
        const bool remains = std::any_of(present.begin(), present.end(),
                                         [&](const namedText& f) { return f.path == path; });
        if (!remains && name.find('/') == word::npos) old.push_back(path);
    }
    return old;
}

namedText listOfSurfaces(const word& caseFolder, const List<namedText>& surfaces)
{
    word names;
    for (const namedText& f : surfaces)
        names += std::filesystem::path(f.path).stem().string() + "\n";
    return {listOf(caseFolder), names};
}

}  // namespace

void writeCase(const word& caseFolder, const zoneGeometry& geometry, const placedParticles& placed,
               const List<initialFields>& initial, const List<word>& sources, label stripLayers)
{
    particleTable particles = emptyTable(geometry, sources);
    particles.x = placed.x;
    for (size_t i = 0; i < placed.x.size(); ++i)
    {
        const initialFields& fields = initial[placed.zone[i]];
        particles.vectors["U"].push_back(fields.U(placed.x[i]));
        particles.scalars["p"].push_back(fields.p(placed.x[i]));
    }
    if (restsElsewhere(initial)) particles.vectors["x0"] = restPositions(geometry, placed, initial);
    particles.integers["zone"].assign(placed.zone.begin(), placed.zone.end());
    auto& id = particles.integers["id"];
    id.resize(placed.x.size());
    std::iota(id.begin(), id.end(), 0);
    List<word> names, phases;
    for (const zoneInfo& z : geometry.zones())
        names.push_back(z.name), phases.push_back(phaseWord(z));
    particles.attributes["zones"] = join(names);
    particles.attributes["phases"] = join(phases);
    if (const word planes = planesText(geometry); !planes.empty())
        particles.attributes["symmetryPlanes"] = planes;

    particleTable walls = emptyTable(geometry, sources), sites = walls;
    walls.x = placed.rigid;
    walls.integers["patch"].assign(placed.rigidPatch.begin(), placed.rigidPatch.end());
    for (size_t i = 0; i < placed.x.size(); ++i)
    {
        if (placed.strip[i] < 0) continue;
        sites.x.push_back(placed.x[i]);
        sites.integers["patch"].push_back(placed.strip[i]);
        sites.integers["zone"].push_back(placed.zone[i]);
    }
    walls.attributes["patches"] = sites.attributes["patches"] = join(patchNames(geometry));
    sites.attributes["zones"] = particles.attributes["zones"];
    sites.setAttribute("stripLayers", stripLayers);

    const heldSignals untilDone;
    List<namedText> files = surfaceTexts(caseFolder, geometry, initial);
    const List<word> old = oldSurfaces(caseFolder, files);
    files.push_back(listOfSurfaces(caseFolder, files));
    for (const auto& [table, file] :
         {std::pair(&walls, "/constant/wallParticles.hdf"),
          std::pair(&sites, "/constant/openSites.hdf"), std::pair(&particles, "/0/particles.hdf")})
        if (table->size() > 0) files.push_back(particleText(*table, caseFolder + file));
    writeTexts(files);
    // an earlier run's files would be taken for valid
    for (const word& path : old) std::filesystem::remove(path);
    if (walls.size() == 0) std::filesystem::remove(caseFolder + "/constant/wallParticles.hdf");
    if (sites.size() == 0) std::filesystem::remove(caseFolder + "/constant/openSites.hdf");
}

}  // namespace ispf
