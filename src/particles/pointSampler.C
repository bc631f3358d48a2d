// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointSampler.H"
#include "messages.H"

#include <algorithm>

namespace ispf
{

namespace
{

// Wendland C2 without its constant, q = r/radius
scalar weightOf(scalar q)
{
    const scalar a = 1 - q;
    return a * a * a * a * (4 * q + 1);
}

// Inverse of the neighbours' spread, zero in directions that they do not span
tensor pseudoInverse(const tensor& spread, scalar least)
{
    const Eigen::SelfAdjointEigenSolver<tensor> eigen(spread);
    tensor inverse = tensor::Zero();
    for (int k = 0; k < 3; ++k)
    {
        const vector e = eigen.eigenvectors().col(k);
        if (eigen.eigenvalues()[k] > least) inverse += e * e.transpose() / eigen.eigenvalues()[k];
    }
    return inverse;
}

}  // namespace

pointSampler::pointSampler(const List<vector>& positions, scalar radius)
    : x_(positions), radius_(radius)
{
    if (!(radius > 0)) throw fatalError("Sampling of particles: the radius must be positive");
    if (x_.empty()) return;
    vector high = low_ = x_[0];
    for (const vector& p : x_) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
    scalar nCells = 1;
    for (int d = 0; d < 3; ++d) nCells *= std::floor((high[d] - low_[d]) / radius_) + 1;
    if (!(nCells < 1e9))
        throw fatalError("Sampling of particles: they spread too far for a radius of " +
                         std::to_string(radius_) + " m; some have flown away");
    for (int d = 0; d < 3; ++d) n_[size_t(d)] = label((high[d] - low_[d]) / radius_) + 1;

    start_.assign(size_t(nCells) + 1, 0);
    List<label> cell(x_.size());
    for (size_t i = 0; i < x_.size(); ++i)
    {
        const auto c = cellOf(x_[i]);
        cell[i] = (c[2] * n_[1] + c[1]) * n_[0] + c[0];
        ++start_[size_t(cell[i]) + 1];
    }
    for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    point_.resize(x_.size());
    List<label> next(start_.begin(), start_.end() - 1);
    for (size_t i = 0; i < x_.size(); ++i) point_[size_t(next[size_t(cell[i])]++)] = label(i);
}

std::array<label, 3> pointSampler::cellOf(const vector& point) const
{
    std::array<label, 3> c;
    for (int d = 0; d < 3; ++d)
    {
        // the bounds allow one cell outside, whose neighbours may still be inside
        const scalar k = std::floor((point[d] - low_[d]) / radius_);
        c[size_t(d)] = label(std::clamp(k, scalar(-2), scalar(n_[size_t(d)]) + 1));
    }
    return c;
}

template <class Visit>
void pointSampler::forNear(const vector& point, const Visit& visit) const
{
    if (x_.empty()) return;
    const auto c = cellOf(point);
    const label first = std::max(0, c[0] - 1), last = std::min(n_[0] - 1, c[0] + 1);
    if (first > last) return;
    for (label k = std::max(0, c[2] - 1); k <= std::min(n_[2] - 1, c[2] + 1); ++k)
        for (label j = std::max(0, c[1] - 1); j <= std::min(n_[1] - 1, c[1] + 1); ++j)
        {
            const size_t row = size_t(k * n_[1] + j) * size_t(n_[0]);
            for (label s = start_[row + size_t(first)]; s < start_[row + size_t(last) + 1]; ++s)
            {
                const label i = point_[size_t(s)];
                const scalar r = (x_[size_t(i)] - point).norm();
                if (r < radius_) visit(i, r);
            }
        }
}

List<pointSampler::contribution> pointSampler::weights(const vector& point) const
{
    List<contribution> result;
    List<vector> offsets;
    forNear(point, [&](label i, scalar r) {
        result.push_back({i, weightOf(r / radius_)});
        offsets.push_back((x_[size_t(i)] - point) / radius_);
    });
    makeLinear(offsets, result);
    return result;
}

void pointSampler::makeLinear(const List<vector>& offsets, List<contribution>& weights)
{
    scalar total = 0;
    vector mean = vector::Zero();
    for (size_t k = 0; k < weights.size(); ++k)
        total += weights[k].weight, mean += weights[k].weight * offsets[k];
    mean /= total;
    tensor spread = tensor::Zero();
    for (size_t k = 0; k < weights.size(); ++k)
    {
        const vector d = offsets[k] - mean;
        spread += weights[k].weight / total * d * d.transpose();
    }
    // value of the regression line at the point: mean value - slope . mean offset
    const vector lever = pseudoInverse(spread, 1e-3) * mean;
    for (size_t k = 0; k < weights.size(); ++k)
        weights[k].weight *= (1 - lever.dot(offsets[k] - mean)) / total;
}

pointSampler::neighbour pointSampler::nearest(const vector& point) const
{
    neighbour best;
    forNear(point, [&](label i, scalar r) {
        if (best.index < 0 || r < best.distance) best = {i, r};
    });
    return best;
}

}  // namespace ispf
