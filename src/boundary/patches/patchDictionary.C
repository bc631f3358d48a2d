// SPDX-License-Identifier: GPL-3.0-or-later
#include "patchDictionary.H"

#include <algorithm>
#include <filesystem>

namespace ispf
{

namespace
{

bool isBetweenZones(const word& surface, const List<zoneInfo>& zones)
{
    for (const zoneInfo& a : zones)
        for (const zoneInfo& b : zones)
            if (surface == a.name + "_to_" + b.name) return true;
    return false;
}

// In alphabetical order, so that the order of patches does not depend on the disk
List<word> surfacesOf(const word& caseFolder)
{
    List<word> names;
    std::error_code ignored;
    for (const auto& item :
         std::filesystem::directory_iterator(caseFolder + "/constant/triSurface", ignored))
        if (item.path().extension() == ".stl") names.push_back(item.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

bool resolvePattern(dictionary& patches, const word& name)
{
    const List<word> literal = patches.keys();
    if (name.empty() || std::find(literal.begin(), literal.end(), name) != literal.end() ||
        !patches.isDict(name))
        return false;
    const dictionary entry = patches.subDict(name);
    patches.subDictOrAdd(name) = entry;
    return true;
}

dictionary readPatchDictionary(const word& caseFolder, const List<zoneInfo>& zones)
{
    dictionary patches = dictionary::fromFile(caseFolder + "/constant/boundary");
    if (patches.allKeys().size() == patches.keys().size()) return patches;
    for (const word& name : surfacesOf(caseFolder))
        if (!isBetweenZones(name, zones)) resolvePattern(patches, name);
    return patches;
}

}  // namespace ispf
