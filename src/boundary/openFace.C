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
    const scalar near = depth_ + dx_, far = std::max(near, openLayer::reach * dx_);
    if (dict.chooseOrDefault("surface", {"triSurface", "plane"}, "triSurface") == "plane")
    {
        const vector point = dict.get<vector>("point"), normal = nonZero(dict, "normal");
        surface_ = patchSurface::plane(point, normal, near);
        deep_ = patchSurface::plane(point, normal, far);
    }
    else
    {
        const triSurface mesh = readPatch(caseFolder, name, dict);
        surface_ = patchSurface::triangles(mesh, group, near);
        deep_ = patchSurface::triangles(mesh, group, far);
    }
}

scalar openFace::weight(scalar q)
{
    const scalar a = 1 - q * q;
    return q < 1 ? a * a : 0;
}

// The feet of all particles are asked for several times a step: looked up again only where another particle
// is, or has moved
void openFace::findFeet(const particleCloud& cloud) const
{
    constexpr scalar nowhere = std::numeric_limits<scalar>::quiet_NaN();
    known_.resize(cloud.n(), {vector::Constant(nowhere), {}});
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (const vector x = cloud.x[i].xyz(); known_[i].x != x)
                known_[i] = {x, surface_->find(x)};
    });
}

void openFace::setFlags(particleCloud& cloud, const List<vector>& weight) const
{
    findFeet(cloud);
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            const surfaceFoot& f = known_[i].foot;
            if (!f.found || f.depth <= 0) continue;
            cloud.pFixed[i] = 1, cloud.pGiven[i] = given_;
            // without a gradient the strip would fall freely onto the face
            if (!weight.empty()) cloud.pGiven[i] += f.depth * f.normal.dot(weight[cloud.zone[i]]);
        }
    });
}

// Place by place the means of both sides are made equal; what differs from the mean within that reach is
// left to the strip's own motion.  A wider mean would let the flow along the surface run into a wall or
// away from it: nothing in the strip holds it back.
void openFace::followInside(particleCloud& cloud) const
{
    findFeet(cloud);
    const scalar reach = 1.5 * dx_;
    pointGrid all(reach);
    List<label> index;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (const surfaceFoot& f = known_[i].foot; f.found && std::abs(f.depth) < depth_)
            all.add(f.foot), index.push_back(i);
    List<vector> change(index.size(), vector::Zero());
    parallelFor(
        label(index.size()),
        [&](label begin, label end) {
            for (label m = begin; m < end; ++m)
            {
                if (known_[index[m]].foot.depth <= 0) continue;
                vector sum[2] = {vector::Zero(), vector::Zero()};
                scalar weights[2] = {0, 0};
                all.within(all[m], reach, [&](label k, scalar r) {
                    const bool inside = known_[index[k]].foot.depth <= 0;
                    const scalar w = weight(r / reach);
                    sum[inside] += w * cloud.Up[index[k]].xyz(), weights[inside] += w;
                });
                if (weights[1] > 0) change[m] = sum[1] / weights[1] - sum[0] / weights[0];
            }
        },
        64);
    for (size_t m = 0; m < index.size(); ++m)
        cloud.Up[index[m]].setXyz(cloud.Up[index[m]].xyz() + change[m]);
}

bool openFace::beyondStrip(const vector& x) const
{
    const surfaceFoot f = surface_->find(x);
    return f.found && f.depth > depth_;
}

bool openFace::near(label i) const
{
    const surfaceFoot& f = known_[i].foot;
    return f.found && f.depth > -0.6 * dx_;
}

}  // namespace ispf
