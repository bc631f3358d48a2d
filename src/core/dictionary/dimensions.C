// SPDX-License-Identifier: GPL-3.0-or-later
#include "dimensions.H"

#include "token.H"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

namespace ispf
{

bool dimensionSet::operator==(const dimensionSet& other) const
{
    for (size_t k = 0; k < 7; ++k)
        if (std::abs(exponents[k] - other.exponents[k]) > 1e-6) return false;
    return true;
}

dimensionSet dimensionSet::operator*(const dimensionSet& other) const
{
    dimensionSet product = *this;
    for (size_t k = 0; k < 7; ++k) product.exponents[k] += other.exponents[k];
    return product;
}

dimensionSet dimensionSet::operator/(const dimensionSet& other) const
{
    return *this * other.raised(-1);
}

dimensionSet dimensionSet::raised(scalar power) const
{
    dimensionSet result = *this;
    for (scalar& e : result.exponents) e *= power;
    return result;
}

word dimensionSet::text() const
{
    static const char* names[] = {"kg", "m", "s", "K", "mol", "A", "Cd"};
    List<word> numbers, symbols;
    for (size_t k = 0; k < 7; ++k)
    {
        const scalar e = exponents[k];
        numbers.push_back(str(e));
        if (e != 0) symbols.push_back(names[k] + (e == 1 ? "" : "^" + str(e)));
    }
    return "[" + join(numbers) + "] (" + (symbols.empty() ? "no unit" : join(symbols)) + ")";
}

namespace
{

struct knownUnit
{
    dimensionSet dimensions;
    scalar factor;
    bool takesPrefix;
};

const std::map<word, knownUnit>& knownUnits()
{
    using namespace dims;
    static const dimensionSet energy = force * length, power = energy / time;
    static const dimensionSet amount{{0, 0, 0, 0, 1}}, current{{0, 0, 0, 0, 0, 1}},
        luminosity{{0, 0, 0, 0, 0, 0, 1}};
    static const scalar pi = std::numbers::pi;
    static const std::map<word, knownUnit> units = {
        {"g", {mass, 1e-3, true}},
        {"t", {mass, 1e3, false}},
        {"lb", {mass, 0.45359237, false}},
        {"m", {length, 1, true}},
        {"in", {length, 0.0254, false}},
        {"ft", {length, 0.3048, false}},
        {"s", {time, 1, true}},
        {"min", {time, 60, false}},
        {"h", {time, 3600, false}},
        {"hr", {time, 3600, false}},
        {"day", {time, 86400, false}},
        {"K", {temperature, 1, true}},
        {"mol", {amount, 1, true}},
        {"A", {current, 1, true}},
        {"Cd", {luminosity, 1, false}},
        {"cd", {luminosity, 1, false}},
        {"l", {volume, 1e-3, true}},
        {"L", {volume, 1e-3, true}},
        {"N", {force, 1, true}},
        {"dyn", {force, 1e-5, false}},
        {"Pa", {pressure, 1, true}},
        {"bar", {pressure, 1e5, true}},
        {"atm", {pressure, 101325, false}},
        {"mmHg", {pressure, 133.322387415, false}},
        {"Torr", {pressure, 101325.0 / 760, false}},
        {"cmH2O", {pressure, 98.0665, false}},
        {"mmH2O", {pressure, 9.80665, false}},
        {"psi", {pressure, 6894.757293168, false}},
        {"P", {dynamicViscosity, 0.1, true}},
        {"St", {kinematicViscosity, 1e-4, true}},
        {"J", {energy, 1, true}},
        {"cal", {energy, 4.184, true}},
        {"W", {power, 1, true}},
        {"Hz", {frequency, 1, true}},
        {"rpm", {frequency, 2 * pi / 60, false}},
        {"rad", {none, 1, true}},
        {"deg", {none, pi / 180, false}},
        {"rot", {none, 2 * pi, false}},
        {"rev", {none, 2 * pi, false}},
        {"%", {none, 0.01, false}},
        {"area", {area, 1, false}},
        {"volume", {volume, 1, false}},
        {"density", {density, 1, false}},
        {"acceleration", {acceleration, 1, false}},
        {"kinematicPressure", {velocity * velocity, 1, false}}};
    return units;
}

const std::map<word, scalar> prefixes = {
    {"T", 1e12}, {"G", 1e9},   {"M", 1e6},   {"k", 1e3},        {"h", 1e2},
    {"d", 1e-1}, {"c", 1e-2},  {"m", 1e-3},  {"u", 1e-6},       {"\xC2\xB5", 1e-6},
    {"n", 1e-9}, {"p", 1e-12}, {"f", 1e-15}, {"\xCE\xBC", 1e-6}};

class unitParser
{
public:
    unitParser(const word& text, const fileLocation& where) : s_(text), where_(where) {}

    unit all()
    {
        const unit u = product();
        if (i_ < s_.size()) fail("unexpected '" + s_.substr(i_) + "'");
        if (!(u.factor > 0) || !std::isfinite(u.factor)) fail("its factor is " + str(u.factor));
        return u;
    }

private:
    [[noreturn]] void fail(const word& what) const
    {
        throw fatalError("The unit [" + s_ + "] is not understood: " + what +
                             ".\nA unit is written like [kg m^-3], [g/cm^3], [mm/s], or as seven "
                             "exponents [1 -3 0 0 0 0 0].",
                         where_);
    }
    bool at(char c) const { return i_ < s_.size() && s_[i_] == c; }
    void skipBlanks()
    {
        while (at(' ')) ++i_;
    }

    // Factors from left to right: kg/m s is (kg/m) s
    unit product()
    {
        if (++depth_ > 20) fail("too many brackets");
        unit u = power();
        for (skipBlanks(); i_ < s_.size() && !at(')'); skipBlanks())
        {
            const bool divides = at('/');
            if (at('/') || at('*') || at('.')) ++i_;
            const unit v = power();
            u.dimensions = divides ? u.dimensions / v.dimensions : u.dimensions * v.dimensions;
            u.factor = divides ? u.factor / v.factor : u.factor * v.factor;
        }
        --depth_;
        return u;
    }

    unit power()
    {
        unit u = atom();
        skipBlanks();
        if (!at('^')) return u;
        ++i_;
        const scalar e = exponent();
        return {u.dimensions.raised(e), std::pow(u.factor, e)};
    }

    scalar exponent()
    {
        const bool brackets = at('(');
        i_ += brackets;
        scalar e = number();
        if (brackets && at('/')) ++i_, e /= number();
        if (brackets && !at(')')) fail("a bracket of an exponent is not closed");
        i_ += brackets;
        if (!(std::abs(e) <= 20)) fail("an exponent of " + str(e));
        return e;
    }

    scalar number()
    {
        const size_t begin = i_;
        while (i_ < s_.size() && (std::isdigit(static_cast<unsigned char>(s_[i_])) || at('.') ||
                                  ((at('-') || at('+')) && i_ == begin)))
            ++i_;
        scalar v;
        if (!readNumber(s_.substr(begin, i_ - begin), v)) fail("a number is wanted after ^ or /");
        return v;
    }

    unit atom()
    {
        skipBlanks();
        if (at('('))
        {
            ++i_;
            const unit u = product();
            if (!at(')')) fail("a bracket is not closed");
            return ++i_, u;
        }
        if (i_ < s_.size() && std::isdigit(static_cast<unsigned char>(s_[i_])))
            return {dims::none, number()};
        const size_t begin = i_;
        const auto isLetter = [&](unsigned char c) {
            return std::isalpha(c) || c >= 0x80 || c == '%' || (std::isdigit(c) && i_ > begin);
        };
        while (i_ < s_.size() && isLetter(static_cast<unsigned char>(s_[i_]))) ++i_;
        if (i_ == begin) fail("a unit is wanted");
        return named(s_.substr(begin, i_ - begin));
    }

    unit named(const word& name) const
    {
        const auto& units = knownUnits();
        if (const auto u = units.find(name); u != units.end())
            return {u->second.dimensions, u->second.factor};
        for (const auto& [prefix, factor] : prefixes)
        {
            if (name.compare(0, prefix.size(), prefix) != 0) continue;
            const auto u = units.find(name.substr(prefix.size()));
            if (u != units.end() && u->second.takesPrefix)
                return {u->second.dimensions, factor * u->second.factor};
        }
        const size_t letters = std::min(name.find_first_of("0123456789"), name.size());
        if (letters < name.size())
            throw fatalError("Unknown unit '" + name + "' in [" + s_ + "]. Powers are written " +
                                 name.substr(0, letters) + "^" + name.substr(letters) + ".",
                             where_);
        List<word> valid = {"kg", "mm", "cm", "ms", "ml", "kPa", "cP", "cSt"};
        for (const auto& [known, u] : units) valid.push_back(known);
        throw fatalError(
            "Unknown unit '" + name + "' in [" + s_ + "]." + didYouMean(name, valid) + "\n" +
                validWords("unit", valid) +
                "\nwith the prefixes T G M k h d c m u n p f, powers like m^2 or s^-1, "
                "products and quotients.",
            where_);
    }

    const word& s_;
    fileLocation where_;
    size_t i_ = 0;
    int depth_ = 0;
};

}  // namespace

unit parsedUnit(const word& text, const fileLocation& where)
{
    const size_t first = text.find_first_not_of(' ');
    if (first == word::npos || text == "-") return {};
    std::istringstream words(text);
    List<scalar> exponents;
    scalar e;
    for (word w; words >> w;)
    {
        if (!readNumber(w, e)) return unitParser(text, where).all();
        exponents.push_back(e);
    }
    if (exponents.size() == 1) return unitParser(text, where).all();
    if (exponents.size() != 5 && exponents.size() != 7)
        throw fatalError("A dimension set has 5 or 7 exponents, of kg m s K mol (A Cd); [" + text +
                             "] has " + std::to_string(exponents.size()) + ".",
                         where);
    unit u;
    std::copy(exponents.begin(), exponents.end(), u.dimensions.exponents.begin());
    return u;
}

}  // namespace ispf
