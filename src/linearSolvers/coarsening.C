// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarsening.H"

#include "blockSums.H"
#include <algorithm>

namespace ispf
{

namespace
{

constexpr label blockRows = 2048;  // aggregates per piece: that of blockSums

float squaredLength(float4 d)
{
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// A piece of the coarse matrix, unscaled
struct piece
{
    List<label> length;  // entries of each row
    List<std::int32_t> column;
    List<float> value;
};

// Sums the entries of the rows of one aggregate after another
class rowAccumulator
{
public:
    rowAccumulator(const multigridLevel& fine, const cellAggregates& aggregates,
                   const multigridLevel& coarse, float cellSize)
        : fine_(fine), agg_(aggregates), coarse_(coarse), far_(4 * cellSize * cellSize)
    {
    }

    void add(label aggregate, piece& to, scalar* moments)
    {
        const size_t rowBegin = to.column.size();
        for (label m = agg_.start[aggregate]; m < agg_.start[aggregate + 1]; ++m)
        {
            addRow(agg_.member[m], aggregate, rowBegin, to);
            if (m % 8 == 0) addMoments(agg_.member[m], aggregate, moments);
        }
        to.length.push_back(label(to.column.size() - rowBegin));
    }

private:
    void addRow(label i, label own, size_t rowBegin, piece& to)
    {
        // slot_[J] is right only if the entry it points to is of this row and names J
        static thread_local List<label> slot;
        if (label(slot.size()) < agg_.n) slot.resize(agg_.n);
        for (label k = fine_.rowStart[i]; k < fine_.rowStart[i + 1]; ++k)
        {
            const label J = agg_.of[fine_.column[k]];
            if (J == own || J < 0) continue;
            size_t s = slot[J];
            if (s < rowBegin || s >= to.column.size() || to.column[s] != J)
            {
                s = slot[J] = label(to.column.size());
                to.column.push_back(J), to.value.push_back(0);
            }
            to.value[s] += fine_.value[k];
        }
    }

    // Second moments of the couplings on both levels, for the factor s
    void addMoments(label i, label own, scalar* moments)
    {
        for (label k = fine_.rowStart[i]; k < fine_.rowStart[i + 1]; ++k)
        {
            const label j = fine_.column[k], J = agg_.of[j];
            const float r2 = squaredLength(fine_.point[i] - fine_.point[j]);
            if (J < 0 || r2 > far_) continue;  // far: a coupling around a periodic box
            moments[0] += fine_.value[k] * r2;
            moments[1] += fine_.value[k] * squaredLength(coarse_.point[own] - coarse_.point[J]);
        }
    }

    const multigridLevel& fine_;
    const cellAggregates& agg_;
    const multigridLevel& coarse_;
    const float far_;
};

void placeAggregates(const multigridLevel& fine, const cellAggregates& aggregates, float cellSize,
                     multigridLevel& coarse)
{
    const label n = aggregates.n;
    coarse.point.resize(n), coarse.group.resize(n);
    coarse.excess.assign(n, 0), coarse.weight.assign(n, 0), coarse.nRows.assign(n, 0),
        coarse.diagonal.assign(n, 0);
    for (label a = 0; a < n; ++a)
    {
        const label first = aggregates.member[aggregates.start[a]];
        coarse.group[a] = fine.group[first];
        for (int d = 0; d < 3; ++d)
            coarse.point[a][d] = (std::floor(fine.point[first][d] / cellSize) + 0.5f) * cellSize;
        for (label m = aggregates.start[a]; m < aggregates.start[a + 1]; ++m)
        {
            coarse.excess[a] += fine.excess[aggregates.member[m]];
            coarse.weight[a] += fine.weight[aggregates.member[m]];
            coarse.nRows[a] += fine.nRows[aggregates.member[m]];
        }
    }
}

// Puts the pieces together and scales
void assemble(const List<piece>& pieces, float s, multigridLevel& coarse)
{
    const label n = coarse.size();
    coarse.ownRowStart.assign(1, 0);
    coarse.ownRowStart.reserve(n + 1);
    for (const piece& p : pieces)
        for (const label length : p.length)
            coarse.ownRowStart.push_back(coarse.ownRowStart.back() + length);
    coarse.ownColumn.reserve(coarse.ownRowStart.back());
    coarse.value.reserve(coarse.ownRowStart.back());
    for (const piece& p : pieces)
    {
        coarse.ownColumn.insert(coarse.ownColumn.end(), p.column.begin(), p.column.end());
        for (const float v : p.value) coarse.value.push_back(s * v);
    }
    coarse.rowStart = coarse.ownRowStart.data();
    coarse.column = coarse.ownColumn.data();
    for (label a = 0; a < n; ++a)
    {
        float off = 0;
        for (label k = coarse.rowStart[a]; k < coarse.rowStart[a + 1]; ++k) off += coarse.value[k];
        coarse.diagonal[a] = -off + std::max(0.f, coarse.excess[a]);
        if (!(coarse.diagonal[a] > 0)) coarse.diagonal[a] = coarse.weight[a];
    }
}

// The aggregates that row i of aggregate `own` interpolates from, and their weights summing to 1
void interpolateRow(const multigridLevel& coarse, label own, float4 x, float inverse,
                    std::int32_t* column, float* weight)
{
    const auto hat = [&](label J) {
        float w = 1;
        for (int d = 0; d < 3; ++d)
            w *= std::max(0.f, 1 - std::abs(x[d] - coarse.point[J][d]) * inverse);
        return w;
    };
    column[0] = own, weight[0] = hat(own);
    int n = 1;
    for (label k = coarse.rowStart[own]; k < coarse.rowStart[own + 1]; ++k)
    {
        const label J = coarse.column[k];
        const float w = hat(J);
        if (w <= 0 || coarse.value[k] == 0 || !coarse.follows(own, J)) continue;
        // More than eight only where cells hold several aggregates: the lightest gives way
        const int at = n < 8 ? n++ : int(std::min_element(weight + 1, weight + 8) - weight);
        if (at == n - 1 || w > weight[at]) column[at] = J, weight[at] = w;
    }
    float sum = 0;
    for (int q = 0; q < n; ++q) sum += weight[q];
    for (int q = 0; q < n; ++q) weight[q] /= sum;
    for (int q = n; q < 8; ++q) column[q] = own, weight[q] = 0;
}

void transpose(multigridLevel& fine)
{
    fine.coarseStart.assign(fine.nCoarse + 1, 0);
    for (size_t k = 0; k < fine.coarse.size(); ++k)
        if (fine.interpolation[k] > 0) ++fine.coarseStart[fine.coarse[k] + 1];
    for (label c = 0; c < fine.nCoarse; ++c) fine.coarseStart[c + 1] += fine.coarseStart[c];
    fine.fine.resize(fine.coarseStart[fine.nCoarse]);
    fine.restriction.resize(fine.fine.size());
    List<label> next(fine.coarseStart.begin(), fine.coarseStart.end() - 1);
    for (size_t k = 0; k < fine.coarse.size(); ++k)
        if (fine.interpolation[k] > 0)
        {
            const label at = next[fine.coarse[k]]++;
            fine.fine[at] = label(k / 8);
            fine.restriction[at] = fine.interpolation[k];
        }
}

void buildTransfer(multigridLevel& fine, const cellAggregates& aggregates,
                   const multigridLevel& coarse, float cellSize)
{
    const label n = fine.size();
    fine.nCoarse = aggregates.n;
    fine.aggregate = aggregates.of;
    fine.coarse.assign(8 * size_t(n), 0);
    fine.interpolation.assign(8 * size_t(n), 0);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (aggregates.of[i] >= 0)
                interpolateRow(coarse, aggregates.of[i], fine.point[i], 1 / cellSize,
                               &fine.coarse[8 * size_t(i)], &fine.interpolation[8 * size_t(i)]);
    });
    transpose(fine);
}

}  // namespace

multigridLevel coarsen(multigridLevel& fine, const cellAggregates& aggregates, float cellSize)
{
    multigridLevel coarse;
    placeAggregates(fine, aggregates, cellSize, coarse);
    List<piece> pieces((aggregates.n + blockRows - 1) / blockRows);
    rowAccumulator rows(fine, aggregates, coarse, cellSize);
    const List<scalar> moments =
        blockSums(aggregates.n, 2, [&](label begin, label end, scalar* sums) {
            sums[0] = sums[1] = 0;
            for (label a = begin; a < end; ++a) rows.add(a, pieces[begin / blockRows], sums);
        });
    const scalar s = moments[0] / moments[1];
    assemble(pieces, std::isfinite(s) && s > 0 ? float(s) : 1, coarse);
    buildTransfer(fine, aggregates, coarse, cellSize);
    return coarse;
}

}  // namespace ispf
