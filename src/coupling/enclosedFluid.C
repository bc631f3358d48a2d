// SPDX-License-Identifier: GPL-3.0-or-later
#include "enclosedFluid.H"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ispf
{

namespace
{

// Share of the wetted area below which a pressure's forces on solid and fluid count as opposite: what is
// left is the difference of two surface sums
constexpr scalar balanced = 0.3;

}  // namespace

// The lowest zone of the body that each zone belongs to
List<label> enclosedFluid::joinZones() const
{
    const particleCloud& cloud = c_.cloud;
    const label nz = label(cloud.zones.size());
    List<label> root(nz);
    std::iota(root.begin(), root.end(), 0);
    const auto isFluid = [](const zoneInfo& z) { return z.phase == phaseType::fluid; };
    if (std::count_if(cloud.zones.begin(), cloud.zones.end(), isFluid) < 2) return root;

    constexpr label block = 4096;
    const label nBlocks = (cloud.n() + block - 1) / block;
    List<List<char>> sees(nBlocks, List<char>(nz * nz, 0));
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label b = begin; b < end; ++b)
                for (label i = std::max(cloud.nSolid(), b * block);
                     i < std::min(cloud.n(), (b + 1) * block); ++i)
                    for (std::int64_t k = c_.list.start[i]; k < c_.list.mid[i]; ++k)
                    {
                        const label j = c_.list.index[k];
                        const label source = j < cloud.n() ? j : cloud.ghostSource(j);
                        sees[b][cloud.zone[i] * nz + cloud.zone[source]] = 1;
                    }
        },
        1);
    for (label a = 0; a < nz; ++a)
        for (label b = 0; b < nz; ++b)
        {
            const auto joined = [&](const List<char>& s) { return s[a * nz + b]; };
            if (root[a] == root[b] || std::none_of(sees.begin(), sees.end(), joined)) continue;
            const auto [low, high] = std::minmax(root[a], root[b]);
            std::replace(root.begin(), root.end(), label(high), label(low));
        }
    return root;
}

void enclosedFluid::setup(const monolithicRows& system, const solidSurface* surface)
{
    surface_ = surface;
    const particleCloud& cloud = c_.cloud;
    const label nz = label(cloud.zones.size());
    const List<label> root = joinZones();
    List<label> count(nz, 0), fixed(nz, 0);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        ++count[root[cloud.zone[i]]], fixed[root[cloud.zone[i]]] += cloud.pFixed[i];

    bodies_.clear(), bodyOf_.assign(nz, -1);
    const List<scalar> pushed = c_.walls->sweptRate(cloud);
    for (label r = 0; r < nz; ++r)
    {
        if (root[r] != r || count[r] == 0 || fixed[r] > 0) continue;
        body b;
        b.n = count[r];
        b.isZone.assign(nz, 0);
        for (label z = r; z < nz; ++z)
            if (root[z] == r && cloud.zones[z].phase == phaseType::fluid)
                b.zones.push_back(z), b.isZone[z] = 1, b.pushed += pushed[z];
        if (std::isnan(b.pushed)) continue;  // no area is known: its rows stay as they are
        for (const label z : b.zones) bodyOf_[z] = label(bodies_.size());
        bodies_.push_back(std::move(b));
    }
    scalar wetted = 0;
    for (body& b : bodies_)
    {
        const scalar area = surface_ ? surface_->area(b.isZone) : 0;
        b.free = area == 0, wetted += area;
        if (b.free) checkPushed(b);
    }
    allFree_ = wetted > 0 && loadsItself(system, wetted);
}

// Does the same pressure in all particles leave the solid alone?  Then nothing tells its level
bool enclosedFluid::loadsItself(const monolithicRows& system, scalar area) const
{
    const particleCloud& cloud = c_.cloud;
    if (*std::max_element(cloud.pFixed.begin(), cloud.pFixed.end())) return false;
    const List<vec4> unit(cloud.nAll(), vec4{simd4{0, 0, 0, 1}});
    List<vec4> left(cloud.nSolid());
    system.solidGradient(unit, left);
    scalar force = 0;
    for (label i = 0; i < cloud.nSolid(); ++i)
        if (!cloud.uFixed[i]) force += cloud.volume() * left[i].xyz().norm();
    return force < balanced * area;
}

void enclosedFluid::checkPushed(const body& b) const
{
    // a closed body that moves within the fluid pushes as much as it leaves free
    const particleCloud& cloud = c_.cloud;
    const scalar around = b.n * cloud.volume() / cloud.dx;
    if (!(std::abs(b.pushed) > 1e-6 * c_.walls->maxWallSpeed() * around)) return;
    throw fatalError("Time " + c_.time.timeName() + " s: walls push " + str(b.pushed) +
                     (cloud.nDims == 2 ? " m^2/s" : " m^3/s") + " into zone " +
                     cloud.zones[b.zones.front()].name +
                     ", which only walls enclose: an incompressible fluid cannot give way. Add an "
                     "open patch or an elastic wall, or let the wall rest");
}

void enclosedFluid::addDefect(List<scalar>& q)
{
    if (bodies_.empty() || allFree_) return;
    const particleCloud& cloud = c_.cloud;
    const state s(cloud);
    for (body& b : bodies_) b.source = b.volume = 0, b.added = s.defect[b.zones.front()];
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        const label z = cloud.zone[i], own = bodyOf_[z];
        if (own < 0 || bodies_[own].free) continue;
        body& b = bodies_[own];
        const scalar V = cloud.volume() * s.expansion[z];
        q[i] += b.added;
        b.source += q[i] * V, b.volume += V;
    }
}

void enclosedFluid::account(particleCloud& cloud, scalar dt) const
{
    if (bodies_.empty() || allFree_) return;
    state s(cloud);
    for (const body& b : bodies_)
    {
        if (b.free) continue;
        const scalar gives = surface_->flux(cloud.Up, b.isZone);
        s.booked += b.added * b.volume * dt;
        for (const label z : b.zones)
        {
            s.defect[z] = (b.source - (gives - b.pushed)) / b.volume;
            if (!c_.source.empty()) s.expansion[z] *= 1 + c_.source[z] * dt;
        }
    }
    s.write(cloud);
}

enclosedFluid::state::state(const particleCloud& cloud)
    : defect(cloud.zones.size(), 0), expansion(cloud.zones.size(), 1)
{
    const auto found = cloud.history.find(divergenceDefect);
    const size_t nz = defect.size();
    if (found == cloud.history.end() || found->second.size() != 2 * nz + 1) return;
    const scalar* from = found->second.data();
    std::copy_n(from, nz, defect.begin()), std::copy_n(from + nz, nz, expansion.begin());
    booked = from[2 * nz];
}

void enclosedFluid::state::write(particleCloud& cloud) const
{
    List<scalar>& to = cloud.history[divergenceDefect];
    to = defect;
    to.insert(to.end(), expansion.begin(), expansion.end());
    to.push_back(booked);
}

// Of a body, -1: of all particles
void enclosedFluid::removeMean(label body, label n, List<scalar>& rows) const
{
    const particleCloud& cloud = c_.cloud;
    const auto counts = [&](label i) { return body < 0 || bodyOf_[cloud.zone[i]] == body; };
    const auto sumRange = [&](label begin, label end) {
        scalar sum = 0;
        for (label i = begin; i < end; ++i)
            if (counts(i)) sum += rows[4 * i + 3];
        return sum;
    };
    const scalar mean = parallelSum(cloud.n(), sumRange) / n;
    for (label i = 0; i < cloud.n(); ++i)
        if (counts(i)) rows[4 * i + 3] -= mean;
}

void enclosedFluid::balance(List<scalar>& rows) const
{
    for (const body& b : bodies_)
        if (b.free) removeMean(label(&b - bodies_.data()), b.n, rows);
    if (allFree_) removeMean(-1, c_.cloud.n(), rows);
}

}  // namespace ispf
