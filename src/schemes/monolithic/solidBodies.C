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

// True if the body of i goes on in the image of that of j, with which it is one at rest
bool solidBodies::joined(label i, label j, const isometry& image) const
{
    const List<isometry>& images = c_.structure->reference().images;
    const scalar tiny = 1e-6 * c_.cloud.dx;
    for (size_t m = 0; m < images.size(); ++m)
        if ((images[m].R - image.R).norm() < 1e-6 && (images[m].t - image.t).norm() < tiny)
            return joinedImages_.count({bodyOf(i), bodyOf(j), label(m) + 1}) > 0;
    return false;
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
    r.one = r.atRest < ownBody * cloud.dx &&
            (g == r.j ? bodyOf(i) == bodyOf(r.j) : joined(i, r.j, r.image));
    return r;
}

}  // namespace ispf
