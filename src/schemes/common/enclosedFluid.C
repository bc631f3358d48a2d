// SPDX-License-Identifier: GPL-3.0-or-later
#include "enclosedFluid.H"
#include "closedBodies.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace entries
{

// The numbers of enclosedFluid::state, defect first
const stateEntry<List<scalar>> divergenceDefect{"divergenceDefect"};

}  // namespace entries

void enclosedFluid::setup(const solidSurface* surface)
{
    surface_ = surface;
    const particleCloud& cloud = c_.cloud;
    const label nz = label(cloud.zones.size());
    bodies_.clear(), bodyOf_.assign(nz, -1), allFree_ = false;
    const List<label> rootOf = closedBodies(cloud, c_.list);
    if (std::all_of(rootOf.begin(), rootOf.end(), [](label r) { return r < 0; })) return;

    const sweptRates swept = c_.walls->swept(cloud);
    const List<scalar> count =
        blockSums(cloud.n() - cloud.nSolid(), nz, [&](label begin, label end, scalar* of) {
            std::fill_n(of, nz, 0);
            for (label k = begin; k < end; ++k) ++of[cloud.zone[cloud.nSolid() + k]];
        });
    for (label r = 0; r < nz; ++r)
    {
        body b;
        b.isZone.assign(nz, 0);
        for (label z = r; z < nz; ++z)
        {
            if (rootOf[z] != r) continue;
            b.zones.push_back(z), b.isZone[z] = 1, b.n += label(count[z]);
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
    const bool given = *std::max_element(cloud.pFixed.begin(), cloud.pFixed.end());
    allFree_ = wetted > 0 && !given && surface_->wetAndOpen()[1] == 0;
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
    for (body& b : bodies_)
    {
        b.volume = b.n * cloud.volume();
        if (b.free) continue;
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
    const auto counted = [&](label i) { return counts(i) ? rows[4 * i + 3] : 0; };
    const scalar mean = sumOf(0, c_.cloud.n(), counted) / n;
    forEach(0, c_.cloud.n(), [&](label i) {
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
    const label n = c_.cloud.n();
    const auto [sum, count] = sumsOf(c_.cloud.nSolid(), n, [&](label i) -> std::array<scalar, 2> {
        if (ofFreeBody(i)) return {};
        return {up[i][3], 1};
    });
    forEach(0, n, [&](label i) {
        if (!ofFreeBody(i)) up[i][3] -= sum / count;
    });
}

void enclosedFluid::keepLevel(const particleCloud& cloud, List<scalar>& z) const
{
    // index of all particles that are in no free body, solids included
    const label others = label(bodies_.size());
    const auto groupOf = [&](label i) {
        const label b = cloud.isFluid(i) ? bodyOf_[cloud.zone[i]] : -1;
        return b >= 0 && bodies_[b].free ? b : others;
    };
    const label nSolid = cloud.nSolid();
    List<scalar> sums =
        blockSums(cloud.n() - nSolid, 2 * (others + 1), [&](label begin, label end, scalar* of) {
            std::fill_n(of, 2 * (others + 1), 0);
            for (label i = nSolid + begin; i < nSolid + end; ++i)
            {
                scalar* group = of + 2 * groupOf(i);
                group[0] += z[4 * i + 3] - cloud.Up[i][3], group[1] += 1;
            }
        });
    if (!allFree_) sums[2 * others] = 0;
    forEach(0, cloud.n(), [&](label i) {
        const scalar* group = sums.data() + 2 * groupOf(i);
        if (group[1] > 0) z[4 * i + 3] -= group[0] / group[1];
    });
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
