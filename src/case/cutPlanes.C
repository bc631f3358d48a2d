// SPDX-License-Identifier: GPL-3.0-or-later
#include "cutPlanes.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ispf
{

void checkCuts(const particleCloud& cloud, const dictionary& patches)
{
    const auto cuts = cloud.notes.find("symmetryPlanes");
    std::istringstream text(cuts == cloud.notes.end() ? "" : cuts->second);
    const auto next = [&text](vector& v) { return bool(text >> v[0] >> v[1] >> v[2]); };
    for (vector point, normal; next(point) && next(normal);)
    {
        const auto liesThere = [&](const word& name) {
            const dictionary& d = patches.subDict(name);
            const bool cyclic = d.found("separation");
            if (!d.found("point") || !(cyclic || d.found("normal"))) return false;
            const vector at = d.get<vector>("point", dims::length),
                         n = cyclic ? d.get<vector>("separation", dims::length)
                                    : d.get<vector>("normal"),
                         beyond = cyclic ? vector(at + n) : at;
            return n.cross(normal).norm() < 1e-6 * n.norm() &&
                   std::min(std::abs((at - point).dot(normal)),
                            std::abs((beyond - point).dot(normal))) < 1e-3 * cloud.dx;
        };
        const List<word> names = patches.dictKeys();
        if (std::any_of(names.begin(), names.end(), liesThere)) continue;
        throw fatalError(
            "generateParticles has cut the particles at the symmetry plane through (" +
                str(point[0]) + " " + str(point[1]) + " " + str(point[2]) + ") with the normal (" +
                str(normal[0]) + " " + str(normal[1]) + " " + str(normal[2]) +
                "), and no patch lies there any more. Give it again in constant/boundary, or run "
                "generateParticles again",
            patches.where());
    }
}

}  // namespace ispf
