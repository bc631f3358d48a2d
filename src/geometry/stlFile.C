// SPDX-License-Identifier: GPL-3.0-or-later
#include "triSurface.H"

#include "fileNames.H"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace ispf
{

namespace
{

constexpr size_t headerBytes = 80, recordBytes = 50;

// The record count of a binary file fixes its length: the only sure mark
bool isBinary(const word& bytes)
{
    if (bytes.size() < headerBytes + 4) return false;
    std::uint32_t n;
    std::memcpy(&n, &bytes[headerBytes], 4);
    if (bytes.size() == headerBytes + 4 + recordBytes * size_t(n)) return true;
    return bytes.compare(0, 5, "solid") != 0;
}

void addChecked(triSurface& s, const vector* corner, label patch, const word& path)
{
    for (int k = 0; k < 3; ++k)
        if (!corner[k].allFinite())
            throw fatalError("A corner of triangle " + std::to_string(s.size()) + " of " + path +
                             " is not a finite number");
    s.add(corner[0], corner[1], corner[2], patch);
}

triSurface readBinary(const word& bytes, const word& path)
{
    std::uint32_t n;
    std::memcpy(&n, &bytes[headerBytes], 4);
    if (bytes.size() < headerBytes + 4 + recordBytes * size_t(n))
        throw fatalError("The binary surface file " + path + " is cut off: it announces " +
                         std::to_string(n) + " triangles and has " + std::to_string(bytes.size()) +
                         " bytes");
    triSurface s;
    s.addPatch(std::filesystem::path(path).stem().string());
    for (std::uint32_t t = 0; t < n; ++t)
    {
        float v[12];
        std::memcpy(v, &bytes[headerBytes + 4 + recordBytes * t], sizeof v);
        const vector corner[3] = {vector(v[3], v[4], v[5]), vector(v[6], v[7], v[8]),
                                  vector(v[9], v[10], v[11])};
        addChecked(s, corner, 0, path);
    }
    return s;
}

triSurface readAscii(const word& bytes, const word& path)
{
    triSurface s;
    std::istringstream lines(bytes);
    word line;
    vector corner[3];
    int nCorners = 0, lineNumber = 0;
    label patch = -1;
    bool inSolid = false;
    while (std::getline(lines, line))
    {
        ++lineNumber;
        std::istringstream in(line);
        word first, name;
        in >> first;
        if (first == "solid")
        {
            in >> name;
            inSolid = true;
            patch = s.addPatch(name.empty() ? std::filesystem::path(path).stem().string() : name);
        }
        else if (first == "vertex")
        {
            vector& p = corner[nCorners % 3];
            if (nCorners > 2 || !(in >> p[0] >> p[1] >> p[2]) || patch < 0)
                throw fatalError("Line " + std::to_string(lineNumber) + " of " + path +
                                 " is not a corner of a triangle: " + line);
            ++nCorners;
        }
        else if (first == "endfacet")
        {
            if (nCorners != 3)
                throw fatalError("The facet ending at line " + std::to_string(lineNumber) + " of " +
                                 path + " has " + std::to_string(nCorners) + " corners, not 3");
            addChecked(s, corner, patch, path);
            nCorners = 0;
        }
        else if (first == "endsolid") inSolid = false;
    }
    if (inSolid)
        throw fatalError("The surface file " + path + " is cut off at line " +
                         std::to_string(lineNumber) + ": there is no endsolid");
    return s;
}

void writeBinary(std::ostream& out, const triSurface& s)
{
    char header[headerBytes] = {};
    std::strncpy(header, "ispf surface", headerBytes - 1);
    out.write(header, headerBytes);
    const std::uint32_t n = std::uint32_t(s.size());
    out.write(reinterpret_cast<const char*>(&n), 4);
    for (label t = 0; t < s.size(); ++t)
    {
        float v[12];
        const vector normal = s.normal(t);
        for (int k = 0; k < 3; ++k)
        {
            v[k] = float(normal[k]);
            for (int c = 0; c < 3; ++c) v[3 + 3 * c + k] = float(s.corner(t, c)[k]);
        }
        out.write(reinterpret_cast<const char*>(v), sizeof v);
        out.write("\0\0", 2);
    }
}

void writeAscii(std::ostream& out, const triSurface& s)
{
    for (label p = 0; p < label(s.patchNames.size()); ++p)
    {
        out << "solid " << s.patchNames[p] << "\n";
        for (label t = 0; t < s.size(); ++t)
        {
            if (s.patch[t] != p) continue;
            const vector n = s.normal(t);
            out << "facet normal " << std::setprecision(6) << n[0] << " " << n[1] << " " << n[2]
                << "\nouter loop\n"
                << std::setprecision(17);
            for (int k = 0; k < 3; ++k)
            {
                const vector& c = s.corner(t, k);
                out << "vertex " << c[0] << " " << c[1] << " " << c[2] << "\n";
            }
            out << "endloop\nendfacet\n";
        }
        out << "endsolid " << s.patchNames[p] << "\n";
    }
}

}  // namespace

triSurface readSTL(const word& path)
{
    const word bytes = readText(path);
    triSurface s = isBinary(bytes) ? readBinary(bytes, path) : readAscii(bytes, path);
    if (s.empty()) throw fatalError("The surface file " + path + " holds no triangle");
    s.weld(0);
    return s;
}

void writeSTL(const triSurface& surface, const word& path, bool binary)
{
    const auto folder = std::filesystem::path(path).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder);
    std::ofstream out(path, std::ios::binary);
    if (binary) writeBinary(out, surface);
    else writeAscii(out, surface);
    out.close();
    if (!out) throw fatalError("Cannot write the surface file " + path);
}

}  // namespace ispf
