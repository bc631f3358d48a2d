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

scalar over(scalar reach, scalar distance)
{
    return std::max(reach - distance, scalar(0));
}

}  // namespace

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

// k of (7.18): the shear modulus over the depth of the plane [N/m]
scalar solidContact::stiffnessOf(label i) const
{
    return c_.structure->shearModulus(i) * (c_.cloud.nDims == 3 ? c_.cloud.dx : 1);
}

void solidContact::findPairs(label i)
{
    const particleCloud& cloud = c_.cloud;
    forNeighbours<among::same>(c_.list, i, [&](pairIndex, label g) {
        if (cloud.uFixed[i] && cloud.uFixed[cloud.ownerOf(g)]) return;
        const auto [j, image, atRest, one] = bodies_.between(i, g);
        if (one) return;
        // particles that are nearer at rest do not repel each other there
        const scalar reach = std::min(pairReach * cloud.dx, atRest);
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
