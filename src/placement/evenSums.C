// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel sums s_i as constraints s_i = 1 on the positions, outside a dead band.  Each step solves the constraints one
// by one for the smallest displacement, as position-based dynamics does (Macklin & Mueller 2013, ACM TOG 32),
//
//     dx_i = sum_j (l_i + l_j) g_ij,   l_i = -(s_i - 1)/(|sum_j g_ij|^2 + sum_j |g_ij|^2)
//
// Repulsion alone makes differences between neighbours even, but not the sums themselves.  The same steps push apart
// two particles that are too near to each other.
#include "packing.H"

#include "packingPairs.H"
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar deadBand = 0.010;
// lies within the band: steps that aim at the edge never quite reach it
constexpr scalar aim = 0.009;
constexpr scalar underRelaxation = 0.5;  // neighbours correct the same place at the same time
constexpr label mostSteps = 60;
constexpr scalar nearest = 0.77;  // in dx: two particles that are nearer are pushed apart

class evening
{
public:
    evening(List<packedParticle>& particles, const packingGuides& guides, scalar support)
        : particles_(particles),
          guides_(guides),
          n_(label(particles.size())),
          pairs_(guides.geometry(), support),
          kernel_(packingKernel::shares(guides.geometry(), support)),
          multiplier_(n_, 0),
          crowded_(n_, 0),
          moved_(n_, 1),
          nearest_(nearest * guides.geometry().dx()),
          ends_(openEnds(guides.geometry())),
          support_(support)
    {
    }

    void run()
    {
        for (label step = 0; step < mostSteps; ++step)
        {
            if (pairs_.refresh(particles_)) std::fill(moved_.begin(), moved_.end(), 1);
            if (!setMultipliers()) return;
            const List<char> held = reachedBy([&](label i) { return isOff(i); });
            parallelFor(n_, [&](label begin, label end) {
                for (label i = begin; i < end; ++i)
                    if (moved_[i] = held[i]; held[i])
                        guides_.move(particles_[i], underRelaxation * displacement(i), true);
            });
        }
    }

private:
    // g_ij, gradient of the pair's part of the sum
    vector gradient(label i, label j) const
    {
        const vector apart = pairs_.apart(i, j);
        return kernel_.F(apart.norm()) * apart;
    }

    // Marks the particles for which `starts` is true, and their neighbours
    template <class Starts>
    List<char> reachedBy(const Starts& starts) const
    {
        List<char> reached(n_, 0);
        for (label i = 0; i < n_; ++i)
            if (starts(i))
            {
                reached[i] = 1;
                forNeighbours<among::all>(
                    pairs_.rows(), i, [&](pairIndex, label j) { reached[pairs_.source(j)] = 1; });
            }
        return reached;
    }

    bool isOff(label i) const { return multiplier_[i] != 0 || crowded_[i]; }

    // False if all sums are in the dead band and no particle is crowded.  Values where no particle has moved stay
    bool setMultipliers()
    {
        const List<char> changed = reachedBy([&](label i) { return moved_[i] != 0; });
        parallelFor(n_, [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                if (changed[i])
                {
                    const bool inZone = particles_[i].where == packedParticle::place::zone;
                    const scalar l = inZone ? multiplierOf(i) : 0;
                    // asked at its present place: a particle may leave the reach of an open end
                    multiplier_[i] = l != 0 && !ends_.within(particles_[i].x, support_) ? l : 0;
                    crowded_[i] = isPlaced(i) && isCrowded(i);
                }
        });
        for (label i = 0; i < n_; ++i)
            if (isOff(i)) return true;
        return false;
    }

    bool isPlaced(label i) const
    {
        return particles_[i].where == packedParticle::place::zone ||
               particles_[i].where == packedParticle::place::strip;
    }

    bool isCrowded(label i) const
    {
        return anyNeighbour<among::all>(pairs_.rows(), i, [&](pairIndex, label j) {
            return pairs_.apart(i, j).squaredNorm() < nearest_ * nearest_;
        });
    }

    scalar multiplierOf(label i) const
    {
        scalar sum = 0;
        pairs_.sums(kernel_, i, i + 1, &sum);
        const scalar off = sum - 1;
        if (std::abs(off) <= deadBand) return 0;
        vector total = vector::Zero();
        scalar squares = 0;
        forNeighbours<among::all>(pairs_.rows(), i, [&](pairIndex, label j) {
            const vector g = gradient(i, j);
            total += g, squares += g.squaredNorm();
        });
        return -std::copysign(std::abs(off) - aim, off) / (total.squaredNorm() + squares);
    }

    vector displacement(label i) const
    {
        vector sum = vector::Zero();
        forNeighbours<among::all>(pairs_.rows(), i, [&](pairIndex, label j) {
            const scalar l = multiplier_[i] + multiplier_[pairs_.source(j)];
            if (l != 0) sum += l * gradient(i, j);
            if (!crowded_[i]) return;
            const vector apart = pairs_.apart(i, j);
            const scalar r = apart.norm();
            if (r < nearest_ && r > 0) sum += (nearest_ - r) / r * apart;
        });
        return sum;
    }

    List<packedParticle>& particles_;
    const packingGuides& guides_;
    label n_;
    packingPairs pairs_;
    packingKernel kernel_;
    List<scalar> multiplier_;
    List<char> crowded_, moved_;
    scalar nearest_;
    surfaceSearch ends_;
    scalar support_;
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
