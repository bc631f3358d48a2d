// SPDX-License-Identifier: GPL-3.0-or-later
// Where the rows of a tabulated function come from.
#include "Function1Table.H"

#include "fileNames.H"
#include "valueReader.H"
#include <algorithm>
#include <sstream>

namespace ispf
{

namespace
{

using row = Function1Table::row;

// ((t v) (t v) ...), optionally with the count in front
class rowReader
{
public:
    rowReader(const List<token>& tokens, const fileLocation& where) : tokens_(tokens), where_(where)
    {
    }

    List<row> all()
    {
        if (!done() && tokens_[i_].isPlain()) ++i_;
        List<row> rows;
        expect('(');
        while (!done() && !tokens_[i_].is(')'))
        {
            expect('(');
            const fileLocation place = here();
            const scalar t = number(), v = number();
            rows.push_back({t, v, place});
            expect(')');
        }
        expect(')');
        if (!done()) fail("nothing after it");
        return rows;
    }

private:
    bool done() const { return i_ == tokens_.size() || tokens_[i_].kind == token::end; }
    fileLocation here() const
    {
        fileLocation place = where_;
        if (!done()) place.line = tokens_[i_].line, place.lineEnd = 0;
        return place;
    }
    [[noreturn]] void fail(const word& wanted) const
    {
        throw fatalError("A table is written ((t value) (t value) ...): " + wanted +
                             " is wanted, found " +
                             (done() ? "its end." : tokens_[i_].described() + "."),
                         here());
    }
    void expect(char c)
    {
        if (done() || !tokens_[i_].is(c)) fail(word(1, c));
        ++i_;
    }
    scalar number()
    {
        scalar v;
        if (done() || !tokens_[i_].isPlain() || !readNumber(tokens_[i_].text, v))
            fail("a finite number");
        ++i_;
        return v;
    }

    const List<token>& tokens_;
    fileLocation where_;
    size_t i_ = 0;
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

class csvReader
{
public:
    csvReader(const dictionary& d, const word& path, const dimensionSet& wanted)
        : path_(path),
          wanted_(wanted),
          dict_(d),
          separator_(d.getOrDefault<word>("separator", ",")),
          merge_(d.getOrDefault<bool>("mergeSeparators", false)),
          nHeader_(d.getOrDefault<label>("nHeaderLine", 0))
    {
        if (separator_ == "\\t") separator_ = "\t";
        if (separator_.size() != 1) d.fail("separator", "The separator must be one character.");
    }

    List<row> rows()
    {
        word refColumn = dict_.getOrDefault<word>("refColumn", "0");
        auto values = dict_.getOrDefault<List<word>>("componentColumns", {"1"});
        if (values.size() != 1) dict_.fail("componentColumns", "One column is wanted here.");
        if (const auto both = dict_.getOrDefault<List<word>>("columns", {}); !both.empty())
        {
            if (both.size() != 2) dict_.fail("columns", "Two columns are wanted: (time value).");
            refColumn = both[0], values[0] = both[1];
        }
        const scalar scale = dict_.getOrDefault<scalar>("scale", 1);
        List<row> rows;
        scalar timeUnit = 1, valueUnit = 1;
        std::istringstream in(readText(path_));
        word line;
        for (label left = nHeader_; std::getline(in, line);)
        {
            ++line_;
            if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
            if (left-- > 0) readHeader(line);
            else
            {
                const size_t first = column("refColumn", refColumn);
                const size_t second = column("componentColumns", values[0]);
                const List<word> cells = split(line);
                const scalar t = cell(cells, first);
                if (rows.empty())
                    timeUnit = factor(first, dims::time), valueUnit = factor(second, wanted_);
                rows.push_back({t * timeUnit, scale * cell(cells, second) * valueUnit, here()});
            }
        }
        return rows;
    }

private:
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

    // Names, each with its unit or without: time [s]
    void readHeader(const word& line)
    {
        header_.clear(), units_.clear();
        for (const word& cell : split(line))
        {
            const size_t open = cell.find('['), close = cell.rfind(']');
            const bool hasUnit = open != word::npos && close != word::npos && close > open;
            header_.push_back(trimmed(hasUnit ? cell.substr(0, open) : cell));
            units_.push_back(hasUnit ? cell.substr(open + 1, close - open - 1) : "");
        }
        headerLine_ = here();
    }

    // To SI
    scalar factor(size_t column, const dimensionSet& wanted) const
    {
        if (column >= units_.size() || units_[column].empty()) return 1;
        const unit u = parsedUnit(units_[column], headerLine_);
        if (wanted.known && !(u.dimensions == wanted))
            throw fatalError("Column '" + header_[column] + "' is in [" + units_[column] +
                                 "], of the dimensions " + u.dimensions.text() +
                                 ",\nbut it must have " + wanted.text() + ".",
                             headerLine_);
        return u.factor;
    }

    size_t column(const word& key, const word& name) const
    {
        scalar number;
        if (readNumber(name, number) && number >= 0 && number == size_t(number))
            return size_t(number);
        const auto found = std::find(header_.begin(), header_.end(), name);
        if (found != header_.end()) return size_t(found - header_.begin());
        dict_.fail(key, "No column '" + name + "' in " + path_ + ". " +
                            (header_.empty() ? "nHeaderLine 1 tells that its first line has names."
                                             : validWords("column", header_)));
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
            throw fatalError(
                "A finite number is wanted, found '" + cells[k] +
                    "'.\nnHeaderLine skips lines at the top; lines with # are skipped anyhow.",
                here());
        return v;
    }

    word path_;
    dimensionSet wanted_;
    const dictionary& dict_;
    word separator_;
    bool merge_;
    label nHeader_;
    List<word> header_, units_;
    fileLocation headerLine_;
    int line_ = 0;
};

}  // namespace

List<row> inlineRows(const List<token>& tokens, const fileLocation& where)
{
    return rowReader(tokens, where).all();
}

List<row> listFileRows(const dictionary& dict, const word& caseFolder)
{
    const word path = dataFile(dict, caseFolder);
    return rowReader(tokenize(readText(path), path), {path, "", 1, 0}).all();
}

List<row> csvFileRows(const dictionary& dict, const word& caseFolder, const dimensionSet& wanted)
{
    return csvReader(dict, dataFile(dict, caseFolder), wanted).rows();
}

List<row> inUnits(List<row> rows, const dictionary& dict, const dimensionSet& wanted)
{
    if (!dict.found("units")) return rows;
    valueReader in(dict.tokenList("units"), "units", dict.where("units"));
    const word form = "two units, ([s] [m])";
    in.expect('(', form);
    if (!in.at('[')) in.fail(form);
    const scalar t = in.readUnit(dims::time);
    if (!in.at('[')) in.fail(form);
    const scalar v = in.readUnit(wanted);
    in.expect(')', form);
    in.expectEnd();
    for (row& r : rows) r.t *= t, r.value *= v;
    return rows;
}

}  // namespace ispf
