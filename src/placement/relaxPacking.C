// SPDX-License-Identifier: GPL-3.0-or-later
// Repulsion by two Wendland kernels.  The wide kernel is that of the flow and makes its sums even.  The narrow
// one keeps next neighbours apart (the wide one alone would allow pairs).
#include "packing.H"

#include "packingPairs.H"
#include <array>
#include <cmath>

namespace ispf
{

namespace
{

using place = packedParticle::place;

constexpr scalar narrowSupport = 1.7;  // in dx
constexpr scalar wideRate = 0.4;       // of the displacement that would remove a long wave at once
constexpr scalar narrowRate = 0.12;
// part of the last move that is repeated: long waves need many moves
constexpr scalar momentum = 0.6;
constexpr label correctionInterval = 8;  // iterations between additions and removals
constexpr scalar roomAtBirth = 0.6;      // in dx, to the next particle
constexpr scalar tolerableSum = 0.035;   // deviation of a kernel sum that calls for a correction
// in dx: two particles nearer than this, held in a corner, never part
constexpr scalar pair = 0.45;

class relaxation
{
public:
    relaxation(List<packedParticle>& particles, const packingGuides& guides,
               const List<label>& target, const relaxationSettings& settings)
        : particles_(particles),
          guides_(guides),
          geometry_(guides.geometry()),
          target_(target),
          settings_(settings),
          dx_(geometry_.dx()),
          even_(packingKernel::shares(geometry_, settings.support)),
          wide_(displacing(wideRate, settings.support)),
          narrow_(displacing(narrowRate, narrowSupport * dx_)),
          pairs_(geometry_, settings.support)
    {
    }

    void run()
    {
        for (label it = 0; it < settings_.iterations; ++it)
        {
            const scalar left = 1 - scalar(it) / settings_.iterations;
            step(std::min(1.0, 2 * left));
            if (it % correctionInterval == correctionInterval - 1 && left > 0.25) correct();
        }
        matchTargets();
    }

private:
    // A kernel whose F, times x_i - x_j, is a displacement
    packingKernel displacing(scalar rate, scalar support) const
    {
        const scalar cell = std::pow(dx_, geometry_.nDims());
        return packingKernel(geometry_.nDims(), support, -rate * cell * dx_ * dx_);
    }

    // Moves all particles once along the repulsion
    void step(scalar rate)
    {
        pairs_.refresh(particles_);
        parallelFor(label(particles_.size()), [&](label begin, label end) {
            List<vector> push(end - begin);
            pairs_.repulsion(wide_, narrow_, begin, end, push.data());
            for (label i = begin; i < end; ++i)
            {
                packedParticle& p = particles_[i];
                const vector from = p.x;
                guides_.move(p, rate * push[i - begin] + momentum * p.way);
                p.way = p.x - from;
            }
        });
    }

    // Sets the kernel sums of particles [begin, end) over the sum of the lattice
    List<scalar> kernelSums()
    {
        pairs_.refresh(particles_);
        List<scalar> sum(particles_.size());
        parallelFor(label(sum.size()),
                    [&](label begin, label end) { pairs_.sums(even_, begin, end, &sum[begin]); });
        return sum;
    }

    void correct();
    void matchTargets();
    enum class exchange
    {
        none,
        uneven,  // where sums differ most
        pairs
    };
    void change(label most, scalar room, exchange what);
    List<char> secondOfPairs(const cellList& cells) const;
    bool isFinal() const;
    bool birthPlace(const cellList& cells, const packedParticle& parent, scalar room,
                    packedParticle& born) const;

    List<packedParticle>& particles_;
    const packingGuides& guides_;
    const zoneGeometry& geometry_;
    const List<label>& target_;
    relaxationSettings settings_;
    scalar dx_;
    packingKernel even_, wide_, narrow_;
    packingPairs pairs_;
};

// Finds the roomiest place around a particle, bound like it in the same zone, at least `room` from all others
bool relaxation::birthPlace(const cellList& cells, const packedParticle& parent, scalar room,
                            packedParticle& born) const
{
    scalar best = room;
    for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b)
            for (int c = -1; c <= 1; ++c)
            {
                if ((a == 0 && b == 0 && c == 0) || (geometry_.nDims() == 2 && c != 0)) continue;
                packedParticle p = parent;
                guides_.hold(p, 0.9 * dx_ * vector(a, b, c).normalized(), true);
                if (geometry_.beyondSymmetry(p.x) >= 0) continue;
                if (p.where == place::zone && geometry_.zoneAt(p.x) != p.owner) continue;
                scalar nearest = dx_ * dx_;
                cells.near(p.x, dx_, [&](label, scalar d2) { nearest = std::min(nearest, d2); });
                if (std::sqrt(nearest) <= best) continue;
                best = std::sqrt(nearest);
                born = p;
            }
    born.seed = born.x, born.way.setZero();
    return best > room;
}

// Per particle: 1 if it is the second of a pair of one zone
List<char> relaxation::secondOfPairs(const cellList& cells) const
{
    List<char> second(particles_.size(), 0);
    for (label i = 0; i < label(particles_.size()); ++i)
        if (particles_[i].where == place::zone)
            cells.near(particles_[i].x, pair * dx_, [&](label j, scalar) {
                if (j < i && particles_[j].where == place::zone &&
                    particles_[j].owner == particles_[i].owner && !second[j])
                    second[i] = 1;
            });
    return second;
}

// Adds particles where sums are lowest and removes them where they are highest, until each zone has its target or
// `most` have changed.  Then exchanges particles, but removes no more than have found a new place.  With
// exchange::uneven, particles held in a layer and free ones are exchanged separately
void relaxation::change(label most, scalar room, exchange what)
{
    const List<scalar> sum = kernelSums();
    List<std::array<List<label>, 2>> zones(geometry_.zones().size());
    for (size_t i = 0; i < particles_.size(); ++i)
        if (const packedParticle& p = particles_[i]; p.where == place::zone)
            zones[p.owner][what == exchange::uneven && p.bound()].push_back(label(i));
    const List<vector> x = withImagePoints(particles_, geometry_, settings_.support);
    const cellList cells(x, settings_.support);
    List<char> gone(particles_.size(), 0), touched(particles_.size(), 0);
    const List<char> second =
        what == exchange::pairs ? secondOfPairs(cells) : List<char>(particles_.size(), 0);
    List<packedParticle> born;
    const auto isolate = [&](label i) {
        cells.near(x[i], 2 * dx_, [&](label j, scalar) {
            if (j < label(touched.size())) touched[j] = 1;
        });
    };
    const auto changeSome = [&](List<label>& m, label excess) {
        const auto rank = [&](label i) { return std::make_tuple(second[i], sum[i], i); };
        std::sort(m.begin(), m.end(), [&](label a, label b) { return rank(a) < rank(b); });
        label high = 0, low = 0, pairs = 0;
        for (const label i : m)
            high += sum[i] > 1 + tolerableSum, low += sum[i] < 1 - tolerableSum, pairs += second[i];
        const label swap = what == exchange::pairs    ? pairs
                           : what == exchange::uneven ? std::min({high, low, most})
                                                      : 0;
        const label remove = std::clamp<label>(excess, 0, most) + swap,
                    add = std::clamp<label>(-excess, 0, most) + swap;
        List<label> removed;
        for (size_t k = m.size(); k-- > 0 && label(removed.size()) < remove;)
            if (!touched[m[k]]) removed.push_back(m[k]), isolate(m[k]);
        label added = 0;
        packedParticle p;
        for (size_t k = 0; k < m.size() && added < add; ++k)
            if (!touched[m[k]] && birthPlace(cells, particles_[m[k]], room, p))
                born.push_back(p), ++added, isolate(m[k]);
        removed.resize(std::min<size_t>(removed.size(), remove - std::min(add - added, swap)));
        for (const label i : removed) gone[i] = 1;
        return label(removed.size()) - added;
    };
    for (size_t z = 0; z < zones.size(); ++z)
    {
        label excess = -target_[z];
        for (const List<label>& members : zones[z]) excess += label(members.size());
        for (List<label>& members : zones[z]) excess -= changeSome(members, excess);
    }
    List<packedParticle> kept;
    for (size_t i = 0; i < particles_.size(); ++i)
        if (!gone[i]) kept.push_back(particles_[i]);
    kept.insert(kept.end(), born.begin(), born.end());
    particles_ = std::move(kept);
}

void relaxation::correct()
{
    change(std::max<label>(20, label(particles_.size() / 200)), roomAtBirth * dx_,
           exchange::uneven);
}

bool relaxation::isFinal() const
{
    List<label> n(target_.size(), 0);
    List<vector> x;
    for (const packedParticle& p : particles_)
    {
        x.push_back(p.x);
        if (p.where == place::zone) ++n[p.owner];
    }
    const List<char> second = secondOfPairs(cellList(x, pair * dx_));
    return n == target_ && std::find(second.begin(), second.end(), 1) == second.end();
}

// Evenly full layers have no gap for one more particle: it is squeezed in, and the others move up
void relaxation::matchTargets()
{
    for (const scalar room : {1.0, 0.75, 0.5, 0.25})
    {
        change(label(particles_.size()), room * roomAtBirth * dx_,
               room == 1 ? exchange::none : exchange::pairs);
        for (label it = 0; it < 20; ++it) step(0.5);
        if (isFinal()) break;
    }
    for (packedParticle& p : particles_) guides_.hold(p, vector::Zero(), true);
}

}  // namespace

void relaxPacking(List<packedParticle>& particles, const packingGuides& guides,
                  const List<label>& target, const relaxationSettings& settings)
{
    relaxation(particles, guides, target, settings).run();
}

placedParticles finishPacking(const List<packedParticle>& particles, const zoneGeometry& geometry,
                              const exterior& outside, scalar support)
{
    placedParticles placed;
    for (const packedParticle& p : particles)
    {
        if (p.where == place::filler) continue;
        if (p.where == place::rigid)
        {
            placed.rigid.push_back(p.x), placed.rigidPatch.push_back(p.owner);
            continue;
        }
        placed.x.push_back(p.x);
        placed.strip.push_back(p.where == place::strip ? p.owner : -1);
        placed.zone.push_back(p.where == place::zone ? p.owner : outside.zoneBefore(p.owner, p.x));
    }
    sortByPhase(placed, geometry.zones());
    dropUnseenRigid(placed, geometry, support);
    return placed;
}

placedParticles placeBodyFitted(const zoneGeometry& geometry, const exterior& outside,
                                scalar support)
{
    const packingGuides guides(geometry, outside);
    List<label> target;
    List<packedParticle> particles = seedPacking(guides, target);
    relaxationSettings settings;
    settings.support = support;
    relaxPacking(particles, guides, target, settings);
    evenSums(particles, guides, support);
    return finishPacking(particles, geometry, outside, support);
}

}  // namespace ispf
