// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression.H"

#include <cmath>
#include <muParser.h>

namespace ispf
{

struct expression::content
{
    word text;
    fileLocation where;
    mu::Parser parser;
    scalar x[3] = {0, 0, 0};

    [[noreturn]] void fail(const mu::ParserError& error) const;
};

void expression::content::fail(const mu::ParserError& error) const
{
    if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN)
        throw fatalError("The formula \"" + text + "\": " + error.GetMsg(), where);
    List<word> names;
    for (const auto& [name, variable] : parser.GetVar()) names.push_back(name);
    for (const auto& [name, constant] : parser.GetConst()) names.push_back(name);
    for (const auto& [name, function] : parser.GetFunDef()) names.push_back(name);
    throw fatalError("The formula \"" + text + "\" has the unknown name '" + error.GetToken() +
                         "'. " + validWords("name", names),
                     where);
}

expression::expression(const word& text, scalar dx, const fileLocation& where)
    : content_(std::make_unique<content>())
{
    content& c = *content_;
    c.text = text, c.where = where;
    for (size_t i = text.find('='); i != word::npos; i = text.find('=', i + 1))
        if (text.substr(i, 2) != "==" && (i == 0 || word("=<>!").find(text[i - 1]) == word::npos))
            throw fatalError("The formula \"" + text + "\" must not assign anything", where);
    try
    {
        c.parser.ClearConst();  // muParser's own are called _pi and _e
        c.parser.DefineConst("pi", M_PI);
        c.parser.DefineConst("dx", dx);
        for (const int d : {0, 1, 2}) c.parser.DefineVar(word(1, char('x' + d)), &c.x[d]);
        c.parser.SetExpr(text);
        c.parser.Eval();
    }
    catch (const mu::ParserError& error)
    {
        c.fail(error);
    }
}

expression::~expression() = default;
expression::expression(expression&&) noexcept = default;

scalar expression::operator()(const vector& x) const
{
    content& c = *content_;
    for (const int d : {0, 1, 2}) c.x[d] = x[d];
    const scalar value = c.parser.Eval();
    if (!std::isfinite(value))
        throw fatalError("The formula \"" + c.text + "\" is " + str(value) + " at (" + str(x[0]) +
                             " " + str(x[1]) + " " + str(x[2]) + ")",
                         c.where);
    return value;
}

}  // namespace ispf
