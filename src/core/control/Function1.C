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

template <class T>
T all(scalar v)
{
    if constexpr (std::is_same_v<T, vector>) return vector::Constant(v);
    else return v;
}

bool finite(scalar v)
{
    return std::isfinite(v);
}

bool finite(const vector& v)
{
    return v.allFinite();
}

template <class T>
class constant : public Function1Of<T>
{
public:
    explicit constant(const T& v) : v_(v) {}
    T value(scalar) const override { return v_; }
    List<T> parts() const override { return {v_}; }

private:
    T v_;
};

// sum of a t^n over the pairs (a n)
template <class T>
class polynomial : public Function1Of<T>
{
public:
    struct term
    {
        T a;
        scalar n;
    };
    polynomial(const List<term>& terms, const fileLocation& where) : terms_(terms), where_(where) {}
    T value(scalar t) const override
    {
        T sum = 0 * terms_[0].a;
        for (const term& term : terms_) sum += term.a * std::pow(t, term.n);
        if (finite(sum)) return sum;
        throw fatalError("The polynomial has no value at " + str(t) +
                             " s: a negative power needs times other than 0, a fractional one "
                             "times that are not negative.",
                         where_);
    }
    List<T> parts() const override
    {
        List<T> all;
        for (const term& term : terms_) all.push_back(term.a);
        return all;
    }

private:
    List<term> terms_;
    fileLocation where_;
};

// scale amplitude wave(frequency (t - t0)) + level.  The wave is a sine, or a square wave that is +1 for the
// share mark/(mark + space) of a period and -1 for the rest
template <class T>
class wave : public Function1Of<T>
{
public:
    wave(const dictionary& d, const word& caseFolder, const dimensionSet& wanted, bool square)
        : square_(square),
          frequency_(d.getInRange("frequency", 0, 1e30, dims::frequency)),
          t0_(d.getOrDefault<scalar>("t0", 0, dims::time)),
          scale_(d.getOrDefault<scalar>("scale", 1)),
          level_(d.getOrDefault<T>("level", all<T>(0), wanted)),
          amplitude_(Function1Of<T>::New("amplitude", d, caseFolder, wanted))
    {
        const scalar markSpace = square ? d.getInRangeOrDefault("markSpace", 1e-12, 1e12, 1) : 1;
        mark_ = markSpace / (1 + markSpace);
    }
    T value(scalar t) const override
    {
        const scalar cycles = frequency_ * (t - t0_);
        const scalar shape = !square_ ? std::sin(2 * std::numbers::pi * cycles)
                             : cycles - std::floor(cycles) < mark_ ? 1
                                                                   : -1;
        return scale_ * shape * amplitude_->value(t) + level_;
    }
    List<T> parts() const override
    {
        List<T> all = amplitude_->parts();
        all.push_back(level_);
        return all;
    }

private:
    bool square_;
    scalar frequency_, t0_, scale_, mark_;
    T level_;
    std::unique_ptr<Function1Of<T>> amplitude_;
};

template <class T>
class scaled : public Function1Of<T>
{
public:
    scaled(const dictionary& d, const word& caseFolder, const dimensionSet& wanted)
        : scale_(Function1::New("scale", d, caseFolder, dims::none)),
          value_(Function1Of<T>::New("value", d, caseFolder, wanted))
    {
    }
    T value(scalar t) const override { return scale_->value(t) * value_->value(t); }
    List<T> parts() const override { return value_->parts(); }

private:
    std::unique_ptr<Function1> scale_;
    std::unique_ptr<Function1Of<T>> value_;
};

// Rises from 0 before `start` to 1 after `duration`
class ramp : public Function1
{
public:
    ramp(const word& type, const dictionary& d)
        : type_(type),
          start_(d.getOrDefault<scalar>("start", 0, dims::time)),
          duration_(d.getInRange("duration", 1e-30, 1e30, dims::time))
    {
    }
    scalar value(scalar t) const override
    {
        const scalar x = std::clamp((t - start_) / duration_, 0.0, 1.0);
        if (type_ == "quadraticRamp") return x * x;
        if (type_ == "quarterCosineRamp") return 1 - std::cos(std::numbers::pi / 2 * x);
        if (type_ == "quarterSineRamp") return std::sin(std::numbers::pi / 2 * x);
        return type_ == "halfCosineRamp" ? 0.5 * (1 - std::cos(std::numbers::pi * x)) : x;
    }
    List<scalar> parts() const override { return {1}; }

private:
    word type_;
    scalar start_, duration_;
};

template <class T>
List<word> types()
{
    List<word> all = {"constant", "uniform", "zero",       "one",    "table", "tableFile",
                      "csvFile",  "sine",    "polynomial", "square", "scale"};
    if constexpr (std::is_same_v<T, scalar>)
        all.insert(all.end(), {"linearRamp", "quadraticRamp", "halfCosineRamp", "quarterCosineRamp",
                               "quarterSineRamp"});
    return all;
}

template <class T>
std::unique_ptr<Function1Of<T>> tabulated(const List<Function1Row<T>>& rows, const dictionary& d)
{
    const word out = d.chooseOrDefault("outOfBounds", outOfBoundsWords(), "clamp");
    return std::make_unique<Function1Table<T>>(rows, out, d.where());
}

template <class T>
List<Function1Row<T>> rowsIn(const word& key, const dictionary& d)
{
    return inlineRows<T>(d.tokenList(key), d.where(key));
}

// The terms ((a n) (b m)); a and b are vectors for a vector function
template <class T>
std::unique_ptr<Function1Of<T>> powers(const List<token>& tokens, const fileLocation& where)
{
    valueReader in(tokens, "coeffs", where);
    const word form = "terms ((coefficient exponent) ...)";
    List<typename polynomial<T>::term> terms;
    if (!in.done() && in.peek().isPlain()) in.take();  // number of terms
    for (in.expect('(', form); !in.at(')'); in.expect(')', form))
    {
        in.expect('(', form);
        auto& term = terms.emplace_back();
        in.read(term.a);
        in.read(term.n);
    }
    in.expect(')', form);
    in.expectEnd();
    if (terms.empty()) throw fatalError("A polynomial wants a term.", where);
    return std::make_unique<polynomial<T>>(terms, where);
}

// The functions that consist of one word
template <class T>
std::unique_ptr<Function1Of<T>> named(const word& type)
{
    if (type == "zero") return std::make_unique<constant<T>>(all<T>(0));
    if (type == "one") return std::make_unique<constant<T>>(all<T>(1));
    return nullptr;
}

template <class T>
std::unique_ptr<Function1Of<T>> fromDict(const word& type, const dictionary& d,
                                         const word& caseFolder, const dimensionSet& wanted)
{
    if (auto f = named<T>(type)) return f;
    if (type == "constant" || type == "uniform")
        return std::make_unique<constant<T>>(d.get<T>("value", wanted));
    if (type == "table") return tabulated(inUnits(rowsIn<T>("values", d), d, wanted), d);
    if (type == "tableFile")
        return tabulated(inUnits(listFileRows<T>(d, caseFolder), d, wanted), d);
    if (type == "csvFile") return tabulated(csvFileRows<T>(d, caseFolder, wanted), d);
    if (type == "polynomial") return powers<T>(d.tokenList("coeffs"), d.where("coeffs"));
    if (type == "scale") return std::make_unique<scaled<T>>(d, caseFolder, wanted);
    if constexpr (std::is_same_v<T, scalar>)
        if (type.find("Ramp") != word::npos) return std::make_unique<ramp>(type, d);
    return std::make_unique<wave<T>>(d, caseFolder, wanted, type == "square");
}

bool isValue(const List<token>& tokens, bool ofVector)
{
    if (tokens.empty()) return false;
    if (tokens[0].is('[') || ofVector) return tokens[0].is('[') || tokens[0].is('(');
    // also for a number that is not finite: reading it gives the error
    const word& text = tokens[0].text;
    const size_t digit = text.find_first_not_of("+-.");
    return tokens[0].isPlain() && digit != word::npos &&
           (std::isdigit(static_cast<unsigned char>(text[digit])) ||
            text.compare(digit, word::npos, "nan") == 0 ||
            text.compare(digit, word::npos, "inf") == 0);
}

}  // namespace

template <class T>
std::unique_ptr<Function1Of<T>> Function1Of<T>::New(const word& key, const dictionary& dict,
                                                    const word& caseFolder,
                                                    const dimensionSet& wanted)
{
    if (dict.isDict(key))
    {
        const dictionary& d = dict.subDict(key);
        return fromDict<T>(d.choose("type", types<T>()), d, caseFolder, wanted);
    }

    constexpr bool ofVector = std::is_same_v<T, vector>;
    List<token> tokens = dict.tokenList(key);
    if (isValue(tokens, ofVector)) return std::make_unique<constant<T>>(dict.get<T>(key, wanted));
    const word type = tokens.empty() ? "" : tokens[0].text;
    if (!tokens.empty()) tokens.erase(tokens.begin());
    if (auto f = named<T>(type); f && tokens.empty()) return f;
    if (const word name = key + "Coeffs"; tokens.empty() && dict.isDict(name))
        return fromDict<T>(dict.choose(key, types<T>()), dict.subDict(name), caseFolder, wanted);
    if (type == "table")
        return std::make_unique<Function1Table<T>>(inlineRows<T>(tokens, dict.where(key), &wanted),
                                                   "clamp", dict.where(key));
    if (type == "polynomial") return powers<T>(tokens, dict.where(key));
    if (type == "constant" || type == "uniform")
        return std::make_unique<constant<T>>(
            valueReader(tokens, key, dict.where(key), wanted).template whole<T>());
    if (type == "codeStream") dict.get<T>(key, wanted);  // get refuses it
    const word v = ofVector ? "(x y z)" : "v";
    dict.fail(key, "'" + key + "' is a function of time: " +
                       (ofVector ? "a vector (x y z)" : "a number") + ", 'constant " + v +
                       "', 'table ((t " + v + ") ...)', 'polynomial ((a n) ...)', or " + key +
                       " { type ...; ... }. " + validWords("type", types<T>()));
}

template class Function1Of<scalar>;
template class Function1Of<vector>;

}  // namespace ispf
