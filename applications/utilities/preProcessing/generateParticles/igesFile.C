// SPDX-License-Identifier: GPL-3.0-or-later
#include "igesFile.H"

#include "token.H"
#include <algorithm>
#include <sstream>

namespace ispf
{

namespace
{

constexpr size_t kindColumn = 72, globalWidth = 72, parameterWidth = 64, nFields = 15;

bool isOf(const word& line, char kind)
{
    return line.size() > kindColumn && line[kindColumn] == kind;
}

word numbered(word text, char kind, label number)
{
    const word digits = std::to_string(number);
    text.resize(kindColumn, ' ');
    return text + kind + word(7 - std::min<size_t>(7, digits.size()), '0') + digits;
}

// Length of the text that begins at `from`, as in 3Habc, and where its letters begin; 0 if none begins there
std::pair<size_t, size_t> announced(const word& text, size_t from)
{
    const size_t h = text.find_first_not_of("0123456789", from);
    if (h == word::npos || h == from || text[h] != 'H' || h - from > 9) return {0, 0};
    return {std::stoul(text.substr(from, h - from)), h + 1};
}

}  // namespace

igesFile::igesFile(const word& path, const word& text) : path_(path)
{
    std::istringstream in(text);
    for (word line; std::getline(in, line);)
    {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        lines_.push_back(line);
    }
    globalText_.width = globalWidth;
    for (size_t k = 0; k < lines_.size(); ++k)
        if (isOf(lines_[k], 'G'))
        {
            globalText_.text += lines_[k].substr(0, globalWidth);
            globalText_.lines.push_back(label(k) + 1);
        }
    global_ = valuesOf(globalText_, true);
    global_.resize(std::max(global_.size(), nFields), {0, 0, ""});
    checkParameters();
}

// Divides a record at its separators, until its end.  The first two values of the global section are the separators
List<igesFile::value> igesFile::valuesOf(const section& s, bool first)
{
    List<value> values(1, {0, 0, ""});
    for (size_t i = 0; i < s.text.size(); ++i)
    {
        value& now = values.back();
        const auto [n, from] = announced(s.text, i);
        if (from > 0 && now.text.empty())
        {
            now.text = s.text.substr(from, n);
            if (first && values.size() == 1 && n == 1) separator_ = now.text[0];
            if (first && values.size() == 2 && n == 1) last_ = now.text[0];
            const size_t next = s.text.find_first_not_of(' ', std::min(from + n, s.text.size()));
            if (next == word::npos || (s.text[next] != separator_ && s.text[next] != last_))
                throw fatalError(
                    "Line " + std::to_string(s.lines[std::min(i / s.width, s.lines.size() - 1)]) +
                    " of the IGES file " + path_ + " announces a text of " + std::to_string(n) +
                    " letters, '" + s.text.substr(i, std::min<size_t>(n + from - i, 30)) +
                    "', but no '" + separator_ + "' or '" + last_ +
                    "' follows them: the number before the H is wrong. Export the file again");
            i = next;
        }
        if (s.text[i] == separator_ || s.text[i] == last_)
        {
            now.end = i;
            if (s.text[i] == last_) break;
            values.push_back({i + 1, i + 1, ""});
        }
        else if (s.text[i] != ' ') now.text += s.text[i];
    }
    return values;
}

// Looks at the parameters of each entity: lines with the same pointer to the directory
void igesFile::checkParameters()
{
    section entity{"", {}, parameterWidth};
    word owner;
    const auto check = [&] {
        if (!entity.lines.empty()) valuesOf(entity, false);
        entity.text.clear(), entity.lines.clear();
    };
    for (size_t k = 0; k < lines_.size(); ++k)
    {
        if (!isOf(lines_[k], 'P')) continue;
        const word pointer = lines_[k].substr(parameterWidth, kindColumn - parameterWidth);
        if (pointer != owner) check();
        owner = pointer;
        entity.text += lines_[k].substr(0, parameterWidth);
        entity.lines.push_back(label(k) + 1);
    }
    check();
}

scalar igesFile::modelScale() const
{
    word text = field(13);
    if (text.empty()) return 1;
    std::replace(text.begin(), text.end(), 'D', 'E');
    scalar scale = 0;
    if (!readNumber(text, scale) || !(scale > 0))
        throw fatalError("The IGES file " + path_ + " has the model scale '" + field(13) +
                         "' (field 13 of its global section), which is no positive number. "
                         "Export it again with a scale of 1");
    return scale;
}

word igesFile::inMillimetres() const
{
    word global;
    for (size_t k = 0; k < global_.size(); ++k)
    {
        const value& v = global_[k];
        const size_t from = std::min(globalText_.text.find_first_not_of(' ', v.begin), v.end);
        const word given = globalText_.text.substr(from, v.end - from);
        global += k == 13 ? "2" : k == 14 ? "2HMM" : given;
        global += k + 1 < global_.size() ? separator_ : last_;
    }
    word text;
    label n = 0;
    for (const word& line : lines_)
    {
        if (isOf(line, 'T') && line.size() > 16 && line[8] == 'G')
        {
            const word count = std::to_string(n);
            text += line.substr(0, 9) + word(7 - std::min<size_t>(7, count.size()), ' ') + count +
                    line.substr(16) + "\n";
        }
        else if (!isOf(line, 'G')) text += line + "\n";
        else if (n == 0)
            for (size_t at = 0; at < global.size(); at += globalWidth)
                text += numbered(global.substr(at, globalWidth), 'G', ++n) + "\n";
    }
    return text;
}

}  // namespace ispf
