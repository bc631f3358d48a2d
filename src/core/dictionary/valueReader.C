// SPDX-License-Identifier: GPL-3.0-or-later
#include "valueReader.H"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ispf
{

valueReader::valueReader(const List<token>& tokens, const word& key, const fileLocation& where,
                         const dimensionSet& wanted)
    : tokens_(tokens), key_(key), where_(where), wanted_(wanted)
{
}

fileLocation valueReader::here() const
{
    fileLocation place = where_;
    if (!done())
        place.file = peek().file ? *peek().file : where_.file, place.line = peek().line,
        place.lineEnd = 0;
    return place;
}

void valueReader::fail(const word& wanted) const
{
    word advice;
    if (!done() && peek().kind == token::directive && peek().text == "codeStream")
        throw fatalError("The value of '" + key_ +
                             "' is #codeStream, which is refused: a case file must not run "
                             "compiled code. Write the value itself, or #calc.",
                         here());
    if (!done() && peek().isPlain() && !peek().text.empty() && std::isdigit(peek().text[0]) &&
        std::isalpha(static_cast<unsigned char>(peek().text.back())))
        advice = " A unit stands in brackets: 5 [mm].";
    if (!done() && peek().isPlain() && peek().text == "-") advice = " #neg $name changes a sign.";
    throw fatalError("The value of '" + key_ + "' should be " + wanted + ", found " +
                         (done() ? "its end." : peek().described() + ".") + advice,
                     here());
}

bool valueReader::atPlain(const word& text) const
{
    return !done() && peek().isPlain() && peek().text == text;
}

void valueReader::expect(char c, const word& wanted)
{
    if (!at(c)) fail(wanted);
    ++i_;
}

void valueReader::expectEnd() const
{
    if (done()) return;
    if (at('['))
        throw fatalError("A unit [...] cannot stand behind the value of '" + key_ +
                             "': give it in SI without one.",
                         here());
    throw fatalError("Unexpected " + peek().described() + " behind the value of '" + key_ +
                         "'. Perhaps a ';' is missing before it.",
                     here());
}

void valueReader::readName()
{
    if (tokens_.size() > i_ + 1 && peek().isPlain() && tokens_[i_ + 1].is('['))
    {
        scalar number;
        i_ += !readNumber(peek().text, number) && peek().text != "uniform";
    }
}

scalar valueReader::readUnit(const dimensionSet& wanted)
{
    if (!at('[')) return 1;
    const fileLocation place = here();
    word text;
    for (++i_; !at(']'); ++i_)
    {
        if (done()) fail("followed by a unit [...]");
        text += (text.empty() ? "" : " ") + peek().text;
    }
    ++i_;
    const unit u = parsedUnit(text, place);
    if (wanted.known && !(u.dimensions == wanted))
        throw fatalError("'" + key_ + "' is given in [" + text + "], of the dimensions " +
                             u.dimensions.text() + ",\nbut it must have " + wanted.text() + ".",
                         place);
    return u.factor;
}

void valueReader::read(scalar& v)
{
    if (done() || !peek().isPlain() || !readNumber(peek().text, v)) fail("a finite number");
    ++i_;
}

void valueReader::read(label& v)
{
    scalar s;
    if (done() || !peek().isPlain() || !readNumber(peek().text, s) || s != std::floor(s) ||
        std::abs(s) > 2147483647.0)
        fail("a whole number");
    v = label(s);
    ++i_;
}

void valueReader::read(word& v)
{
    if (done() || (!peek().isPlain() && peek().kind != token::quoted)) fail("a word");
    v = take().text;
}

void valueReader::read(bool& v)
{
    static const List<word> on = {"on", "yes", "true"}, off = {"off", "no", "false"};
    const auto isOneOf = [&](const List<word>& words) {
        return !done() && std::find(words.begin(), words.end(), peek().text) != words.end();
    };
    v = isOneOf(on);
    if (!v && !isOneOf(off)) fail("a switch: on off yes no true false");
    ++i_;
}

template <int n>
std::array<scalar, n> valueReader::components(const word& wanted)
{
    std::array<scalar, n> c;
    expect('(', wanted);
    for (scalar& v : c)
    {
        if (at(')')) fail(wanted);
        read(v);
    }
    expect(')', wanted);
    return c;
}

void valueReader::read(vector& v)
{
    const auto c = components<3>("a vector (x y z)");
    v = {c[0], c[1], c[2]};
}

void valueReader::read(tensor& t)
{
    const bool symmetric = i_ + 7 < tokens_.size() && tokens_[i_ + 7].is(')');
    if (symmetric)
    {
        const auto c = components<6>("a symmetric tensor (xx xy xz yy yz zz)");
        t << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
        return;
    }
    const auto c = components<9>("a tensor (xx xy xz yx yy yz zx zy zz)");
    t << c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8];
}

namespace
{

constexpr size_t largestUniformList = 100000000;  // 1000000000{0} is a typing error

template <class T>
constexpr size_t nComponents = std::is_same_v<T, vector> ? 3
                               : std::is_same_v<T, word> ? 0
                                                         : 1;

}  // namespace

template <class T>
void valueReader::read(List<T>& list)
{
    if (atPlain("nonuniform")) ++i_;
    if (!done() && peek().isPlain() && !listType(peek().text).empty()) ++i_;
    label n = -1;
    if (!done() && peek().isPlain()) read(n);
    if (n == 0 && done()) return;
    if (at('{')) return readUniform(list, n);
    if (!done() && peek().kind == token::numbers) return readNumbers(list, n);
    expect('(', "a list ( ... )");
    while (!at(')'))
    {
        if (done()) fail("a list closed by )");
        read(list.emplace_back());
    }
    if (n >= 0 && n != label(list.size()))
        fail("a list of " + std::to_string(n) + " (it has " + std::to_string(list.size()) + ")");
    ++i_;
}

template <class T>
void valueReader::readUniform(List<T>& list, label n)
{
    if (n < 0) fail("a list: the number before { must not be negative");
    if (size_t(n) > largestUniformList) fail("a list of a sensible length");
    ++i_;
    T value;
    read(value);
    expect('}', "a list closed by }");
    list.assign(size_t(n), value);
}

template <class T>
void valueReader::readNumbers(List<T>& list, label n)
{
    const word& bytes = peek().text;
    const size_t components = bytes.size() / sizeof(scalar) / size_t(n);
    if (components != nComponents<T>)
        fail("a list of elements with " + std::to_string(nComponents<T>) +
             " components (these have " + std::to_string(components) + ")");
    list.resize(size_t(n));
    for (size_t k = 0; k < list.size(); ++k)
    {
        scalar v[3];
        std::memcpy(v, &bytes[k * components * sizeof(scalar)], components * sizeof(scalar));
        for (size_t c = 0; c < components; ++c)
            if (!std::isfinite(v[c]))
                fail("a list of finite numbers (element " + std::to_string(k) + " is not)");
        if constexpr (std::is_same_v<T, vector>) list[k] = {v[0], v[1], v[2]};
        else if constexpr (std::is_same_v<T, label>)
        {
            if (v[0] != std::floor(v[0]) || std::abs(v[0]) > 2147483647.0)
                fail("a list of whole numbers");
            list[k] = label(v[0]);
        }
        else if constexpr (std::is_same_v<T, scalar>) list[k] = v[0];
    }
    ++i_;
}

namespace
{

void scale(scalar& v, scalar by)
{
    v *= by;
}
void scale(vector& v, scalar by)
{
    v *= by;
}
void scale(tensor& v, scalar by)
{
    v *= by;
}
void scale(label&, scalar) {}
template <class T>
void scale(List<T>& list, scalar by)
{
    if constexpr (!std::is_same_v<T, word>)
        for (T& v : list) scale(v, by);
}

template <class T>
constexpr bool hasUnit =
    !std::is_same_v<T, word> && !std::is_same_v<T, bool> && !std::is_same_v<T, List<word>>;

}  // namespace

template <class T>
T valueReader::whole()
{
    T value{};
    if constexpr (hasUnit<T>)
    {
        readName();
        const scalar before = readUnit();
        if (atPlain("uniform")) ++i_;
        read(value);
        const scalar behind = readUnit();
        if (before != 1 && behind != 1)
            throw fatalError("'" + key_ + "' has a unit before and one behind its value.", where_);
        if (before * behind != 1) scale(value, before * behind);
    }
    else read(value);
    expectEnd();
    return value;
}

template scalar valueReader::whole();
template label valueReader::whole();
template bool valueReader::whole();
template word valueReader::whole();
template vector valueReader::whole();
template tensor valueReader::whole();
template List<scalar> valueReader::whole();
template List<label> valueReader::whole();
template List<word> valueReader::whole();
template List<vector> valueReader::whole();

}  // namespace ispf
