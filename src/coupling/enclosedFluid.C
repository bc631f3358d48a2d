// SPDX-License-Identifier: GPL-3.0-or-later
#include "enclosedFluid.H"
#include "closedBodies.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Share of the wetted area below which a pressure's forces on solid and fluid count as opposite: what is
// left is the difference of two surface sums
constexpr scalar balanced = 0.3;

constexpr scalar largestShare = 0.2;  // of the fluxes: 0.01 is usual
// Of what would pass the surface at the largest speed: fluid that is stirred within misses 0.002 of it, with no flux
constexpr scalar stirredShare = 0.01;

// Where walls carry solids along, their surface ends at the wall: what it sweeps there is not known
bool clampedMove(const particleCloud& cloud)
{
    for (label i = 0; i < cloud.nSolid(); ++i)
        if (cloud.uFixed[i] && !cloud.Up[i].xyz().isZero(0)) return true;
    return false;
}

}  // namespace

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
            b.pushed += swept.net[z], b.gross += swept.gross[z];
            bodyOf_[z] = label(bodies_.size());
        }
        if (b.n > 0) bodies_.push_back(std::move(b));
    }
    const bool moved = clampedMove(cloud);
    scalar wetted = 0;
    for (body& b : bodies_)
    {
        const scalar area = surface_ ? surface_->area(b.isZone) : 0;
        b.free = area == 0, b.known = !std::isnan(b.pushed) && !moved, wetted += area;
        if (b.free) refusePush(c_, swept, b.zones);
    }
    allFree_ = wetted > 0 && loadsItself(gradientOf, wetted);
}

// Does the same pressure in all particles leave the solid alone?  Then nothing tells its level
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
           std::none_of(bodies_.begin(), bodies_.end(),
                        [](const body& b) { return !b.free && b.known; });
}

void enclosedFluid::addDefect(List<scalar>& q)
{
    if (inactive()) return;
    const particleCloud& cloud = c_.cloud;
    const state s(cloud);
    const auto bodyOf = [&](label i) { return bodyOf_[cloud.zone[i]]; };
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        if (bodyOf(i) < 0) continue;
        body& b = bodies_[bodyOf(i)];
        const scalar V = cloud.volume();
        b.volume += V, b.added += s.defect[cloud.zone[i]] * V, b.source += q[i] * V;
    }
    for (body& b : bodies_) b.added = b.free || !b.known ? 0 : b.added, b.source += b.added;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (bodyOf(i) >= 0) q[i] += bodies_[bodyOf(i)].added / bodies_[bodyOf(i)].volume;
}

void enclosedFluid::account(particleCloud& cloud, scalar dt, const List<tensor>& cofactor) const
{
    if (inactive())
    {
        if (cloud.history.count(divergenceDefect)) state(cloud).clear().write(cloud);
        return;
    }
    state s = state(cloud).clear();
    for (const body& b : bodies_)
    {
        s.booked += b.added * dt;
        if (!b.free && b.known) expectNext(b, cofactor, s);
    }
    s.write(cloud);
}

void enclosedFluid::expectNext(const body& b, const List<tensor>& cofactor, state& s) const
{
    const scalar gives = surface_->flux(c_.cloud.Up, cofactor, b.isZone);
    scalar defect = b.source - (gives - b.pushed);
    // when all is at rest again what still flows inside may miss more than what then passes
    s.largest = std::max(s.largest, std::abs(gives) + b.gross + std::abs(b.source - b.added));
    const scalar speed = std::max(c_.cloud.maxSpeed(), c_.walls->maxGivenSpeed());
    const scalar most =
        std::max(largestShare * s.largest, stirredShare * speed * surface_->area(b.isZone));
    if (std::abs(defect) > most)
    {
        warning("time " + c_.time.timeName() + " s: zone " + c_.cloud.zones[b.zones.front()].name +
                ": its walls push " + str(b.pushed) + ", the solid gives way by " + str(gives) +
                " and its divergence says " + str(b.source) + " m^" +
                std::to_string(c_.cloud.nDims) + "/s. Does its fluid fill what encloses it?");
        defect = std::clamp(defect, -most, most);
    }
    for (const label z : b.zones) s.defect[z] = defect / b.volume;
}

enclosedFluid::state::state(const particleCloud& cloud)
    : defect(cloud.zones.size(), 0)
{
    const auto found = cloud.history.find(divergenceDefect);
    const size_t nz = defect.size();
    if (found == cloud.history.end() || found->second.size() != nz + 2) return;
    const scalar* from = found->second.data();
    std::copy_n(from, nz, defect.begin());
    largest = from[nz], booked = from[nz + 1];
}

// The defects of this step come anew
enclosedFluid::state enclosedFluid::state::clear()
{
    std::fill(defect.begin(), defect.end(), 0);
    return *this;
}

void enclosedFluid::state::write(particleCloud& cloud) const
{
    List<scalar>& to = cloud.history[divergenceDefect];
    to = defect;
    to.push_back(largest), to.push_back(booked);
}

// Of the n particles that count(i) is true for
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
    const label others = label(bodies_.size());  // all that no free body has, solids as well
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
