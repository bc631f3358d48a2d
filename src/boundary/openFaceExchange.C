// SPDX-License-Identifier: GPL-3.0-or-later
#include "openFace.H"

#include <algorithm>
#include <queue>

namespace ispf
{

namespace
{

constexpr scalar closest = 0.75;  // [dx] no particle is put nearer than this to another one
constexpr scalar widest = 1.2;    // [dx] a hole of this radius is filled even if none is missing

}  // namespace

// What lies near the face now
struct openFace::strip
{
    pointGrid feet, particles;
    List<label> index;  // of the particles in the cloud

    strip(scalar radius, scalar dx) : feet(radius), particles(1.5 * dx) {}
};

label openFace::removeBeyond(particleCloud& cloud) const
{
    List<char> gone(cloud.n(), 0);
    label n = 0;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        const vector x = cloud.x[i].xyz();
        if (surface_->surelyFar(x)) continue;
        const surfaceFoot f = surface_->find(x);
        if (f.found && f.depth > depth_) gone[i] = 1, ++n;
    }
    if (n > 0) cloud.remove(gone);
    return n;
}

openFace::strip openFace::stripOf(const particleCloud& cloud) const
{
    strip s(radius_, dx_);
    for (label i = 0; i < cloud.n(); ++i)
    {
        const vector x = cloud.x[i].xyz();
        if (surface_->surelyFar(x)) continue;
        const surfaceFoot f = surface_->find(x);
        if (!f.found || f.depth < -1.5 * dx_) continue;
        s.particles.add(x), s.index.push_back(i);
        if (f.depth > 0 && cloud.isFluid(i)) s.feet.add(f.foot);
    }
    return s;
}

// Spots in the order of their holes, the largest first; each new particle shrinks those around it
List<label> openFace::choose(const strip& s) const
{
    using candidate = std::pair<scalar, label>;  // hole radius, spot
    const auto smaller = [](const candidate& a, const candidate& b) {
        return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::priority_queue<candidate, List<candidate>, decltype(smaller)> queue(smaller);
    for (label k = 0; k < label(spots_.size()); ++k)
    {
        const scalar hole = s.particles.nearest(spots_[k].x, 1.5 * dx_);
        if (hole >= closest * dx_) queue.push({hole, k});
    }
    List<label> chosen;
    pointGrid added(1.5 * dx_), addedFeet(radius_);
    while (!queue.empty())
    {
        const auto [hole, k] = queue.top();
        queue.pop();
        const spot& place = spots_[k];
        const scalar now = added.nearest(place.x, hole);
        if (now < closest * dx_) continue;
        if (now < hole)
        {
            queue.push({now, k});
            continue;
        }
        scalar missing = place.full;
        const auto subtract = [&](label, scalar r) { missing -= weight(r); };
        s.feet.within(place.foot, radius_, subtract);
        addedFeet.within(place.foot, radius_, subtract);
        if (missing < 0.5 && hole < widest * dx_) continue;
        added.add(place.x), addedFeet.add(place.foot), chosen.push_back(k);
    }
    return chosen;
}

// All fields of a newcomer are the weighted mean of its zone's particles within 1.5 dx
void openFace::insert(particleCloud& cloud, const strip& s, const List<label>& chosen) const
{
    const label before = cloud.n();
    for (const label k : chosen) cloud.append(spots_[k].x, spots_[k].zone, vec4{}, cloud.nextId());
    for (size_t c = 0; c < chosen.size(); ++c)
    {
        const spot& place = spots_[chosen[c]];
        const label i = before + label(c);
        List<std::pair<label, scalar>> share;
        scalar sum = 0;
        s.particles.within(place.x, 1.5 * dx_, [&](label q, scalar r) {
            const label j = s.index[q];
            if (!cloud.isFluid(j) || cloud.zone[j] != place.zone) return;
            share.push_back({j, 1.5 * dx_ - r}), sum += 1.5 * dx_ - r;
        });
        const auto mean = [&](auto& field) {
            for (const auto& [j, w] : share) field[i].s += w / sum * field[j].s;
        };
        mean(cloud.Up);
        for (auto& [name, field] : cloud.vectors) mean(field);
        for (auto& [name, field] : cloud.scalars)
            for (const auto& [j, w] : share) field[i] += w / sum * field[j];
        cloud.Up[i][3] = given_, cloud.pFixed[i] = 1, cloud.pGiven[i] = given_;
    }
}

label openFace::fill(particleCloud& cloud) const
{
    const strip s = stripOf(cloud);
    const List<label> chosen = choose(s);
    if (!chosen.empty()) insert(cloud, s, chosen);
    return label(chosen.size());
}

}  // namespace ispf
