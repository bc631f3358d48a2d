// SPDX-License-Identifier: GPL-3.0-or-later
#include "stlWriter.H"

#include <cstring>
#include <iomanip>
#include <sstream>

namespace ispf
{

namespace
{

constexpr size_t headerBytes = 80;

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

namedText stlText(const triSurface& surface, const word& path, bool binary)
{
    std::ostringstream out;
    if (binary) writeBinary(out, surface);
    else writeAscii(out, surface);
    return {path, out.str()};
}

void writeSTL(const triSurface& surface, const word& path, bool binary)
{
    writeTexts({stlText(surface, path, binary)});
}

}  // namespace ispf
