// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel sums s_i as constraints s_i = 1 on the positions, outside a dead band.  Each step solves the constraints one
// by one for the smallest displacement, as position-based dynamics does (Macklin & Mueller 2013, ACM TOG 32),
//
//     dx_i = sum_j (l_i + l_j) g_ij,   l_i = -(s_i - 1)/(|sum_j g_ij|^2 + sum_j |g_ij|^2)
//
// Repulsion alone makes differences between neighbours even, but not the sums themselves.
#include "packing.H"

#include "packingPairs.H"
#include "smoothingKernel.H"
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar deadBand = 0.012;
constexpr scalar underRelaxation = 0.5;  // neighbours correct the same place at the same time
constexpr label mostSteps = 60;

class evening
{
public:
    evening(List<packedParticle>& particles, const packingGuides& guides, scalar support)
        : particles_(particles),
          guides_(guides),
          n_(label(particles.size())),
          pairs_(guides.geometry(), support),
          kernel_(smoothingKernel::New("WendlandC2", guides.geometry().nDims(), support / 2)),
          multiplier_(n_, 0),
          counted_(n_, 0)
    {
        const scalar dx = guides.geometry().dx();
        share_ = std::pow(dx, guides.geometry().nDims()) / kernel_->latticeSum(dx);
        const surfaceSearch ends(openEnds(guides.geometry()));
        for (label i = 0; i < n_; ++i)
            counted_[i] = particles[i].where == packedParticle::place::zone &&
                          !ends.within(particles[i].x, support);
    }

    void run()
    {
        for (label step = 0; step < mostSteps; ++step)
        {
            pairs_.refresh(particles_);
            if (!setMultipliers()) return;
            parallelFor(n_, [&](label begin, label end) {
                for (label i = begin; i < end; ++i)
                    if (const vector by = displacement(i); by.squaredNorm() > 0)
                        guides_.move(particles_[i], underRelaxation * by, true);
            });
        }
    }

private:
    // g_ij, gradient of the pair's part of the sum
    vector gradient(label i, label j) const
    {
        const vector apart = pairs_.x(i) - pairs_.x(j);
        const scalar distSqr = apart.squaredNorm();
        scalar F = 0;
        kernel_->F(&distSqr, &F, 1);
        return share_ * F * apart;
    }

    // False if all sums are in the dead band
    bool setMultipliers()
    {
        parallelFor(n_, [&](label begin, label end) {
            for (label i = begin; i < end; ++i) multiplier_[i] = counted_[i] ? multiplierOf(i) : 0;
        });
        return std::any_of(multiplier_.begin(), multiplier_.end(), [](scalar l) { return l != 0; });
    }

    scalar multiplierOf(label i) const
    {
        const auto [first, last] = pairs_.of(i);
        scalar sum = share_ * kernel_->W(0);
        for (const label* j = first; j != last; ++j)
            sum += share_ * kernel_->W((pairs_.x(i) - pairs_.x(*j)).norm());
        const scalar off = sum - 1, beyond = std::abs(off) - deadBand;
        if (beyond <= 0) return 0;
        vector total = vector::Zero();
        scalar squares = 0;
        for (const label* j = first; j != last; ++j)
        {
            const vector g = gradient(i, *j);
            total += g, squares += g.squaredNorm();
        }
        return -std::copysign(beyond, off) / (total.squaredNorm() + squares);
    }

    vector displacement(label i) const
    {
        const auto [first, last] = pairs_.of(i);
        vector sum = vector::Zero();
        for (const label* j = first; j != last; ++j)
            if (const scalar l = multiplier_[i] + multiplier_[pairs_.source(*j)]; l != 0)
                sum += l * gradient(i, *j);
        return sum;
    }

    List<packedParticle>& particles_;
    const packingGuides& guides_;
    label n_;
    packingPairs pairs_;
    std::unique_ptr<smoothingKernel> kernel_;
    scalar share_ = 0;  // share of a particle in a full sum, per W
    List<scalar> multiplier_;
    List<char> counted_;
};

}  // namespace

triSurface openEnds(const zoneGeometry& geometry)
{
    triSurface ends;
    for (size_t z = 0; z < geometry.zones().size(); ++z)
    {
        const triSurface& s = geometry.boundary(label(z));
        ends.append(s.subset([&](label t) {
            const word& name = s.patchNames[s.patch[t]];
            for (const patchInfo& p : geometry.patches())
                if (p.name == name) return p.type == patchInfo::kind::other;
            return name.empty();
        }));
    }
    return ends;
}

void evenSums(List<packedParticle>& particles, const packingGuides& guides, scalar support)
{
    evening(particles, guides, support).run();
}

}  // namespace ispf
