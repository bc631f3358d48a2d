// SPDX-License-Identifier: GPL-3.0-or-later
#include "triSurface.H"

#include "fileNames.H"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace ispf
{

namespace
{

constexpr size_t headerBytes = 80, recordBytes = 50;
// the range of single precision ends there; volumes are still finite
constexpr scalar largest = 1e40;

bool isBlank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

// True if token is the keyword, in upper or lower case
bool is(std::string_view token, std::string_view keyword)
{
    const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; };
    return std::equal(token.begin(), token.end(), keyword.begin(), keyword.end(), same);
}

// Words of an ascii file, one after another wherever its lines end
class asciiReader
{
public:
    asciiReader(const word& bytes, const word& path) : text_(bytes), path_(path)
    {
        if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;  // byte order mark
    }

    triSurface read()
    {
        bool inSolid = false;
        for (auto token = next(); !token.empty(); token = next())
        {
            if (is(token, "solid")) startSolid(), inSolid = true;
            else if (is(token, "facet") && inSolid) readFacet();
            else if (is(token, "endsolid") && inSolid) name({"solid"}), inSolid = false;
            else fail("'" + shown(token) + "' stands where solid, facet or endsolid should");
        }
        if (inSolid)
            throw fatalError("The surface file " + path_ + " is cut off at line " +
                             std::to_string(line_) + ": there is no endsolid");
        return std::move(surface_);
    }

private:
    [[noreturn]] void fail(const word& what) const
    {
        throw fatalError("Line " + std::to_string(line_) + " of the surface file " + path_ + ": " +
                         what);
    }
    // The beginning of a word; letters that are not of ASCII as \xNN
    static word shown(std::string_view token)
    {
        word text;
        for (const unsigned char c : token.substr(0, 40))
        {
            char code[8];
            std::snprintf(code, sizeof code, c > ' ' && c < 127 ? "%c" : "\\x%02x", c);
            text += code;
        }
        return text;
    }

    std::string_view next()
    {
        for (; at_ < text_.size() && isBlank(text_[at_]); ++at_)
            line_ += text_[at_] == '\n' || (text_[at_] == '\r' && text_.substr(at_, 2) != "\r\n");
        const size_t from = at_;
        while (at_ < text_.size() && !isBlank(text_[at_])) ++at_;
        return text_.substr(from, at_ - from);
    }

    void expect(std::string_view keyword)
    {
        const auto token = next();
        if (token.empty())
            throw fatalError("The surface file " + path_ + " is cut off at line " +
                             std::to_string(line_) + ", within a facet");
        if (!is(token, keyword))
            fail("'" + shown(token) + "' stands where " + word(keyword) +
                 " should: a facet has three corners");
    }

    // The rest of the line; in a file without lines, all up to a keyword
    word name(const List<word>& keywords)
    {
        word found;
        while (true)
        {
            while (at_ < text_.size() && isBlank(text_[at_]) && text_[at_] != '\n' &&
                   text_[at_] != '\r')
                ++at_;
            if (at_ == text_.size() || isBlank(text_[at_])) return found;
            const size_t from = at_;
            const auto token = next();
            for (const word& keyword : keywords)
                if (is(token, keyword))
                {
                    at_ = from;
                    return found;
                }
            found += (found.empty() ? "" : "_") + word(token);
        }
    }

    void startSolid()
    {
        word given = name({"facet", "endsolid"});
        if (given.empty())
        {
            ++unnamed_;
            given = std::filesystem::path(path_).stem().string() +
                    (unnamed_ > 1 ? std::to_string(unnamed_) : word());
        }
        patch_ = surface_.addPatch(given);
    }

    scalar number()
    {
        word digits(next());
        std::replace_if(
            digits.begin(), digits.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
        const char* first = digits.data() + (digits[0] == '+');
        const char* last = digits.data() + digits.size();
        scalar value = 0;
        const auto [end, error] = std::from_chars(first, last, value);
        const bool outOfRange = error == std::errc::result_out_of_range;
        if ((error != std::errc() && !outOfRange) || end != last)
            fail("'" + shown(digits) + "' is not a coordinate of a corner");
        if (outOfRange || !(std::abs(value) < largest))
            fail("'" + shown(digits) + "' is not a finite number, or absurdly large");
        return value;
    }

    // The normal is not read, because it may be wrong: the order of the corners counts
    void readFacet()
    {
        for (auto token = next(); !is(token, "outer"); token = next())
            if (token.empty() || is(token, "vertex") || is(token, "endfacet"))
                fail("the facet has no 'outer loop'");
        expect("loop");
        vector corner[3];
        for (vector& p : corner)
        {
            expect("vertex");
            for (int k = 0; k < 3; ++k) p[k] = number();
        }
        expect("endloop"), expect("endfacet");
        surface_.add(corner[0], corner[1], corner[2], patch_);
    }

    std::string_view text_;
    const word& path_;
    size_t at_ = 0;
    int line_ = 1, unnamed_ = 0;
    label patch_ = -1;
    triSurface surface_;
};

std::uint32_t announced(const word& bytes)
{
    std::uint32_t n;
    std::memcpy(&n, &bytes[headerBytes], 4);
    return n;
}

size_t binaryBytes(std::uint32_t n)
{
    return headerBytes + 4 + recordBytes * size_t(n);
}

// A binary file has the length that its record count gives.  This is the only sure mark, because its header may begin
// with "solid".  A binary file that is too long or cut off has bytes that no text has.
bool isBinary(const word& bytes)
{
    if (bytes.size() < binaryBytes(0)) return false;
    return bytes.size() == binaryBytes(announced(bytes)) ||
           bytes.find('\0') < binaryBytes(0) + 2 * recordBytes;
}

void checkLooksAscii(const word& bytes, const word& path)
{
    const size_t mark = bytes.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
    const auto begin = std::find_if_not(bytes.begin() + mark, bytes.end(), isBlank);
    if (begin == bytes.end()) throw fatalError("The surface file " + path + " is empty");
    const word start(begin, begin + std::min<size_t>(bytes.end() - begin, 5));
    if (!is(start, "solid"))
        throw fatalError("The file " + path +
                         " is not STL: it is neither text that begins with 'solid' nor as long as "
                         "a binary file of the number of facets in its bytes 81 to 84");
}

triSurface readBinary(const word& bytes, const word& path)
{
    const std::uint32_t n = announced(bytes);
    if (bytes.size() < binaryBytes(n))
        throw fatalError("The binary surface file " + path +
                         " is cut off, or no STL: it announces " + std::to_string(n) +
                         " triangles, which take " + std::to_string(binaryBytes(n)) +
                         " bytes, and has " + std::to_string(bytes.size()));
    if (bytes.size() > binaryBytes(n))
        warning("The binary surface file " + path + " announces " + std::to_string(n) +
                " triangles; the " + std::to_string(bytes.size() - binaryBytes(n)) +
                " bytes after these are not read");
    triSurface s;
    s.addPatch(std::filesystem::path(path).stem().string());
    for (std::uint32_t t = 0; t < n; ++t)
    {
        float v[12];
        std::memcpy(v, &bytes[binaryBytes(t)], sizeof v);
        const vector a(v[3], v[4], v[5]), b(v[6], v[7], v[8]), c(v[9], v[10], v[11]);
        if (!a.allFinite() || !b.allFinite() || !c.allFinite())
            throw fatalError("A corner of triangle " + std::to_string(t + 1) +
                             " of the binary surface file " + path + " is not a finite number");
        s.add(a, b, c, 0);
    }
    return s;
}

}  // namespace

triSurface parseSTL(const word& bytes, const word& path)
{
    const bool binary = isBinary(bytes);
    if (!binary) checkLooksAscii(bytes, path);
    triSurface s = binary ? readBinary(bytes, path) : asciiReader(bytes, path).read();
    if (s.empty()) throw fatalError("The surface file " + path + " holds no triangle");
    const label all = label(s.size());
    s.weld(0);
    if (const label flat = all - label(s.size()); flat > 0 && flat < all)
        info() << path << ": triangles without area dropped: " << flat << "\n";
    if (s.empty()) throw fatalError("All triangles of the surface file " + path + " have no area");
    return s;
}

triSurface readSTL(const word& path)
{
    return parseSTL(readText(path), path);
}

}  // namespace ispf
