// SPDX-License-Identifier: GPL-3.0-or-later
#include "densityFeedback.H"

#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

constexpr scalar unknown = 2;    // value of e_start that is not known
constexpr scalar unsure = 0.03;  // uncertainty of the faces' places [dx], doc/constants.md
constexpr scalar parts = 4;      // of the extent: L/4 in (3.15), doc/constants.md

// Largest side of the box around the fluid particles with isOf(i)
template <class IsOf>
scalar extent(const particleCloud& cloud, IsOf&& isOf)
{
    vector low = vector::Constant(std::numeric_limits<scalar>::max()), high = -low;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (isOf(i)) low = low.cwiseMin(cloud.x[i].xyz()), high = high.cwiseMax(cloud.x[i].xyz());
    return std::max(cloud.dx, (high - low).maxCoeff());
}

}  // namespace

densityFeedback::densityFeedback(const dictionary& solution, const particleCloud& cloud)
    : cloud_(cloud), constant_(solution.getInRangeOrDefault("densityFeedback", 0, 1, 0))
{
}

void densityFeedback::addTo(List<scalar>& q, const adjointPair& pair, const List<char>& drained,
                            scalar dt)
{
    added_ = 0;
    states_.assign(cloud_.zones.size(), {unknown, 0});
    if (const auto known = cloud_.state.find(entries::drainedZones);
        known && known->size() == 2 * states_.size())
        for (size_t z = 0; z < states_.size(); ++z)
            states_[z] = {(*known)[2 * z], (*known)[2 * z + 1]};
    for (label z = 0; z < label(cloud_.zones.size()); ++z)
    {
        if (cloud_.zones[z].phase != phaseType::fluid) continue;
        const auto counts = [&](label i) {
            return drained[i] && cloud_.zone[i] == z && q[i] == 0 && !cloud_.beyondOpen(i);
        };
        List<scalar> cells(cloud_.n() - cloud_.nSolid(), 0);
        parallelFor(label(cells.size()), [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
                if (const label i = cloud_.nSolid() + k; counts(i)) cells[k] = pair.cell(i);
        });
        label n = 0;
        scalar room = 0, speed = 0;
        for (size_t k = 0; k < cells.size(); ++k)
            if (cells[k] != 0)
                room += cells[k], ++n, speed += cloud_.Up[cloud_.nSolid() + k].xyz().norm();
        if (n == 0) continue;
        zoneState& state = states_[z];
        if (state.start == unknown) state.start = 1 - room / n;
        const scalar L = extent(cloud_, counts), all = 1 - room / n - state.start,
                     band = unsure * cloud_.dx / L;
        const scalar e = all - std::clamp(all, -band, band);
        const scalar w = constant_ * speed / n * parts / L;
        state.source += (1 - std::exp(-4 * w * dt)) * (w * e - state.source);
        for (label i = cloud_.nSolid(); i < cloud_.n(); ++i)
            if (counts(i)) q[i] = state.source, added_ += state.source * cloud_.volume();
    }
}

void densityFeedback::book(particleCloud& cloud, scalar dt) const
{
    if (!on()) return;
    cloud.state.add(entries::fluidFeedback, added_ * dt);
    List<scalar> states;
    for (const zoneState& s : states_) states.push_back(s.start), states.push_back(s.source);
    cloud.state.set(entries::drainedZones, states);
}

}  // namespace ispf
