// SPDX-License-Identifier: GPL-3.0-or-later
#include "cadFormat.H"

#include "fileNames.H"
#include "igesFile.H"
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace ispf
{

namespace
{

namespace fs = std::filesystem;

const std::map<word, word> formatOfType = {
    {".igs", "IGES"},  {".iges", "IGES"},       {".stp", "STEP"}, {".step", "STEP"},
    {".brep", "BREP"}, {".geo", "gmsh-script"}, {".stl", "STL"},  {".msh", "gmsh-mesh"}};

word lower(word text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

word lineFrom(const word& text, size_t from)
{
    const size_t end = text.find_first_of("\r\n", from);
    return text.substr(from, end == word::npos ? end : end - from);
}

size_t firstLetter(const word& text)
{
    const size_t at = text.find_first_not_of(" \t\r\n");
    return at == word::npos ? text.size() : at;
}

// The last line that is not blank, and whether a blank line is before it
std::pair<word, bool> lastLine(const word& text)
{
    const size_t end = text.find_last_not_of(" \r\n\t");
    if (end == word::npos) return {"", false};
    const size_t before = text.find_last_of("\r\n", end);
    if (before == word::npos) return {text, false};
    const size_t from = text.find_last_not_of("\r", before - (text[before] == '\n' ? 1 : 0));
    return {lineFrom(text, before + 1), from != word::npos && text[from] == '\n'};
}

bool isBinarySTL(const word& text)
{
    std::uint32_t n = 0;
    if (text.size() < 84) return false;
    std::copy_n(&text[80], 4, reinterpret_cast<char*>(&n));
    return text.size() == 84 + 50 * size_t(n);
}

// The format by its first bytes; "" if they do not show it
word contentOf(const word& text)
{
    const word start = text.substr(firstLetter(text), 200);
    const auto begins = [&](const char* mark) { return start.rfind(mark, 0) == 0; };
    if (isBinarySTL(text)) return "STL";
    if (begins("ISO-10303-21;")) return "STEP";
    if (start.find("CASCADE Topology V") != word::npos) return "BREP";
    if (begins("$MeshFormat") || begins("$NOD")) return "gmsh-mesh";
    const word first = lineFrom(text, 0);
    if (first.size() > 72 && first[72] == 'S' &&
        first.find_first_not_of(" 0123456789", 73) == word::npos)
        return "IGES";
    if (lower(start.substr(0, 6)).rfind("solid", 0) == 0 &&
        lower(text.substr(0, 2000)).find("facet") != word::npos)
        return "STL";
    const std::map<word, word> others = {{"\x1f\x8b", "gzip-compressed"},
                                         {"PK\x03\x04", "zip-compressed"},
                                         {"ply", "PLY"},
                                         {"OFF", "OFF"},
                                         {"# vtk", "VTK"},
                                         {"<?xml", "XML"},
                                         {"<VTKFile", "VTK XML"},
                                         {"\x89HDF", "HDF5"},
                                         {"%PDF", "PDF"},
                                         {"\xd0\xcf\x11\xe0", "a CAD program's own"}};
    for (const auto& [mark, name] : others)
        if (begins(mark.c_str())) return name;
    return "";
}

word kind(const word& format)
{
    return format == "gmsh-script" ? "a gmsh script"
           : format == "gmsh-mesh" ? "a mesh of gmsh"
                                   : format;
}

void checkContent(const word& path, const word& format, const word& text)
{
    const word found = contentOf(text);
    // a script may begin with anything; the reader of STL itself reports errors
    if (found == format || (found.empty() && (format == "gmsh-script" || format == "STL"))) return;
    if (!found.empty())
        throw fatalError("The file " + path + " is named as " + kind(format) + " but holds " +
                         found +
                         " data: name it as what it is, or export it again as IGES, STEP or STL");
    const std::map<word, word> marks = {{"IGES", "should have an S in column 73"},
                                        {"STEP", "should be ISO-10303-21;"},
                                        {"BREP", "should name a CASCADE Topology version"},
                                        {"gmsh-mesh", "should be $MeshFormat"}};
    throw fatalError("The file " + path + " is not " + kind(format) + ": its first line " +
                     marks.at(format));
}

// fatalError if the file is cut off.  OpenCASCADE and gmsh would take the part that is there, or wait for ever for the
// rest.  Checks formats with a mark at their end
void checkWhole(const word& path, const word& format, const word& text)
{
    const auto [last, afterBlank] = lastLine(text);
    word should;
    if (format == "IGES" && !(last.size() > 72 && last[72] == 'T'))
        should = "have a T in column 73";
    if (format == "STEP" && last.find("END-ISO-10303-21;") == word::npos)
        should = "be END-ISO-10303-21;";
    if (format == "gmsh-mesh" && last.rfind("$End", 0) != 0) should = "begin with $End";
    // the root shape after the table's last entry: orientation, number and location
    const bool root = !last.empty() && (last[0] == '+' || last[0] == '-') &&
                      last.find_first_not_of("0123456789 ", 1) == word::npos;
    if (format == "BREP" && !(root && afterBlank))
        should = "name the whole shape, as in '+1 0', after a blank line";
    if (!should.empty())
        throw fatalError("The file " + path + " is cut off: its last line should " + should);
}

// One name for a unit that IGES, STEP and programs call by several names
word commonName(const word& unit)
{
    static const std::map<word, word> names = {
        {"in", "inch"},       {"inches", "inch"},   {"foot", "ft"},       {"feet", "ft"},
        {"mi", "mile"},       {"uin", "microinch"}, {"millimetre", "mm"}, {"millimeter", "mm"},
        {"centimetre", "cm"}, {"centimeter", "cm"}, {"metre", "m"},       {"meter", "m"},
        {"micron", "um"}};
    const auto known = names.find(unit);
    return known == names.end() ? unit : known->second;
}

// The unit that the global section of an IGES file declares
word unitOfIGES(const igesFile& file)
{
    static const std::array<const char*, 12> flags = {"",  "inch", "mm",  "",   "ft", "mile",
                                                      "m", "km",   "mil", "um", "cm", "microinch"};
    const word flag = file.unitFlag();
    if (flag == "3") return commonName(lower(file.unitName()));
    const auto digit = [](unsigned char c) { return std::isdigit(c); };
    const bool number =
        !flag.empty() && flag.size() < 3 && std::all_of(flag.begin(), flag.end(), digit);
    return number && std::stoul(flag) < flags.size() ? flags[std::stoul(flag)] : "";
}

// Unit from the text between = and ; of a LENGTH_UNIT (ISO 10303-41), without blanks
word unitOfEntity(const word& entity)
{
    static const std::map<word, word> prefixes = {{"$", "m"},        {"", "m"},
                                                  {".MILLI.", "mm"}, {".CENTI.", "cm"},
                                                  {".MICRO.", "um"}, {".KILO.", "km"}};
    const size_t si = entity.find("SI_UNIT("), other = entity.find("CONVERSION_BASED_UNIT('");
    if (other != word::npos)
    {
        const size_t from = other + 23;
        return commonName(lower(entity.substr(from, entity.find('\'', from) - from)));
    }
    if (si == word::npos) return "";
    const word prefix = entity.substr(si + 8, entity.find(',', si) - si - 8);
    const auto known = prefixes.find(prefix);
    return known != prefixes.end() ? known->second : lower(prefix) + "metre";
}

// The units that a context assigns; not the mm that defines an inch
word unitOfSTEP(const word& text)
{
    std::map<word, word> units;  // by instance
    word assigned;
    for (size_t from = 0, to; (to = text.find(';', from)) != word::npos; from = to + 1)
    {
        word entity = text.substr(from, to - from);
        if (entity.find("LENGTH_UNIT") == word::npos &&
            entity.find("GLOBAL_UNIT_ASSIGNED_CONTEXT") == word::npos)
            continue;
        entity.erase(std::remove_if(entity.begin(), entity.end(),
                                    [](unsigned char c) { return std::isspace(c); }),
                     entity.end());
        const size_t equals = entity.find('='),
                     context = entity.find("GLOBAL_UNIT_ASSIGNED_CONTEXT((");
        const size_t number = entity.rfind('#', equals);
        if (equals == word::npos || number == word::npos) continue;
        if (context != word::npos)
            assigned +=
                "," + entity.substr(context + 30, entity.find(')', context) - context - 30) + ",";
        else if (const word unit = unitOfEntity(entity); !unit.empty())
            units[entity.substr(number, equals - number)] = unit;
    }
    std::set<word> all, used;
    for (const auto& [instance, unit] : units)
    {
        all.insert(unit);
        if (assigned.find("," + instance + ",") != word::npos) used.insert(unit);
    }
    const std::set<word>& found = used.empty() ? all : used;
    return join(List<word>(found.begin(), found.end()), " and ");
}

}  // namespace

cadFormat recognisedFormat(const word& path)
{
    if (!fs::exists(path)) throw fatalError("There is no geometry file " + path);
    if (!fs::is_regular_file(path)) throw fatalError(path + " is not a file");
    const auto known = formatOfType.find(lower(fs::path(path).extension().string()));
    List<word> types;
    for (const auto& [type, name] : formatOfType) types.push_back(type);
    if (known == formatOfType.end())
        throw fatalError("The type of " + path + " is not known. " + validWords("type", types));
    cadFormat format;
    format.name = known->second;
    const word text = readText(path);
    if (firstLetter(text) == text.size())
        throw fatalError("The geometry file " + path + " is empty");
    checkContent(path, format.name, text);
    checkWhole(path, format.name, text);
    if (format.name == "IGES")
    {
        const igesFile iges(path, text);
        format.declaredUnit = unitOfIGES(iges);
        format.modelScale = iges.modelScale();
        format.inMillimetres = iges.inMillimetres();
    }
    if (format.name == "STEP") format.declaredUnit = unitOfSTEP(text);
    return format;
}

}  // namespace ispf
