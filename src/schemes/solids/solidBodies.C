// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidBodies.H"
#include "blockMatrix3.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

namespace
{

// [dx] parts of one body that are nearer at rest are no strangers: their strain keeps them apart.  No lattice has this
// distance, which rounding would decide
constexpr scalar ownBody = 4.06;

}  // namespace

solidBodies::solidBodies(const fsiCase& c)
    : c_(c), bodyOf_(c.structure->tangentPattern().connectedSets())
{
    if (std::all_of(bodyOf_.begin(), bodyOf_.end(), [](label first) { return first == 0; }))
        bodyOf_ = {};
    const referenceNeighbours& atRest = c.structure->gradient().neighbours();
    for (label i = 0; i < atRest.n(); ++i)
        forNeighbours<among::others>(atRest, i, [&](pairIndex p, label j) {
            joinedImages_.insert({bodyOf(i), bodyOf(j), atRest.image[p]});
        });
}

// Number of the image, 0: the identity, -1: none of those that solids have at rest
label solidBodies::numberOf(const isometry& image) const
{
    const auto same = [&](const isometry& M) {
        return (M.R - image.R).norm() < 1e-6 && (M.t - image.t).norm() < 1e-6 * c_.cloud.dx;
    };
    if (same(isometry())) return 0;
    const List<isometry>& images = c_.structure->reference().images;
    for (size_t m = 0; m < images.size(); ++m)
        if (same(images[m])) return label(m) + 1;
    return -1;
}

// True if a particle is a neighbour of both at rest
bool solidBodies::share(label i, label j) const
{
    const referenceNeighbours& near = c_.structure->gradient().neighbours();
    std::int64_t a = near.start[i], b = near.start[j];
    while (a < near.mid[i] && b < near.mid[j])
    {
        if (near.index[a] == near.index[b]) return true;
        ++(near.index[a] < near.index[b] ? a : b);
    }
    return false;
}

// True if the solid goes on from i to the image of j: they are a pair, or too far apart for one but not for a common neighbour
bool solidBodies::goesOn(label i, label j, label image, scalar atRest) const
{
    const structureModel& structure = *c_.structure;
    if (image < 0 || atRest > ownBody * c_.cloud.dx) return false;
    if (atRest < (1 - 1e-6) * structure.reference().support)
        return structure.gradient().neighbours().placeOf(i, j, std::uint16_t(image)) >= 0;
    return image == 0 ? share(i, j) : joinedImages_.count({bodyOf(i), bodyOf(j), image}) > 0;
}

solidBodies::relation solidBodies::between(label i, label g) const
{
    const particleCloud& cloud = c_.cloud;
    const List<vector>& rest = c_.structure->reference().x0;
    relation r;
    r.j = cloud.ownerOf(g);
    if (g != r.j)
        r.image.R = cloud.ruleOf(g).R,
        r.image.t = cloud.x[g].xyz() - r.image.R * cloud.x[r.j].xyz();
    r.atRest = (rest[i] - r.image(rest[r.j])).norm();
    r.one = goesOn(i, r.j, numberOf(r.image), r.atRest);
    return r;
}

}  // namespace ispf
