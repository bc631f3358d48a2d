// SPDX-License-Identifier: GPL-3.0-or-later
#include "approachLimit.H"
#include "forPairs.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Exchanges among three particles settle in a few sweeps; the rest is left to the next step
constexpr int mostSweeps = 5;

vector velocityOf(const particleCloud& cloud, label j)
{
    if (j < cloud.n()) return cloud.Up[j].xyz();
    const vec4& u = cloud.Up[cloud.ghostSource(j)];
    return (cloud.ruleOf(j).M * Eigen::Vector4d(u[0], u[1], u[2], u[3])).head<3>() +
           cloud.ghostOffset(j).xyz();
}

// n points from j to i.  lacks: what (8.35) demands of the relative velocity along n less its value; > 0: the pair comes too
// near
struct approach
{
    scalar lacks;
    vector n;
};

approach approachOf(const particleCloud& cloud, label i, label j, scalar closest, scalar dt)
{
    const vector d = cloud.x[i].xyz() - cloud.x[j].xyz();
    const scalar r = d.norm(), room = std::max(r - closest, scalar(0));
    if (r == 0) return {0, vector::Zero()};  // the direction is not defined
    const vector n = d / r;
    return {-room / dt - n.dot(cloud.Up[i].xyz() - velocityOf(cloud, j)), n};
}

}  // namespace

label limitApproach(particleCloud& cloud, const neighbourList& list, scalar closest,
                    scalar besideSolid, scalar dt, List<vec4>& toSolid)
{
    const auto leastOf = [&](label j) {
        return cloud.ownerOf(j) < cloud.nSolid() ? besideSolid : closest;
    };
    toSolid.assign(cloud.nSolid(), vec4{});
    const label first = cloud.nSolid(), nFluid = cloud.n() - first;
    List<char> meets(nFluid, 0);
    label exchanges = 0;
    const scalar reach = std::max(closest, besideSolid) + 2 * cloud.maxSpeed() * dt;
    const auto lacks = [&](label i, label j) {
        return magSqr(cloud.x[i].s - cloud.x[j].s) < reach * reach &&
               approachOf(cloud, i, j, leastOf(j), dt).lacks > 0;
    };
    const auto exchange = [&](label i, label j) {
        const label owner = cloud.ownerOf(j);
        const auto [lacks, n] = approachOf(cloud, i, j, leastOf(j), dt);
        const bool isSolid = owner < first;
        const int free = !cloud.uFixed[i] + (!isSolid && !cloud.uFixed[owner]);
        if (!(lacks > 0) || free == 0) return;
        const vector change = lacks / free * n;
        if (!cloud.uFixed[i]) cloud.Up[i].s += vec4::from(change).s;
        // if j is an image of i, i itself has got the change already
        if (owner != i && !cloud.uFixed[owner])
            (isSolid ? toSolid[owner] : cloud.Up[owner]).s -=
                vec4::from(j < cloud.n() ? change : vector(cloud.ruleOf(j).R.transpose() * change))
                    .s;
        ++exchanges;
    };
    for (int sweep = 0; sweep < mostSweeps; ++sweep)
    {
        parallelFor(nFluid, [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
                meets[k] = anyNeighbour<among::media>(
                    list, first + k, [&](pairIndex, label j) { return lacks(first + k, j); });
        });
        if (std::find(meets.begin(), meets.end(), 1) == meets.end()) return exchanges;
        for (label k = 0; k < nFluid; ++k)
            if (meets[k])
                forNeighbours<among::media>(list, first + k,
                                            [&](pairIndex, label j) { exchange(first + k, j); });
    }
    // Fluid that presses from the other side does not press it into a solid: these pairs come last
    for (int sweep = 0; first > 0 && sweep < mostSweeps; ++sweep)
    {
        const label before = exchanges;
        for (label k = 0; k < nFluid; ++k)
            forNeighbours<among::others>(list, first + k, [&](pairIndex, label j) {
                const label owner = cloud.ownerOf(j);
                if (owner >= 0 && owner < first && lacks(first + k, j)) exchange(first + k, j);
            });
        if (exchanges == before) break;
    }
    return exchanges;
}

}  // namespace ispf
