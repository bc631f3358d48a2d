// SPDX-License-Identifier: GPL-3.0-or-later
#include "openFace.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

openFace::openFace(const word& name, const dictionary& dict, const word& caseFolder,
                   const imageGroup& group, const particleCloud& cloud)
    : name_(name),
      where_(dict.where("type")),
      dx_(cloud.dx),
      near_(2.5 * cloud.dx),
      region_(6 * cloud.dx),
      stripWidth_(
          dict.getInRangeOrDefault("stripWidth", 0.9 * cloud.dx, 10 * cloud.dx, 1.5 * cloud.dx)),
      depth_(stripWidth_ + 0.5 * dx_),
      p_(Function1::New("p", dict, caseFolder)),
      spotGrid_(1.5 * cloud.dx)
{
    const scalar reach = depth_ + 2 * dx_;
    if (dict.chooseOrDefault("surface", {"triSurface", "plane"}, "triSurface") == "plane")
        surface_ =
            patchSurface::plane(dict.get<vector>("point"), dict.get<vector>("normal"), reach);
    else surface_ = patchSurface::triangles(readPatch(caseFolder, name, dict), group, reach);
}

scalar openFace::weight(scalar q)
{
    const scalar a = 1 - q * q;
    return q < 1 ? a * a : 0;
}

void openFace::setFlags(particleCloud& cloud, const List<vector>& weight) const
{
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            const vector x = cloud.x[i].xyz();
            if (surface_->surelyFar(x)) continue;
            const surfaceFoot f = surface_->find(x);
            if (!f.found || f.depth <= 0) continue;
            cloud.pFixed[i] = 1, cloud.pGiven[i] = given_;
            // without a gradient the strip would fall freely onto the face
            if (!weight.empty()) cloud.pGiven[i] += f.depth * f.normal.dot(weight[cloud.zone[i]]);
        }
    });
}

bool openFace::near(const vector& x) const
{
    if (surface_->surelyFar(x)) return false;
    const surfaceFoot f = surface_->find(x);
    return f.found && f.depth > -1.3 * dx_;
}

}  // namespace ispf
