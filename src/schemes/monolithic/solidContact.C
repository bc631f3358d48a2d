// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidContact.H"
#include "forPairs.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// [dx] r_ij of two particles, with a layer of fluid between them, and r_iw of a particle and a wall
constexpr scalar pairReach = 2, wallReach = 1.5;
// [dx] parts of one body that are nearer at rest are no strangers: their strain keeps them apart.  No lattice has this
// distance, which rounding would decide
constexpr scalar ownBody = 4.06;

scalar over(scalar reach, scalar distance)
{
    return std::max(reach - distance, scalar(0));
}

}  // namespace

solidContact::solidContact(const fsiCase& c)
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
bool solidContact::joined(label i, label j, const isometry& image) const
{
    const List<isometry>& images = c_.structure->reference().images;
    const scalar tiny = 1e-6 * c_.cloud.dx;
    for (size_t m = 0; m < images.size(); ++m)
        if ((images[m].R - image.R).norm() < 1e-6 && (images[m].t - image.t).norm() < tiny)
            return joinedImages_.count({bodyOf(i), bodyOf(j), label(m) + 1}) > 0;
    return false;
}

void solidContact::find()
{
    pairs_.clear(), walls_.clear();
    for (label i = 0; i < c_.cloud.nSolid(); ++i)
    {
        findPairs(i);
        // a wall within reach has neighbours among its particles and images
        if (!c_.cloud.uFixed[i] && rowOf<among::walls>(c_.list, i).size() > 0) findWalls(i);
    }
}

// 0 for neighbours within a body.  Particles that are nearer at rest than r_ij do not repel each other there
scalar solidContact::reachOf(bool one, scalar atRest) const
{
    return one && atRest < ownBody * c_.cloud.dx ? 0 : std::min(pairReach * c_.cloud.dx, atRest);
}

// k of (7.18): the shear modulus over the depth of the plane [N/m]
scalar solidContact::stiffnessOf(label i) const
{
    return c_.structure->shearModulus(i) * (c_.cloud.nDims == 3 ? c_.cloud.dx : 1);
}

void solidContact::findPairs(label i)
{
    const particleCloud& cloud = c_.cloud;
    const List<vector>& rest = c_.structure->reference().x0;
    forNeighbours<among::same>(c_.list, i, [&](pairIndex, label g) {
        const label j = cloud.ownerOf(g);
        if (cloud.uFixed[i] && cloud.uFixed[j]) return;
        isometry image;
        if (g != j)
            image.R = cloud.ruleOf(g).R, image.t = cloud.x[g].xyz() - image.R * cloud.x[j].xyz();
        const bool one = g == j ? bodyOf(i) == bodyOf(j) : joined(i, j, image);
        const scalar reach = reachOf(one, (rest[i] - image(rest[j])).norm());
        if (reach == 0) return;
        pairs_.push_back({i, j, image, reach, 0.5 * std::min(stiffnessOf(i), stiffnessOf(j))});
    });
}

void solidContact::findWalls(label i)
{
    const scalar reach = wallReach * c_.cloud.dx;
    const vector x = c_.cloud.x[i].xyz();
    for (const nearWall& w : c_.walls->wallsNear(x, c_.structure->reference().x0[i], 2 * reach))
        walls_.push_back({i, w.normal, w.foot, std::min(reach, w.atRest), stiffnessOf(i)});
}

void solidContact::addForce(const List<vec4>& x, List<vec4>& f) const
{
    const scalar dx = c_.cloud.dx;
    for (const meeting& m : pairs_)
    {
        const vector gap = m.gap(x);
        const scalar r = gap.norm(), in = over(m.reach, r);
        if (in == 0) continue;
        const vector push = m.stiffness * in * in / (dx * r) * gap;
        f[m.i].s += vec4::from(push).s;
        f[m.j].s -= vec4::from(m.image.R.transpose() * push).s;
    }
    for (const wallMeeting& w : walls_)
    {
        const scalar in = over(w.reach, w.distance(x));
        f[w.i].s -= vec4::from(w.stiffness * in * in / dx * w.normal).s;
    }
}

scalar solidContact::energy(const List<vec4>& x) const
{
    scalar sum = 0;
    for (const meeting& m : pairs_)
        sum += m.stiffness * std::pow(over(m.reach, m.gap(x).norm()), 3);
    for (const wallMeeting& w : walls_)
        sum += w.stiffness * std::pow(over(w.reach, w.distance(x)), 3);
    return sum / (3 * c_.cloud.dx);
}

void solidContact::addTangent(const List<vec4>& x, const blockMatrix3& A, blockMatrix3& sum) const
{
    List<blockMatrix3::entry> entries;
    List<tensor> diagonal(A.diagonal);
    const auto slope = [&](scalar stiffness, scalar in, const vector& n) {
        return tensor(2 * stiffness * in / c_.cloud.dx * n * n.transpose());
    };
    for (const meeting& m : pairs_)
    {
        const vector gap = m.gap(x);
        const tensor H = slope(m.stiffness, over(m.reach, gap.norm()), gap.normalized());
        const tensor& R = m.image.R;
        diagonal[m.i] += H, diagonal[m.j] += R.transpose() * H * R;
        entries.push_back({m.i, m.j, -H * R}), entries.push_back({m.j, m.i, -R.transpose() * H});
    }
    for (const wallMeeting& w : walls_)
        diagonal[w.i] += slope(w.stiffness, over(w.reach, w.distance(x)), w.normal);
    sum = A.plus(blockMatrix3::ofEntries(A.size(), std::move(entries)));
    for (label i = 0; i < A.size(); ++i) sum.diagonal[i] += diagonal[i] - A.diagonal[i];
}

}  // namespace ispf
