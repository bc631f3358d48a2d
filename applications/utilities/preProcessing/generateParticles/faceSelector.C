// SPDX-License-Identifier: GPL-3.0-or-later
#include "faceSelector.H"

#include <algorithm>

namespace ispf
{

namespace
{

// Colours change a little by the conversion to linear light and percentages
constexpr int colourTolerance = 6;

bool has(const List<word>& list, const word& name)
{
    return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

faceSelector::faceSelector(const dictionary& dict)
{
    if (dict.found("colour"))
    {
        hasColour_ = true;
        colour_ = dict.get<List<label>>("colour");
        const auto valid = [](label c) { return c >= 0 && c <= 255; };
        if (colour_.size() != 3 || !std::all_of(colour_.begin(), colour_.end(), valid))
            dict.fail("colour", "A colour is three numbers (r g b), 0 to 255");
    }
    if (dict.found("faces")) faces_ = dict.get<List<label>>("faces"), where_ = dict.where("faces");
    if (dict.found("group")) group_ = dict.get<word>("group");
    if (dict.found("box"))
    {
        const auto corners = dict.get<List<vector>>("box", dims::length);
        if (corners.size() != 2) dict.fail("box", "A box is two corners: ((x y z) (x y z)), in m");
        hasBox_ = true;
        box_.add(corners[0]), box_.add(corners[1]);
    }
}

bool faceSelector::marks(const cadFace& face) const
{
    if (hasColour_ && face.coloured)
    {
        bool same = true;
        for (int k = 0; k < 3; ++k)
            same = same && std::abs(face.colour[k] - colour_[k]) <= colourTolerance;
        if (same) return true;
    }
    if (std::find(faces_.begin(), faces_.end(), face.tag) != faces_.end()) return true;
    return !group_.empty() && has(face.groups, group_);
}

bool faceSelector::holds(const boundBox& b) const
{
    return hasBox_ && !b.empty() && (b.min.array() >= box_.min.array()).all() &&
           (b.max.array() <= box_.max.array()).all();
}

bool faceSelector::matches(const cadVolume& volume) const
{
    return !group_.empty() && has(volume.groups, group_);
}

void faceSelector::checkFaces(const cadModel& cad) const
{
    const auto has = [&](label tag) {
        return std::any_of(cad.faces.begin(), cad.faces.end(),
                           [tag](const cadFace& f) { return f.tag == tag; });
    };
    for (const label tag : faces_)
        if (!has(tag))
            throw fatalError(cad.path + " has no face " + std::to_string(tag) +
                                 "; they are numbered 1 to " +
                                 std::to_string(cad.faces.empty() ? 0 : cad.faces.back().tag),
                             where_);
}

word faceSelector::describe() const
{
    List<word> parts;
    if (hasColour_)
        parts.push_back("colour (" + std::to_string(colour_[0]) + " " + std::to_string(colour_[1]) +
                        " " + std::to_string(colour_[2]) + ")");
    if (!faces_.empty()) parts.push_back("the listed faces");
    if (!group_.empty()) parts.push_back("group " + group_);
    if (hasBox_) parts.push_back("the box");
    return join(parts, " or ");
}

}  // namespace ispf
