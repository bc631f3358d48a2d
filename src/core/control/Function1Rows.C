// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the rows of a tabulated function.
#include "Function1Table.H"

#include "csvTable.H"
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

// Names of the columns of the time and of n components
List<word> columnNames(const dictionary& dict, size_t n)
{
    const word value = n == 3 ? "x y z" : "value",
               three = n == 3 ? "Three columns are" : "One column is";
    List<word> all = dict.getOrDefault<List<word>>("columns", {});
    if (!all.empty() && all.size() != n + 1)
        dict.fail("columns",
                  (n == 3 ? "Four" : "Two") + word(" columns are wanted: (time ") + value + ").");
    const word time = dict.getOrDefault<word>("refColumn", "0");
    List<word> components;
    for (size_t k = 1; k <= n; ++k) components.push_back(std::to_string(k));
    components = dict.getOrDefault<List<word>>("componentColumns", components);
    if (components.size() != n)
        dict.fail("componentColumns", three + " wanted here: (" + value + ").");
    if (!all.empty()) return all;
    components.insert(components.begin(), time);
    return components;
}

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
    constexpr size_t n = sizeof(T) / sizeof(scalar);
    csvFormat format;
    format.path = dataFile(dict, caseFolder);
    format.separator = dict.getOrDefault<word>("separator", ",");
    if (format.separator == "\\t") format.separator = "\t";
    format.mergeSeparators = dict.getOrDefault<bool>("mergeSeparators", false);
    format.nHeaderLine = dict.getOrDefault<label>("nHeaderLine", 0);
    const scalar scale = dict.getOrDefault<scalar>("scale", 1);
    const rowUnits units(dict, wanted);
    List<csvColumn> columns;
    for (const word& name : columnNames(dict, n))
        if (columns.empty())
            columns.push_back({name, "refColumn", dims::time, units.time, units.given});
        else columns.push_back({name, "componentColumns", wanted, units.value, units.given});
    List<Function1Row<T>> rows;
    for (const csvRow& row : csvRows(format, columns, dict))
    {
        Function1Row<T>& r = rows.emplace_back();
        r.t = row.values[0], r.where = row.where;
        if constexpr (n == 3) r.value = vector(row.values[1], row.values[2], row.values[3]);
        else r.value = row.values[1];
        r.value *= scale;
    }
    return rows;
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
