// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of patches
#include "patch.H"

#include <algorithm>

namespace ispf
{

std::unique_ptr<patch> newWallPatch(const word& name, const patchSetting& s);
std::unique_ptr<patch> newSymmetryPatch(const word& name, const patchSetting& s);
std::unique_ptr<patch> newCyclicPatch(const word& name, const patchSetting& s);
std::unique_ptr<patch> newOpenPatch(const word& name, const patchSetting& s);

namespace
{

struct kind
{
    word type;
    std::unique_ptr<patch> (*make)(const word& name, const patchSetting& s);
};

const List<kind>& kinds()
{
    static const List<kind> table = {{"wall", newWallPatch},
                                     {"symmetryPlane", newSymmetryPatch},
                                     {"cyclic", newCyclicPatch},
                                     {"open", newOpenPatch}};
    return table;
}

}  // namespace

std::unique_ptr<patch> patch::New(const word& name, const patchSetting& s)
{
    List<word> types;
    for (const kind& k : kinds()) types.push_back(k.type);
    const dictionary& dict = s.patches.subDict(name);
    const word type = dict.choose("type", types);
    for (const word key : {"point", "normal"}) dict.found(key);  // generateParticles reads them
    const auto is = [&](const kind& k) { return k.type == type; };
    return std::find_if(kinds().begin(), kinds().end(), is)->make(name, s);
}

}  // namespace ispf
