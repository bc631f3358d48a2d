// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleFields.H"

#include <algorithm>

namespace ispf
{

namespace
{

const List<word> ofStructure = {"stretches", "vonMises", "F_x",     "F_y",
                                "F_z",       "sigma_x",  "sigma_y", "sigma_z"};

}  // namespace

const List<word>& solidFieldNames()
{
    static const List<word> names = [] {
        List<word> all = {"displacement"};
        all.insert(all.end(), ofStructure.begin(), ofStructure.end());
        return all;
    }();
    return names;
}

particleField::particleField(const particleCloud& cloud, const word& name,
                             const fileLocation& where, const fsiCase* c)
    : cloud_(cloud), name_(name), kind_(kindOf(c))
{
    if (kind_ != kind::none) return;
    List<word> valid = {"U", "p"};
    if (cloud.vectors.count("x0") > 0) valid.push_back("displacement");
    if (c && c->structure) valid.insert(valid.end(), ofStructure.begin(), ofStructure.end());
    for (const auto& s : cloud.scalars) valid.push_back(s.first);
    for (const auto& v : cloud.vectors) valid.push_back(v.first);
    throw fatalError("There is no field '" + name + "'. " + validWords("field", valid), where);
}

particleField::kind particleField::kindOf(const fsiCase* c)
{
    if (name_ == "U") return kind::velocity;
    if (name_ == "p") return kind::pressure;
    if (cloud_.vectors.count(name_) > 0) return kind::vector;
    if (cloud_.scalars.count(name_) > 0) return kind::scalar;
    if (name_ == "displacement")
        return cloud_.vectors.count("x0") ? kind::displacement : kind::none;
    if (!c || !c->structure ||
        std::find(ofStructure.begin(), ofStructure.end(), name_) == ofStructure.end())
        return kind::none;
    solid_ = std::make_shared<solidFields>(*c);
    if (name_ == "vonMises") return kind::vonMises;
    if (name_ == "stretches") return kind::stretches;
    row_ = name_.back() - 'x';
    return name_[0] == 'F' ? kind::gradient : kind::stress;
}

scalar particleField::at(label i) const
{
    if (kind_ == kind::pressure) return cloud_.Up[i][3];
    if (kind_ == kind::scalar) return cloud_.scalars.at(name_)[i];
    return cloud_.isFluid(i) ? 0 : vonMisesOf(solid_->sigma(i));
}

vector particleField::vectorAt(label i, const tensor& R) const
{
    if (kind_ == kind::velocity) return R * cloud_.Up[i].xyz();
    if (kind_ == kind::vector) return R * cloud_.vectors.at(name_)[i].xyz();
    if (cloud_.isFluid(i)) return vector::Zero();
    if (kind_ == kind::displacement)
        return R * (cloud_.x[i].xyz() - cloud_.vectors.at("x0")[i].xyz());
    if (kind_ == kind::stretches) return stretchesOf(solid_->F(i));
    const tensor& T = kind_ == kind::gradient ? solid_->F(i) : solid_->sigma(i);
    return (R * T * R.transpose()).row(row_).transpose();
}

List<word> particleField::titles() const
{
    if (!isVector()) return {name_};
    if (kind_ == kind::stretches) return {name_ + "_1", name_ + "_2", name_ + "_3"};
    return {name_ + "_x", name_ + "_y", name_ + "_z"};
}

List<particleField> fieldsOf(const particleCloud& cloud, const dictionary& dict,
                             const List<word>& defaults, const fsiCase* c)
{
    List<particleField> fields;
    for (const word& name : dict.getOrDefault<List<word>>("fields", defaults))
    {
        fields.emplace_back(cloud, name, dict.where("fields"), c);
        for (const particleField& f : fields) fields.back().shareWith(f);
    }
    if (fields.empty() && !defaults.empty())
        dict.fail("fields", "It names no field and has no effect");
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
