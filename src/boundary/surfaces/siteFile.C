// SPDX-License-Identifier: GPL-3.0-or-later
#include "siteFile.H"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace ispf
{

siteFile::siteFile(const word& path) : path_(path)
{
    if (!std::filesystem::exists(path))
        throw fatalError("Cannot find " + path +
                         ", which the patches of constant/boundary need. "
                         "generateParticles writes it");
    const particleTable table = readParticles(path);
    const auto attribute = table.attributes.find("patches");
    const auto column = table.integers.find("patch");
    if (attribute == table.attributes.end() || column == table.integers.end())
        throw fatalError(path +
                         " needs the integer field 'patch' and the attribute 'patches' with "
                         "the names. Write it anew with generateParticles");
    if (table.attributes.count("stripLayers"))
    {
        const scalar layers = table.scalarAttribute("stripLayers");
        stripLayers_ = label(std::clamp<scalar>(layers, 0, mostStripLayers + 1));
        if (stripLayers_ != layers || layers < leastStripLayers || layers > mostStripLayers)
            throw fatalError(
                path + ": the attribute stripLayers is " + table.attributes.at("stripLayers") +
                ", but must be a whole number from " + std::to_string(leastStripLayers) + " to " +
                std::to_string(mostStripLayers));
    }
    std::istringstream in(attribute->second);
    List<word> names;
    for (word name; in >> name;) names.push_back(name);
    for (const word& name : names) points_[name];
    for (size_t k = 0; k < table.size(); ++k)
    {
        const globalId patch = column->second[k];
        if (patch < 0 || patch >= globalId(names.size()))
            throw fatalError(path + ": point " + std::to_string(k) + " has patch " +
                             std::to_string(patch) + ", but the attribute 'patches' lists " +
                             std::to_string(names.size()) + " names");
        points_[names[size_t(patch)]].push_back(table.x[k]);
    }
}

void siteFile::checkPatches(const dictionary& patches) const
{
    const List<word> known = patches.keys();
    for (const auto& [name, points] : points_)
        if (!points.empty() && !patches.found(name))
            throw fatalError(path_ + " has " + std::to_string(points.size()) +
                                 " points of a patch '" + name +
                                 "', which constant/boundary lacks." + didYouMean(name, known) +
                                 "\n" + validWords("patch", known) +
                                 "\nGive it an entry, or run generateParticles again",
                             patches.where());
}

List<vector> siteFile::positions(const word& patch, const fileLocation& where) const
{
    const auto found = points_.find(patch);
    if (found != points_.end() && !found->second.empty()) return found->second;
    List<word> names;
    for (const auto& [name, points] : points_)
        if (!points.empty()) names.push_back(name);
    throw fatalError("Patch " + patch + " has no point in " + path_ + ". " +
                         validWords("patch", names) +
                         ". Name it alike in constant/boundary and for generateParticles",
                     where);
}

}  // namespace ispf
