// SPDX-License-Identifier: GPL-3.0-or-later
#include "asciiFiles.H"

#include "dictionary.H"
#include "fileNames.H"
#include "particleTableCheck.H"
#include "token.H"
#include "wideColumns.H"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace ispf
{

namespace
{

// Reads the tokens of an entry one by one
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
    void want(const char* form)
    {
        if (!next().isPlain()) d_.fail(key_, word(form) + " is missing.");
    }
    // Reads all numbers of a typed list, if that comes next
    bool readNumbers(List<scalar>& values)
    {
        if (!more() || t_[at_].kind != token::numbers) return false;
        const word& bytes = t_[at_++].text;
        values.resize(bytes.size() / sizeof(scalar));
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(scalar));
        return true;
    }
    bool readNumbers(List<globalId>&) { return false; }
    // Reads n(...); the list must have n elements
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
        const List<word> known = {"FoamFile",   "version", "nParticles", "checksums",
                                  "attributes", "arrays",  "checksum"};
        for (const word& key : state_.keys())
            if (std::find(known.begin(), known.end(), key) == known.end())
                warning(state_.path() + ": the entry '" + key +
                        "' is of no use here: later times are without it");
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
        if (stored != checksumOfRest(table))
            state_.fail("checksum",
                        "The checksum does not fit attributes and arrays: the file was "
                        "damaged, or edited.");
        for (const auto& [name, ignored] : sums_)
            if (!isFile(folder_ + "/" + name))
                throw fatalError("Cannot read " + folder_ + "/" + name +
                                 ": the field is missing, but " + folder_ + stateFile +
                                 " names it.");
        readFields(table);
        for (const word& name : foreign_) judge(name, table);
        checkTable(table, "Cannot read '" + folder_ + "'", isDamaged);
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
                item.is_regular_file() && name != paraviewCopy && name != "particles.hdf" &&
                item.path().extension() != ".tmp")
                names.push_back(name);
        std::sort(names.begin(), names.end());
        for (const word& name : names)
            if (isOurs(name)) readField(name, table);
            else readForeign(name, table);
    }

    // True if the field has a checksum, or if particles need it: such a field is ours even if a user has edited it
    bool isOurs(const word& name) const
    {
        static const List<word> needed = {positions, "U", "p", "zone", "id", "x0"};
        return sums_.count(name) || std::find(needed.begin(), needed.end(), name) != needed.end();
    }

    void remarkLost(const word& name, const word& why) const
    {
        warning(folder_ + "/" + name + " " + why + ": later times are without it");
    }

    // Reads a field of another program; leaves it out if it is unsound
    void readForeign(const word& name, particleTable& table)
    {
        try
        {
            if (readText(folder_ + "/" + name).find("internalField") == word::npos)
                return remarkLost(name, "is no field");
            readField(name, table);
            foreign_.push_back(name);
        }
        catch (const fatalError& e)
        {
            const int line = e.location().line;
            remarkLost(name, "is no field that can be read (" +
                                 (line > 0 ? "line " + std::to_string(line) + ": " : "") +
                                 e.what() + ")");
        }
    }

    void judge(const word& name, particleTable& table) const
    {
        const word fault = takeOutUnsound(table, name);
        if (!fault.empty()) return remarkLost(name, "is not kept (" + fault + ")");
        remarkKept(name);
    }

    void remarkKept(const word& name) const
    {
        warning(folder_ + "/" + name + " has no checksum in " + folder_ + stateFile +
                ": somebody else has put it in, and it is kept");
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
        else if (const auto [isWhole, width] = wideType(type); width > 0)
            isWhole ? readWide(d, name, width, table.integers)
                    : readWide(d, name, width, table.scalars);
        else if (type != "vector")
            d.fail("internalField",
                   "Expected nonuniform and a list.\n" +
                       validWords("list",
                                  {"List<scalar>", "List<vector>", "List<label>", "List<vector2D>",
                                   "List<symmTensor>", "List<tensor>", "List<sphericalTensor>",
                                   "List<FixedList<scalar,n>>", "List<FixedList<label,n>>"}));
        else if (name == positions) keep(name, table.x = values(List<vector>()));
        else keep(name, table.vectors[name] = values(List<vector>()));
    }

    // Whether the type has whole numbers, and how many; zero if it is no type of several numbers
    static std::pair<bool, size_t> wideType(const word& type)
    {
        for (const char* component : {"scalar", "label"})
        {
            const word begin = "FixedList<" + word(component) + ",";
            scalar n = 0;
            if (!type.starts_with(begin) ||
                !readNumber(type.substr(begin.size(), type.size() - begin.size() - 1), n))
                continue;
            const bool isOne = n >= 1 && n <= scalar(mostComponents) && n == std::floor(n);
            return {component == word("label"), isOne ? size_t(n) : 0};
        }
        const size_t width = componentsOf(type);
        return {false, elementType("scalar", width) == type ? width : 0};
    }

    template <class T>
    void readWide(const dictionary& d, const word& name, size_t width,
                  std::map<word, List<T>>& columns)
    {
        const List<T> flat = flatList<T>(d, width);
        keep(name, flat);
        split(flat, name, width, columns);
    }

    // The values of n((..)(..)...) or n{(..)}, row by row
    template <class T>
    List<T> flatList(const dictionary& d, size_t width)
    {
        entryReader r(d, "internalField");
        r.want("nonuniform"), r.want("List<...>");
        globalId n = 0;
        r.read(n);
        if (n != state_.get<label>("nParticles"))
            d.fail("internalField",
                   "The list is said to hold " + std::to_string(n) + " elements, but there are " +
                       std::to_string(state_.get<label>("nParticles")) + " particles.");
        List<T> flat;
        const auto readElement = [&] {
            r.want('(');
            for (size_t k = 0; k < width; ++k) r.read(flat.emplace_back());
            r.want(')');
        };
        if (r.skip('{'))
        {
            readElement();
            r.want('}');
            flat.reserve(size_t(n) * width);
            while (flat.size() < size_t(n) * width) flat.push_back(flat[flat.size() - width]);
        }
        else if (!r.readNumbers(flat))
        {
            r.want('(');
            for (globalId i = 0; i < n; ++i) readElement();
            r.want(')');
        }
        if (r.more()) r.fail(r.next(), "the end of the list");
        return flat;
    }

    // The whole numbers of the list: particle numbers exceed 32 bits
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
        if (sum == sums_.end()) return isOurs(name) ? remarkKept(name) : void();
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
    List<word> foreign_;
};

}  // namespace

particleTable readAsciiState(const word& folder)
{
    return asciiReader(folder).read();
}

List<word> asciiStateFiles(const word& folder)
{
    if (!isFile(folder + stateFile)) return {};
    List<word> files = {folder + stateFile, folder + "/" + paraviewCopy};
    try
    {
        const asciiReader reader(folder);
        for (const auto& [name, ignored] : reader.sums()) files.push_back(folder + "/" + name);
    }
    catch (const fatalError&)  // an unreadable state: its fields stay
    {
    }
    return files;
}

}  // namespace ispf
