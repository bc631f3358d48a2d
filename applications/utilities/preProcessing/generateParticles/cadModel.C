// SPDX-License-Identifier: GPL-3.0-or-later
#include "cadModel.H"

#include "cadFormat.H"
#include "gmshReader.H"
#include <algorithm>
#include <map>

namespace ispf
{

namespace
{

cadModel fromSTL(const word& path, scalar unit)
{
    cadModel model;
    model.path = path;
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

const std::map<word, scalar> unitsInMetres = {
    {"m", 1},         {"cm", 1e-2},          {"mm", 1e-3},   {"um", 1e-6},
    {"km", 1e3},      {"inch", 25.4e-3},     {"ft", 0.3048}, {"mile", 1609.344},
    {"mil", 25.4e-6}, {"microinch", 25.4e-9}};

scalar unitInMetres(const word& unit)
{
    const auto at = unitsInMetres.find(unit);
    List<word> names;
    for (const auto& k : unitsInMetres) names.push_back(k.first);
    if (at == unitsInMetres.end())
        throw fatalError("The unit " + unit + " is not known. " + validWords("unit", names));
    return at->second;
}

// The unit of the file's numbers
word unitOf(const word& path, const cadFormat& format, const word& asked)
{
    if (!asked.empty()) unitInMetres(asked);
    if (!format.declaredUnit.empty())
    {
        if (!asked.empty() && asked != format.declaredUnit)
            throw fatalError("The file " + path + " declares that it is in " + format.declaredUnit +
                             ", but 'unit " + asked + ";' says " + asked +
                             ". Remove the entry if the file is right, otherwise export it again "
                             "in its true unit");
        if (!unitsInMetres.count(format.declaredUnit))
            warning(path + " declares that it is in " + format.declaredUnit +
                    ", which is not one known unit: its reader may have taken it for mm. Look at "
                    "the size that is reported");
        return format.declaredUnit;
    }
    if (format.declares() && asked.empty())
    {
        warning(path +
                " declares no unit that is known: it is read in mm. If that is so, say "
                "'unit mm;'");
        return "mm";
    }
    if (!asked.empty()) return asked;
    if (format.name != "BREP")
        throw fatalError(
            "Files of this format do not state their unit: give 'unit mm;' or "
            "another unit beside the file " +
            path);
    warning("A .brep file does not state its unit: " + path +
            " is read in mm. If that is so, say 'unit mm;'");
    return "mm";
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
    const cadFormat format = recognisedFormat(path);
    const word unitName = unitOf(path, format, settings.unit);
    // gmsh converts a STEP file that declares its unit to mm.  It takes an IGES file for one in mm: it would take one
    // without a unit for one in inch, and knows no model scale
    const bool iges = format.name == "IGES", converted = !format.declaredUnit.empty() &&
                                                         (!iges || !unitsInMetres.count(unitName));
    const scalar unit = unitInMetres(converted ? "mm" : unitName) / format.modelScale;
    cadModel model = format.name == "STL"
                         ? fromSTL(path, unit)
                         : meshWithGmsh(path, {settings.meshSize / unit, unit, settings.timeLimit,
                                               format.inMillimetres});
    model.unit = unitName;
    model.givenFacets = format.name == "STL" || format.name == "gmsh-mesh";
    model.origin = format.name + (format.declaredUnit.empty()
                                      ? " in " + unitName
                                      : " in " + format.declaredUnit + ", as it declares");
    if (format.modelScale != 1)
        model.origin += ", model scale " + str(format.modelScale) + ": lengths are divided by it";
    return model;
}

}  // namespace ispf
