// SPDX-License-Identifier: GPL-3.0-or-later
#include "footSums.H"

#include "execution.H"

#include <cmath>

namespace ispf
{

namespace
{

constexpr label lanes = 8;  // number of partial sums that run side by side

struct lanesOfSums
{
    scalar of[2][lanes] = {};
    scalar total(int k) const
    {
        scalar sum = 0;
        for (const scalar s : of[k]) sum += s;
        return sum;
    }
};

ISPF_INLINE scalar weight(scalar distSqr, scalar perSquare)
{
    const scalar a = 1 - distSqr * perSquare, w = a > 0 ? a : 0;
    return w * w;
}

// Adds the weights of n feet.  perSquare: inverse squares of the radii
ISPF_HOT void addRun(const scalar* x, const scalar* y, const scalar* z, label n, const scalar* at,
                     const scalar* perSquare, lanesOfSums& sums)
{
    const scalar first = perSquare[0], second = perSquare[1];
    const auto add = [&](label k, label lane) {
        const scalar a = x[k] - at[0], b = y[k] - at[1], c = z[k] - at[2];
        const scalar distSqr = a * a + b * b + c * c;
        sums.of[0][lane] += weight(distSqr, first), sums.of[1][lane] += weight(distSqr, second);
    };
    label k = 0;
    for (; k + lanes <= n; k += lanes)
        for (label lane = 0; lane < lanes; ++lane) add(k + lane, lane);
    for (; k < n; ++k) add(k, 0);
}

}  // namespace

footSums::footSums(const List<vector>& feet, scalar mostRadius)
    : radius_(mostRadius), width_(0.25 * mostRadius)
{
    vector high = low_;
    if (!feet.empty()) low_ = high = feet[0];
    for (const vector& x : feet) low_ = low_.cwiseMin(x), high = high.cwiseMax(x);
    for (int d = 0; d < 3; ++d) n_[d] = label((high[d] - low_[d]) / width_) + 1;
    List<size_t> cell;
    start_.assign(size_t(n_[0]) * n_[1] * n_[2] + 1, 0);
    for (const vector& x : feet)
    {
        label c[3];
        for (int d = 0; d < 3; ++d) c[d] = label((x[d] - low_[d]) / width_);
        cell.push_back((size_t(c[2]) * n_[1] + c[1]) * n_[0] + c[0]);
        ++start_[cell.back() + 1];
    }
    for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    for (List<scalar>& s : sorted_) s.resize(feet.size());
    List<label> next(start_.begin(), start_.end() - 1);
    for (size_t i = 0; i < feet.size(); ++i)
    {
        const label k = next[cell[i]]++;
        for (int d = 0; d < 3; ++d) sorted_[d][k] = feet[i][d];
    }
}

std::array<scalar, 2> footSums::at(const vector& x, const std::array<scalar, 2>& radii) const
{
    const auto cellsWithin = [&](int d, scalar reach) {
        return std::pair(std::max(label(0), label(std::floor((x[d] - reach - low_[d]) / width_))),
                         std::min(n_[d] - 1, label(std::floor((x[d] + reach - low_[d]) / width_))));
    };
    // distance from x to cell c along axis d
    const auto gap = [&](int d, label c) {
        const scalar low = low_[d] + scalar(c) * width_;
        return std::max({low - x[d], x[d] - (low + width_), 0.0});
    };
    const scalar perSquare[2] = {1 / (radii[0] * radii[0]), 1 / (radii[1] * radii[1])};
    lanesOfSums sums;
    const auto [c0, c1] = cellsWithin(2, radius_);
    for (label c = c0; c <= c1; ++c)
    {
        const scalar inPlane = std::sqrt(std::max(0.0, radius_ * radius_ - gap(2, c) * gap(2, c)));
        const auto [b0, b1] = cellsWithin(1, inPlane);
        for (label b = b0; b <= b1; ++b)
        {
            const auto [a0, a1] =
                cellsWithin(0, std::sqrt(std::max(0.0, inPlane * inPlane - gap(1, b) * gap(1, b))));
            if (a0 > a1) continue;
            const size_t row = (size_t(c) * n_[1] + b) * n_[0];
            const label first = start_[row + a0], last = start_[row + a1 + 1];
            addRun(sorted_[0].data() + first, sorted_[1].data() + first, sorted_[2].data() + first,
                   last - first, x.data(), perSquare, sums);
        }
    }
    return {sums.total(0), sums.total(1)};
}

}  // namespace ispf
