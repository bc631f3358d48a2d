// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleFields.H"

#include <algorithm>

namespace ispf
{

particleField::particleField(const particleCloud& cloud, const word& name,
                             const fileLocation& where)
    : cloud_(cloud), name_(name), kind_(kindOf(cloud, name))
{
    if (kind_ != kind::none) return;
    List<word> valid = {"U", "p"};
    if (cloud.vectors.count("x0") > 0) valid.push_back("displacement");
    for (const auto& s : cloud.scalars) valid.push_back(s.first);
    for (const auto& v : cloud.vectors) valid.push_back(v.first);
    throw fatalError("There is no field '" + name + "'. " + validWords("field", valid), where);
}

particleField::kind particleField::kindOf(const particleCloud& cloud, const word& name)
{
    if (name == "U") return kind::velocity;
    if (name == "p") return kind::pressure;
    if (cloud.vectors.count(name) > 0) return kind::vector;
    if (cloud.scalars.count(name) > 0) return kind::scalar;
    return name == "displacement" && cloud.vectors.count("x0") > 0 ? kind::displacement
                                                                   : kind::none;
}

scalar particleField::at(label i) const
{
    return kind_ == kind::pressure ? cloud_.Up[i][3] : cloud_.scalars.at(name_)[i];
}

vector particleField::vectorAt(label i) const
{
    switch (kind_)
    {
        case kind::velocity:
            return cloud_.Up[i].xyz();
        case kind::displacement:
            return cloud_.x[i].xyz() - cloud_.vectors.at("x0")[i].xyz();
        default:
            return cloud_.vectors.at(name_)[i].xyz();
    }
}

List<word> particleField::titles() const
{
    if (!isVector()) return {name_};
    return {name_ + "_x", name_ + "_y", name_ + "_z"};
}

List<particleField> fieldsOf(const particleCloud& cloud, const dictionary& dict,
                             const List<word>& defaults)
{
    List<particleField> fields;
    for (const word& name : dict.getOrDefault<List<word>>("fields", defaults))
        fields.emplace_back(cloud, name, dict.where("fields"));
    return fields;
}

particleSelection::particleSelection(const particleCloud& cloud, const dictionary& dict,
                                     const word& defaultPhase)
    : zone_(cloud.zones.size(), 0)
{
    const word phase = dict.chooseOrDefault("phase", {"fluid", "solid", "all"}, defaultPhase);
    if (dict.found("zones"))
    {
        if (dict.found("phase")) dict.fail("zones", "Give either zones or phase, not both.");
        const List<word> names = dict.get<List<word>>("zones");
        if (names.empty()) dict.fail("zones", "At least one zone is wanted.");
        for (const word& name : names) zone_[cloud.zoneIndex(name, dict.where("zones"))] = 1;
        return;
    }
    for (size_t z = 0; z < cloud.zones.size(); ++z)
        zone_[z] =
            phase == "all" || (phase == "fluid") == (cloud.zones[z].phase == phaseType::fluid);
    if (std::count(zone_.begin(), zone_.end(), 1) == 0)
        dict.fail("phase", "No zone of the case is " + phase + ": give 'zones' or another phase.");
}

}  // namespace ispf
