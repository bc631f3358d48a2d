// SPDX-License-Identifier: GPL-3.0-or-later
#include "initialFields.H"

#include "token.H"

namespace ispf
{

namespace
{

// A formula of the position x y z [m] and of dx
expression ofPosition(const word& text, scalar dx, const fileLocation& where)
{
    return {text, {"x", "y", "z"}, {{"dx", dx}}, where};
}

scalar at(const expression& formula, const vector& x)
{
    return formula({x[0], x[1], x[2]});
}

List<expression> threeOfPosition(const List<word>& texts, const word& key, const dictionary& zone,
                                 scalar dx)
{
    if (texts.size() != 3)
        zone.fail(key, key + " wants three formulas, e.g. (\"sin(2*pi*y)\" 0 0)");
    List<expression> formulas;
    for (const word& text : texts) formulas.push_back(ofPosition(text, dx, zone.where(key)));
    return formulas;
}

}  // namespace

initialFields::initialFields(const dictionary& zone, scalar dx, int nDims, bool solid)
    : nDims_(nDims), where_(zone.where("U")), whereRest_(zone.where("rest"))
{
    if (zone.found("U")) U_ = threeOfPosition(zone.get<List<word>>("U"), "U", zone, dx);
    if (zone.found("rest")) rest_ = threeOfPosition(zone.get<List<word>>("rest"), "rest", zone, dx);
    if (!solid && restsElsewhere())
        zone.fail("rest", "Only what is solid has a state of rest: phase solid or clamped");
    if (!zone.found("p")) return;
    // a number may have a unit; a formula is in SI
    const List<word> tokens = zone.tokens("p");
    scalar number;
    const bool hasUnit = tokens.size() > 1 && (tokens[0] == "[" || readNumber(tokens[0], number));
    p_.push_back(
        ofPosition(hasUnit ? str(zone.get<scalar>("p", dims::pressure), 17) : zone.get<word>("p"),
                   dx, zone.where("p")));
}

vector initialFields::value(const List<expression>& formulas, const word& name, const vector& x,
                            const fileLocation& where) const
{
    const vector v(at(formulas[0], x), at(formulas[1], x), at(formulas[2], x));
    if (nDims_ == 2 && v[2] != 0)
        throw fatalError(
            "The case is two-dimensional, in x and y: " + name + " must not point along z", where);
    return v;
}

vector initialFields::U(const vector& x) const
{
    return U_.empty() ? vector::Zero() : value(U_, "U", x, where_);
}

vector initialFields::rest(const vector& x) const
{
    return rest_.empty() ? x : value(rest_, "rest", x, whereRest_);
}

scalar initialFields::p(const vector& x) const
{
    return p_.empty() ? 0 : at(p_[0], x);
}

}  // namespace ispf
