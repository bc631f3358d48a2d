// SPDX-License-Identifier: GPL-3.0-or-later
#include "outsideEntry.H"

namespace ispf
{

outsideEntry::outsideEntry(const dictionary& structureProperties, const word& caseFolder)
    : dict_(structureProperties.subOrEmptyDict("outside")),
      given_(structureProperties.found("outside"))
{
    if (!given_) return;
    stiffness_ = dict_.getInRangeOrDefault<scalar>("stiffness", 0, 1e30, 0,
                                                   dims::pressure * dims::perLength);
    damping_ =
        dict_.getInRangeOrDefault<scalar>("damping", 0, 1e30, 0, dims::pressure / dims::velocity);
    if (dict_.found("pressure"))
        pressure_ = Function1::New("pressure", dict_, caseFolder, dims::pressure);
    dict_.refuseOthers({"pressure", "stiffness", "damping"});
    if (dict_.empty())
        structureProperties.fail("outside",
                                 "It has no entry and no effect. Give a pressure, a stiffness or a "
                                 "damping, or leave it away");
}

void outsideEntry::fail(const word& why) const
{
    dict_.fail(dict_.keys().front(), why);
}

}  // namespace ispf
