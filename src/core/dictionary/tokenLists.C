// SPDX-License-Identifier: GPL-3.0-or-later
// Typed lists of numbers: List<vector> 3((1 2 3) ...), ASCII or binary.  They are kept as doubles, so that a field of a
// million values does not become a million words.
#include "token.H"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cctype>
#include <cmath>
#include <cstring>
#include <map>

namespace ispf
{

namespace
{

// Skips blanks, then `c`
bool skip(const char*& p, const char* end, char c)
{
    while (p < end && std::isspace(static_cast<unsigned char>(*p))) ++p;
    return p < end && *p == c && (++p, true);
}

bool number(const char*& p, const char* end, scalar& v)
{
    while (p < end && std::isspace(static_cast<unsigned char>(*p))) ++p;
    const auto [behind, error] = std::from_chars(p, end, v);
    if (error != std::errc() || !std::isfinite(v) || behind == end) return false;
    if (!std::isspace(static_cast<unsigned char>(*behind)) && *behind != ')') return false;
    p = behind;
    return true;
}

template <class T>
scalar valueAt(const char* p, bool swapped)
{
    char bytes[sizeof(T)];
    std::memcpy(bytes, p, sizeof(T));
    if (swapped) std::reverse(bytes, bytes + sizeof(T));
    return scalar(std::bit_cast<T>(bytes));
}

scalar valueAt(const char* p, const word& type, size_t size, bool swapped)
{
    if (type == "bool") return *p != 0;
    if (type == "label")
        return size == 8 ? valueAt<std::int64_t>(p, swapped) : valueAt<std::int32_t>(p, swapped);
    return size == 8 ? valueAt<double>(p, swapped) : valueAt<float>(p, swapped);
}

bool readCount(const word& text, size_t& n)
{
    const auto [p, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    return error == std::errc() && p == text.data() + text.size() && n > 0;
}

}  // namespace

word listType(const word& text)
{
    const bool isList = text.size() > 6 && text.compare(0, 5, "List<") == 0 && text.back() == '>';
    return isList ? text.substr(5, text.size() - 6) : "";
}

size_t componentsOf(const word& type)
{
    static const std::map<word, size_t> components = {
        {"scalar", 1}, {"label", 1},      {"bool", 1},   {"sphericalTensor", 1},
        {"vector", 3}, {"symmTensor", 6}, {"tensor", 9}, {"vector2D", 2}};
    const auto found = components.find(type);
    return found == components.end() ? 0 : found->second;
}

bool tokenReader::opensTypedList(const token& t) const
{
    size_t n;
    return t.is('(') && componentsOf(listType(type_)) > 0 && readCount(count_, n);
}

// Reads the list after its (.  If it has other than plain numbers, the ( stays a token
void tokenReader::readTypedList(token& t)
{
    const word type = listType(type_);
    size_t n;
    readCount(count_, n);
    if (binary_) readBinaryList(t, type, n);
    else if (type != "bool") readAsciiList(t, n, componentsOf(type));
}

void tokenReader::readBinaryList(token& t, const word& type, size_t n)
{
    const size_t size = type == "bool"    ? 1
                        : type == "label" ? layout_.labelSize
                                          : layout_.scalarSize;
    const size_t nValues = n <= s_.size() ? n * componentsOf(type) : s_.size();
    const size_t end = i_ + nValues * size;
    if (end >= s_.size() || s_[end] != ')')
        fail("The binary list of " + std::to_string(n) + " " + type +
                 " does not end where it should: the file is cut short, or `arch` or `format` in "
                 "its header are not true.",
             t.line);
    const bool swapped = layout_.bigEndian != (std::endian::native == std::endian::big);
    word values(nValues * sizeof(scalar), '\0');
    for (size_t k = 0; k < nValues; ++k)
    {
        const scalar v = valueAt(&s_[i_ + k * size], type, size, swapped);
        std::memcpy(&values[k * sizeof v], &v, sizeof v);
    }
    i_ = end + 1;
    t.kind = token::numbers, t.text = std::move(values);
}

bool tokenReader::readAsciiList(token& t, size_t n, size_t nComponents)
{
    const char *p = s_.data() + i_, *end = s_.data() + s_.size();
    if (n > s_.size()) return false;  // every element takes at least one character
    word values;
    values.reserve(std::min(n * nComponents, size_t(end - p) / 2 + 1) * sizeof(scalar));
    for (size_t k = 0; k < n; ++k)
    {
        if (nComponents > 1 && !skip(p, end, '(')) return false;
        for (size_t c = 0; c < nComponents; ++c)
        {
            scalar v;
            if (!number(p, end, v)) return false;
            values.append(reinterpret_cast<const char*>(&v), sizeof v);
        }
        if (nComponents > 1 && !skip(p, end, ')')) return false;
    }
    if (!skip(p, end, ')')) return false;
    line_ += int(std::count(s_.data() + i_, p, '\n'));
    i_ = size_t(p - s_.data());
    t.kind = token::numbers, t.text = std::move(values);
    return true;
}

namespace
{

// (a b c), with one element per line if there are many
word writtenNumbers(const word& values, size_t count)
{
    const size_t n = values.size() / sizeof(scalar), perElement = count ? n / count : 1;
    const char separator = count > 10 ? '\n' : ' ';
    word out = count > 10 ? "\n(\n" : "(";
    for (size_t k = 0; k < n; ++k)
    {
        if (k > 0) out += k % perElement == 0 ? separator : ' ';
        if (perElement > 1 && k % perElement == 0) out += '(';
        scalar v;
        std::memcpy(&v, &values[k * sizeof v], sizeof v);
        out += numberText(v);
        if (perElement > 1 && k % perElement == perElement - 1) out += ')';
    }
    return out + (count > 10 ? "\n)" : ")");
}

}  // namespace

word inQuotes(const word& text)
{
    word out(1, '"');
    for (const char c : text)
    {
        if (c == '"' || c == '\n') out += '\\';
        out += c;
    }
    out += '"';
    return out;
}

word written(const token& t, size_t count)
{
    switch (t.kind)
    {
        case token::quoted:
            return inQuotes(t.text);
        case token::verbatim:
            return "#{" + t.text + "#}";
        case token::variable:
            return "${" + t.text + "}";
        case token::directive:
            return "#" + t.text;
        case token::numbers:
            return writtenNumbers(t.text, count);
        default:
            return t.text;
    }
}

}  // namespace ispf
