// SPDX-License-Identifier: GPL-3.0-or-later
#include "token.H"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <mutex>
#include <set>

namespace ispf
{

namespace
{

constexpr size_t longestWord = 1024;  // as in OpenFOAM

// Keeps the names of files that tokens point to
const word* keptName(const word& name)
{
    static std::mutex guard;
    static std::set<word> names;
    const std::lock_guard<std::mutex> lock(guard);
    return &*names.insert(name).first;
}

bool isBlank(char c)
{
    return std::isspace(static_cast<unsigned char>(c));
}

}  // namespace

tokenReader::tokenReader(const word& text, const word& fileName)
    : s_(text), file_(keptName(fileName))
{
    if (s_.size() >= UINT32_MAX) fail("A dictionary of 4 GB or more cannot be read.", 0);
}

void tokenReader::fail(const word& message, int line) const
{
    throw fatalError(message, fileLocation{*file_, "", line, 0});
}

bool tokenReader::at(const char* p) const
{
    return s_.compare(i_, std::strlen(p), p) == 0;
}

token tokenReader::make(token::kindType kind, const word& text, int line) const
{
    token t;
    t.kind = kind, t.line = line, t.file = file_, t.text = text;
    return t;
}

token tokenReader::next()
{
    token t;
    if (!pending_.empty())
    {
        t = pending_.front();
        pending_.pop_front();
        return t;
    }
    skipBlank();
    const size_t first = i_;
    t = read();
    if (opensTypedList(t)) readTypedList(t);
    t.first = std::uint32_t(first), t.last = std::uint32_t(i_);
    type_ = std::move(count_);
    count_ = t.isPlain() ? t.text : "";
    return t;
}

// Moves to the place after the next `closing`; returns the text before it
word tokenReader::upTo(const word& closing, const word& what)
{
    const int line = line_;
    const size_t e = s_.find(closing, i_);
    if (e == word::npos) fail("The " + what + " begun here is never closed.", line);
    const word text = s_.substr(i_, e - i_);
    line_ += int(std::count(text.begin(), text.end(), '\n'));
    i_ = e + closing.size();
    return text;
}

void tokenReader::skipBlank()
{
    while (i_ < s_.size())
    {
        if (isBlank(s_[i_])) line_ += s_[i_++] == '\n';
        else if (at("\xEF\xBB\xBF")) i_ += 3;  // byte order mark: also inside, if files were joined
        else if (at("//")) i_ = std::min(s_.find('\n', i_), s_.size());
        else if (at("/*")) i_ += 2, upTo("*/", "comment /*");
        else return;
    }
}

token tokenReader::read()
{
    const int line = line_;
    if (i_ == s_.size()) return make(token::end, "", line);
    const char c = s_[i_];
    if (c == '\0') fail("A zero byte: this is not a text file.", line);
    if (std::strchr(";{}()[],", c)) return ++i_, make(token::punctuation, word(1, c), line);
    if (c == '"') return quotedString();
    if (c == '#') return hash();
    if (c == '$') return dollar();
    if (std::isdigit(static_cast<unsigned char>(c)) || std::strchr("+-.", c))
        return make(token::plain, readNumberOrWord(), line);
    const word text = readWord();
    if (text.empty()) fail(word("Unexpected character '") + c + "'.", line);
    return make(token::plain, text, line);
}

// #{ verbatim #}, #word, #eval{ formula }
token tokenReader::hash()
{
    const int line = line_;
    if (at("#{")) return i_ += 2, make(token::verbatim, upTo("#}", "verbatim text #{"), line);
    for (++i_; at(' ') || at('\t');) ++i_;
    const token name = make(token::directive, readWord(), line);
    if (name.text != "eval" && name.text != "calc") return name;
    const size_t behind = i_;
    const int lineBehind = line_;
    skipBlank();
    if (at('{'))
    {
        const size_t first = i_;
        token body = make(token::verbatim, braced("formula {"), line_);
        body.first = std::uint32_t(first), body.last = std::uint32_t(i_);
        pending_.push_back(body);
    }
    else i_ = behind, line_ = lineBehind;
    return name;
}

// $name, ${name}, ${{ formula }}
token tokenReader::dollar()
{
    const int line = line_;
    const size_t first = i_++;
    if (!at('{')) return make(token::variable, readWord(), line);
    word name = braced("macro ${");
    if (name.empty() || name.front() != '{' || name.back() != '}')
        return make(token::variable, name, line);
    token body = make(token::verbatim, name.substr(1, name.size() - 2), line);
    body.first = std::uint32_t(first), body.last = std::uint32_t(i_);
    pending_.push_back(body);
    return make(token::directive, "eval", line);
}

// The text from the { here to the brace that closes it
word tokenReader::braced(const word& what)
{
    const int line = line_;
    const size_t begin = i_ + 1;
    int depth = 0;
    for (; i_ < s_.size(); ++i_)
    {
        line_ += s_[i_] == '\n';
        depth += (s_[i_] == '{') - (s_[i_] == '}');
        if (depth == 0) return ++i_, s_.substr(begin, i_ - 1 - begin);
    }
    fail("The " + what + " begun here is never closed.", line);
}

// \" is a quote, and \ before a line end continues the string; any other backslash stays, for
// regular expressions
token tokenReader::quotedString()
{
    const int line = line_;
    word text;
    bool escaped = false;
    for (++i_;; ++i_)
    {
        if (i_ == s_.size()) fail("The string begun here is never closed.", line);
        const char c = s_[i_];
        if (c == '"' && !escaped) break;
        if (c == '\n' && !escaped)
            fail("A string runs over the end of the line; a closing \" is missing.", line);
        if (c == '\0') fail("A zero byte in a string: this is not a text file.", line);
        if (escaped && (c == '"' || c == '\n')) text.pop_back();
        line_ += c == '\n';
        escaped = c == '\\' && !escaped;
        text += c;
    }
    ++i_;
    return make(token::quoted, text, line);
}

bool tokenReader::endsWord(size_t i) const
{
    const char c = s_[i];
    if (isBlank(c) || std::strchr("\";{}", c)) return true;
    return c == '/' && i + 1 < s_.size() && (s_[i + 1] == '/' || s_[i + 1] == '*');
}

// Brackets belong to a word if they close inside it: div(phi,U).  Otherwise the word ends before
// the bracket that is left open, so that `uniform(0 0 0)` and `[m]` are read correctly.
word tokenReader::readWord()
{
    const size_t begin = i_;
    List<size_t> open;
    size_t e = i_;
    for (; e < s_.size() && !endsWord(e) && e - begin <= longestWord; ++e)
    {
        if (s_[e] == '(' || s_[e] == '[') open.push_back(e);
        if (s_[e] != ')' && s_[e] != ']') continue;
        if (open.empty()) break;
        open.pop_back();
    }
    i_ = open.empty() ? e : open.front();
    if (i_ - begin > longestWord)
        fail("A word of more than " + std::to_string(longestWord) + " characters.", line_);
    return s_.substr(begin, i_ - begin);
}

// A number ends at any bracket or comma and before a macro: 3(1 2 3)
word tokenReader::readNumberOrWord()
{
    const size_t begin = i_;
    while (i_ < s_.size() && !endsWord(i_) && !std::strchr("()[],$", s_[i_])) ++i_;
    if (i_ - begin > longestWord)
        fail("A number of more than " + std::to_string(longestWord) + " characters.", line_);
    return s_.substr(begin, i_ - begin);
}

word token::described() const
{
    switch (kind)
    {
        case end:
            return "the end of the file";
        case quoted:
            return "the string \"" + text + "\"";
        case variable:
            return "the macro $" + text;
        case directive:
            return "the directive #" + text;
        case verbatim:
            return "the verbatim text #{" + text + "#}";
        case numbers:
            return "a list of numbers";
        default:
            return "'" + text + "'";
    }
}

List<token> tokenize(const word& text, const word& fileName)
{
    tokenReader reader(text, fileName);
    List<token> tokens;
    do tokens.push_back(reader.next());
    while (tokens.back().kind != token::end);
    return tokens;
}

bool readNumber(const word& text, scalar& value)
{
    const char* begin = text.c_str() + (text[0] == '+' && text[1] != '-');
    const char* end = text.c_str() + text.size();
    const auto [p, error] = std::from_chars(begin, end, value);
    return error == std::errc() && p == end && std::isfinite(value);
}

word numberText(scalar value)
{
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace ispf
