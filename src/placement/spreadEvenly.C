// SPDX-License-Identifier: GPL-3.0-or-later
#include "packing.H"

#include "cellList.H"
#include <cmath>
#include <map>
#include <memory>
#include <queue>

namespace ispf
{

namespace
{

constexpr scalar triangular = 1.075;  // next neighbours of a triangular pattern, in spacings

// Samples with their images, which are dropped together
class crowd
{
public:
    crowd(const List<vector>& samples, const List<scalar>& spacing, const List<halfSpace>& planes)
        : x_(samples),
          spacing_(spacing),
          reach_(triangular * largest(spacing)),
          copies_(samples.size())
    {
        for (size_t i = 0; i < samples.size(); ++i) source_.push_back(label(i));
        for (const halfSpace& plane : planes)
            for (size_t i = 0, n = x_.size(); i < n; ++i)
                if (plane.distance(x_[i]) > -reach_)
                {
                    x_.push_back(plane.mirror(x_[i]));
                    source_.push_back(source_[i]);
                }
        for (size_t k = 0; k < x_.size(); ++k) copies_[source_[k]].push_back(label(k));
        cells_ = std::make_unique<cellList>(x_, reach_);
    }

    label size() const { return label(copies_.size()); }

    // Crowding by the sample's own images, which cannot be dropped without it
    scalar selfCrowding(label i) const
    {
        scalar sum = 0;
        for (const label copy : copies_[i])
        {
            const scalar d2 = (x_[copy] - x_[i]).squaredNorm(), reach = triangular * spacing_[i];
            if (copy != i && d2 < reach * reach) sum += weight(d2, reach);
        }
        return sum;
    }

    // Calls visit(j, weight) for all samples that crowd sample i or are crowded by it
    template <class Visit>
    void around(label i, Visit&& visit) const
    {
        for (const label copy : copies_[i])
            cells_->near(x_[copy], reach_, [&](label k, scalar d2) {
                const label j = source_[k];
                const scalar reach = 0.5 * triangular * (spacing_[i] + spacing_[j]);
                if (j != i && k < size() && d2 < reach * reach) visit(j, weight(d2, reach));
            });
    }

private:
    static scalar largest(const List<scalar>& values)
    {
        return values.empty() ? 1 : *std::max_element(values.begin(), values.end());
    }
    // Weight that falls to zero at the distance of a perfect triangular pattern
    static scalar weight(scalar distSqr, scalar reach)
    {
        const scalar q = 1 - std::sqrt(distSqr) / reach, q2 = q * q, q4 = q2 * q2;
        return q4 * q4;
    }

    List<vector> x_;
    const List<scalar>& spacing_;
    scalar reach_;
    List<label> source_;
    List<List<label>> copies_;
    std::unique_ptr<cellList> cells_;
};

// The number of samples that each cube of a few spacings may still lose, separately for the two sides of a wall.
// Crowding is local: without quotas, rims and chance would make one region denser than another by some percent.
class quotas
{
public:
    quotas(const List<vector>& samples, const List<vector>& normals, const List<scalar>& spacing,
           label keep)
    {
        // the side is the first part of the key, so that a rounding rest stays on its side
        std::map<std::array<std::int64_t, 6>, List<label>> cubes;
        for (size_t i = 0; i < samples.size(); ++i)
        {
            std::array<std::int64_t, 6> c;
            for (int d = 0; d < 3; ++d)
            {
                c[d] = std::lround(normals[i][d]);
                c[3 + d] = std::int64_t(std::floor(samples[i][d] / (cubeSize * spacing[0])));
            }
            cubes[c].push_back(label(i));
        }
        cube_.resize(samples.size());
        scalar due = 0;
        label given = 0;
        for (const auto& [c, members] : cubes)  // rounded so that the sum is exact
        {
            due += scalar(keep) * scalar(members.size()) / scalar(samples.size());
            const label share = label(std::lround(due)) - given;
            given += share;
            for (const label i : members) cube_[i] = label(spare_.size());
            spare_.push_back(label(members.size()) - share);
        }
    }
    bool spend(label i) { return spare_[cube_[i]] > 0 && spare_[cube_[i]]-- > 0; }

private:
    static constexpr scalar cubeSize = 4;
    List<label> cube_, spare_;
};

struct candidate
{
    scalar weight;
    label index;
    bool operator<(const candidate& o) const
    {
        return weight < o.weight || (weight == o.weight && index < o.index);
    }
};

}  // namespace

List<label> spreadEvenly(const List<vector>& samples, const List<vector>& normals,
                         const List<scalar>& spacing, const List<halfSpace>& planes, label keep)
{
    const crowd all(samples, spacing, planes);
    const label n = all.size();
    List<scalar> weight(n, 0);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i) all.around(i, [&](label, scalar w) { weight[i] += w; });
    });
    quotas allowed(samples, normals, spacing, keep);
    std::priority_queue<candidate> crowded;
    for (label i = 0; i < n; ++i) crowded.push({weight[i], i});
    List<char> gone(n, 0);
    for (label left = n; left > keep;)
    {
        const candidate c = crowded.top();
        crowded.pop();
        if (gone[c.index]) continue;
        if (c.weight > weight[c.index])  // it has become less crowded since it was queued
        {
            crowded.push({weight[c.index], c.index});
            continue;
        }
        if (!allowed.spend(c.index)) continue;  // its cube has lost enough
        gone[c.index] = 1, --left;
        all.around(c.index, [&](label j, scalar w) { weight[j] -= gone[j] ? 0 : w; });
    }
    List<label> kept;
    for (label i = 0; i < n; ++i)
        if (!gone[i]) kept.push_back(i);
    return kept;
}

}  // namespace ispf
