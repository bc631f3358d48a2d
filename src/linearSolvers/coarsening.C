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
        // slot[J] is right only if the entry it points to is of this row and names J
        static thread_local List<label> slot;
        if (label(slot.size()) < agg_.n) slot.resize(agg_.n);
        fine_.A.forRow(i, [&](label j, float value) {
            const label J = agg_.of[j];
            if (J == own || J < 0) return;
            size_t s = slot[J];
            if (s < rowBegin || s >= to.column.size() || to.column[s] != J)
            {
                s = slot[J] = label(to.column.size());
                to.column.push_back(J), to.value.push_back(0);
            }
            to.value[s] += value;
        });
    }

    // Second moments of the couplings on both levels, for the factor s
    void addMoments(label i, label own, scalar* moments)
    {
        fine_.A.forRow(i, [&](label j, float value) {
            const label J = agg_.of[j];
            const float r2 = squaredLength(fine_.point[i] - fine_.point[j]);
            // far: a coupling around a periodic box
            if (J < 0 || r2 > far_) return;
            moments[0] += value * r2;
            moments[1] += value * squaredLength(coarse_.point[own] - coarse_.point[J]);
        });
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
    coarse.excess.assign(n, 0), coarse.weight.assign(n, 0), coarse.nRows.assign(n, 0);
    for (label a = 0; a < n; ++a)
    {
        const label first = aggregates.member[aggregates.start[a]];
        coarse.group[a] = fine.group[first];
        // by the product that aggregateByCell uses: a lattice has rows on the very edge of a cell
        for (int d = 0; d < 3; ++d)
            coarse.point[a][d] =
                (std::floor(fine.point[first][d] * (1 / cellSize)) + 0.5f) * cellSize;
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
    List<label> rowStart(1, 0);
    List<std::int32_t> column;
    List<float> value;
    for (const piece& p : pieces)
    {
        for (const label length : p.length) rowStart.push_back(rowStart.back() + length);
        column.insert(column.end(), p.column.begin(), p.column.end());
        value.insert(value.end(), p.value.begin(), p.value.end());
    }
    const label n = label(coarse.point.size());
    const List<scalar> off = coarse.A.assign(n, rowStart.data(), column.data(), value.data(), s);
    for (label a = 0; a < n; ++a)
    {
        float& diagonal = coarse.A.diagonal()[a];
        diagonal = float(-s * off[a] + std::max(0.f, coarse.excess[a]));
        if (!(diagonal > 0)) diagonal = coarse.weight[a];
    }
}

}  // namespace

void coarsen(const multigridLevel& fine, const cellAggregates& aggregates, float cellSize,
             multigridLevel& coarse)
{
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
}

}  // namespace ispf
