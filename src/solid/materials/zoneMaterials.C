// SPDX-License-Identifier: GPL-3.0-or-later
#include "zoneMaterials.H"

#include "messages.H"

#include <algorithm>

namespace ispf
{

namespace
{

List<relaxationBranch> branchesOf(const dictionary& dict, scalar G)
{
    if (!dict.found("relaxation")) return {};
    const dictionary& own = dict.subDict("relaxation");
    const List<scalar> moduli = own.get<List<scalar>>("moduli"),
                       times = own.get<List<scalar>>("times", dims::time);
    if (moduli.size() != times.size() || moduli.empty())
        own.fail("moduli", "A branch has one modulus and one time: there are " +
                               std::to_string(moduli.size()) + " moduli and " +
                               std::to_string(times.size()) + " times");
    List<relaxationBranch> branches;
    for (size_t i = 0; i < moduli.size(); ++i)
    {
        const word which = " of branch " + std::to_string(i + 1) + " must be from 1e-12 to ";
        if (!(moduli[i] >= 1e-12 && moduli[i] <= 1e6))
            own.fail("moduli", "The modulus " + str(moduli[i]) + which + "1e6, in units of G");
        if (!(times[i] >= 1e-12 && times[i] <= 1e12))
            own.fail("times", "The time " + str(times[i]) + " s" + which + "1e12 s");
        branches.push_back({moduli[i] * G, times[i]});
    }
    return branches;
}

}  // namespace

zoneMaterials::zoneMaterials(const dictionary& dict, const List<vector>& x0,
                             const List<label>& zone, const List<word>& zoneNames)
    : law_(x0.size(), 0), place_(x0.size())
{
    if (dict.found("material") == dict.found("materials"))
        throw fatalError(
            "structureModel totalLagrangian needs exactly one of 'material { .. }', for all zones, "
            "and 'materials { <zone> { .. } .. }'",
            dict.where());
    if (dict.found("material"))
    {
        for (label k = 0; k < label(x0.size()); ++k) place_[k] = k;
        add(dict.subDict("material"), x0), same_ = {0};
    }
    else
    {
        const dictionary materials = dict.subDict("materials");
        List<word> solid, entries;
        for (label z = 0; z < label(zoneNames.size()); ++z)
        {
            List<vector> places;
            for (label k = 0; k < label(x0.size()); ++k)
                if (zone[k] == z)
                    law_[k] = label(laws_.size()), place_[k] = label(places.size()),
                    places.push_back(x0[k]);
            if (places.empty()) continue;
            solid.push_back(zoneNames[z]);
            if (!materials.found(zoneNames[z]))
                throw fatalError("'materials' has no material for the zone " + zoneNames[z],
                                 materials.where());
            add(materials.subDict(zoneNames[z]), places);
            entries.push_back(materials.valueText(zoneNames[z]));
            same_.push_back(
                label(std::find(entries.begin(), entries.end(), entries.back()) - entries.begin()));
        }
        for (const word& key : materials.keys())
            if (std::find(solid.begin(), solid.end(), key) == solid.end())
                materials.fail(key,
                               "No solid particle is in a zone of this name; zones of solid: " +
                                   join(solid, " "));
        names_ = solid;
    }
}

void zoneMaterials::add(const dictionary& dict, const List<vector>& x0)
{
    laws_.push_back(material::New(dict, x0));
    modulus_.push_back(laws_.back()->shearModulus());
    viscosity_.push_back(
        dict.getInRangeOrDefault<scalar>("viscosity", 0, 1e15, 0, dims::dynamicViscosity));
    branches_.push_back(branchesOf(dict, modulus_.back()));
    fast_.push_back(modulus_.back());
    for (const relaxationBranch& b : branches_.back()) fast_.back() += b.G;
}

bool zoneMaterials::damps() const
{
    return std::any_of(viscosity_.begin(), viscosity_.end(), [](scalar v) { return v > 0; });
}

bool zoneMaterials::remembers() const
{
    return std::any_of(branches_.begin(), branches_.end(),
                       [](const auto& b) { return !b.empty(); });
}

scalar zoneMaterials::stiffest() const
{
    return *std::max_element(fast_.begin(), fast_.end());
}

bool zoneMaterials::differ() const
{
    return std::any_of(same_.begin(), same_.end(), [](label m) { return m > 0; });
}

word zoneMaterials::description() const
{
    List<word> each;
    for (size_t m = 0; m < laws_.size(); ++m)
        each.push_back((names_.empty() ? "" : names_[m] + " ") + laws_[m]->description() + ", G " +
                       str(modulus_[m], 4) + " Pa, E = 3 G " + str(3 * modulus_[m], 4) + " Pa" +
                       (viscosity_[m] > 0 ? ", viscosity " + str(viscosity_[m], 4) + " Pa s" : "") +
                       (branches_[m].empty()
                            ? ""
                            : ", " + std::to_string(branches_[m].size()) +
                                  " relaxing branches, G at once " + str(fast_[m], 4) + " Pa"));
    return join(each, "; ");
}

}  // namespace ispf
