// SPDX-License-Identifier: GPL-3.0-or-later
#include "enclosedFluid.H"
#include "closedBodies.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// A uniform pressure is balanced if its force on the solid is below this share of the wetted area.  The rest is
// the difference of two surface sums
constexpr scalar balanced = 0.3;

}  // namespace

namespace entries
{

// The numbers of enclosedFluid::state, defect first
const stateEntry<List<scalar>> divergenceDefect{"divergenceDefect"};

}  // namespace entries

void enclosedFluid::setup(const solidGradient& gradientOf, const solidSurface* surface)
{
    surface_ = surface;
    const particleCloud& cloud = c_.cloud;
    const label nz = label(cloud.zones.size());
    bodies_.clear(), bodyOf_.assign(nz, -1), allFree_ = false;
    const List<label> rootOf = closedBodies(cloud, c_.list);
    if (std::all_of(rootOf.begin(), rootOf.end(), [](label r) { return r < 0; })) return;

    const sweptRates swept = c_.walls->swept(cloud);
    List<label> count(nz, 0);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i) ++count[cloud.zone[i]];
    for (label r = 0; r < nz; ++r)
    {
        body b;
        b.isZone.assign(nz, 0);
        for (label z = r; z < nz; ++z)
        {
            if (rootOf[z] != r) continue;
            b.zones.push_back(z), b.isZone[z] = 1, b.n += count[z];
            bodyOf_[z] = label(bodies_.size());
        }
        if (b.n > 0) bodies_.push_back(std::move(b));
    }
    scalar wetted = 0;
    for (body& b : bodies_)
    {
        const scalar area = surface_ ? surface_->area(b.isZone) : 0;
        b.free = area == 0, wetted += area;
        if (b.free) refusePush(c_, swept, b.zones);
    }
    allFree_ = wetted > 0 && loadsItself(gradientOf, wetted);
}

// True if a uniform pressure in all particles exerts no force on the solid.  Then nothing determines its level
bool enclosedFluid::loadsItself(const solidGradient& gradientOf, scalar area) const
{
    const particleCloud& cloud = c_.cloud;
    if (*std::max_element(cloud.pFixed.begin(), cloud.pFixed.end())) return false;
    const List<vec4> unit(cloud.nAll(), vec4{simd4{0, 0, 0, 1}});
    List<vec4> left(cloud.nSolid());
    gradientOf(unit, left);
    scalar force = 0;
    for (label i = 0; i < cloud.nSolid(); ++i)
        if (!cloud.uFixed[i]) force += cloud.volume() * left[i].xyz().norm();
    return force < balanced * area;
}

bool enclosedFluid::inactive() const
{
    return !makesGood_ || allFree_ ||
           std::all_of(bodies_.begin(), bodies_.end(), [](const body& b) { return b.free; });
}

void enclosedFluid::addDefect(List<scalar>& q)
{
    if (inactive()) return;
    const particleCloud& cloud = c_.cloud;
    const state s(cloud);
    const auto bodyOf = [&](label i) { return bodyOf_[cloud.zone[i]]; };
    const scalar V = cloud.volume();
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (bodyOf(i) >= 0)
        {
            body& b = bodies_[bodyOf(i)];
            b.volume += V, b.added += b.free ? 0 : s.defect[cloud.zone[i]] * V;
        }
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (bodyOf(i) >= 0) q[i] += bodies_[bodyOf(i)].added / bodies_[bodyOf(i)].volume;
}

void enclosedFluid::account(particleCloud& cloud, scalar dt, const List<tensor>& dF,
                            scalar way) const
{
    if (inactive() && !cloud.state.find(entries::divergenceDefect)) return;
    state s(cloud);
    std::fill(s.defect.begin(), s.defect.end(), 0);
    for (const body& b : bodies_)
    {
        if (inactive() || b.free) continue;
        s.booked += b.added * dt;
        const scalar defect = surface_->missed(cloud.Up, dF, way, b.isZone);
        for (const label z : b.zones) s.defect[z] = defect / b.volume;
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

// Takes the mean off the continuity rows of the n particles with counts(i)
template <class Counts>
void enclosedFluid::removeMean(Counts&& counts, label n, List<scalar>& rows) const
{
    const auto sumRange = [&](label begin, label end) {
        scalar sum = 0;
        for (label i = begin; i < end; ++i)
            if (counts(i)) sum += rows[4 * i + 3];
        return sum;
    };
    const scalar mean = parallelSum(c_.cloud.n(), sumRange) / n;
    parallelFor(c_.cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (counts(i)) rows[4 * i + 3] -= mean;
    });
}

bool enclosedFluid::ofFreeBody(label i) const
{
    const label b = c_.cloud.isFluid(i) ? bodyOf_[c_.cloud.zone[i]] : -1;
    return b >= 0 && bodies_[b].free;
}

void enclosedFluid::dropLevel(List<vec4>& up) const
{
    if (!allFree_) return;
    const label n = c_.cloud.n(), nSolid = c_.cloud.nSolid();
    const auto sumOf = [&](const auto& value) {
        return parallelSum(n - nSolid, [&](label begin, label end) {
            scalar sum = 0;
            for (label i = nSolid + begin; i < nSolid + end; ++i)
                if (!ofFreeBody(i)) sum += value(i);
            return sum;
        });
    };
    const scalar mean = sumOf([&](label i) { return up[i][3]; }) / sumOf([](label) { return 1; });
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (!ofFreeBody(i)) up[i][3] -= mean;
    });
}

void enclosedFluid::keepLevel(const particleCloud& cloud, List<scalar>& z) const
{
    // index of all particles that are in no free body, solids included
    const label others = label(bodies_.size());
    List<scalar> change(others + 1, 0), n(others + 1, 0);
    const auto groupOf = [&](label i) {
        const label b = cloud.isFluid(i) ? bodyOf_[cloud.zone[i]] : -1;
        return b >= 0 && bodies_[b].free ? b : others;
    };
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        change[groupOf(i)] += z[4 * i + 3] - cloud.Up[i][3], n[groupOf(i)] += 1;
    if (!allFree_) change[others] = 0;
    for (label i = 0; i < cloud.n(); ++i)
        if (const label k = groupOf(i); n[k] > 0) z[4 * i + 3] -= change[k] / n[k];
}

void enclosedFluid::balance(List<scalar>& rows) const
{
    const particleCloud& cloud = c_.cloud;
    label others = cloud.n() - cloud.nSolid();
    const auto bodyOf = [&](label i) { return cloud.isFluid(i) ? bodyOf_[cloud.zone[i]] : -1; };
    for (label b = 0; b < label(bodies_.size()); ++b)
    {
        if (!bodies_[b].free) continue;
        removeMean([&](label i) { return bodyOf(i) == b; }, bodies_[b].n, rows);
        others -= bodies_[b].n;
    }
    if (allFree_)
        removeMean([&](label i) { return cloud.isFluid(i) && !ofFreeBody(i); }, others, rows);
}

}  // namespace ispf
