// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of the file, version 2:
//   /VTKHDF             UnstructuredGrid 1.0: Points, one vertex cell each, PointData/<column> of shape (n), (n, 3) or,
//                       from other programs, (n, any): wideColumns.H
//   /ispf               attribute version; contents: the paths of the following items and of all columns
//   /ispf/extra/<name>, /ispf/text/<name>
// Each array that this program writes has an attribute checksum.  All numbers are double or 64-bit integers: ParaView
// shows what a restart reads.  Version 1 had one checksum, /ispf@checksum, for the whole file.
#include "particleFile.H"

#include "fileNames.H"
#include "hdf5File.H"
#include "particleTableCheck.H"
#include "wideColumns.H"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace ispf
{

namespace
{

constexpr globalId formatVersion = 2;
constexpr std::uint8_t vtkVertex = 1;
const word grid = "/VTKHDF", points = "/VTKHDF/Points", columns = "/VTKHDF/PointData";
const word ours = "/ispf", extras = "/ispf/extra", texts = "/ispf/text",
           contents = "/ispf/contents";
const word sum = "checksum";

class composer
{
public:
    word bytes(const particleTable& table)
    {
        addGrid(table);
        file_.group(extras);
        file_.group(texts);
        file_.attribute(ours, "version", List<globalId>{formatVersion});
        put(points, table.x);
        putColumns(table.scalars), putAll(columns, table.vectors);
        putColumns(table.integers), putAll(extras, table.extra);
        putAll(texts, table.attributes);
        put(contents, word(list_));
        return file_.bytes();
    }

private:
    template <class T>
    void put(const word& path, const T& values)
    {
        file_.write(path, values);
        file_.attribute(path, sum, List<globalId>{checksumOf(path, values)});
        list_ += path + "\n";
    }
    template <class T>
    void putColumns(const std::map<word, List<T>>& list)
    {
        for (const diskColumn<T>& column : diskColumns(list))
        {
            const word path = columns + "/" + column.name;
            if (!column.wide)
            {
                put(path, *column.parts[0]);
                continue;
            }
            const List<T> flat = column.flat();
            file_.write(path, flat, column.parts.size());
            file_.attribute(path, sum, List<globalId>{checksumOf(path, flat)});
            list_ += path + "\n";
        }
    }
    template <class Columns>
    void putAll(const word& group, const Columns& list)
    {
        for (const auto& [name, values] : list) put(group + "/" + name, values);
    }
    void addGrid(const particleTable& table)
    {
        const globalId n = globalId(table.size());
        file_.group(columns);
        file_.attribute(grid, "Version", List<globalId>{1, 0});
        file_.attribute(grid, "Type", word("UnstructuredGrid"));
        for (const word count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
            file_.write(grid + "/" + count, List<globalId>{n});
        List<globalId> index(size_t(n) + 1);
        std::iota(index.begin(), index.end(), globalId(0));
        file_.write(grid + "/Offsets", index);
        index.pop_back();
        file_.write(grid + "/Connectivity", index);
        file_.write(grid + "/Types", List<std::uint8_t>(size_t(n), vtkVertex));
    }

    hdf5Writer file_;
    word list_;
};

class tableReader
{
public:
    tableReader(const word& path, List<word>& remarks) : path_(path), file_(path), remarks_(remarks)
    {
    }

    particleTable read()
    {
        version_ = readVersion();
        if (version_ > 1) readContents();
        remarkOthers();
        particleTable table;
        get(points, table.x);
        for (const word& name : file_.children(columns))
            if (isForeign(columns + "/" + name)) readForeign(name, table);
            else readColumn(name, table);
        for (const word& name : file_.children(extras))
            if (isOf(extras + "/" + name, hdf5Reader::kind::scalars)) getExtra(name, table.extra);
        for (const word& name : file_.children(texts))
            if (isOf(texts + "/" + name, hdf5Reader::kind::text))
                get(texts + "/" + name, table.attributes[name]);
        for (const word& name : foreign_) judge(name, table);
        checkTable(table, "Cannot read '" + path_ + "'", isDamaged);
        if (version_ == 1) checkWhole(table);
        return table;
    }

private:
    void remark(const word& text) { remarks_.push_back(path_ + ": " + text); }
    void remarkLost(const word& what) { remark(what + ": later times are without it"); }

    // Warns of what the reader does not keep
    void remarkOthers()
    {
        const auto others = [&](const word& group, const List<word>& known) {
            for (const word& name : file_.found(group) ? file_.children(group) : List<word>())
                if (std::find(known.begin(), known.end(), name) == known.end())
                    remarkLost("'" + (group == "/" ? "" : group) + "/" + name +
                               "' is not one of particles");
        };
        others("/", {grid.substr(1), ours.substr(1)});
        others(grid, {"Points", "PointData", "NumberOfPoints", "NumberOfCells",
                      "NumberOfConnectivityIds", "Offsets", "Connectivity", "Types"});
        others(ours, {"extra", "text", "contents"});
        remarkAttributes("/", {}), remarkAttributes(grid, {"Version", "Type"});
        remarkAttributes(ours, {"version", sum}), remarkAttributes(points, {sum});
        for (const word& group : {columns, extras, texts})
            for (const word& name : file_.found(group) ? file_.children(group) : List<word>())
                remarkAttributes(group + "/" + name, {sum});
    }

    void remarkAttributes(const word& object, const List<word>& known)
    {
        if (!file_.found(object) && object != "/") return;
        for (const word& name : file_.attributes(object))
            if (std::find(known.begin(), known.end(), name) == known.end())
                remarkLost("the attribute " + name + " of '" + object + "' is of no use here");
    }

    bool isForeign(const word& path) const
    {
        return version_ > 1 && !ours_.count(path) && !file_.foundAttribute(path, sum);
    }

    bool leadsNowhere(const word& path)
    {
        if (file_.found(path)) return false;
        remarkLost("'" + path + "' is a link to nothing");
        return true;
    }

    // Reads a column of another program; leaves it out if it is unsound
    void readForeign(const word& name, particleTable& table)
    {
        const word path = columns + "/" + name;
        if (leadsNowhere(path)) return;
        try
        {
            if (readColumn(name, table)) foreign_.push_back(name);
        }
        catch (const fatalError& e)
        {
            remarkLost("'" + path + "' is no field that can be read (" + e.what() + ")");
        }
    }

    void judge(const word& name, particleTable& table)
    {
        const word path = columns + "/" + name, fault = takeOutUnsound(table, name);
        if (fault.empty()) remarkKept(path);
        else remarkLost("'" + path + "' is not kept (" + fault + ")");
    }

    void remarkKept(const word& path)
    {
        remark("'" + path + "' has no checksum: somebody else has put it in, and it is kept");
    }

    void getExtra(const word& name, std::map<word, List<scalar>>& list)
    {
        const word path = extras + "/" + name;
        List<scalar> values;
        file_.read(path, values);
        const bool isSound =
            std::all_of(values.begin(), values.end(), [](scalar v) { return std::isfinite(v); });
        if (isForeign(path) && !isSound)
            return remarkLost("'" + path + "' holds what is not a finite number");
        check(path, values);
        list[name] = std::move(values);
    }

    // True if this program wrote the array or text, or if it has the wanted kind
    bool isOf(const word& path, hdf5Reader::kind wanted)
    {
        if (ours_.count(path) || file_.foundAttribute(path, sum)) return true;
        if (leadsNowhere(path)) return false;
        if (file_.kindOf(path) == wanted) return true;
        remarkLost("'" + path + "' is no " +
                   (wanted == hdf5Reader::kind::text ? "text" : "list of real numbers"));
        return false;
    }

    globalId readVersion() const
    {
        if (!file_.found(ours) || !file_.found(columns) || !file_.foundAttribute(ours, "version"))
            file_.fail(
                "it is an HDF5 file, but not one of particles written by this program family");
        List<globalId> version;
        file_.attribute(ours, "version", version);
        if (version.size() == 1 && (version[0] == 1 || version[0] == formatVersion))
            return version[0];
        file_.fail("its format version is " +
                   (version.empty() ? word("absent") : std::to_string(version[0])) +
                   "; this program reads versions 1 to " + std::to_string(formatVersion) +
                   ".  Use the program that wrote it, or a newer one");
    }

    template <class T>
    void get(const word& path, T& values)
    {
        file_.read(path, values);
        check(path, values);
    }

    template <class T>
    void check(const word& path, const T& values)
    {
        if (version_ == 1) return;
        if (!file_.foundAttribute(path, sum))
            return isForeign(path) && path.starts_with(columns) ? void() : remarkKept(path);
        List<globalId> stored;
        file_.attribute(path, sum, stored);
        if (stored != List<globalId>{checksumOf(path, values)})
            file_.fail(
                "the checksum of '" + path +
                "' does not fit its content: the file was damaged, or edited.  If you have edited "
                "it, remove the attribute " +
                sum + " of that dataset");
    }

    // False, with a remark, if the column is of an unknown kind
    bool readColumn(const word& name, particleTable& table)
    {
        const word path = columns + "/" + name;
        switch (file_.kindOf(path))
        {
            case hdf5Reader::kind::scalars:
                return get(name, table.scalars);
            case hdf5Reader::kind::vectors:
                return get(name, table.vectors);
            case hdf5Reader::kind::integers:
                return fits(path) && get(name, table.integers);
            case hdf5Reader::kind::wideScalars:
                return getWide(name, table.scalars);
            case hdf5Reader::kind::wideIntegers:
                return fits(path) && getWide(name, table.integers);
            default:
                remarkLost("'" + path + "' has no rows of numbers");
                return false;
        }
    }

    bool fits(const word& path)
    {
        if (!file_.exceedsIntegers(path)) return true;
        remarkLost("'" + path + "' holds whole numbers beyond 2^63");
        return false;
    }

    template <class T>
    bool get(const word& name, std::map<word, List<T>>& list)
    {
        List<T> values;
        get(columns + "/" + name, values);
        list[name] = std::move(values);
        return true;
    }

    template <class T>
    bool getWide(const word& name, std::map<word, List<T>>& list)
    {
        const word path = columns + "/" + name;
        List<T> flat;
        file_.readWide(path, flat);
        check(path, flat);
        split(flat, name, file_.width(path), list);
        return true;
    }

    void checkWhole(const particleTable& table)
    {
        if (!file_.foundAttribute(ours, sum))
            return remark("it has no checksum and is read as it is");
        List<globalId> stored;
        file_.attribute(ours, sum, stored);
        if (stored != List<globalId>{checksumOf(table)})
            file_.fail("its checksum does not fit its content: the file was damaged or edited");
    }

    // Reads the list of what was written: none of it may be missing
    void readContents()
    {
        if (!file_.found(contents))
            file_.fail("'" + contents + "' is missing: the file was damaged");
        word text;
        get(contents, text);
        std::istringstream lines(text);
        for (word path; std::getline(lines, path);)
            if (!file_.found(path))
                file_.fail("'" + path + "' is missing: the file was damaged, or edited");
            else ours_.insert(path);
    }

    word path_;
    hdf5Reader file_;
    List<word>& remarks_;
    globalId version_ = 0;
    std::set<word> ours_;  // paths
    List<word> foreign_;   // columns
};

}  // namespace

namedText particleText(const particleTable& table, const word& path)
{
    checkTable(table, "Particles are not written to '" + path + "'", hasDiverged);
    return {path, composer().bytes(table)};
}

void writeParticles(const particleTable& table, const word& path)
{
    writeTexts({particleText(table, path)});
}

particleTable readParticlesHere(const word& path, List<word>& remarks)
{
    return tableReader(path, remarks).read();
}

}  // namespace ispf
