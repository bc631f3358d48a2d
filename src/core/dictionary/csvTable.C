// SPDX-License-Identifier: GPL-3.0-or-later
#include "csvTable.H"

#include "fileNames.H"
#include "token.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ispf
{

namespace
{

word trimmed(const word& s)
{
    const auto blank = " \t\r\"";
    const size_t b = s.find_first_not_of(blank);
    return b == word::npos ? "" : s.substr(b, s.find_last_not_of(blank) - b + 1);
}

class csvReader
{
public:
    csvReader(const csvFormat& format, const List<csvColumn>& columns, const dictionary& d)
        : format_(format), columns_(columns), dict_(d)
    {
    }

    List<csvRow> rows()
    {
        List<csvRow> rows;
        List<size_t> places;
        List<scalar> factors;
        word text = readText(format_.path);
        if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);  // byte order mark
        std::istringstream in(text);
        word line;
        while (std::getline(in, line))
        {
            const word content = trimmed(line);
            if (++line_ <= format_.nHeaderLine) readHeader(line);
            if (line_ <= format_.nHeaderLine || content.empty() || content[0] == '#') continue;
            if (rows.empty()) chooseColumns(places);
            const List<word> cells = split(line);
            csvRow& row = rows.emplace_back();
            row.where = here();
            for (const size_t k : places) row.values.push_back(cell(cells, k));
            if (factors.empty())
                for (size_t k = 0; k < columns_.size(); ++k)
                    factors.push_back(factor(places[k], columns_[k]));
            for (size_t k = 0; k < columns_.size(); ++k) row.values[k] *= factors[k];
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

    fileLocation here() const { return {format_.path, "", line_, 0}; }

    List<word> split(const word& line) const
    {
        List<word> cells;
        for (size_t i = 0; i <= line.size();)
        {
            const size_t e = std::min(line.find(format_.separator, i), line.size());
            if (!format_.mergeSeparators || e > i) cells.push_back(trimmed(line.substr(i, e - i)));
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

    void chooseColumns(List<size_t>& places)
    {
        chooseHeader();
        for (const csvColumn& c : columns_) places.push_back(place(c));
    }

    // Chooses the last header line that has the wanted columns; one behind a # only if no other has them
    void chooseHeader()
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
            const bool all = std::all_of(columns_.begin(), columns_.end(),
                                         [&](const csvColumn& c) { return has(h, c.name); });
            const int rank = 2 * all + !h.remark;
            if (rank > 0 && rank >= best) best = rank, header_ = h;
        }
    }

    scalar factor(size_t column, const csvColumn& c) const
    {
        if (column >= header_.units.size() || header_.units[column].empty()) return c.factor;
        const unit u = parsedUnit(header_.units[column], header_.where);
        if (c.dimensions.known && !(u.dimensions == c.dimensions))
            throw fatalError("Column '" + header_.names[column] + "' is in [" +
                                 header_.units[column] + "], of the dimensions " +
                                 u.dimensions.text() + ",\nbut it must have " +
                                 c.dimensions.text() + ".",
                             header_.where);
        if (c.given && std::abs(u.factor - c.factor) > 1e-9 * std::abs(c.factor))
            dict_.fail("units", "Column '" + header_.names[column] + "' is in [" +
                                    header_.units[column] + "] by the header of " + format_.path +
                                    ", and in another unit by this entry. Leave one of them away");
        return u.factor;
    }

    size_t place(const csvColumn& c) const
    {
        scalar number;
        if (readNumber(c.name, number) && number >= 0 && number == size_t(number))
            return size_t(number);
        const auto found = std::find(header_.names.begin(), header_.names.end(), c.name);
        if (found != header_.names.end()) return size_t(found - header_.names.begin());
        const List<word>& known =
            header_.names.empty() && !headers_.empty() ? headers_.back().names : header_.names;
        dict_.fail(c.entry,
                   "No column '" + c.name + "' in " + format_.path + ". " +
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

    const csvFormat& format_;
    const List<csvColumn>& columns_;
    const dictionary& dict_;
    List<headerLine> headers_;
    headerLine header_;  // the one in use
    int line_ = 0;
};

}  // namespace

List<csvRow> csvRows(const csvFormat& format, const List<csvColumn>& columns,
                     const dictionary& dict)
{
    if (format.separator.size() != 1)
        dict.fail("separator", "The separator must be one character.");
    return csvReader(format, columns, dict).rows();
}

}  // namespace ispf
