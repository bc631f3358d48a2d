// SPDX-License-Identifier: GPL-3.0-or-later
// gmsh runs in a child process and hands its result over as bytes
#include "cadModel.H"

#include "fileNames.H"
#include "guardedProcess.H"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <gmsh.h>
#include <map>
#include <unordered_map>

namespace ispf
{

namespace
{

// Plain bytes, the same on both sides of one machine
struct packer
{
    word bytes;
    template <class T>
    void put(const T& value)
    {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    template <class T>
    void putList(const List<T>& list)
    {
        put(list.size());
        bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    }
    void putWords(const List<word>& list)
    {
        put(list.size());
        for (const word& w : list) putList(List<char>(w.begin(), w.end()));
    }
};

struct unpacker
{
    const word& bytes;
    size_t at = 0;
    void take(void* to, size_t n)
    {
        if (at + n > bytes.size()) throw fatalError("gmsh's result is cut off");
        std::memcpy(to, &bytes[at], n);
        at += n;
    }
    template <class T>
    T get()
    {
        T value;
        take(&value, sizeof(T));
        return value;
    }
    template <class T>
    List<T> getList()
    {
        List<T> list(get<size_t>());
        if (!list.empty()) take(list.data(), list.size() * sizeof(T));
        return list;
    }
    List<word> getWords()
    {
        List<word> list(get<size_t>());
        for (word& w : list)
        {
            const auto letters = getList<char>();
            w.assign(letters.begin(), letters.end());
        }
        return list;
    }
};

// OpenCASCADE hands colours over in linear light; files and CAD programs show sRGB
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
    throw fatalError(what + (reason.empty() ? word() : ": " + reason));
}

// A script goes on after a line that it cannot read or a file that is not there
void checkScript(const word& path)
{
    std::string error;
    gmsh::logger::getLastError(error);
    if (std::filesystem::path(path).extension() == ".geo" && !error.empty())
        throw fatalError("gmsh stumbles over it: " + error);
}

void openFile(const word& path, scalar meshSize)
{
    gmsh::initialize();
    gmsh::option::setNumber("General.Verbosity", 2);
    gmsh::option::setNumber("General.AbortOnError", 1);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::option::setNumber("Mesh.CharacteristicLengthMax", meshSize);
    gmsh::option::setNumber("Mesh.CharacteristicLengthFromCurvature", 1);
    gmsh::option::setNumber("Mesh.MinimumElementsPerTwoPi", 36);
    gmsh::open(path);
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

word meshInChild(const word& path, scalar meshSize)
{
    openFile(path, meshSize);
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
    packer out;
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 2);
    out.put(entities.size());
    for (const auto& [dim, tag] : entities)
    {
        int r = 0, g = 0, b = 0, a = 0;
        gmsh::model::getColor(dim, tag, r, g, b, a);
        // gmsh answers a transparent blue for entities without a colour of their own
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
    return out.bytes;
}

cadModel unpack(const word& bytes, scalar unit)
{
    cadModel model;
    unpacker in{bytes};
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

cadModel fromSTL(const word& path, scalar unit)
{
    cadModel model;
    triSurface all = readSTL(path);
    all.scale(unit);
    for (const word& name : all.patchNames)
    {
        cadFace face;
        face.tag = label(model.faces.size()) + 1;
        face.groups = {name};
        face.surface = all.patchSurface(name);
        face.surface.patchNames = {""};
        model.faces.push_back(std::move(face));
    }
    return model;
}

scalar unitInMetres(const word& unit)
{
    static const std::map<word, scalar> known = {
        {"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"inch", 25.4e-3}};
    const auto at = known.find(unit);
    List<word> names;
    for (const auto& k : known) names.push_back(k.first);
    if (at == known.end())
        throw fatalError("The unit " + unit + " is not known. " + validWords("unit", names));
    return at->second;
}

}  // namespace

namespace
{

// OpenCASCADE and gmsh take what there is of a file; the formats that say where they end are looked at
void checkWhole(const word& path, const word& type)
{
    const bool iges = type == ".igs" || type == ".iges", step = type == ".stp" || type == ".step",
               msh = type == ".msh";
    if (!iges && !step && !msh) return;
    const word text = readText(path);
    const size_t end = text.find_last_not_of(" \r\n\t");
    const word last = end == word::npos ? "" : text.substr(text.find_last_of('\n', end) + 1);
    const bool whole = iges   ? last.size() > 72 && last[72] == 'T'
                       : step ? last.find("END-ISO-10303-21;") != word::npos
                              : last.rfind("$End", 0) == 0;
    if (!whole)
        throw fatalError("The file " + path + " is cut off: its last line should " +
                         (iges   ? "have a T in column 73"
                          : step ? "be END-ISO-10303-21;"
                                 : "begin with $End"));
}

}  // namespace

const cadFace& cadModel::face(label tag) const
{
    const auto at =
        std::find_if(faces.begin(), faces.end(), [tag](const cadFace& f) { return f.tag == tag; });
    if (at == faces.end())
        throw fatalError(path + " has no face " + std::to_string(tag) +
                         "; faces are numbered 1 to " +
                         std::to_string(faces.empty() ? 0 : faces.back().tag));
    return *at;
}

cadModel readCad(const word& path, const cadSettings& settings)
{
    if (!std::filesystem::exists(path)) throw fatalError("There is no geometry file " + path);
    word type = std::filesystem::path(path).extension().string();
    std::transform(type.begin(), type.end(), type.begin(), [](char c) { return std::tolower(c); });
    const List<word> declaring = {".igs", ".iges", ".stp", ".step"};
    const List<word> plain = {".brep", ".geo", ".msh", ".stl"};
    word unitName = settings.unit;
    const auto isOne = [&](const List<word>& types) {
        return std::find(types.begin(), types.end(), type) != types.end();
    };
    if (!isOne(declaring) && !isOne(plain))
    {
        List<word> valid = declaring;
        valid.insert(valid.end(), plain.begin(), plain.end());
        throw fatalError("The type of " + path + " is not known. " + validWords("type", valid));
    }
    if (isOne(declaring))
    {
        if (!unitName.empty() && unitName != "mm")
            throw fatalError("The file " + path + " declares its own unit: remove 'unit " +
                             unitName + ";'");
        unitName = "mm";  // gmsh converts
    }
    else if (type == ".brep" && unitName.empty())
    {
        warning("A .brep file does not say what its numbers mean: " + path +
                " is read in mm. If that is so, say 'unit mm;'");
        unitName = "mm";
    }
    else if (unitName.empty())
        throw fatalError("A " + type +
                         " file does not say what its numbers mean: give 'unit mm;' or "
                         "whatever it is beside the file " +
                         path);
    checkWhole(path, type);
    const scalar unit = unitInMetres(unitName);
    cadModel model;
    if (type == ".stl") model = fromSTL(path, unit);
    else
        model = unpack(runGuarded("Meshing " + path + " with gmsh", settings.timeLimit,
                                  [&] { return meshInChild(path, settings.meshSize / unit); }),
                       unit);
    model.path = path, model.unit = unitName;
    return model;
}

}  // namespace ispf
