// SPDX-License-Identifier: GPL-3.0-or-later
// Space near surfaces is cut into bands one particle thick.  A fine jittered lattice of samples measures
// the volume of each band, and so the number of its particles.  The samples, moved to the middle of the
// band, are the candidates for the particles.  Corners, edges and curvature need no special treatment: a
// sample belongs to the surface nearest to it.
#include "packing.H"

#include <cmath>
#include <map>
#include <tuple>

namespace ispf
{

namespace
{

using place = packedParticle::place;

// About 8 samples per particle, 16 in 2D
scalar samplesPerSpacing(int nDims)
{
    return nDims == 3 ? 2 : 4;
}

constexpr label bandsOfThick = 2;  // along each surface of a zone that is not thin
constexpr scalar thinBelow = 5.5;  // [dx]: a zone thinner than this consists of bands alone

struct sample
{
    packedParticle p;
    label band = -1;
    scalar width = 0;  // of the band
    bool thin = false;
};

// A number in [-0.5, 0.5) that depends only on the cell and the axis
scalar jitter(std::int64_t i, std::int64_t j, std::int64_t k, int axis)
{
    std::uint64_t h = std::uint64_t(i) * 0x9E3779B97F4A7C15ull ^
                      std::uint64_t(j) * 0xC2B2AE3D27D4EB4Full ^
                      std::uint64_t(k) * 0x165667B19E3779F9ull ^ std::uint64_t(axis + 1) << 56;
    h ^= h >> 31, h *= 0xBF58476D1CE4E5B9ull, h ^= h >> 29, h *= 0x94D049BB133111EBull,
        h ^= h >> 32;
    return scalar(h >> 11) / scalar(1ull << 53) - 0.5;
}

class sampler
{
public:
    explicit sampler(const packingGuides& guides)
        : guides_(guides), geometry_(guides.geometry()), dx_(geometry_.dx())
    {
    }

    // Finds the band of x, which lies in the given zone; false if x is in no band
    bool at(const vector& x, label zone, sample& s) const
    {
        if (geometry_.beyondSymmetry(x) >= 0) return false;
        return zone >= 0 ? inZone(x, zone, s) : outside(x, s);
    }

private:
    bool inZone(const vector& x, label zone, sample& s) const
    {
        const surfacePoint q = guides_.surface(zone).nearest(x, 0.5 * thinBelow * dx_);
        if (!q.found) return false;
        const vector inward =
            q.distance > 1e-3 * dx_ ? vector((x - q.point) / q.distance) : vector(-q.normal);
        const scalar t = guides_.zoneThickness(zone, q.point, inward, thinBelow * dx_);
        const bool thin = s.thin = std::isfinite(t);
        const scalar width = thin ? t / std::max<scalar>(1, std::round(t / dx_)) : dx_;
        s.width = width;
        s.band = label(q.distance / width);
        if (!thin && s.band >= bandsOfThick) return false;
        // layers of solids keep their depth, so that a wall has as many as fit; fluid particles are free
        const bool solid = geometry_.zones()[zone].phase == phaseType::solid;
        s.p.where = place::zone, s.p.owner = zone;
        s.p.depth = (s.band == 0 || thin) && solid ? (s.band + 0.5) * width : -1;
        s.p.x = q.point + (s.band + 0.5) * width * inward;
        if (s.p.bound()) s.p.normal = inward;
        return true;
    }

    bool outside(const vector& x, sample& s) const
    {
        const exteriorPoint q = guides_.outside().at(x);
        if (q.type == exteriorPoint::kind::nothing) return false;
        const bool rigid = q.type == exteriorPoint::kind::rigid;
        scalar width = dx_;
        if (rigid)
        {
            const scalar reach = 2 * guides_.outside().wallThickness();
            const scalar t = guides_.rigidThickness(q.foot, q.normal, reach);
            // rounded up to one layer more: a missing layer would be missing to the fluid on both sides
            if (std::isfinite(t)) width = t / std::max<scalar>(1, std::ceil(t / dx_ - 0.3));
        }
        s.width = width;
        s.band = label(q.depth / width);
        s.p.where = rigid                                  ? place::rigid
                    : q.type == exteriorPoint::kind::strip ? place::strip
                                                           : place::filler;
        s.p.owner = q.patch;
        s.p.depth = (s.band + 0.5) * width;
        s.p.x = q.foot + s.p.depth * q.normal;
        return true;
    }

    const packingGuides& guides_;
    const zoneGeometry& geometry_;
    scalar dx_;
};

using bandKey = std::tuple<place, label, label>;  // where, owner, band

using bandSamples = std::map<bandKey, List<sample>>;
using depthAndParticle = std::pair<scalar, packedParticle>;

class sweeper
{
public:
    sweeper(const packingGuides& guides, const sampler& bands)
        : guides_(guides), geometry_(guides.geometry()), sampler_(bands), dx_(geometry_.dx())
    {
        const boundBox box = guides.outside().bounds();
        for (int k = 0; k < 3; ++k)
        {
            low_[k] = std::int64_t(std::floor(box.min[k] / dx_)) - 1;
            n_[k] = std::int64_t(std::ceil(box.max[k] / dx_)) + 1 - low_[k];
        }
        if (geometry_.nDims() == 2) low_[2] = 0, n_[2] = 1;
        for (size_t z = 0; z < geometry_.zones().size(); ++z)
            surfaces_.push_back(&guides.surface(label(z)));
    }

    bandSamples all() const
    {
        const bool flat = n_[2] == 1;
        List<bandSamples> slices(flat ? n_[1] : n_[2]);
        parallelFor(
            label(slices.size()),
            [&](label begin, label end) {
                for (label k = begin; k < end; ++k)
                    for (std::int64_t j = flat ? k : 0; j < (flat ? k + 1 : n_[1]); ++j)
                        for (std::int64_t i = 0; i < n_[0]; ++i)
                            cell(low_[0] + i, low_[1] + j, flat ? 0 : low_[2] + k, slices[k]);
            },
            1);
        bandSamples total;
        for (bandSamples& slice : slices)
            for (auto& [key, list] : slice)
                total[key].insert(total[key].end(), list.begin(), list.end());
        return total;
    }

    // True if the particles beyond a surface (behind walls, in strips) end within a kernel's reach along it.  There nothing
    // holds them against the push from within: a wall would lose 3 % of its particles
    bool endsBeside(const packedParticle& p) const
    {
        const bool flat = geometry_.nDims() == 2;
        const vector a = flat ? vector(-p.normal[1], p.normal[0], 0) : p.normal.unitOrthogonal(),
                     b = p.normal.cross(a);
        for (int k = 0; k < 8; k += flat ? 4 : 1)
        {
            const vector along = std::cos(k * M_PI / 4) * a + std::sin(k * M_PI / 4) * b;
            if (isNothing(p.x + 1.25 * dx_ * along) || isNothing(p.x + 2.5 * dx_ * along))
                return true;
        }
        return false;
    }

private:
    bool isNothing(const vector& x) const
    {
        if (geometry_.beyondSymmetry(x) >= 0) return false;
        const bool something = isSwept(centreOf((x / dx_).array().floor())) &&
                               guides_.outside().at(x).type != exteriorPoint::kind::nothing;
        return !something && geometry_.zoneAt(x) < 0;
    }

    vector centreOf(const vector& cell) const
    {
        vector centre = dx_ * (cell + vector::Constant(0.5));
        if (geometry_.nDims() == 2) centre[2] = 0;
        return centre;
    }

    bool isSwept(const vector& centre) const
    {
        const scalar reach = std::max(guides_.outside().wallThickness(), 0.5 * thinBelow * dx_);
        return nearSurface(centre, reach + dx_);
    }

    bool nearSurface(const vector& x, scalar radius) const
    {
        for (const surfaceSearch* s : surfaces_)
            if (s->within(x, radius)) return true;
        return false;
    }

    // True if neither a face nor a sliver between faces is within the radius
    bool isWithinOneZone(const vector& x, scalar radius) const
    {
        return geometry_.beyondSymmetry(x) < -radius &&
               !nearSurface(x, radius + zoneGeometry::probe * dx_);
    }

    void cell(std::int64_t i, std::int64_t j, std::int64_t k, bandSamples& out) const
    {
        const vector centre = centreOf(vector(i, j, k));
        if (geometry_.beyondSymmetry(centre) < dx_ && isSwept(centre)) samplesOf(i, j, k, out);
    }

    void samplesOf(std::int64_t i, std::int64_t j, std::int64_t k, bandSamples& out) const
    {
        // fine cells are numbered through the whole space, so that the jitter is the same everywhere
        const scalar perSpacing = samplesPerSpacing(geometry_.nDims()), a = dx_ / perSpacing;
        std::int64_t first[3], last[3];
        const std::int64_t cell[3] = {i, j, k};
        for (int d = 0; d < 3; ++d)
        {
            first[d] = std::int64_t(std::ceil(cell[d] * perSpacing - 1e-9));
            last[d] = std::int64_t(std::ceil((cell[d] + 1) * perSpacing - 1e-9));
        }
        if (geometry_.nDims() == 2) first[2] = 0, last[2] = 1;
        const vector centre = centreOf(vector(i, j, k));
        vector reach = vector::Zero();
        for (int d = 0; d < geometry_.nDims(); ++d)
            reach[d] = std::max(centre[d] - first[d] * a, last[d] * a - centre[d]);
        const bool oneZone = isWithinOneZone(centre, reach.norm());
        const label zone = oneZone ? geometry_.zoneAt(centre) : -1;
        for (std::int64_t c = first[2]; c < last[2]; ++c)
            for (std::int64_t b = first[1]; b < last[1]; ++b)
                for (std::int64_t e = first[0]; e < last[0]; ++e)
                {
                    vector x(e + 0.5 + 0.9 * jitter(e, b, c, 0), b + 0.5 + 0.9 * jitter(e, b, c, 1),
                             c + 0.5 + 0.9 * jitter(e, b, c, 2));
                    x *= a;
                    if (geometry_.nDims() == 2) x[2] = 0;
                    sample s;
                    if (sampler_.at(x, oneZone ? zone : geometry_.zoneAt(x), s))
                        out[{s.p.where, s.p.owner, s.band}].push_back(s);
                }
    }

    const packingGuides& guides_;
    const zoneGeometry& geometry_;
    const sampler& sampler_;
    scalar dx_;
    std::int64_t low_[3], n_[3];
    List<const surfaceSearch*> surfaces_;
};

// Points of a lattice that is turned against all axes.  In an upright lattice each plane along a cylinder or a
// plate would have the same wrong number of points
class turnedLattice
{
public:
    turnedLattice(const packingGuides& guides) : guides_(guides), geometry_(guides.geometry())
    {
        const Eigen::AngleAxisd about(0.7, vector(0.36, 0.48, 0.8));
        turn_ = geometry_.nDims() == 3 ? tensor(about)
                                       : tensor(Eigen::AngleAxisd(0.4, vector::UnitZ()));
        half_ = label(std::ceil(0.5 * geometry_.bounds().diagonal() / geometry_.dx())) + 1;
    }

    // Points deeper in a zone than its bands, and a reserve up to half a band less deep
    List<depthAndParticle> points(const sampler& bands) const
    {
        const bool flat = geometry_.nDims() == 2;
        const label n = 2 * half_ + 1;
        List<List<depthAndParticle>> rows(n);
        parallelFor(
            n,
            [&](label begin, label end) {
                for (label j = begin; j < end; ++j)
                    for (label k = 0; k < (flat ? 1 : n); ++k)
                        for (label i = 0; i < n; ++i)
                            add(vector(i - half_, j - half_, flat ? 0 : k - half_), bands, rows[j]);
            },
            1);
        List<depthAndParticle> all;
        for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
        return all;
    }

private:
    void add(const vector& index, const sampler& bands, List<depthAndParticle>& row) const
    {
        const scalar dx = geometry_.dx();
        const boundBox box = geometry_.bounds();
        packedParticle p;
        p.x = box.centre() + dx * (turn_ * index);
        if (box.distSqr(p.x) > 0 || geometry_.beyondSymmetry(p.x) >= 0) return;
        p.owner = geometry_.zoneAt(p.x);
        if (p.owner < 0) return;
        const surfacePoint q = guides_.surface(p.owner).nearest(p.x, 2 * bandsOfThick * dx);
        if (q.found && q.distance < (bandsOfThick - 0.5) * dx) return;
        sample s;
        if (bands.at(p.x, p.owner, s) && s.thin) return;
        row.push_back({q.found ? q.distance : 1e300, p});
    }

    const packingGuides& guides_;
    const zoneGeometry& geometry_;
    tensor turn_;
    label half_;
};

// Interleaves the bits of three indices: cells that are near in space get keys that are near
std::uint64_t zOrder(const vector& cell)
{
    constexpr int bits = 21;
    std::uint64_t key = 0;
    for (int b = 0; b < bits; ++b)
        for (int d = 0; d < 3; ++d) key |= (std::uint64_t(cell[d]) >> b & 1) << (3 * b + d);
    return key;
}

void sortInSpace(List<packedParticle>& particles, const vector& low, scalar dx)
{
    List<std::pair<std::uint64_t, label>> order;
    for (size_t i = 0; i < particles.size(); ++i)
        order.push_back({zOrder((particles[i].x - low) / dx), label(i)});
    std::sort(order.begin(), order.end());
    List<packedParticle> sorted;
    for (const auto& [key, i] : order) sorted.push_back(particles[i]);
    particles = std::move(sorted);
}

}  // namespace

List<packedParticle> seedPacking(const packingGuides& guides, List<label>& target)
{
    const zoneGeometry& geometry = guides.geometry();
    const scalar dx = geometry.dx(), cell = std::pow(dx, geometry.nDims());
    const int nDims = geometry.nDims();
    const scalar share = std::pow(samplesPerSpacing(nDims), -nDims);  // of a particle, per sample
    const sampler bands(guides);

    List<packedParticle> seeds;
    List<label> inBands(geometry.zones().size(), 0);
    const sweeper sweep(guides, bands);
    for (const auto& [key, samples] : sweep.all())
    {
        // a band of other width has its share of the volume with other distances along it
        List<vector> x, normals;
        List<scalar> spacing;
        for (const sample& s : samples)
        {
            x.push_back(s.p.x);
            normals.push_back(s.p.normal);
            spacing.push_back(dx * std::pow(dx / s.width, 1.0 / (geometry.nDims() - 1)));
        }
        const label keep = label(std::lround(share * scalar(samples.size())));
        if (std::get<0>(key) == place::zone) inBands[std::get<1>(key)] += keep;
        for (const label i : spreadEvenly(x, normals, spacing, geometry.symmetryPlanes(), keep))
            seeds.push_back(samples[i].p);
    }
    List<List<depthAndParticle>> interior(geometry.zones().size());
    for (const auto& entry : turnedLattice(guides).points(bands))
        interior[entry.second.owner].push_back(entry);
    target.clear();
    for (size_t z = 0; z < geometry.zones().size(); ++z)
    {
        target.push_back(label(std::lround(geometry.volume(label(z)) / cell)));
        auto& list = interior[z];
        std::stable_sort(list.begin(), list.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        const label wanted = std::max<label>(0, target[z] - inBands[z]);
        for (label k = 0; k < std::min(wanted, label(list.size())); ++k)
            seeds.push_back(list[k].second);
    }
    for (packedParticle& p : seeds)
    {
        if (p.where == place::strip) p.guard = guides.wallBeside(p.x, p.owner);
        guides.hold(p, vector::Zero(), true);
        p.seed = p.x;
        p.fixed = p.where != place::zone && sweep.endsBeside(p);
    }
    sortInSpace(seeds, guides.outside().bounds().min, dx);
    return seeds;
}

}  // namespace ispf
