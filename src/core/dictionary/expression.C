// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression.H"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <muParser.h>
#include <numbers>
#include <re2/re2.h>

namespace ispf
{

struct expression::content
{
    word text;
    fileLocation where;
    mu::Parser parser;
    List<scalar> variables;

    [[noreturn]] void fail(const mu::ParserError& error) const;
    scalar evaluate() const;
};

namespace
{

// vector(x, y, z) returns one of its components at a time
thread_local int component = 0;
thread_local scalar vectorScale = 1;

scalar vectorComponent(scalar x, scalar y, scalar z)
{
    return vectorScale * (component == 0 ? x : component == 1 ? y : z);
}

// A number in [0, 1), the same at each call with this seed, as in OpenFOAM's formulas: the second number of the
// linear congruential generator of 48 bits, with the first number in the lower digits
scalar randomNumber(scalar seed)
{
    if (!std::isfinite(seed)) return seed;
    const std::uint32_t s = std::uint32_t(std::int64_t(std::fmod(std::round(seed), 4294967296.0)));
    unsigned short state[3] = {0x330E, std::uint16_t(s), std::uint16_t(s >> 16)};
    constexpr scalar range = 2147483648.0;
    const scalar first = scalar(nrand48(state)), second = scalar(nrand48(state));
    return (second + first / range) / range;
}

scalar truth(bool b)
{
    return b ? 1 : 0;
}

void defineFunctions(mu::Parser& p)
{
    using f = scalar (*)(scalar);
    using g = scalar (*)(scalar, scalar);
    constexpr scalar degree = std::numbers::pi / 180;
    p.DefineFun("degToRad", f([](scalar x) { return x * degree; }));
    p.DefineFun("radToDeg", f([](scalar x) { return x / degree; }));
    p.DefineFun("log", f([](scalar x) { return std::log(x); }));
    p.DefineFun("sqr", f([](scalar x) { return x * x; }));
    p.DefineFun("magSqr", f([](scalar x) { return x * x; }));
    p.DefineFun("pow3", f([](scalar x) { return x * x * x; }));
    p.DefineFun("cbrt", f([](scalar x) { return std::cbrt(x); }));
    for (const char* name : {"mag", "abs", "fabs"})
        p.DefineFun(name, f([](scalar x) { return std::abs(x); }));
    p.DefineFun("floor", f([](scalar x) { return std::floor(x); }));
    p.DefineFun("ceil", f([](scalar x) { return std::ceil(x); }));
    p.DefineFun("round", f([](scalar x) { return std::round(x); }));
    for (const char* name : {"trunc", "label", "int"})
        p.DefineFun(name, f([](scalar x) { return std::trunc(x); }));
    for (const char* name : {"scalar", "double"}) p.DefineFun(name, f([](scalar x) { return x; }));
    p.DefineFun("bool", f([](scalar x) { return truth(x != 0); }));
    // as in OpenFOAM: 0 is neither positive nor negative, and its sign is +
    p.DefineFun("pos", f([](scalar x) { return truth(x > 0); }));
    p.DefineFun("neg", f([](scalar x) { return truth(x < 0); }));
    p.DefineFun("pos0", f([](scalar x) { return truth(x >= 0); }));
    p.DefineFun("neg0", f([](scalar x) { return truth(x <= 0); }));
    p.DefineFun("sign", f([](scalar x) { return x >= 0 ? scalar(1) : scalar(-1); }));
    p.DefineFun("rand", f(randomNumber));
    p.DefineFun("pow", g([](scalar x, scalar y) { return std::pow(x, y); }));
    p.DefineFun("hypot", g([](scalar x, scalar y) { return std::hypot(x, y); }));
    for (const char* name : {"mod", "fmod"})
        p.DefineFun(name, g([](scalar x, scalar y) { return std::fmod(x, y); }));
    p.DefineFun("vector", vectorComponent, false);  // must not be folded into a constant
    p.DefineOprt("%", g([](scalar x, scalar y) { return std::fmod(x, y); }), mu::prMUL_DIV);
    p.DefineInfixOprt("!", f([](scalar x) { return truth(x == 0); }));
    p.ClearConst();  // muParser's own constants are _pi and _e
    p.DefineConst("pi", std::numbers::pi);
    p.DefineConst("M_PI", std::numbers::pi);
    p.DefineConst("true", 1);
    p.DefineConst("false", 0);
}

void replaceAll(word& text, const word& old, const word& by)
{
    for (size_t i = text.find(old); i != word::npos; i = text.find(old, i + by.size()))
        text.replace(i, old.size(), by);
}

// Replaces spellings of C++ and of OpenFOAM that muParser does not know
word plainFormula(word text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
    for (const char* space : {"Foam::", "std::", "constant::mathematical::"})
        replaceAll(text, space, "");
    // no blanks before and after the parenthesis of a function
    static const RE2 before(R"((\w) +\()"), behind(R"(\( +)");
    RE2::GlobalReplace(&text, before, R"(\1()");
    RE2::GlobalReplace(&text, behind, "(");
    replaceAll(text, "pi()", "pi");
    replaceAll(text, "rand()", "rand(0)");
    return text;
}

bool assigns(const word& text)
{
    for (size_t i = text.find('='); i != word::npos; i = text.find('=', i + 1))
    {
        if (text.compare(i, 2, "==") == 0) ++i;
        else if (i == 0 || word("<>!").find(text[i - 1]) == word::npos) return true;
    }
    return false;
}

}  // namespace

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

scalar expression::content::evaluate() const
{
    try
    {
        return parser.Eval();
    }
    catch (const mu::ParserError& error)
    {
        fail(error);
    }
}

expression::expression(const word& text, const List<word>& variables,
                       const std::map<word, scalar>& constants, const fileLocation& where)
    : content_(std::make_unique<content>())
{
    content& c = *content_;
    c.text = text, c.where = where;
    c.variables.assign(variables.size(), 0);
    if (text.size() > 4000)
        throw fatalError("A formula of more than 4000 characters: \"" + text.substr(0, 60) + "...",
                         where);
    if (assigns(text))
        throw fatalError("The formula \"" + text + "\" must not assign anything", where);
    if (text.find_first_of(";{}") != word::npos)
        throw fatalError("\"" + text + "\" is no formula: statements are not run here", where);
    try
    {
        defineFunctions(c.parser);
        for (const auto& [name, value] : constants) c.parser.DefineConst(name, value);
        for (size_t k = 0; k < variables.size(); ++k)
            c.parser.DefineVar(variables[k], &c.variables[k]);
        c.parser.SetExpr(plainFormula(text));
        c.parser.Eval();
    }
    catch (const mu::ParserError& error)
    {
        c.fail(error);
    }
}

expression::~expression() = default;
expression::expression(expression&&) noexcept = default;

const word& expression::text() const
{
    return content_->text;
}

scalar expression::operator()(const List<scalar>& variables) const
{
    content& c = *content_;
    std::copy(variables.begin(), variables.end(), c.variables.begin());
    const scalar value = c.evaluate();
    if (std::isfinite(value)) return value;
    word at;
    for (const scalar v : variables) at += (at.empty() ? " at (" : " ") + str(v);
    throw fatalError(
        "The formula \"" + c.text + "\" is " + str(value) + at + (at.empty() ? "" : ")"), c.where);
}

namespace
{

List<scalar> components(const expression& formula, scalar scale)
{
    List<scalar> c;
    vectorScale = scale;
    for (component = 0; component < 3; ++component) c.push_back(formula());
    component = 0, vectorScale = 1;
    return c;
}

// A formula of vectors must be linear in them: twice the vectors must give twice the result
List<scalar> evaluatedVector(const word& text, const fileLocation& where)
{
    const expression formula(text, {}, {}, where);
    const List<scalar> once = components(formula, 1), twice = components(formula, 2);
    for (size_t k = 0; k < 3; ++k)
        if (std::abs(twice[k] - 2 * once[k]) > 1e-9 * (std::abs(once[k]) + std::abs(twice[k])))
            throw fatalError("The formula \"" + text +
                                 "\": vectors can be added, and multiplied with or divided by "
                                 "numbers, no more.",
                             where);
    return once;
}

size_t closing(const word& text, size_t i)
{
    int depth = 0;
    for (; i < text.size(); ++i)
    {
        depth += (text[i] == '(') - (text[i] == ')');
        if (depth == 0) return i;
    }
    return word::npos;
}

}  // namespace

List<scalar> evaluated(const word& text, const fileLocation& where)
{
    word rest = text;
    // mag(vector) and magSqr(vector) become numbers, the innermost first
    for (const word name : {"magSqr(", "mag("})
        for (size_t i = rest.rfind(name); i != word::npos;
             i = i ? rest.rfind(name, i - 1) : word::npos)
        {
            const size_t open = i + name.size() - 1, end = closing(rest, open);
            if (end == word::npos) break;
            const word inner = rest.substr(open + 1, end - open - 1);
            if (inner.find("vector(") == word::npos) continue;
            const List<scalar> v = evaluatedVector(inner, where);
            const scalar square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
            rest.replace(i, end + 1 - i, str(name == "mag(" ? std::sqrt(square) : square, 17));
        }
    if (rest.find("vector(") != word::npos) return evaluatedVector(rest, where);
    return {expression(rest, {}, {}, where)()};
}

}  // namespace ispf
