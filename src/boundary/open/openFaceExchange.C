// SPDX-License-Identifier: GPL-3.0-or-later
#include "openFace.H"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace ispf
{

namespace
{

constexpr scalar closest = 0.75;   // [dx] no particle is put nearer than this to another one
constexpr scalar offWalls = 0.35;  // [dx] nor nearer than this to a wall
constexpr scalar missingHere = 0.25, missingAround = 0.5;  // particles, see openFace.H
// [dx] a hole of this radius is filled even if no particle is missing
constexpr scalar widest = 1.4;

}  // namespace

// The particles near the face at present
struct openFace::census
{
    const particleCloud& cloud;
    pointGrid feet;  // of the fluid in the strip
    openLayer::deficit before;
    pointGrid particles;  // all, from 1.5 dx before the face
    List<label> index;    // of the particles in the cloud
    pointGrid entered;    // feet of the particles that came in through the surface in this step
    List<scalar> beyond;  // how far they are beyond the surface

    census(const particleCloud& c, const openLayer& layer, scalar region)
        : cloud(c),
          feet(region),
          before(layer.missing(c, region)),
          particles(1.5 * c.dx),
          entered(region)
    {
    }

    // Calls share(j, weight) for the fluid of a zone within 1.5 dx of x, for any if there is none of it; the sum of the weights is
    // one
    template <class Share>
    void around(const vector& x, std::uint8_t zone, Share&& share) const
    {
        List<std::pair<label, scalar>> found[2];  // of other zones, of this one
        scalar sums[2] = {0, 0};
        const scalar radius = 1.5 * cloud.dx;
        particles.within(x, radius, [&](label k, scalar r) {
            const label j = index[k];
            if (!cloud.isFluid(j)) return;
            const bool own = cloud.zone[j] == zone;
            found[own].push_back({j, radius - r}), sums[own] += radius - r;
        });
        const bool own = !found[1].empty();
        for (const auto& [j, w] : found[own]) share(j, w / sums[own]);
    }
};

label openFace::removeBeyond(particleCloud& cloud) const
{
    findFeet(cloud);
    const auto left = [&](label i) {
        return known_[i].foot.found && known_[i].foot.depth > depth_;
    };
    // a wall may cross the face: what has left was before it at rest
    const auto rest = cloud.vectors.find("x0");
    for (label i = 0; i < cloud.nSolid(); ++i)
        if (!cloud.uFixed[i] && left(i) && rest != cloud.vectors.end() &&
            !(surface_->find(rest->second[i].xyz()).depth > 0))
            throw fatalError("The solid leaves through the open face " + name_ + " with " +
                             cloud.describe(i) +
                             ". Only fluid can. End the run before, or move the face away");
    List<char> gone(cloud.n(), 0);
    label kept = cloud.nSolid();
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (left(i)) gone[i] = 1;
        else known_[kept++] = known_[i];
    const label n = cloud.n() - kept;
    if (n > 0) cloud.remove(gone);
    return n;
}

openFace::census openFace::count(const particleCloud& cloud) const
{
    census c(cloud, layer_, region_);
    for (label i = 0; i < cloud.n(); ++i)
    {
        const surfaceFoot& f = known_[i].foot;
        if (!f.found || f.depth < -1.5 * dx_) continue;
        c.particles.add(cloud.x[i].xyz()), c.index.push_back(i);
        if (!cloud.isFluid(i)) continue;
        if (f.depth > 0) c.feet.add(f.foot);
        else if (cloud.beyondOpen(i)) c.entered.add(f.foot), c.beyond.push_back(-f.depth);
    }
    return c;
}

// Per sample of the strip: 1 if a moving wall stands in it or has passed over it; no particle is missing there
List<char> openFace::passedOver(const movingWalls& walls) const
{
    List<char> over(samples_.size(), 0);
    if (walls.any)
        parallelFor(
            label(samples_.size()),
            [&](label begin, label end) {
                for (label k = begin; k < end; ++k) over[k] = walls.over(samples_[k].x, 0);
            },
            256);
    return over;
}

// Chooses spots for new particles.  Spots whose nearest particle is about a spacing away come first: new particles then
// close up like a lattice.  With the largest holes first the gaps left would be too narrow to fill
List<label> openFace::choose(const census& c, const movingWalls& walls) const
{
    using candidate = std::tuple<scalar, label, scalar>;  // misfit, spot, its hole at that time
    std::priority_queue<candidate, List<candidate>, std::greater<>> queue;
    const auto sum = [&](const pointGrid& feet, const vector& at, scalar radius) {
        scalar weights = 0;
        feet.within(at, radius, [&](label, scalar r) { weights += weight(r / radius); });
        return weights;
    };
    const auto without = [&](const pointGrid& feet, const vector& at, scalar full, scalar radius) {
        return full - sum(feet, at, radius);
    };
    pointGrid passed(region_);
    const List<char> over = passedOver(walls);
    for (size_t k = 0; k < samples_.size(); ++k)
        if (over[k]) passed.add(samples_[k].foot);
    // the deficit of the layer is counted within the larger radius and scaled by the radii: within the smaller radius
    // it would be mostly chance
    const scalar counted = std::hypot(region_, openLayer::depth * dx_);
    const scalar hereOfRegion = std::pow(near_ / region_, c.cloud.nDims - 1);
    const auto before = [&](const vector& at) {
        return walls.near(at, counted) ? 0 : c.before.sum(at, region_, weight);
    };
    // a spot is useful if it has room and particles are missing, or if its hole may become a wide one
    const label n = label(spots_.size());
    List<scalar> hole(n), missingNear(n), missingRegion(n);
    parallelFor(
        n,
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                const spot& at = spots_[k];
                if (c.particles.any(at.x, closest * dx_) || walls.over(at.x, offWalls * dx_))
                    continue;
                hole[k] = c.particles.nearest(at.x, 1.5 * dx_);
                const scalar inLayer = before(at.foot);
                missingNear[k] = without(c.feet, at.foot, at.fullNear, near_) -
                                 perSample_ * sum(passed, at.foot, near_) + hereOfRegion * inLayer;
                if (missingNear[k] < missingHere) continue;
                missingRegion[k] = without(c.feet, at.foot, at.fullRegion, region_) -
                                   perSample_ * sum(passed, at.foot, region_) + inLayer;
            }
        },
        256);
    const auto offer = [&](label k) {
        const bool wanted = missingNear[k] >= missingHere && missingRegion[k] >= missingAround;
        if (hole[k] >= (wanted ? closest : widest) * dx_)
            queue.push({std::abs(hole[k] - dx_), k, hole[k]});
    };
    for (label k = 0; k < n; ++k) offer(k);

    List<label> chosen;
    pointGrid addedFeet(region_);
    const auto flowsOut = [&](const spot& at) {
        scalar out = 0;
        c.around(at.x, at.zone,
                 [&](label j, scalar w) { out += w * c.cloud.Up[j].xyz().dot(at.normal); });
        return out > 0;
    };
    while (!queue.empty())
    {
        const auto [misfit, k, then] = queue.top();
        queue.pop();
        if (then != hole[k]) continue;
        const spot& at = spots_[k];
        const bool wanted =
            without(addedFeet, at.foot, missingNear[k], near_) >= missingHere &&
            without(addedFeet, at.foot, missingRegion[k], region_) >= missingAround &&
            !flowsOut(at);
        if (!wanted && hole[k] < widest * dx_) continue;
        addedFeet.add(at.foot), chosen.push_back(k);
        spotGrid_.within(at.x, 1.5 * dx_, [&](label other, scalar r) {
            if (r < hole[other]) hole[other] = r, offer(other);
        });
    }
    return chosen;
}

// How far a new particle starts inside the outer end: as far as the particle that left the strip has moved beyond the
// surface.  Without this, whole layers would lose up to one step each
scalar openFace::lag(const census& c, const spot& at) const
{
    scalar sum = 0, weights = 0;
    c.entered.within(at.foot, near_, [&](label k, scalar r) {
        sum += weight(r / near_) * c.beyond[k], weights += weight(r / near_);
    });
    return weights > 0 ? sum / weights : 0;
}

// Appends the new particles.  Each field is the weighted mean over its zone's particles within 1.5 dx; integers are
// those of the nearest particle
void openFace::insert(particleCloud& cloud, const census& c, const List<label>& chosen) const
{
    const label before = cloud.n();
    for (const label k : chosen) cloud.append(spots_[k].x, spots_[k].zone, vec4{}, cloud.nextId());
    for (size_t k = 0; k < chosen.size(); ++k)
    {
        const spot& at = spots_[chosen[k]];
        const label i = before + label(k);
        scalar nearest = 0;
        c.around(at.x, at.zone, [&](label j, scalar w) {
            if (w > nearest)
                for (auto& [name, field] : cloud.integers) field[i] = field[j];
            nearest = std::max(nearest, w);
            cloud.Up[i].s += w * cloud.Up[j].s;
            for (auto& [name, field] : cloud.vectors) field[i].s += w * field[j].s;
            for (auto& [name, field] : cloud.scalars) field[i] += w * field[j];
        });
        if (at.depth > 0.9 * depth_)
            cloud.x[i].setXyz(at.x - std::min(lag(c, at), 0.5 * dx_) * at.normal);
        if (inflow_) cloud.uFixed[i] = 1;
        else cloud.Up[i][3] = given_, cloud.pFixed[i] = 1, cloud.pGiven[i] = given_;
    }
}

openFace::change openFace::exchange(particleCloud& cloud, const movingWalls& walls) const
{
    change c;
    c.deleted = removeBeyond(cloud);
    const census present = count(cloud);
    const List<label> chosen = choose(present, walls);
    if (!chosen.empty()) insert(cloud, present, chosen);
    c.created = label(chosen.size());
    return c;
}

}  // namespace ispf
