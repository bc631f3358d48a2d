// SPDX-License-Identifier: GPL-3.0-or-later
#include "initialFields.H"

namespace ispf
{

initialFields::initialFields(const dictionary& zone, scalar dx)
{
    if (zone.found("U"))
        for (const word& text : zone.get<List<word>>("U"))
            U_.emplace_back(text, dx, zone.where("U"));
    if (!U_.empty() && U_.size() != 3)
        zone.fail("U", "U wants three formulas, e.g. (\"sin(2*pi*y)\" 0 0)");
    if (zone.found("p")) p_.emplace_back(zone.get<word>("p"), dx, zone.where("p"));
}

vector initialFields::U(const vector& x) const
{
    return U_.empty() ? vector(0, 0, 0) : vector(U_[0](x), U_[1](x), U_[2](x));
}

scalar initialFields::p(const vector& x) const
{
    return p_.empty() ? 0 : p_[0](x);
}

}  // namespace ispf
