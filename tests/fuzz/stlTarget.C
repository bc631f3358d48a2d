// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceTopology.H"
#include "targets.H"

#include <cstdlib>

namespace ispf::fuzz
{

namespace
{

bool sound(const triSurface& s)
{
    for (const auto& t : s.triangles)
        for (const label node : t)
            if (node < 0 || size_t(node) >= s.nodes.size() || !s.nodes[node].allFinite())
                return false;
    for (const label p : s.patch)
        if (p < 0 || size_t(p) >= s.patchNames.size()) return false;
    return s.patch.size() == s.triangles.size();
}

}  // namespace

void stl(const word& bytes)
{
    quietly([&] {
        triSurface s = parseSTL(bytes, "fuzz.stl");
        if (s.empty() || !sound(s)) std::abort();
        s.weld(1e-9 * s.bounds().diagonal());
        checkClosed(s).describe();
        orientOutward(s);
        if (!sound(s)) std::abort();
        s.area(), s.volume();
    });
}

}  // namespace ispf::fuzz
