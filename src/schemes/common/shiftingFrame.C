// SPDX-License-Identifier: GPL-3.0-or-later
#include "shiftingFrame.H"

#include "patchDictionary.H"

#include <algorithm>

namespace ispf
{

word shiftingFrame(const fsiCase& c)
{
    const dictionary patches = readPatchDictionary(c.caseFolder(), c.cloud.zones);
    const List<word> names = patches.dictKeys();
    const bool endless = std::all_of(names.begin(), names.end(), [&](const word& name) {
        return patches.subDict(name).get<word>("type") == "cyclic";
    });
    return endless ? "mean" : "still";
}

}  // namespace ispf
