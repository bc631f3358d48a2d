// SPDX-License-Identifier: GPL-3.0-or-later
// gmsh runs in a child process and returns its result as bytes
#include "gmshReader.H"

#include "guardedProcess.H"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmsh.h>
#include <map>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>
#include <unordered_map>

namespace ispf
{

namespace
{

// OpenCASCADE gives colours in linear light; files and CAD programs use sRGB
int toSRGB(int linear)
{
    const scalar c = linear / 255.0;
    return int(
        std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
}

constexpr scalar mostAcross = 5000;  // mesh sizes over a part: more takes hours

void check(bool ok, const word& what)
{
    if (ok) return;
    std::string reason;
    gmsh::logger::getLastError(reason);
    throw std::runtime_error(what + (reason.empty() ? word() : ": " + reason));
}

// gmsh continues a script after a line that it cannot read or a file that does not exist
void checkScript(const word& path)
{
    std::string error;
    gmsh::logger::getLastError(error);
    if (std::filesystem::path(path).extension() == ".geo" && !error.empty())
        throw std::runtime_error("gmsh stumbles over it: " + error);
}

// Default time limits [s], for a slow machine: OpenCASCADE reads some 100 kB per second, gmsh makes
// some 1000 triangles per second; a task that takes ten times as long will not end
scalar readingTime(const word& path, const gmshSettings& settings)
{
    return settings.timeLimit > 0 ? settings.timeLimit
                                  : 60 + 1e-4 * scalar(std::filesystem::file_size(path));
}

// Memory for reading [byte].  A file whose entities refer to themselves would take any
size_t readingMemory(const word& path)
{
    constexpr size_t least = 1000000000, perByte = 2000;
    return least + perByte * size_t(std::filesystem::file_size(path));
}

// Ends the limit on memory: what a mesh takes depends on its size, which is known after reading
void liftMemoryLimit()
{
    rlimit memory;
    if (getrlimit(RLIMIT_AS, &memory) != 0) return;
    memory.rlim_cur = memory.rlim_max;
    setrlimit(RLIMIT_AS, &memory);
}

scalar meshingTime(const gmshSettings& settings)
{
    if (settings.timeLimit > 0) return settings.timeLimit;
    scalar area = 0;  // in the units of the file
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    for (const auto& [dim, tag] : surfaces)
    {
        double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
        gmsh::model::getBoundingBox(dim, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
        area += 2 * (vector(high) - vector(low)).squaredNorm();
    }
    return 60 + 0.02 * area / (settings.meshSize * settings.meshSize);
}

void openFile(const word& path, const gmshSettings& settings, const grantTime& grant)
{
    const scalar meshSize = settings.meshSize;
    gmsh::initialize(0, nullptr, false);  // ignores options that the user has set elsewhere
    gmsh::option::setNumber("General.Verbosity", 2);
    gmsh::option::setNumber("General.AbortOnError", 1);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::option::setNumber("Mesh.CharacteristicLengthMax", meshSize);
    gmsh::option::setNumber("Mesh.CharacteristicLengthFromCurvature", 1);
    gmsh::option::setNumber("Mesh.MinimumElementsPerTwoPi", 36);
    gmsh::open(path);
    liftMemoryLimit();
    checkScript(path);
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    check(!surfaces.empty(), "the file holds no surface");
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 2);
    if (!types.empty()) return;
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    const scalar size = (vector(high) - vector(low)).norm();
    check(size < mostAcross * meshSize,
          "it measures " + str(size / meshSize) +
              " times the mesh size (surfaceSize, by default dx): are dx and the unit right?");
    grant(meshingTime(settings));
    gmsh::model::mesh::generate(2);
}

std::map<std::pair<int, int>, List<word>> physicalGroups()
{
    std::map<std::pair<int, int>, List<word>> names;
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    for (const auto& [dim, tag] : groups)
    {
        std::string name;
        gmsh::model::getPhysicalName(dim, tag, name);
        std::vector<int> members;
        gmsh::model::getEntitiesForPhysicalGroup(dim, tag, members);
        for (const int m : members)
            names[{dim, m}].push_back(name.empty() ? std::to_string(tag) : name);
    }
    return names;
}

// Corners of the triangles of one face; quadrangles are split
List<vector> trianglesOf(int face, const std::unordered_map<std::size_t, vector>& position)
{
    List<vector> corners;
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 2, face);
    for (size_t k = 0; k < types.size(); ++k)
    {
        const size_t stride = nodes[k].size() / std::max<size_t>(1, elements[k].size());
        const bool quad = types[k] == 3 || types[k] == 10 || types[k] == 16;
        for (size_t e = 0; e + stride <= nodes[k].size(); e += stride)
            for (const int c : quad ? List<int>{0, 1, 2, 0, 2, 3} : List<int>{0, 1, 2})
                corners.push_back(position.at(nodes[k][e + c]));
    }
    return corners;
}

// A file in the folder for temporary files that is gone with the object
class temporaryFile
{
public:
    temporaryFile(const word& content, const word& type)
    {
        path_ = (std::filesystem::temp_directory_path() / ("ispfXXXXXX" + type)).string();
        const int file = mkstemps(path_.data(), int(type.size()));
        if (file < 0) throw fatalError("Cannot make the temporary file " + path_);
        close(file);
        std::ofstream out(path_, std::ios::binary);
        out << content;
        if (!out.flush()) throw fatalError("Cannot write the temporary file " + path_);
    }
    temporaryFile(const temporaryFile&) = delete;
    ~temporaryFile() { std::remove(path_.c_str()); }

    const word& path() const { return path_; }

private:
    word path_;
};

void meshInChild(const word& path, const gmshSettings& settings, const grantTime& grant,
                 packer& out)
{
    openFile(path, settings, grant);
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters);
    std::unordered_map<std::size_t, vector> position;
    for (size_t n = 0; n < tags.size(); ++n) position[tags[n]] = vector(&x[3 * n]);

    const auto groups = physicalGroups();
    const auto groupsOf = [&](int dim, int tag) {
        const auto at = groups.find({dim, tag});
        return at == groups.end() ? List<word>() : at->second;
    };
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 2);
    out.put(entities.size());
    for (const auto& [dim, tag] : entities)
    {
        int r = 0, g = 0, b = 0, a = 0;
        gmsh::model::getColor(dim, tag, r, g, b, a);
        // for entities without a colour gmsh returns a transparent blue
        out.put(tag), out.put(a > 0);
        for (const int c : {r, g, b}) out.put(toSRGB(c));
        out.putWords(groupsOf(2, tag));
        out.putList(trianglesOf(tag, position));
    }
    gmsh::model::getEntities(entities, 3);
    out.put(entities.size());
    for (const auto& [dim, tag] : entities)
    {
        gmsh::vectorpair boundary;
        gmsh::model::getBoundary({{dim, tag}}, boundary, false, false, false);
        List<label> faces;
        for (const auto& f : boundary) faces.push_back(std::abs(f.second));
        out.put(tag), out.putList(faces), out.putWords(groupsOf(3, tag));
        double mass = 0;
        std::string type;
        gmsh::model::getType(dim, tag, type);
        if (type != "Discrete volume") gmsh::model::occ::getMass(dim, tag, mass);
        out.put(mass);
    }
    gmsh::finalize();
}

cadModel unpack(unpacker in, const word& path, scalar unit)
{
    cadModel model;
    model.path = path;
    for (size_t n = in.get<size_t>(); n > 0; --n)
    {
        cadFace face;
        face.tag = in.get<int>();
        face.coloured = in.get<bool>();
        for (int& c : face.colour) c = in.get<int>();
        face.groups = in.getWords();
        face.surface.addPatch("");
        const auto corners = in.getList<vector>();
        for (size_t k = 0; k + 2 < corners.size(); k += 3)
            face.surface.add(unit * corners[k], unit * corners[k + 1], unit * corners[k + 2], 0);
        model.faces.push_back(std::move(face));
    }
    for (size_t n = in.get<size_t>(); n > 0; --n)
    {
        cadVolume volume;
        volume.tag = in.get<int>();
        volume.faces = in.getList<label>();
        volume.groups = in.getWords();
        volume.volume = std::abs(in.get<double>()) * unit * unit * unit;
        model.volumes.push_back(std::move(volume));
    }
    return model;
}

}  // namespace

cadModel meshWithGmsh(const word& path, const gmshSettings& settings)
{
    processLimits limits;
    limits.seconds = readingTime(path, settings);
    limits.memory = readingMemory(path);
    limits.ifEnded =
        " Is the file damaged, or does one of its entities refer to itself? Export it again.";
    limits.ifTooLong =
        " Is the unit right, the mesh size (surfaceSize) not absurdly small? 'timeLimit' sets the "
        "seconds it may take.";
    std::optional<temporaryFile> replacement;
    if (!settings.replacement.empty()) replacement.emplace(settings.replacement, ".igs");
    const auto job = [&](packer& out, const grantTime& grant) {
        meshInChild(replacement ? replacement->path() : path, settings, grant, out);
    };
    return unpack(runGuarded("Meshing " + path + " with gmsh", limits, job), path, settings.unit);
}

}  // namespace ispf
