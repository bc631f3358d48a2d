// SPDX-License-Identifier: GPL-3.0-or-later
// Values of entries: get<T>, choose, getInRange, toString.
#include "dictionaryContent.H"

#include <algorithm>
#include <array>
#include <cmath>

namespace ispf
{

namespace
{

// Reads typed values from the tokens of one entry, with the place of each for errors
class valueReader
{
public:
    valueReader(const List<token>& tokens, const word& key, const fileLocation& where)
        : tokens_(tokens), key_(key), where_(where)
    {
    }

    [[noreturn]] void fail(const word& wanted) const
    {
        fileLocation place = where_;
        if (!done()) place.file = *peek().file, place.line = peek().line, place.lineEnd = 0;
        throw fatalError("The value of '" + key_ + "' should be " + wanted + ", found " +
                             (done() ? "its end." : peek().described() + "."),
                         place);
    }

    bool done() const { return i_ == tokens_.size(); }
    bool at(char c) const { return !done() && peek().is(c); }
    bool atPlain(const word& text) const
    {
        return !done() && peek().isPlain() && peek().text == text;
    }
    const token& peek() const { return tokens_[i_]; }
    const token& take() { return tokens_[i_++]; }

    // A dimension set before a value, with or without the name repeated: nu [0 2 -1 0 0 0 0] 1e-6
    void skipDimensions()
    {
        const bool named = tokens_.size() > 1 && tokens_[0].isPlain() && tokens_[1].is('[');
        i_ += named;
        if (!at('[')) return;
        while (!at(']')) ++i_;
        ++i_;
    }

    void skipWord(const word& text) { i_ += atPlain(text); }

    void expect(char c, const word& wanted)
    {
        if (!at(c)) fail(wanted);
        ++i_;
    }

    void expectEnd() const
    {
        if (done()) return;
        fileLocation place = where_;
        place.line = peek().line, place.lineEnd = 0;
        throw fatalError("Unexpected " + peek().described() + " behind the value of '" + key_ +
                             "'. Perhaps a ';' is missing before it.",
                         place);
    }

    void read(scalar& v)
    {
        if (done() || !peek().isPlain() || !readNumber(peek().text, v)) fail("a finite number");
        ++i_;
    }

    void read(label& v)
    {
        scalar s;
        if (done() || !peek().isPlain() || !readNumber(peek().text, s) || s != std::floor(s) ||
            std::abs(s) > 2147483647.0)
            fail("a whole number");
        v = label(s);
        ++i_;
    }

    void read(word& v)
    {
        if (done() || (!peek().isPlain() && peek().kind != token::quoted)) fail("a word");
        v = take().text;
    }

    void read(bool& v)
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
    std::array<scalar, n> components(const word& wanted)
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

    void read(vector& v)
    {
        const auto c = components<3>("a vector (x y z)");
        v = {c[0], c[1], c[2]};
    }

    void read(tensor& t)
    {
        const auto c = components<9>("a tensor (xx xy xz yx yy yz zx zy zz)");
        t << c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8];
    }

    // (a b c), 3(a b c), 3{a}, List<scalar> 3(a b c), nonuniform List<scalar> ...
    template <class T>
    void read(List<T>& list)
    {
        skipWord("nonuniform");
        if (!done() && peek().isPlain() && peek().text.compare(0, 5, "List<") == 0) ++i_;
        label n = -1;
        if (!done() && peek().isPlain()) read(n);
        if (n == 0 && done()) return;
        if (at('{')) return readUniform(list, n);
        expect('(', "a list ( ... )");
        while (!at(')'))
        {
            if (done()) fail("a list closed by )");
            read(list.emplace_back());
        }
        if (n >= 0 && n != label(list.size()))
            fail("a list of " + std::to_string(n) + " (it has " + std::to_string(list.size()) +
                 ")");
        ++i_;
    }

private:
    template <class T>
    void readUniform(List<T>& list, label n)
    {
        if (n < 0) fail("a list: the number before { must not be negative");
        ++i_;
        T value;
        read(value);
        expect('}', "a list closed by }");
        list.assign(size_t(n), value);
    }

    const List<token>& tokens_;
    word key_;
    fileLocation where_;
    size_t i_ = 0;
};

template <class T>
constexpr bool isWord = std::is_same_v<T, word> || std::is_same_v<T, bool>;

}  // namespace

template <class T>
T dictionary::get(const word& key) const
{
    valueReader in(valueEntry(key).value, key, where(key));
    T value{};
    if constexpr (!isWord<T>) in.skipDimensions();
    if constexpr (!isWord<T>) in.skipWord("uniform");
    in.read(value);
    in.expectEnd();
    return value;
}

template scalar dictionary::get<scalar>(const word&) const;
template label dictionary::get<label>(const word&) const;
template bool dictionary::get<bool>(const word&) const;
template word dictionary::get<word>(const word&) const;
template vector dictionary::get<vector>(const word&) const;
template tensor dictionary::get<tensor>(const word&) const;
template List<scalar> dictionary::get<List<scalar>>(const word&) const;
template List<label> dictionary::get<List<label>>(const word&) const;
template List<word> dictionary::get<List<word>>(const word&) const;
template List<vector> dictionary::get<List<vector>>(const word&) const;

word dictionary::choose(const word& key, const List<word>& valid) const
{
    const word value = get<word>(key);
    if (std::find(valid.begin(), valid.end(), value) == valid.end())
        fail(key, "Unknown " + key + " '" + value + "'." + didYouMean(value, valid) + "\n" +
                      validWords(key, valid));
    return value;
}

word dictionary::chooseOrDefault(const word& key, const List<word>& valid, const word& value) const
{
    return found(key) ? choose(key, valid) : value;
}

template <class T>
T dictionary::getInRange(const word& key, scalar low, scalar high) const
{
    const T value = get<T>(key);
    if (value < low || value > high)
        fail(key, "'" + key + "' is " + str(value, 10) + ", but must lie between " + str(low, 10) +
                      " and " + str(high, 10) + ".");
    return value;
}

template scalar dictionary::getInRange<scalar>(const word&, scalar, scalar) const;
template label dictionary::getInRange<label>(const word&, scalar, scalar) const;

namespace
{

word inQuotes(const word& text)
{
    word out(1, '"');
    for (const char c : text)
    {
        if (c == '"') out += '\\';
        out += c;
    }
    out += '"';
    return out;
}

word written(const token& t)
{
    if (t.kind == token::quoted) return inQuotes(t.text);
    return t.kind == token::verbatim ? "#{" + t.text + "#}" : t.text;
}

word writtenKey(const dictionaryEntry& e)
{
    if (e.pattern || e.key.find('"') != word::npos) return inQuotes(e.key);
    const List<token> words = tokenize(e.key, "");
    scalar number;
    const bool plain = words[0].isPlain() && words[0].text == e.key && !readNumber(e.key, number);
    return plain ? e.key : inQuotes(e.key);
}

word indented(const word& text)
{
    word out;
    for (size_t i = 0; i < text.size();)
    {
        const size_t e = text.find('\n', i) + 1;
        out += "    " + text.substr(i, e - i);
        i = e;
    }
    return out;
}

}  // namespace

word dictionary::toString() const
{
    word text;
    for (const dictionaryEntry& e : content_->entries)
    {
        const word key = writtenKey(e);
        if (e.isDict)
        {
            text += key + "\n{\n" + indented(e.dict.toString()) + "}\n";
            continue;
        }
        text += key;
        for (size_t k = 0; k < e.value.size(); ++k)
        {
            const bool tight = k > 0 && (e.value[k - 1].is('(') || e.value[k].is(')'));
            if (!tight) text += ' ';
            text += written(e.value[k]);
        }
        text += ";\n";
    }
    return text;
}

}  // namespace ispf
