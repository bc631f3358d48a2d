// SPDX-License-Identifier: GPL-3.0-or-later
#include "fieldSampler.H"

#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

constexpr scalar none = std::numeric_limits<scalar>::quiet_NaN();

// True if the particles lie all around the point: their weighted mean is near it, and weights are hardly negative
bool interpolates(const List<pointSampler::contribution>& weights, const List<vector>& positions,
                  const vector& point, scalar dx)
{
    scalar size = 0;
    vector mean = vector::Zero();
    for (const auto& c : weights)
        size += std::abs(c.weight), mean += c.weight * positions[size_t(c.index)];
    return size < 1.2 && (mean - point).norm() < 0.1 * dx;
}

}  // namespace

fieldSampler::fieldSampler(const dictionary& dict, const fsiCase& c, frame f)
    : case_(c),
      frame_(f),
      chosen_(c.cloud, dict, f == frame::rest ? "solid" : "fluid"),
      radius_(c.cloud.dx * dict.getInRangeOrDefault("radius", 1.2, 10, 2)),
      images_(c.walls->images())
{
    if (f == frame::present) return;
    for (label i = c.cloud.nSolid(); i < c.cloud.n(); ++i)
        if (chosen_(c.cloud, i))
            dict.fail(dict.found("zones") ? "zones" : "phase",
                      "Zone '" + c.cloud.zones[c.cloud.zone[i]].name +
                          "' is fluid, which knows no place at rest: name solids alone.");
}

const List<vec4>& fieldSampler::places() const
{
    return frame_ == frame::rest ? case_.cloud.vectors.at("x0") : case_.cloud.x;
}

// Collects the chosen particles and images in the box
void fieldSampler::gather(const vector& low, const vector& high, List<vector>& positions)
{
    const auto inside = [&](const vector& x) {
        return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
    };
    sources_.clear();
    for (label i = 0; i < case_.cloud.n(); ++i)
    {
        if (!chosen_(case_.cloud, i)) continue;
        const vector x = places()[i].xyz();
        if (inside(x)) positions.push_back(x), sources_.push_back({i, nullptr});
        for (const structureImage& map : images_)
            if (const vector y = map(x); inside(y))
                positions.push_back(y), sources_.push_back({i, &map});
    }
}

void fieldSampler::update(const List<vector>& points)
{
    weights_.assign(points.size(), {});
    if (points.empty()) return;
    vector low = points[0], high = points[0];
    for (const vector& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    List<vector> positions;
    gather(low.array() - radius_, high.array() + radius_, positions);
    const pointSampler sampler(positions, radius_);
    parallelFor(
        label(points.size()),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                const pointSampler::neighbour nearest = sampler.nearest(points[k]);
                if (nearest.index < 0 || nearest.distance > 1.5 * case_.cloud.dx) continue;
                List<pointSampler::contribution> w = sampler.weights(points[k]);
                if (nearest.distance <= case_.cloud.dx ||
                    interpolates(w, positions, points[k], case_.cloud.dx))
                    weights_[k] = std::move(w);
            }
        },
        64);
}

vector fieldSampler::nearest(const vector& point) const
{
    vector found = vector::Constant(std::numeric_limits<scalar>::infinity());
    for (label i = 0; i < case_.cloud.n(); ++i)
        if (const vector x = places()[i].xyz();
            chosen_(case_.cloud, i) && (x - point).norm() < (found - point).norm())
            found = x;
    return found;
}

scalar fieldSampler::sample(const particleField& f, size_t point) const
{
    if (weights_[point].empty()) return none;
    scalar sum = 0;
    for (const auto& c : weights_[point])
    {
        const source& s = sources_[c.index];
        sum += c.weight * f.at(s.particle);
        if (s.map && f.name() == "p") sum += c.weight * case_.walls->pressureOffset(*s.map);
    }
    return sum;
}

vector fieldSampler::sampleVector(const particleField& f, size_t point) const
{
    if (weights_[point].empty()) return vector::Constant(none);
    vector sum = vector::Zero();
    for (const auto& c : weights_[point])
    {
        const source& s = sources_[c.index];
        sum += c.weight * (s.map ? f.vectorAt(s.particle, s.map->R) : f.vectorAt(s.particle));
    }
    return sum;
}

List<scalar> fieldSampler::components(const particleField& f, size_t point) const
{
    if (!f.isVector()) return {sample(f, point)};
    const vector v = sampleVector(f, point);
    return {v[0], v[1], v[2]};
}

}  // namespace ispf
