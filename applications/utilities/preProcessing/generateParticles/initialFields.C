// SPDX-License-Identifier: GPL-3.0-or-later
#include "initialFields.H"

#include "token.H"

namespace ispf
{

namespace
{

// of position, variables x y z [m]; and of dx
expression ofPosition(const word& text, scalar dx, const fileLocation& where)
{
    return {text, {"x", "y", "z"}, {{"dx", dx}}, where};
}

scalar at(const expression& formula, const vector& x)
{
    return formula({x[0], x[1], x[2]});
}

}  // namespace

initialFields::initialFields(const dictionary& zone, scalar dx, int nDims)
    : nDims_(nDims), where_(zone.where("U"))
{
    if (zone.found("U"))
        for (const word& text : zone.get<List<word>>("U"))
            U_.push_back(ofPosition(text, dx, where_));
    if (!U_.empty() && U_.size() != 3)
        zone.fail("U", "U wants three formulas, e.g. (\"sin(2*pi*y)\" 0 0)");
    if (!zone.found("p")) return;
    // a number may have a unit, a formula is in SI
    const List<word> tokens = zone.tokens("p");
    scalar number;
    const bool hasUnit = tokens.size() > 1 && (tokens[0] == "[" || readNumber(tokens[0], number));
    p_.push_back(
        ofPosition(hasUnit ? str(zone.get<scalar>("p", dims::pressure), 17) : zone.get<word>("p"),
                   dx, zone.where("p")));
}

vector initialFields::U(const vector& x) const
{
    if (U_.empty()) return vector::Zero();
    const vector U(at(U_[0], x), at(U_[1], x), at(U_[2], x));
    if (nDims_ == 2 && U[2] != 0)
        throw fatalError("The case is two-dimensional, in x and y: U must not point along z",
                         where_);
    return U;
}

scalar initialFields::p(const vector& x) const
{
    return p_.empty() ? 0 : at(p_[0], x);
}

}  // namespace ispf
