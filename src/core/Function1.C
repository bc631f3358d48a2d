// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1Table.H"

#include "valueReader.H"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ispf
{

namespace
{

class constant : public Function1
{
public:
    explicit constant(scalar v) : v_(v) {}
    scalar value(scalar) const override { return v_; }

private:
    scalar v_;
};

// sum of a t^n over the pairs (a n)
class polynomial : public Function1
{
public:
    explicit polynomial(const List<Function1Table::row>& terms) : terms_(terms) {}
    scalar value(scalar t) const override
    {
        scalar sum = 0;
        for (const auto& term : terms_) sum += term.t * std::pow(t, term.value);
        return sum;
    }

private:
    List<Function1Table::row> terms_;  // (coefficient, exponent)
};

// scale amplitude wave(frequency (t - t0)) + level; a sine, or a square wave that is +1 for the
// share mark/(mark + space) of a period and -1 for the rest
class wave : public Function1
{
public:
    wave(const dictionary& d, const word& caseFolder, const dimensionSet& wanted, bool square)
        : square_(square),
          frequency_(d.getInRange("frequency", 0, 1e30, dims::frequency)),
          t0_(d.getOrDefault<scalar>("t0", 0, dims::time)),
          scale_(d.getOrDefault<scalar>("scale", 1)),
          level_(d.getOrDefault<scalar>("level", 0, wanted)),
          amplitude_(New("amplitude", d, caseFolder, wanted))
    {
        const scalar markSpace = square ? d.getInRangeOrDefault("markSpace", 1e-12, 1e12, 1) : 1;
        mark_ = markSpace / (1 + markSpace);
    }
    scalar value(scalar t) const override
    {
        const scalar cycles = frequency_ * (t - t0_);
        const scalar shape = !square_ ? std::sin(2 * std::numbers::pi * cycles)
                             : cycles - std::floor(cycles) < mark_ ? 1
                                                                   : -1;
        return scale_ * amplitude_->value(t) * shape + level_;
    }

private:
    bool square_;
    scalar frequency_, t0_, scale_, level_, mark_;
    std::unique_ptr<Function1> amplitude_;
};

class scaled : public Function1
{
public:
    scaled(const dictionary& d, const word& caseFolder, const dimensionSet& wanted)
        : scale_(New("scale", d, caseFolder, dims::none)),
          value_(New("value", d, caseFolder, wanted))
    {
    }
    scalar value(scalar t) const override { return scale_->value(t) * value_->value(t); }

private:
    std::unique_ptr<Function1> scale_, value_;
};

// From 0 before `start` to 1 after `duration`
class ramp : public Function1
{
public:
    explicit ramp(const dictionary& d)
        : type_(d.get<word>("type")),
          start_(d.getOrDefault<scalar>("start", 0, dims::time)),
          duration_(d.getInRange("duration", 1e-30, 1e30, dims::time))
    {
    }
    scalar value(scalar t) const override
    {
        const scalar x = std::clamp((t - start_) / duration_, 0.0, 1.0);
        if (type_ == "quadraticRamp") return x * x;
        return type_ == "halfCosineRamp" ? 0.5 * (1 - std::cos(std::numbers::pi * x)) : x;
    }

private:
    word type_;
    scalar start_, duration_;
};

const List<word> types = {"constant",   "table",         "tableFile",     "csvFile",
                          "sine",       "polynomial",    "square",        "scale",
                          "linearRamp", "quadraticRamp", "halfCosineRamp"};

std::unique_ptr<Function1> tabulated(const List<Function1Table::row>& rows, const dictionary& d)
{
    const word out = d.chooseOrDefault("outOfBounds", Function1Table::outOfBoundsWords(), "clamp");
    return std::make_unique<Function1Table>(rows, out, d.where());
}

List<Function1Table::row> rowsIn(const word& key, const dictionary& d)
{
    return inlineRows(d.tokenList(key), d.where(key));
}

std::unique_ptr<Function1> fromDict(const dictionary& d, const word& caseFolder,
                                    const dimensionSet& wanted)
{
    const word type = d.choose("type", types);
    if (type == "constant") return std::make_unique<constant>(d.get<scalar>("value", wanted));
    if (type == "table") return tabulated(inUnits(rowsIn("values", d), d, wanted), d);
    if (type == "tableFile") return tabulated(inUnits(listFileRows(d, caseFolder), d, wanted), d);
    if (type == "csvFile")
        return tabulated(inUnits(csvFileRows(d, caseFolder, wanted), d, wanted), d);
    if (type == "polynomial") return std::make_unique<polynomial>(rowsIn("coeffs", d));
    if (type == "scale") return std::make_unique<scaled>(d, caseFolder, wanted);
    if (type.find("Ramp") != word::npos) return std::make_unique<ramp>(d);
    return std::make_unique<wave>(d, caseFolder, wanted, type == "square");
}

}  // namespace

std::unique_ptr<Function1> Function1::New(const word& key, const dictionary& dict,
                                          const word& caseFolder, const dimensionSet& wanted)
{
    if (dict.isDict(key)) return fromDict(dict.subDict(key), caseFolder, wanted);

    List<token> tokens = dict.tokenList(key);
    scalar v;
    if ((!tokens.empty() && readNumber(tokens[0].text, v)) ||
        (!tokens.empty() && tokens[0].is('[')))
        return std::make_unique<constant>(dict.get<scalar>(key, wanted));
    const word type = tokens.empty() ? "" : tokens[0].text;
    if (!tokens.empty()) tokens.erase(tokens.begin());
    if (type == "table")
        return std::make_unique<Function1Table>(inlineRows(tokens, dict.where(key)), "clamp",
                                                dict.where(key));
    if (type == "polynomial")
        return std::make_unique<polynomial>(inlineRows(tokens, dict.where(key)));
    if (type == "constant")
        return std::make_unique<constant>(
            valueReader(tokens, key, dict.where(key), wanted).whole<scalar>());
    dict.fail(key, "'" + key +
                       "' is a function of time: a number, 'constant v', "
                       "'table ((t v) ...)', 'polynomial ((a n) ...)', or " +
                       key + " { type ...; ... }. " + validWords("type", types));
}

}  // namespace ispf
