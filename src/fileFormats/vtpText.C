// SPDX-License-Identifier: GPL-3.0-or-later
// XML PolyData, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
#include "particleState.H"
#include "wideColumns.H"

#include <cstdio>

namespace ispf
{

namespace
{

word escaped(const word& name)
{
    word text;
    for (const char c : name)
        if (c == '&') text += "&amp;";
        else if (c == '<') text += "&lt;";
        else if (c == '"') text += "&quot;";
        else text += c;
    return text;
}

class xml
{
public:
    explicit xml(int precision) : precision_(precision) {}

    void put(scalar v)
    {
        char digits[32];
        text += word(digits, size_t(std::snprintf(digits, sizeof digits, "%.*g", precision_, v)));
        text += '\n';
    }
    void put(const vector& v)
    {
        for (int d = 0; d < 3; ++d) put(v[d]), text.back() = d < 2 ? ' ' : '\n';
    }
    void put(globalId v) { text += std::to_string(v) + '\n'; }

    template <class T>
    void array(const word& name, const char* type, int components, const List<T>& values)
    {
        text += "<DataArray type=\"" + word(type) + "\" Name=\"" + escaped(name) +
                "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"ascii\">\n";
        for (const T& v : values) put(v);
        text += "</DataArray>\n";
    }

    word text;

private:
    int precision_;
};

}  // namespace

word vtpText(const particleTable& table, int precision)
{
    const word n = std::to_string(table.size());
    List<globalId> index, behind;
    for (size_t i = 0; i < table.size(); ++i)
        index.push_back(globalId(i)), behind.push_back(globalId(i) + 1);
    xml file(precision);
    file.text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece "
        "NumberOfPoints=\"" +
        n + "\" NumberOfVerts=\"" + n +
        "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n";
    file.array("Points", "Float64", 3, table.x);
    file.text += "</Points>\n<Verts>\n";
    file.array("connectivity", "Int64", 1, index);
    file.array("offsets", "Int64", 1, behind);
    file.text += "</Verts>\n<PointData>\n";
    for (const diskColumn<scalar>& c : diskColumns(table.scalars))
        file.array(c.name, "Float64", int(c.parts.size()), c.flat());
    for (const auto& [name, values] : table.vectors) file.array(name, "Float64", 3, values);
    for (const diskColumn<globalId>& c : diskColumns(table.integers))
        file.array(c.name, "Int64", int(c.parts.size()), c.flat());
    return file.text + "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace ispf
