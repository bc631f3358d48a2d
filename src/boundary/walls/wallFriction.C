// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallFriction.H"
#include "sphc.H"

#include <algorithm>

namespace ispf
{

namespace
{

// least |sum F n| over sum |F| with which the rigid neighbours count as one wall
constexpr scalar oneSided = 0.9;

struct view
{
    const particleCloud& cloud;
    const neighbourList& list;

    // Calls visit(j, F_ij) for the particles of walls, which are no images
    template <class Visit>
    void forRigid(label i, const Visit& visit) const
    {
        forNeighbours<among::walls>(list, i, [&](pairIndex k, label j) {
            if (cloud.ownerOf(j) < 0) visit(j, list.F[k]);
        });
    }

    // Unit vector away from the wall, or zero
    vector away(label i) const
    {
        vector sum = vector::Zero();
        scalar size = 0;
        forRigid(i, [&](label j, scalar F) { sum -= F * cloud.ghostDepth(j).xyz(), size -= F; });
        return size > 0 && sum.norm() > oneSided * size ? vector(sum.normalized())
                                                        : vector(vector::Zero());
    }

    scalar atRigid(label i) const
    {
        const vector n = away(i);
        if (n.isZero(0)) return 1;
        scalar wall = 0, fluid = 0;
        forRigid(i, [&](label j, scalar F) {
            const vec4& depth = cloud.ghostDepth(j);
            wall += F * cloud.wallFactor(i, j) *
                    n.dot(cloud.x[i].xyz() - cloud.x[j].xyz() - depth[3] * depth.xyz());
        });
        forNeighbours<among::all>(list, i, [&](pairIndex k, label j) {
            if (cloud.ownerOf(j) >= 0)
                fluid += list.F[k] * n.dot(cloud.x[i].xyz() - cloud.x[j].xyz());
        });
        return wall < 0 ? std::clamp(-fluid / wall, 0.5, 2.0) : 1;
    }

    bool seesRigid(label i) const
    {
        return anyNeighbour<among::walls>(list, i,
                                          [&](pairIndex, label j) { return cloud.ownerOf(j) < 0; });
    }

    // Entry of the list that is the particle's own image in a wall; -1: no such entry or several
    pairIndex ownImage(label i) const
    {
        pairIndex found = -1;
        const bool several = anyNeighbour<among::all>(list, i, [&](pairIndex k, label j) {
            if (j < cloud.n() || cloud.ghostSource(j) != i || !cloud.sticks(j)) return false;
            if (found >= 0) return true;
            found = k;
            return false;
        });
        return several ? -1 : found;
    }

    scalar atImage(label i, pairIndex image) const
    {
        const vector n = cloud.x[i].xyz() - cloud.x[list.index[image]].xyz();
        scalar others = 0;
        forNeighbours<among::all>(list, i, [&](pairIndex k, label j) {
            if (k != image)
                others +=
                    sphc::viscousF(cloud, list, k) * n.dot(cloud.x[i].xyz() - cloud.x[j].xyz());
        });
        const scalar own = sphc::viscousF(cloud, list, image) * n.squaredNorm();
        return own < 0 ? std::clamp(-others / own, 0.25, 4.0) : 1;
    }
};

}  // namespace

void makeShearExact(particleCloud& cloud, const neighbourList& list)
{
    bool mirrors = false;
    for (label g = cloud.n(); g < cloud.nAll() && !mirrors; ++g) mirrors = cloud.sticks(g);
    if (!mirrors && !cloud.hasRigid()) return;
    List<scalar> scale(cloud.n(), 1);
    List<label> image(mirrors ? cloud.n() : 0, -1);
    const view v{cloud, list};
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = std::max(begin, cloud.nSolid()); i < end; ++i)
        {
            const pairIndex own = mirrors ? v.ownImage(i) : -1;
            if (own < 0) scale[i] = v.atRigid(i);
            else if (!v.seesRigid(i)) image[i] = list.index[own], scale[i] = v.atImage(i, own);
        }
    });
    cloud.scaleFriction(std::move(scale), std::move(image));
}

}  // namespace ispf
