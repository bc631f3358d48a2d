// SPDX-License-Identifier: GPL-3.0-or-later
#include "enclosedFluid.H"
#include "closedBodies.H"
#include "disjointSets.H"

#include <algorithm>
#include <numeric>

namespace ispf
{

namespace entries
{

// The numbers of enclosedFluid::state, defect first
const stateEntry<List<scalar>> divergenceDefect{"divergenceDefect"};

}  // namespace entries

enclosedFluid::enclosedFluid(const fsiCase& c) : c_(c)
{
    if (c.structure) solidOf_ = c.structure->tangentPattern().connectedSets();
    label n = 0;  // each particle leads to the first of its solid
    for (label i = 0; i < label(solidOf_.size()); ++i)
        solidOf_[i] = solidOf_[i] == i ? n++ : solidOf_[solidOf_[i]];
    levelOfSolid_.assign(n, -1), free_.assign(n, 0);
    for (const label s : solidOf_) ++free_[s];
    for (label i = 0; i < label(solidOf_.size()); ++i)
        if (c.structure->reference().fixed[i]) free_[solidOf_[i]] = 0;
}

void enclosedFluid::setup(const solidSurface* surface)
{
    surface_ = surface;
    bodies_.clear(), levels_.clear(), bodyOf_.assign(c_.cloud.zones.size(), -1);
    std::fill(levelOfSolid_.begin(), levelOfSolid_.end(), -1);
    findBodies(closedBodies(c_.cloud, c_.list));
    findLevels();
    if (bodies_.empty()) return;
    const sweptRates swept = c_.walls->swept(c_.cloud);
    for (const level& l : levels_)
        if (!l.ofSolid) refusePush(c_, swept, l.zones);
}

// rootOf: of closedBodies
void enclosedFluid::findBodies(const List<label>& rootOf)
{
    if (std::all_of(rootOf.begin(), rootOf.end(), [](label r) { return r < 0; })) return;
    const particleCloud& cloud = c_.cloud;
    const label nz = label(rootOf.size());
    const List<scalar> count =
        blockSums(cloud.n() - cloud.nSolid(), nz, [&](label begin, label end, scalar* of) {
            std::fill_n(of, nz, 0);
            for (label k = begin; k < end; ++k) ++of[cloud.zone[cloud.nSolid() + k]];
        });
    for (label r = 0; r < nz; ++r)
    {
        if (rootOf[r] != r) continue;
        body b;
        b.isZone.assign(nz, 0);
        for (label z = r; z < nz; ++z)
            if (rootOf[z] == r)
                b.isZone[z] = 1, b.n += label(count[z]), bodyOf_[z] = label(bodies_.size());
        b.volume = b.n * cloud.volume();
        bodies_.push_back(std::move(b));
    }
}

// Joins the bodies that the free part of one solid lies between, and joins with `given` those whose solid reaches an open surface,
// or fluid with a given pressure.  Each set without it has a free level.  So has a solid without sides and clamps, which fills a
// periodic space
void enclosedFluid::findLevels()
{
    const label given = label(bodies_.size()), nSolids = label(levelOfSolid_.size());
    List<label> set(given + 1 + nSolids);
    std::iota(set.begin(), set.end(), 0);
    List<char> sided(nSolids, 0);
    const auto nodeOf = [&](label zone) {
        return zone >= 0 && bodyOf_[zone] >= 0 ? bodyOf_[zone] : given;
    };
    for (label k = 0; surface_ && k < c_.cloud.nSolid(); ++k)
        if (!c_.cloud.uFixed[k])
            surface_->forZonesBefore(k, [&](label zone) {
                join(set, nodeOf(zone), given + 1 + solidOf_[k]), sided[solidOf_[k]] = 1;
            });

    List<label> number(set.size(), -1);  // of the level of each set
    const auto numberOf = [&](label node) { return number[representative(set, node)]; };
    for (label b = 0; b < given; ++b)
    {
        const label root = representative(set, b);
        if (root == representative(set, given)) continue;
        if (number[root] < 0) number[root] = label(levels_.size()), levels_.emplace_back();
        level& l = levels_[bodies_[b].level = number[root]];
        l.n += bodies_[b].n;
        for (label z = 0; z < label(bodyOf_.size()); ++z)
            if (bodyOf_[z] == b) l.zones.push_back(z);
    }
    for (label s = 0; s < nSolids; ++s)
    {
        levelOfSolid_[s] = numberOf(given + 1 + s);
        if (levelOfSolid_[s] >= 0) levels_[levelOfSolid_[s]].ofSolid = true;
        if (!surface_ || sided[s] || free_[s] == 0) continue;
        levelOfSolid_[s] = label(levels_.size());
        levels_.push_back({.zones = {}, .n = free_[s], .ofSolid = true, .alone = true});
    }
}

// Free level of the pressure of particle i, -1: its level is given
label enclosedFluid::levelOf(label i) const
{
    const particleCloud& cloud = c_.cloud;
    if (!cloud.isFluid(i)) return levelOfSolid_[solidOf_[i]];
    const label body = bodyOf_[cloud.zone[i]];
    return body < 0 ? -1 : bodies_[body].level;
}

bool enclosedFluid::inactive() const
{
    return !makesGood_ ||
           std::all_of(bodies_.begin(), bodies_.end(), [](const body& b) { return b.level >= 0; });
}

void enclosedFluid::addDefect(List<scalar>& q)
{
    if (inactive()) return;
    const particleCloud& cloud = c_.cloud;
    const state s(cloud);
    for (body& b : bodies_)
    {
        if (b.level >= 0) continue;
        b.added = cloud.volume() * sumOf(cloud.nSolid(), cloud.n(), [&](label i) {
                      const label z = cloud.zone[i];
                      return b.isZone[z] ? s.defect[z] : 0;
                  });
    }
    forEach(cloud.nSolid(), cloud.n(), [&](label i) {
        const label of = bodyOf_[cloud.zone[i]];
        if (of >= 0) q[i] += bodies_[of].added / bodies_[of].volume;
    });
}

void enclosedFluid::account(particleCloud& cloud, scalar dt, const List<tensor>& dF,
                            scalar way) const
{
    if (inactive() && !cloud.state.find(entries::divergenceDefect)) return;
    state s(cloud);
    std::fill(s.defect.begin(), s.defect.end(), 0);
    for (const body& b : bodies_)
    {
        if (inactive() || b.level >= 0) continue;
        s.booked += b.added * dt;
        const scalar defect = surface_->missed(cloud.Up, dF, way, b.isZone);
        for (size_t z = 0; z < s.defect.size(); ++z)
            if (b.isZone[z]) s.defect[z] = defect / b.volume;
    }
    s.write(cloud);
}

enclosedFluid::state::state(const particleCloud& cloud) : defect(cloud.zones.size(), 0)
{
    const auto kept = cloud.state.find(entries::divergenceDefect);
    const size_t nz = defect.size();
    if (!kept || kept->size() != nz + 1) return;
    std::copy_n(kept->data(), nz, defect.begin());
    booked = kept->back();
}

void enclosedFluid::state::write(particleCloud& cloud) const
{
    List<scalar> kept = defect;
    kept.push_back(booked);
    cloud.state.set(entries::divergenceDefect, kept);
}

// Mean of value(i) over the fluid of each level, over the solid of one without fluid
template <class Value>
List<scalar> enclosedFluid::means(Value&& value) const
{
    const bool alone =
        std::any_of(levels_.begin(), levels_.end(), [](const level& l) { return l.alone; });
    const label first = alone ? 0 : c_.cloud.nSolid(), n = label(levels_.size());
    List<scalar> sums = blockSums(c_.cloud.n() - first, n, [&](label begin, label end, scalar* of) {
        std::fill_n(of, n, 0);
        for (label i = first + begin; i < first + end; ++i)
            if (const label l = levelOf(i); l >= 0 && counts(i, l)) of[l] += value(i);
    });
    for (label l = 0; l < n; ++l) sums[l] /= levels_[l].n;
    return sums;
}

void enclosedFluid::dropLevel(List<vec4>& up) const
{
    if (std::none_of(levels_.begin(), levels_.end(), [](const level& l) { return l.ofSolid; }))
        return;
    const List<scalar> mean = means([&](label i) { return up[i][3]; });
    forEach(0, c_.cloud.n(), [&](label i) {
        if (const label l = levelOf(i); l >= 0 && levels_[l].ofSolid) up[i][3] -= mean[l];
    });
}

void enclosedFluid::keepLevel(const particleCloud& cloud, scalar fall, List<scalar>& z) const
{
    if (levels_.empty()) return;
    const List<scalar> gain = means([&](label i) { return z[4 * i + 3] - cloud.Up[i][3] - fall; });
    forEach(0, cloud.n(), [&](label i) {
        if (const label l = levelOf(i); l >= 0) z[4 * i + 3] -= gain[l];
    });
}

void enclosedFluid::balance(List<scalar>& rows) const
{
    if (levels_.empty()) return;
    const particleCloud& cloud = c_.cloud;
    const List<scalar> mean = means([&](label i) { return rows[4 * i + 3]; });
    forEach(0, cloud.n(), [&](label i) {
        if (const label l = levelOf(i); l >= 0 && counts(i, l)) rows[4 * i + 3] -= mean[l];
    });
}

}  // namespace ispf
