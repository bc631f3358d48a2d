// SPDX-License-Identifier: GPL-3.0-or-later
#include "asciiFiles.H"

#include "fileNames.H"
#include "particleTableCheck.H"
#include "wideColumns.H"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace ispf
{

namespace
{

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

// Dimensions [kg m s K mol A cd] of fields with a fixed meaning
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
        add(name, text + ")\n;\n", checksumOf(name, values));
    }

    template <class T>
    void addColumns(const std::map<word, List<T>>& columns, const word& type, const char* component)
    {
        for (const diskColumn<T>& c : diskColumns(columns))
            if (c.wide) addWide(c, component);
            else add(c.name, type, component, *c.parts[0]);
    }

    template <class T>
    void addWide(const diskColumn<T>& column, const char* component)
    {
        const word list = elementType(component, column.parts.size());
        const bool isTensor = list.find('<') == word::npos;
        const word type = isTensor ? word(1, char(std::toupper(list[0]))) + list.substr(1) : "";
        word text = header("particle" + type + "Field", location_, column.name) +
                    "internalField   nonuniform List<" + list + ">\n";
        put(text, column.parts[0]->size());
        text += "\n(\n";
        for (size_t i = 0; i < column.parts[0]->size(); ++i)
        {
            for (size_t k = 0; k < column.parts.size(); ++k)
                text += k == 0 ? '(' : ' ', put(text, (*column.parts[k])[i]);
            text += ")\n";
        }
        add(column.name, text + ")\n;\n", checksumOf(column.name, column.flat()));
    }

    List<namedText> files(const particleTable& table, int precision)
    {
        add(positions, "Vector", "vector", table.x);
        addColumns(table.scalars, "Scalar", "scalar");
        for (const auto& [name, v] : table.vectors) add(name, "Vector", "vector", v);
        addColumns(table.integers, "Label", "label");
        files_.push_back({folder_ + "/" + paraviewCopy, vtpText(table, precision)});
        files_.push_back(
            {folder_ + stateFile, stateText(table)});  // last: with this file the folder is a state
        return std::move(files_);
    }

private:
    void add(const word& name, word text, globalId sum)
    {
        files_.push_back({folder_ + "/" + name, std::move(text)});
        sums_ += "    (" + quoted(name) + " " + std::to_string(sum) + ")\n";
    }
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
        return text + ");\n\nchecksum    " + std::to_string(checksumOfRest(table)) + ";\n";
    }

    word folder_, location_, sums_;
    List<namedText> files_;
};

}  // namespace

globalId checksumOfRest(const particleTable& table)
{
    particleTable t;
    t.extra = table.extra, t.attributes = table.attributes;
    return checksumOf(t);
}

void writeAsciiState(const particleTable& table, const word& folder, int precision)
{
    checkTable(table, "Particles are not written to '" + folder + "'", hasDiverged);
    List<word> old = asciiStateFiles(folder);
    const List<namedText> files = composer(folder).files(table, precision);
    writeTexts(files);
    for (const word& file : old)
        if (std::none_of(files.begin(), files.end(), [&](const auto& f) { return f.path == file; }))
            std::filesystem::remove(file);
}

}  // namespace ispf
