// SPDX-License-Identifier: GPL-3.0-or-later
#include "token.H"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

namespace ispf
{

namespace
{

class tokenizer
{
public:
    tokenizer(const word& text, const word& fileName)
        : s_(text), file_(std::make_shared<const word>(fileName))
    {
        if (s_.compare(0, 3, "\xEF\xBB\xBF") == 0) i_ = 3;  // byte order mark
    }

    List<token> all()
    {
        List<token> tokens;
        for (;;)
        {
            skipBlank();
            tokens.push_back(next());
            if (tokens.back().kind == token::end) return tokens;
            if (tokens.back().kind == token::directive && tokens.back().text == "eval")
            {
                skipBlank();
                if (at('{')) tokens.push_back(bracedExpression());
            }
        }
    }

private:
    [[noreturn]] void fail(const word& message, int line) const
    {
        throw fatalError(message, fileLocation{*file_, "", line, 0});
    }
    bool at(char c) const { return i_ < s_.size() && s_[i_] == c; }
    bool at(const char* p) const { return s_.compare(i_, std::strlen(p), p) == 0; }
    token make(token::kindType kind, const word& text, int line) const
    {
        return {kind, text, line, file_};
    }

    // Moves behind the next `closing`; the text before it
    word upTo(const word& closing, const word& what)
    {
        const int line = line_;
        const size_t e = s_.find(closing, i_);
        if (e == word::npos) fail("The " + what + " begun here is never closed.", line);
        const word text = s_.substr(i_, e - i_);
        line_ += int(std::count(text.begin(), text.end(), '\n'));
        i_ = e + closing.size();
        return text;
    }

    void skipBlank()
    {
        while (i_ < s_.size())
        {
            if (std::isspace(static_cast<unsigned char>(s_[i_]))) line_ += s_[i_++] == '\n';
            else if (at("//")) i_ = std::min(s_.find('\n', i_), s_.size());
            else if (at("/*")) i_ += 2, upTo("*/", "comment /*");
            else return;
        }
    }

    token next()
    {
        if (i_ == s_.size()) return make(token::end, "", line_);
        const int line = line_;
        const char c = s_[i_];
        if (c == '\0') fail("A zero byte: this is not a text file.", line);
        if (std::strchr(";{}()[],", c)) return ++i_, make(token::punctuation, word(1, c), line);
        if (c == '"') return quotedString();
        if (at("#{")) return i_ += 2, make(token::verbatim, upTo("#}", "verbatim text #{"), line);
        if (c == '#') return ++i_, make(token::directive, readWord(), line);
        if (at("${{")) return i_ += 3, make(token::verbatim, upTo("}}", "expression ${{"), line);
        if (at("${")) return i_ += 2, make(token::variable, upTo("}", "macro ${"), line);
        if (c == '$') return ++i_, make(token::variable, readWord(), line);
        if (std::isdigit(static_cast<unsigned char>(c)) || std::strchr("+-.", c))
            return make(token::plain, readNumberOrWord(), line);
        const word text = readWord();
        if (text.empty()) fail(word("Unexpected character '") + c + "'.", line);
        return make(token::plain, text, line);
    }

    token quotedString()
    {
        const int line = line_;
        word text;
        for (++i_;; ++i_)
        {
            if (i_ == s_.size()) fail("The string begun here is never closed.", line);
            if (s_[i_] == '"') break;
            if (s_[i_] == '\n')
                fail("A string runs over the end of the line; a closing \" is missing.", line);
            // \" is a quote; any other backslash belongs to a regular expression
            if (s_[i_] == '\\' && i_ + 1 < s_.size() && s_[i_ + 1] == '"') ++i_;
            text += s_[i_];
        }
        ++i_;
        return make(token::quoted, text, line);
    }

    token bracedExpression()
    {
        const int line = line_;
        int depth = 0;
        const size_t begin = i_ + 1;
        for (; i_ < s_.size(); ++i_)
        {
            line_ += s_[i_] == '\n';
            depth += (s_[i_] == '{') - (s_[i_] == '}');
            if (depth == 0)
                return ++i_, make(token::verbatim, s_.substr(begin, i_ - 1 - begin), line);
        }
        fail("The expression { begun here is never closed.", line);
    }

    bool endsWord(size_t i) const
    {
        const char c = s_[i];
        if (std::isspace(static_cast<unsigned char>(c)) || std::strchr("\";{}", c)) return true;
        return c == '/' && i + 1 < s_.size() && (s_[i + 1] == '/' || s_[i + 1] == '*');
    }

    // Brackets belong to a word if they close inside it: div(phi,U).  Otherwise the word ends
    // before the one left open, so that `uniform(0 0 0)` and `[m]` are read as meant.
    word readWord()
    {
        const size_t begin = i_;
        List<size_t> open;
        size_t e = i_;
        for (; e < s_.size() && !endsWord(e); ++e)
        {
            if (s_[e] == '(' || s_[e] == '[') open.push_back(e);
            if (s_[e] != ')' && s_[e] != ']') continue;
            if (open.empty()) break;
            open.pop_back();
        }
        i_ = open.empty() ? e : open.front();
        return s_.substr(begin, i_ - begin);
    }

    // A number ends at any bracket or comma: 3(1 2 3)
    word readNumberOrWord()
    {
        const size_t begin = i_;
        while (i_ < s_.size() && !endsWord(i_) && !std::strchr("()[],", s_[i_])) ++i_;
        return s_.substr(begin, i_ - begin);
    }

    const word& s_;
    std::shared_ptr<const word> file_;
    size_t i_ = 0;
    int line_ = 1;
};

}  // namespace

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
        default:
            return "'" + text + "'";
    }
}

List<token> tokenize(const word& text, const word& fileName)
{
    return tokenizer(text, fileName).all();
}

bool readNumber(const word& text, scalar& value)
{
    const char* begin = text.c_str() + (text[0] == '+' && text[1] != '-');
    const char* end = text.c_str() + text.size();
    const auto [p, error] = std::from_chars(begin, end, value);
    return error == std::errc() && p == end && std::isfinite(value);
}

}  // namespace ispf
