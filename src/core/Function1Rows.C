// SPDX-License-Identifier: GPL-3.0-or-later
// Where the rows of a tabulated function come from.
#include "Function1Table.H"

#include "fileNames.H"
#include "token.H"
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
    csvReader(const dictionary& d, const word& path)
        : path_(path),
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
        const word refColumn = dict_.getOrDefault<word>("refColumn", "0");
        const auto values = dict_.getOrDefault<List<word>>("componentColumns", {"1"});
        if (values.size() != 1) dict_.fail("componentColumns", "One column is wanted here.");
        const scalar scale = dict_.getOrDefault<scalar>("scale", 1);
        List<row> rows;
        std::istringstream in(readText(path_));
        word line;
        for (label left = nHeader_; std::getline(in, line);)
        {
            ++line_;
            if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
            if (left-- > 0) header_ = split(line);
            else
            {
                const size_t first = column("refColumn", refColumn);
                const size_t second = column("componentColumns", values[0]);
                const List<word> cells = split(line);
                const scalar t = cell(cells, first);
                rows.push_back({t, scale * cell(cells, second), here()});
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
    const dictionary& dict_;
    word separator_;
    bool merge_;
    label nHeader_;
    List<word> header_;
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

List<row> csvFileRows(const dictionary& dict, const word& caseFolder)
{
    return csvReader(dict, dataFile(dict, caseFolder)).rows();
}

}  // namespace ispf
