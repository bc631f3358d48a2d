// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidSides.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

int fluidZone(const particleCloud& cloud, label j)
{
    return cloud.isMedium(j) ? cloud.zone[cloud.ownerOf(j)] : -1;
}

solidSides::solidSides(const particleCloud& cloud, const neighbourList& list,
                       const List<isometry>& images)
    : cloud_(cloud), list_(list)
{
    if (!cloud.hasRigid()) return;
    List<vector> x;
    for (label i = 0; i < cloud.n(); ++i) x.push_back(cloud.x[i].xyz());
    owned_ = std::make_unique<imagedPoints>(x, 1.5 * cloud.dx, images);
}

// True if the wall's surface next to the wall's nearest particle lies before particle i
bool solidSides::beyondWall(label i) const
{
    scalar nearest = 1e30;
    bool beyond = false;
    forNeighbours<among::walls>(list_, i, [&](pairIndex, label j) {
        if (cloud_.ownerOf(j) >= 0) return;
        const vector way = cloud_.x[i].xyz() - cloud_.x[j].xyz();
        const vec4& d = cloud_.ghostDepth(j);
        if (way.norm() < nearest)
            nearest = way.norm(), beyond = d[3] > 0 && d.xyz().dot(way) <= d[3];
    });
    return beyond;
}

// Fluid zone of neighbour j of solid particle i, or of the particle that j represents beyond a wall; -1: no fluid
int solidSides::mirroredZone(label i, label j) const
{
    if (cloud_.isMedium(j)) return fluidZone(cloud_, j);
    if (const label owner = cloud_.ownerOf(j); owner >= 0)
        return cloud_.isFluid(owner) ? cloud_.zone[owner] : -1;
    const vec4& d = cloud_.ghostDepth(j);
    if (!(d[3] > 0) || !(d.xyz().dot(cloud_.x[i].xyz() - cloud_.x[j].xyz()) > d[3])) return -1;
    scalar nearest = 1e30;
    label next = -1;
    owned_->grid.within(cloud_.x[j].xyz() + 2 * d[3] * d.xyz(), 1.5 * cloud_.dx,
                        [&](label k, scalar r) {
                            if (r < nearest) nearest = r, next = owned_->source[k];
                        });
    return next >= cloud_.nSolid() ? cloud_.zone[next] : -1;
}

// Half the mean way along n to the fluid on that side, in any zone
vector solidSides::wayAhead(label i, const vector& n) const
{
    scalar sum = 0, moment = 0;
    forNeighbours<among::others>(list_, i, [&](pairIndex k, label j) {
        const scalar d = (cloud_.x[j].xyz() - cloud_.x[i].xyz()).dot(n);
        if (d > 0 && fluidZone(cloud_, j) >= 0) sum += list_.F[k] * d, moment += list_.F[k] * d * d;
    });
    return sum != 0 ? vector(0.5 * moment / sum * n) : vector(0.5 * cloud_.dx * n);
}

// 2 V sum grad W of the medium that is absent, (5.26): that of a full support is zero
vector solidSides::absentArea(label i) const
{
    return sumNeighbours<among::all>(
        list_, i, vector(vector::Zero()), [&](pairIndex k, label j) -> vector {
            return 2 * cloud_.volume() * list_.F[k] * (cloud_.x[j].xyz() - cloud_.x[i].xyz());
        });
}

// True if there is room for a particle ahead: a ball that packed particles nowhere leave between them, within the kernel
bool solidSides::isEmpty(label i, const vector& n) const
{
    constexpr scalar room = 0.95, ahead[] = {1, 1.6, 2.2};  // [dx], doc/constants.md
    const scalar dx = cloud_.dx;
    return std::any_of(std::begin(ahead), std::end(ahead), [&](scalar t) {
        const vector at = cloud_.x[i].xyz() + t * dx * n;
        bool empty = true;
        forNeighbours<among::all>(list_, i, [&](pairIndex, label j) {
            empty = empty && (cloud_.x[j].xyz() - at).norm() > room * dx;
        });
        return empty;
    });
}

// Half the mean way along the normal to what is absent, from the first moment of the kernel's gradient: that of a full support
// is one
vector solidSides::wayOut(label i, const vector& absent) const
{
    const vector n = absent.normalized();
    const scalar moment =
        sumNeighbours<among::all>(list_, i, 1.0, [&](pairIndex k, label j) -> scalar {
            const scalar d = (cloud_.x[j].xyz() - cloud_.x[i].xyz()).dot(n);
            return list_.F[k] * d * d;
        });
    const scalar way = moment * cloud_.volume() / absent.norm();
    return std::clamp(way, 0.25 * cloud_.dx, 1.5 * cloud_.dx) * n;
}

solidSides::sides solidSides::of(label i) const
{
    sides s;
    if (owned_ && beyondWall(i)) return s;
    // a smaller area counts as no zone
    const scalar V = cloud_.volume(), least = 2e-3 * V / cloud_.dx;
    List<vector> areas(cloud_.zones.size() + 1, vector::Zero());
    forNeighbours<among::others>(list_, i, [&](pairIndex k, label j) {
        if (const int z = mirroredZone(i, j); z >= 0)
            areas[z] += 2 * V * list_.F[k] * (cloud_.x[i].xyz() - cloud_.x[j].xyz());
    });
    // in the midst of packed particles the kernel's sum has a gradient too, though nothing is absent
    constexpr scalar disorder = 0.15;  // doc/constants.md
    if (const vector absent = absentArea(i);
        absent.norm() > disorder * V / cloud_.dx && isEmpty(i, absent.normalized()))
        areas.back() = absent;
    for (const int k : {0, 1})
    {
        const auto most =
            std::max_element(areas.begin(), areas.end(),
                             [](const vector& a, const vector& b) { return a.norm() < b.norm(); });
        if (most->norm() < least) break;
        s.zone[k] = label(most - areas.begin());
        s.area[k] = *most;
        s.way[k] = most == areas.end() - 1 ? wayOut(i, *most) : wayAhead(i, most->normalized());
        most->setZero();
    }
    return s;
}

}  // namespace ispf
