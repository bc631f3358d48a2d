// SPDX-License-Identifier: GPL-3.0-or-later
// uniform/particles, version 1:
//     version 1;  nParticles n;
//     checksums   (("positions" -123) ...);          // of the fields that are of ours
//     attributes  (("dx" "0.01") ...);               // texts
//     arrays      (("name" 3(0.1 0.2 0.3)) ...);     // of any length
//     checksum    c;                                 // of attributes and arrays
#include "particleState.H"

#include "dictionary.H"
#include "fileNames.H"
#include "particleTableCheck.H"
#include "token.H"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace ispf
{

namespace
{

constexpr label asciiVersion = 1;
const word positions = "positions", stateFile = "/uniform/particles", copy = "particles.vtp";

word header(const word& type, const word& location, const word& object)
{
    return "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " + type +
           ";\n    location    \"" + location + "\";\n    object      " + object + ";\n}\n\n";
}

template <class Number>
void put(word& text, Number v)
{
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, v).ptr);
}

void put(word& text, const vector& v)
{
    for (int d = 0; d < 3; ++d) text += d == 0 ? '(' : ' ', put(text, v[d]);
    text += ')';
}

// A text may hold quotes and line ends
word quoted(const word& text)
{
    const bool plain = text.find_first_of("\"\\\n\r") == word::npos;
    return plain ? '"' + text + '"' : "#{" + text + "#}";
}

// [kg m s K mol A cd] of the fields whose meaning is fixed
word dimensionsOf(const word& field)
{
    static const std::map<word, word> known = {{positions, "[0 1 0 0 0 0 0]"},
                                               {"x0", "[0 1 0 0 0 0 0]"},
                                               {"U", "[0 1 -1 0 0 0 0]"},
                                               {"p", "[1 -1 -2 0 0 0 0]"}};
    const auto found = known.find(field);
    return found == known.end() ? "" : "dimensions      " + found->second + ";\n\n";
}

class composer
{
public:
    explicit composer(const word& folder)
        : folder_(folder), location_(std::filesystem::path(folder).filename().string())
    {
    }

    template <class T>
    void add(const word& name, const word& type, const word& component, const List<T>& values)
    {
        word text = header("particle" + type + "Field", location_, name) + dimensionsOf(name) +
                    "internalField   nonuniform List<" + component + ">\n";
        put(text, values.size());
        text += "\n(\n";
        for (const T& v : values) put(text, v), text += '\n';
        files_.push_back({folder_ + "/" + name, text + ")\n;\n"});
        sums_ += "    (" + quoted(name) + " " + std::to_string(checksumOf(name, values)) + ")\n";
    }

    List<namedText> files(const particleTable& table, int precision)
    {
        add(positions, "Vector", "vector", table.x);
        for (const auto& [name, v] : table.scalars) add(name, "Scalar", "scalar", v);
        for (const auto& [name, v] : table.vectors) add(name, "Vector", "vector", v);
        for (const auto& [name, v] : table.integers) add(name, "Label", "label", v);
        files_.push_back({folder_ + "/" + copy, vtpText(table, precision)});
        files_.push_back(
            {folder_ + stateFile, stateText(table)});  // last: it makes the folder a state
        return std::move(files_);
    }

private:
    word stateText(const particleTable& table) const
    {
        word text = header("dictionary", location_ + "/uniform", "particles") + "version     " +
                    std::to_string(asciiVersion) + ";\nnParticles  " +
                    std::to_string(table.size()) + ";\n\nchecksums\n(\n" + sums_ +
                    ");\n\nattributes\n(\n";
        for (const auto& [name, value] : table.attributes)
            text += "    (" + quoted(name) + " " + quoted(value) + ")\n";
        text += ");\n\narrays\n(\n";
        for (const auto& [name, values] : table.extra)
        {
            text += "    (" + quoted(name) + " " + std::to_string(values.size()) + "(";
            for (const scalar v : values) put(text, v), text += ' ';
            text += "))\n";
        }
        return text + ");\n\nchecksum    " + std::to_string(rest(table)) + ";\n";
    }

    word folder_, location_, sums_;
    List<namedText> files_;

public:
    // Of all that is no field
    static globalId rest(const particleTable& table)
    {
        particleTable t;
        t.extra = table.extra, t.attributes = table.attributes;
        return checksumOf(t);
    }
};

// Goes through the tokens of an entry
class entryReader
{
public:
    entryReader(const dictionary& d, const word& key) : d_(d), key_(key), t_(d.tokenList(key)) {}

    bool more() const { return at_ < t_.size(); }
    const token& next()
    {
        if (!more()) d_.fail(key_, "The entry ends too early: the file is damaged or truncated.");
        return t_[at_++];
    }
    bool skip(char c) { return more() && t_[at_].is(c) && ++at_; }
    void want(char c)
    {
        const token& t = next();
        if (!t.is(c)) fail(t, word("'") + c + "'");
    }
    word text()
    {
        const token& t = next();
        if (t.kind != token::quoted && t.kind != token::verbatim && !t.isPlain()) fail(t, "a text");
        return t.text;
    }
    void read(scalar& v)
    {
        const token& t = next();
        if (!readNumber(t.text, v)) fail(t, "a number");
    }
    void read(globalId& v)
    {
        const token& t = next();
        const char* end = t.text.data() + t.text.size();
        const auto [stop, error] = std::from_chars(t.text.data(), end, v);
        if (error != std::errc() || stop != end) fail(t, "a whole number");
    }
    // n(...): n must be what is there
    template <class T>
    void readList(List<T>& values)
    {
        globalId n = 0;
        read(n);
        const size_t left = t_.size() - at_;
        if (n < 0 || size_t(n) > left)
            d_.fail(key_, "The list is said to hold " + std::to_string(n) +
                              " values, but there are not so many.");
        values.resize(size_t(n));
        want('(');
        for (T& v : values) read(v);
        want(')');
    }
    [[noreturn]] void fail(const token& t, const word& wanted) const
    {
        throw fatalError("Expected " + wanted + ", found " + t.described() + ".",
                         t.where(d_.scope()));
    }

private:
    const dictionary& d_;
    word key_;
    const List<token>& t_;
    size_t at_ = 0;
};

class asciiReader
{
public:
    explicit asciiReader(const word& folder)
        : folder_(folder), state_(dictionary::fromFile(folder + stateFile))
    {
        if (const label v = state_.get<label>("version"); v != asciiVersion)
            state_.fail("version", "The format version is " + std::to_string(v) +
                                       "; this program reads version " +
                                       std::to_string(asciiVersion) +
                                       ".  Use the program that wrote it, or a newer one.");
        readPairs("checksums", [&](entryReader& r, const word& name) { r.read(sums_[name]); });
    }

    const std::map<word, globalId>& sums() const { return sums_; }

    particleTable read()
    {
        particleTable table;
        readPairs("attributes",
                  [&](entryReader& r, const word& name) { table.attributes[name] = r.text(); });
        readPairs("arrays",
                  [&](entryReader& r, const word& name) { r.readList(table.extra[name]); });
        entryReader sum(state_, "checksum");
        globalId stored = 0;
        sum.read(stored);
        if (stored != composer::rest(table))
            state_.fail("checksum",
                        "The checksum does not fit attributes and arrays: the file was "
                        "damaged, or edited.");
        for (const auto& [name, ignored] : sums_)
            if (!isFile(folder_ + "/" + name))
                throw fatalError("Cannot read " + folder_ + "/" + name +
                                 ": the field is missing, but " + folder_ + stateFile +
                                 " names it.");
        readFields(table);
        checkTable(table, "Cannot read '" + folder_ + "'");
        if (globalId(table.size()) != state_.get<label>("nParticles"))
            state_.fail("nParticles", "There are " + std::to_string(table.size()) + " positions.");
        return table;
    }

private:
    template <class Value>
    void readPairs(const word& key, Value&& value)
    {
        entryReader r(state_, key);
        r.want('(');
        while (!r.skip(')'))
        {
            r.want('(');
            const word name = r.text();
            value(r, name);
            r.want(')');
        }
    }

    void readFields(particleTable& table)
    {
        List<word> names;
        for (const auto& item : std::filesystem::directory_iterator(folder_))
            if (const word name = item.path().filename().string();
                item.is_regular_file() && name != copy && name != "particles.hdf" &&
                item.path().extension() != ".tmp")
                names.push_back(name);
        std::sort(names.begin(), names.end());
        for (const word& name : names) readField(name, table);
    }

    void readField(const word& name, particleTable& table)
    {
        const dictionary d = dictionary::fromFile(folder_ + "/" + name);
        const List<token>& tokens = d.tokenList("internalField");
        const word type = tokens.size() > 1 ? listType(tokens[1].text) : "";
        const auto values = [&](auto list) {
            return d.get<decltype(list)>("internalField", dims::any);
        };
        if (type == "scalar") keep(name, table.scalars[name] = values(List<scalar>()));
        else if (type == "label")
            keep(name, table.integers[name] = whole(d, values(List<scalar>())));
        else if (type != "vector")
            d.fail("internalField",
                   "Expected nonuniform and a list.\n" +
                       validWords("list", {"List<scalar>", "List<vector>", "List<label>"}));
        else if (name == positions) keep(name, table.x = values(List<vector>()));
        else keep(name, table.vectors[name] = values(List<vector>()));
    }

    // Particle numbers are beyond 32 bits
    static List<globalId> whole(const dictionary& d, const List<scalar>& values)
    {
        constexpr scalar exact = 9007199254740992;  // 2^53
        List<globalId> result;
        for (const scalar v : values)
        {
            if (v != std::floor(v) || std::abs(v) > exact)
                d.fail("internalField", str(v, 17) + " is not a whole number up to 2^53.");
            result.push_back(globalId(v));
        }
        return result;
    }

    template <class T>
    void keep(const word& name, const List<T>& values)
    {
        const word file = folder_ + "/" + name;
        const auto sum = sums_.find(name);
        if (sum == sums_.end())
            return warning(file + " has no checksum in " + folder_ + stateFile +
                           ": somebody else has put it in, and it is kept");
        if (sum->second != checksumOf(name, values))
            throw fatalError(
                "Cannot read " + file +
                ": its checksum does not fit its content: it was damaged, or edited.  If "
                "you have edited it, take its checksum out of " +
                folder_ + stateFile);
    }

    word folder_;
    dictionary state_;
    std::map<word, globalId> sums_;
};

}  // namespace

void writeAsciiState(const particleTable& table, const word& folder, int precision)
{
    checkTable(table, "Particles are not written to '" + folder + "'");
    List<word> old = asciiStateFiles(folder);
    const List<namedText> files = composer(folder).files(table, precision);
    writeTexts(files);
    for (const word& file : old)
        if (std::none_of(files.begin(), files.end(), [&](const auto& f) { return f.path == file; }))
            std::filesystem::remove(file);
}

particleTable readAsciiState(const word& folder)
{
    return asciiReader(folder).read();
}

List<word> asciiStateFiles(const word& folder)
{
    if (!isFile(folder + stateFile)) return {};
    List<word> files = {folder + stateFile, folder + "/" + copy};
    try
    {
        const asciiReader reader(folder);
        for (const auto& [name, ignored] : reader.sums()) files.push_back(folder + "/" + name);
    }
    catch (const fatalError&)  // of no use any more
    {
    }
    return files;
}

}  // namespace ispf
