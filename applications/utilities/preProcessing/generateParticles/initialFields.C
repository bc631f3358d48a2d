// SPDX-License-Identifier: GPL-3.0-or-later
#include "initialFields.H"

namespace ispf
{

initialFields::initialFields(const dictionary& zone, scalar dx, int nDims)
    : nDims_(nDims), where_(zone.where("U"))
{
    if (zone.found("U"))
        for (const word& text : zone.get<List<word>>("U")) U_.emplace_back(text, dx, where_);
    if (!U_.empty() && U_.size() != 3)
        zone.fail("U", "U wants three formulas, e.g. (\"sin(2*pi*y)\" 0 0)");
    if (zone.found("p")) p_.emplace_back(zone.get<word>("p"), dx, zone.where("p"));
}

vector initialFields::U(const vector& x) const
{
    if (U_.empty()) return vector::Zero();
    const vector U(U_[0](x), U_[1](x), U_[2](x));
    if (nDims_ == 2 && U[2] != 0)
        throw fatalError("The case is two-dimensional, in x and y: U must not point along z",
                         where_);
    return U;
}

scalar initialFields::p(const vector& x) const
{
    return p_.empty() ? 0 : p_[0](x);
}

}  // namespace ispf
