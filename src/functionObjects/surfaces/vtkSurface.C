// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSurface.H"

#include "dataFile.H"

namespace ispf
{

namespace
{

word row(const vector& v, int digits)
{
    return scientific(v[0], digits) + " " + scientific(v[1], digits) + " " +
           scientific(v[2], digits) + "\n";
}

word text(const triangleField& f, int digits)
{
    word all = f.scalars.empty() ? "VECTORS " + f.name + " double\n"
                                 : "SCALARS " + f.name + (f.whole ? " int" : " double") +
                                       " 1\nLOOKUP_TABLE default\n";
    for (const scalar v : f.scalars)
        all += (f.whole ? std::to_string(label(v)) : scientific(v, digits)) + "\n";
    for (const vector& v : f.vectors) all += row(v, digits);
    return all;
}

}  // namespace

word vtkText(const word& title, const List<triSurface>& surfaces, const List<triangleField>& fields,
             int digits)
{
    word points, triangles;
    size_t nPoints = 0, nTriangles = 0;
    for (const triSurface& s : surfaces)
    {
        for (const vector& x : s.nodes) points += row(x, digits);
        for (const auto& t : s.triangles)
        {
            triangles += "3";
            for (const label node : t) triangles += " " + std::to_string(nPoints + size_t(node));
            triangles += "\n";
        }
        nPoints += s.nodes.size(), nTriangles += s.triangles.size();
    }
    const word n = std::to_string(nTriangles);
    word all = "# vtk DataFile Version 3.0\n" + title + "\nASCII\nDATASET POLYDATA\nPOINTS " +
               std::to_string(nPoints) + " double\n" + points + "POLYGONS " + n + " " +
               std::to_string(4 * nTriangles) + "\n" + triangles + "CELL_DATA " + n + "\n";
    for (const triangleField& f : fields) all += text(f, digits);
    return all;
}

}  // namespace ispf
