// SPDX-License-Identifier: GPL-3.0-or-later
#include "packing.H"

#include "cellList.H"
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

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
    List<scalar> spacing_;
    scalar reach_;
    List<label> source_;
    List<List<label>> copies_;
    std::unique_ptr<cellList> cells_;
};

// A cube of a few spacings on one side of a wall, and the number of samples that it still drops.
// Crowding is local: without these numbers, rims and chance would make one region denser than another by some percent.
struct stretch
{
    label begin, end;  // samples that are left: a range of an order
    label spare = 0;   // samples to drop
};

constexpr scalar cubeSize = 4;  // in spacings
constexpr label turns = 16;     // in each turn all stretches drop a part

List<stretch> stretchesOf(const List<vector>& samples, const List<vector>& normals,
                          const List<scalar>& spacing, label keep, List<label>& order)
{
    // the side is the first part of the key, so that a rounding rest stays on its side
    std::map<std::array<std::int64_t, 6>, List<label>> cubes;
    auto at = cubes.end();  // the next sample is mostly in the same cube
    for (size_t i = 0; i < samples.size(); ++i)
    {
        std::array<std::int64_t, 6> c;
        for (int d = 0; d < 3; ++d)
        {
            c[d] = std::lround(normals[i][d]);
            c[3 + d] = std::int64_t(std::floor(samples[i][d] / (cubeSize * spacing[0])));
        }
        if (at == cubes.end() || at->first != c) at = cubes.try_emplace(c).first;
        at->second.push_back(label(i));
    }
    List<stretch> all;
    scalar due = 0;
    label given = 0;
    for (const auto& [c, members] : cubes)  // rounded so that the sum is exact
    {
        due += scalar(keep) * scalar(members.size()) / scalar(samples.size());
        const label share = label(std::lround(due)) - given, n = label(members.size());
        given += share;
        all.push_back({label(order.size()), label(order.size()) + n, n - share});
        order.insert(order.end(), members.begin(), members.end());
    }
    return all;
}

template <class T>
List<T> inOrder(const List<T>& values, const List<label>& order)
{
    List<T> sorted;
    for (const label i : order) sorted.push_back(values[i]);
    return sorted;
}

}  // namespace

List<label> spreadEvenly(const List<vector>& samples, const List<vector>& normals,
                         const List<scalar>& spacing, const List<halfSpace>& planes, label keep)
{
    List<label> order;
    List<stretch> stretches = stretchesOf(samples, normals, spacing, keep, order);
    const crowd all(inOrder(samples, order), inOrder(spacing, order), planes);
    const label n = all.size();
    List<scalar> weight(n, 0);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i) all.around(i, [&](label, scalar w) { weight[i] += w; });
    });
    List<label> left(n);
    std::iota(left.begin(), left.end(), 0);
    List<char> gone(n, 0);
    const auto dropOneOf = [&](stretch& s) {
        const auto most = std::max_element(left.begin() + s.begin, left.begin() + s.end,
                                           [&](label a, label b) { return weight[a] < weight[b]; });
        const label i = *most;
        gone[i] = 1, --s.spare;
        *most = left[--s.end];
        all.around(i, [&](label j, scalar w) { weight[j] -= w; });
    };
    for (label turn = turns; turn > 0; --turn)
        for (stretch& s : stretches)
            for (label k = (s.spare + turn - 1) / turn; k > 0; --k) dropOneOf(s);
    List<label> kept;
    for (label i = 0; i < n; ++i)
        if (!gone[i]) kept.push_back(order[i]);
    std::sort(kept.begin(), kept.end());
    return kept;
}

}  // namespace ispf
