// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the rows of a tabulated function.
#include "Function1Table.H"

#include "fileNames.H"
#include "valueReader.H"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace ispf
{

namespace
{

// Reads ((t v) (t v) ...), with an optional count in front and, if `unit` is given, an optional unit after it
template <class T>
class rowReader : private valueReader
{
public:
    rowReader(const List<token>& tokens, const fileLocation& where,
              const dimensionSet* unit = nullptr)
        : valueReader(tokens, "table", where), unit_(unit)
    {
    }

    List<Function1Row<T>> all()
    {
        if (!done() && peek().isPlain()) take();
        List<Function1Row<T>> rows;
        next('(');
        while (!ends() && !at(')'))
        {
            next('(');
            Function1Row<T> r;
            r.where = here();
            element(r.t);
            element(r.value);
            next(')');
            rows.push_back(r);
        }
        next(')');
        const scalar factor = unit_ ? readUnit(*unit_) : 1;
        for (Function1Row<T>& r : rows) r.value *= factor;
        if (!ends() && at('['))
            throw fatalError(
                "A unit cannot stand here: 'units ([s] [m]);' beside the table gives "
                "those of times and values.",
                here());
        if (!ends()) failRow("nothing after it");
        return rows;
    }

private:
    const dimensionSet* unit_;
    bool ends() const { return done() || peek().kind == token::end; }
    [[noreturn]] void failRow(const word& wanted) const
    {
        const word value = std::is_same_v<T, vector> ? "(x y z)" : "value";
        throw fatalError("A table is written ((t " + value + ") (t " + value + ") ...): " + wanted +
                             " is wanted, found " +
                             (ends() ? "its end." : peek().described() + "."),
                         here());
    }
    void next(char c)
    {
        if (ends() || !at(c)) failRow(word(1, c));
        take();
    }
    void element(scalar& v)
    {
        if (ends() || !peek().isPlain() || !readNumber(peek().text, v)) failRow("a finite number");
        take();
    }
    void element(vector& v)
    {
        next('(');
        for (scalar& x : v) element(x);
        next(')');
    }
};

word dataFile(const dictionary& dict, const word& caseFolder)
{
    const word path = fromFolder(caseFolder, expandPath(dict.get<word>("file")));
    if (!isFile(path)) dict.fail("file", "There is no file " + path + ".");
    return path;
}

word trimmed(const word& s)
{
    const auto blank = " \t\r\"";
    const size_t b = s.find_first_not_of(blank);
    return b == word::npos ? "" : s.substr(b, s.find_last_not_of(blank) - b + 1);
}

// Factors to SI of the entry units ([ms] [mm])
struct rowUnits
{
    bool given = false;
    scalar time = 1, value = 1;

    rowUnits(const dictionary& dict, const dimensionSet& wanted) : given(dict.found("units"))
    {
        if (!given) return;
        valueReader in(dict.tokenList("units"), "units", dict.where("units"));
        const word form = "two units, ([s] [m])";
        in.expect('(', form);
        if (!in.at('[')) in.fail(form);
        time = in.readUnit(dims::time);
        if (!in.at('[')) in.fail(form);
        value = in.readUnit(wanted);
        in.expect(')', form);
        in.expectEnd();
    }
};

class csvReader
{
public:
    csvReader(const dictionary& d, const word& path, const dimensionSet& wanted)
        : path_(path),
          wanted_(wanted),
          dict_(d),
          units_(d, wanted),
          separator_(d.getOrDefault<word>("separator", ",")),
          merge_(d.getOrDefault<bool>("mergeSeparators", false)),
          nHeader_(d.getOrDefault<label>("nHeaderLine", 0))
    {
        if (separator_ == "\\t") separator_ = "\t";
        if (separator_.size() != 1) d.fail("separator", "The separator must be one character.");
    }

    template <class T>
    List<Function1Row<T>> rows()
    {
        constexpr size_t n = sizeof(T) / sizeof(scalar);
        const List<word> names = columnNames(n);
        const scalar scale = dict_.getOrDefault<scalar>("scale", 1);
        List<Function1Row<T>> rows;
        List<scalar> units(n + 1, 1.0);
        word text = readText(path_);
        if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);  // byte order mark
        std::istringstream in(text);
        word line;
        while (std::getline(in, line))
        {
            const word content = trimmed(line);
            if (++line_ <= nHeader_) readHeader(line);
            if (line_ <= nHeader_ || content.empty() || content[0] == '#') continue;
            if (rows.empty()) chooseHeader(names);
            List<size_t> columns;
            for (const word& name : names)
                columns.push_back(column(columns.empty() ? "refColumn" : "componentColumns", name));
            const List<word> cells = split(line);
            List<scalar> v;
            for (const size_t c : columns) v.push_back(cell(cells, c));
            for (size_t k = 0; k <= n && rows.empty(); ++k)
                units[k] = k == 0 ? factor(columns[k], dims::time, units_.time)
                                  : factor(columns[k], wanted_, units_.value) * scale;
            for (size_t k = 0; k <= n; ++k) v[k] *= units[k];
            Function1Row<T>& r = rows.emplace_back();
            r.t = v[0], r.where = here();
            if constexpr (n == 3) r.value = {v[1], v[2], v[3]};
            else r.value = v[1];
        }
        return rows;
    }

private:
    struct headerLine
    {
        List<word> names, units;
        bool remark = false;  // begins with #
        fileLocation where;
    };

    // Names of the columns of the time and of n components
    List<word> columnNames(size_t n) const
    {
        const word value = n == 3 ? "x y z" : "value",
                   three = n == 3 ? "Three columns are" : "One column is";
        List<word> all = dict_.getOrDefault<List<word>>("columns", {});
        if (!all.empty() && all.size() != n + 1)
            dict_.fail("columns", (n == 3 ? "Four" : "Two") + word(" columns are wanted: (time ") +
                                      value + ").");
        const word time = dict_.getOrDefault<word>("refColumn", "0");
        List<word> components;
        for (size_t k = 1; k <= n; ++k) components.push_back(std::to_string(k));
        components = dict_.getOrDefault<List<word>>("componentColumns", components);
        if (components.size() != n)
            dict_.fail("componentColumns", three + " wanted here: (" + value + ").");
        if (!all.empty()) return all;
        components.insert(components.begin(), time);
        return components;
    }

    fileLocation here() const { return {path_, "", line_, 0}; }

    List<word> split(const word& line) const
    {
        List<word> cells;
        for (size_t i = 0; i <= line.size();)
        {
            const size_t e = std::min(line.find(separator_, i), line.size());
            if (!merge_ || e > i) cells.push_back(trimmed(line.substr(i, e - i)));
            i = e + 1;
        }
        return cells;
    }

    // Reads names, each with or without a unit: time [s].  They may stand behind a #
    void readHeader(const word& line)
    {
        headerLine h;
        h.where = here();
        h.remark = trimmed(line)[0] == '#';
        const size_t first = h.remark ? line.find('#') : 0;
        const size_t begin = h.remark ? line.find_first_not_of("# \t\r", first) : 0;
        if (trimmed(line).empty() || begin == word::npos) return;
        for (const word& cell : split(line.substr(begin)))
        {
            const size_t open = cell.find('['), close = cell.rfind(']');
            const bool hasUnit = open != word::npos && close != word::npos && close > open;
            h.names.push_back(trimmed(hasUnit ? cell.substr(0, open) : cell));
            h.units.push_back(hasUnit ? cell.substr(open + 1, close - open - 1) : "");
        }
        headers_.push_back(h);
    }

    // Chooses the last header line that has the wanted columns; one behind a # only if no other has them
    void chooseHeader(const List<word>& columns)
    {
        const auto has = [](const headerLine& h, const word& column) {
            scalar number;
            return readNumber(column, number)
                       ? number < scalar(h.names.size())
                       : std::find(h.names.begin(), h.names.end(), column) != h.names.end();
        };
        int best = 0;
        for (const headerLine& h : headers_)
        {
            const bool all = std::all_of(columns.begin(), columns.end(),
                                         [&](const word& column) { return has(h, column); });
            const int rank = 2 * all + !h.remark;
            if (rank > 0 && rank >= best) best = rank, header_ = h;
        }
    }

    // Factor to SI of a column.  given: factor of the entry units, used if the header has no unit for the column
    scalar factor(size_t column, const dimensionSet& wanted, scalar given) const
    {
        if (column >= header_.units.size() || header_.units[column].empty()) return given;
        const unit u = parsedUnit(header_.units[column], header_.where);
        if (wanted.known && !(u.dimensions == wanted))
            throw fatalError("Column '" + header_.names[column] + "' is in [" +
                                 header_.units[column] + "], of the dimensions " +
                                 u.dimensions.text() + ",\nbut it must have " + wanted.text() + ".",
                             header_.where);
        if (units_.given && std::abs(u.factor - given) > 1e-9 * std::abs(given))
            dict_.fail("units", "Column '" + header_.names[column] + "' is in [" +
                                    header_.units[column] + "] by the header of " + path_ +
                                    ", and in another unit by this entry. Leave one of them away");
        return u.factor;
    }

    size_t column(const word& key, const word& name) const
    {
        scalar number;
        if (readNumber(name, number) && number >= 0 && number == size_t(number))
            return size_t(number);
        const auto found = std::find(header_.names.begin(), header_.names.end(), name);
        if (found != header_.names.end()) return size_t(found - header_.names.begin());
        const List<word>& known =
            header_.names.empty() && !headers_.empty() ? headers_.back().names : header_.names;
        dict_.fail(key, "No column '" + name + "' in " + path_ + ". " +
                            (known.empty() ? "nHeaderLine 1 tells that its first line has names."
                                           : validWords("column", known)));
    }

    scalar cell(const List<word>& cells, size_t k) const
    {
        if (k >= cells.size())
            throw fatalError("Column " + std::to_string(k) +
                                 " (counted from 0) is wanted, but the line has " +
                                 std::to_string(cells.size()) + " columns.",
                             here());
        scalar v;
        if (!readNumber(cells[k], v))
            throw fatalError("A finite number is wanted, found '" + cells[k] +
                                 "'.\nnHeaderLine tells how many lines at the top to skip: blank "
                                 "ones and those with # "
                                 "count.",
                             here());
        return v;
    }

    word path_;
    dimensionSet wanted_;
    const dictionary& dict_;
    rowUnits units_;
    word separator_;
    bool merge_;
    label nHeader_;
    List<headerLine> headers_;
    headerLine header_;  // the one in use
    int line_ = 0;
};

}  // namespace

template <class T>
List<Function1Row<T>> inlineRows(const List<token>& tokens, const fileLocation& where,
                                 const dimensionSet* unit)
{
    return rowReader<T>(tokens, where, unit).all();
}

template <class T>
List<Function1Row<T>> listFileRows(const dictionary& dict, const word& caseFolder)
{
    const word path = dataFile(dict, caseFolder);
    return rowReader<T>(tokenize(readText(path), path), {path, "", 1, 0}).all();
}

template <class T>
List<Function1Row<T>> csvFileRows(const dictionary& dict, const word& caseFolder,
                                  const dimensionSet& wanted)
{
    return csvReader(dict, dataFile(dict, caseFolder), wanted).rows<T>();
}

template <class T>
List<Function1Row<T>> inUnits(List<Function1Row<T>> rows, const dictionary& dict,
                              const dimensionSet& wanted)
{
    const rowUnits units(dict, wanted);
    for (Function1Row<T>& r : rows) r.t *= units.time, r.value *= units.value;
    return rows;
}

template List<Function1Row<scalar>> inlineRows(const List<token>&, const fileLocation&,
                                               const dimensionSet*);
template List<Function1Row<scalar>> listFileRows(const dictionary&, const word&);
template List<Function1Row<scalar>> csvFileRows(const dictionary&, const word&,
                                                const dimensionSet&);
template List<Function1Row<scalar>> inUnits(List<Function1Row<scalar>>, const dictionary&,
                                            const dimensionSet&);
template List<Function1Row<vector>> inlineRows(const List<token>&, const fileLocation&,
                                               const dimensionSet*);
template List<Function1Row<vector>> listFileRows(const dictionary&, const word&);
template List<Function1Row<vector>> csvFileRows(const dictionary&, const word&,
                                                const dimensionSet&);
template List<Function1Row<vector>> inUnits(List<Function1Row<vector>>, const dictionary&,
                                            const dimensionSet&);

}  // namespace ispf
