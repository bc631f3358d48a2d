// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1Table.H"

#include "token.H"
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
    wave(const dictionary& d, const word& caseFolder, bool square)
        : square_(square),
          frequency_(d.getInRange("frequency", 0, 1e30)),
          t0_(d.getOrDefault<scalar>("t0", 0)),
          scale_(d.getOrDefault<scalar>("scale", 1)),
          level_(d.getOrDefault<scalar>("level", 0)),
          amplitude_(New("amplitude", d, caseFolder))
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
    scaled(const dictionary& d, const word& caseFolder)
        : scale_(New("scale", d, caseFolder)), value_(New("value", d, caseFolder))
    {
    }
    scalar value(scalar t) const override { return scale_->value(t) * value_->value(t); }

private:
    std::unique_ptr<Function1> scale_, value_;
};

const List<word> types = {"constant", "table",      "tableFile", "csvFile",
                          "sine",     "polynomial", "square",    "scale"};

std::unique_ptr<Function1> tabulated(const List<Function1Table::row>& rows, const dictionary& d)
{
    const word out = d.chooseOrDefault("outOfBounds", Function1Table::outOfBoundsWords(), "clamp");
    return std::make_unique<Function1Table>(rows, out, d.where());
}

List<Function1Table::row> rowsIn(const word& key, const dictionary& d)
{
    return inlineRows(d.tokenList(key), d.where(key));
}

std::unique_ptr<Function1> fromDict(const dictionary& d, const word& caseFolder)
{
    const word type = d.choose("type", types);
    if (type == "constant") return std::make_unique<constant>(d.get<scalar>("value"));
    if (type == "table") return tabulated(rowsIn("values", d), d);
    if (type == "tableFile") return tabulated(listFileRows(d, caseFolder), d);
    if (type == "csvFile") return tabulated(csvFileRows(d, caseFolder), d);
    if (type == "polynomial") return std::make_unique<polynomial>(rowsIn("coeffs", d));
    if (type == "scale") return std::make_unique<scaled>(d, caseFolder);
    return std::make_unique<wave>(d, caseFolder, type == "square");
}

}  // namespace

std::unique_ptr<Function1> Function1::New(const word& key, const dictionary& dict,
                                          const word& caseFolder)
{
    if (dict.isDict(key)) return fromDict(dict.subDict(key), caseFolder);

    List<token> tokens = dict.tokenList(key);
    scalar v;
    if ((!tokens.empty() && readNumber(tokens[0].text, v)) ||
        (!tokens.empty() && tokens[0].is('[')))
        return std::make_unique<constant>(dict.get<scalar>(key, dims::any));
    const word type = tokens.empty() ? "" : tokens[0].text;
    if (!tokens.empty()) tokens.erase(tokens.begin());
    if (type == "table")
        return std::make_unique<Function1Table>(inlineRows(tokens, dict.where(key)), "clamp",
                                                dict.where(key));
    if (type == "polynomial")
        return std::make_unique<polynomial>(inlineRows(tokens, dict.where(key)));
    if (type == "constant" && tokens.size() == 1 && readNumber(tokens[0].text, v))
        return std::make_unique<constant>(v);
    dict.fail(key, "'" + key +
                       "' is a function of time: a number, 'constant v', "
                       "'table ((t v) ...)', 'polynomial ((a n) ...)', or " +
                       key + " { type ...; ... }. " + validWords("type", types));
}

}  // namespace ispf
