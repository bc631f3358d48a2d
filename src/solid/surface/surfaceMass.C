// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceMass.H"
#include "forPairs.H"

namespace ispf
{

namespace
{

struct part
{
    label particle;
    tensor weight;  // of its velocity
};

// L_k of the surface at the way e0 from particle k
List<part> motionOf(const structureModel& structure, label k, const vector& e0)
{
    const structureReference& ref = structure.reference();
    const referenceNeighbours& pairs = structure.gradient().neighbours();
    tensor one = tensor::Zero();
    one.diagonal().head(ref.nDims).setOnes();
    List<part> parts = {{k, one}};
    const label leader = structure.gradient().leader(k);
    forNeighbours<among::all>(pairs, leader, [&](pairIndex p, label a) {
        const scalar w = structure.gradient().slope(leader, p).dot(e0);
        parts.push_back({leader, -w * one});
        parts.push_back({a, w * one});
        if (pairs.image[p]) parts.back().weight *= ref.images[pairs.image[p] - 1].R;
    });
    return parts;
}

}  // namespace

blockMatrix3 surfaceMass(const solidSurface& surface, const structureModel& structure,
                         const List<char>& fixed)
{
    List<blockMatrix3::entry> entries;
    for (label k = 0; k < structure.n(); ++k)
    {
        if (fixed[k]) continue;
        surface.forOpenSides(k, [&](const vector& S0, const vector& e0) {
            const List<part> parts = motionOf(structure, k, e0);
            for (const part& a : parts)
                for (const part& b : parts)
                    entries.push_back(
                        {a.particle, b.particle, S0.norm() * a.weight.transpose() * b.weight});
        });
    }
    return blockMatrix3::ofEntries(structure.n(), std::move(entries));
}

}  // namespace ispf
