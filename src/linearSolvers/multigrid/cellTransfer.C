// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellTransfer.H"

#include <algorithm>

namespace ispf
{

namespace
{

ISPF_HOT void restrictRows(label c, label end, const label* start, const std::int32_t* fine,
                           const float* weight, const float* r, float* coarse)
{
    for (; c < end; ++c)
    {
        float sum = {}, odd = {};
        label k = start[c];
        for (; k + 2 <= start[c + 1]; k += 2)
        {
            sum += weight[k] * r[fine[k]];
            odd += weight[k + 1] * r[fine[k + 1]];
        }
        if (k < start[c + 1]) sum += weight[k] * r[fine[k]];
        coarse[c] = sum + odd;
    }
}

ISPF_HOT void prolongRows(label i, label end, const std::int32_t* c, const float* w,
                          const float* coarse, float* x)
{
    for (; i < end; ++i, c += 8, w += 8)
    {
        float sum = {};
        for (int q = 0; q < 8; ++q) sum += w[q] * coarse[c[q]];
        x[i] += sum;
    }
}

// The aggregates from which the rows of one aggregate may interpolate; the aggregate itself is first
struct candidates
{
    List<std::int32_t> aggregate;
    List<float> x, y, z, weight;

    void clear() { aggregate.clear(), x.clear(), y.clear(), z.clear(); }
    void add(label a, float4 point)
    {
        aggregate.push_back(a);
        x.push_back(point[0]), y.push_back(point[1]), z.push_back(point[2]);
    }
};

// Trilinear weights of the candidates at one point
ISPF_HOT void hatWeights(label n, const float* x, const float* y, const float* z, float4 at,
                         float inverse, float* weight)
{
    for (label c = 0; c < n; ++c)
        weight[c] = std::max(0.f, 1 - std::abs(at[0] - x[c]) * inverse) *
                    std::max(0.f, 1 - std::abs(at[1] - y[c]) * inverse) *
                    std::max(0.f, 1 - std::abs(at[2] - z[c]) * inverse);
}

// Keeps the 8 largest weights and makes their sum 1 (only cells with several aggregates have more than 8)
void select(const candidates& from, std::int32_t* column, float* weight)
{
    column[0] = from.aggregate[0], weight[0] = from.weight[0];
    int n = 1;
    for (size_t c = 1; c < from.aggregate.size(); ++c)
    {
        if (!(from.weight[c] > 0)) continue;
        const int at = n < 8 ? n++ : int(std::min_element(weight + 1, weight + 8) - weight);
        if (at == n - 1 || from.weight[c] > weight[at])
            column[at] = from.aggregate[c], weight[at] = from.weight[c];
    }
    float sum = 0;
    for (int q = 0; q < n; ++q) sum += weight[q];
    for (int q = 0; q < n; ++q) weight[q] /= sum;
    for (int q = n; q < 8; ++q) column[q] = column[0], weight[q] = 0;
}

}  // namespace

void cellTransfer::assign(const multigridLevel& fine, const cellAggregates& aggregates,
                          const multigridLevel& coarse, float cellSize)
{
    nFine_ = fine.size(), nCoarse_ = aggregates.n;
    coarse_.resize(most * size_t(nFine_)), weight_.resize(coarse_.size());
    for (label i = 0; i < nFine_; ++i)
        if (aggregates.of[i] < 0)
            for (size_t q = most * size_t(i); q < most * size_t(i + 1); ++q)
                coarse_[q] = 0, weight_[q] = 0;
    parallelFor(
        aggregates.n,
        [&](label begin, label end) {
            candidates from;
            for (label a = begin; a < end; ++a)
            {
                from.clear();
                from.add(a, coarse.point[a]);
                coarse.A.forRow(a, [&](label b, float) {
                    if (coarse.follows(a, b)) from.add(b, coarse.point[b]);
                });
                const label n = label(from.aggregate.size());
                from.weight.resize(n);
                for (label m = aggregates.start[a]; m < aggregates.start[a + 1]; ++m)
                {
                    const label i = aggregates.member[m];
                    hatWeights(n, from.x.data(), from.y.data(), from.z.data(), fine.point[i],
                               1 / cellSize, from.weight.data());
                    select(from, &coarse_[most * size_t(i)], &weight_[most * size_t(i)]);
                }
            }
        },
        levelGrain / 8);
    transpose();
}

void cellTransfer::transpose()
{
    start_.assign(nCoarse_ + 1, 0);
    for (size_t k = 0; k < coarse_.size(); ++k)
        if (weight_[k] > 0) ++start_[coarse_[k] + 1];
    for (label c = 0; c < nCoarse_; ++c) start_[c + 1] += start_[c];
    fine_.resize(start_[nCoarse_]);
    fineWeight_.resize(fine_.size());
    List<label> next(start_.begin(), start_.end() - 1);
    for (size_t k = 0; k < coarse_.size(); ++k)
        if (weight_[k] > 0)
        {
            const label at = next[coarse_[k]]++;
            fine_[at] = label(k / most);
            fineWeight_[at] = weight_[k];
        }
}

void cellTransfer::restrictTo(const List<float>& fine, List<float>& coarse) const
{
    parallelFor(
        nCoarse_,
        [&](label c, label e) {
            restrictRows(c, e, start_.data(), fine_.data(), fineWeight_.data(), fine.data(),
                         coarse.data());
        },
        levelGrain / 8);
}

void cellTransfer::prolongAdd(const List<float>& coarse, List<float>& fine) const
{
    parallelFor(
        nFine_,
        [&](label i, label e) {
            prolongRows(i, e, &coarse_[most * size_t(i)], &weight_[most * size_t(i)], coarse.data(),
                        fine.data());
        },
        levelGrain);
}

}  // namespace ispf
