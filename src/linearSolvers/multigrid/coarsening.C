// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarsening.H"

#include "execution.H"
#include <algorithm>

namespace ispf
{

namespace
{

constexpr label blockRows = 2048;  // aggregates per piece: as in blockSums

float squaredLength(float4 d)
{
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// A piece of the coarse matrix, before scaling
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
        // Place of an aggregate in the current row, -1 if it is not in it
        static thread_local List<label> place;
        if (label(place.size()) < agg_.n) place.resize(agg_.n, -1);
        row_.assign(1, {aggregate, 0});
        place[aggregate] = 0;
        for (label m = agg_.start[aggregate]; m < agg_.start[aggregate + 1]; ++m)
        {
            addRow(agg_.member[m], place.data());
            if (m % 8 == 0) addMoments(agg_.member[m], aggregate, moments);
        }
        for (const entry& e : row_) place[e.column] = -1;
        for (size_t k = 1; k < row_.size(); ++k)
            to.column.push_back(row_[k].column), to.value.push_back(row_[k].value);
        to.length.push_back(label(row_.size()) - 1);
    }

private:
    struct entry
    {
        label column;
        float value;
    };

    void addRow(label i, label* place)
    {
        fine_.A.forRow(i, [&](label j, float value) {
            const label J = agg_.of[j];
            if (J < 0) return;
            if (place[J] < 0) place[J] = label(row_.size()), row_.push_back({J, 0});
            row_[place[J]].value += value;
        });
    }

    // Adds the second moments of the couplings of row i on both levels, for the factor s
    void addMoments(label i, label own, scalar* moments)
    {
        fine_.A.forRow(i, [&](label j, float value) {
            const label J = agg_.of[j];
            const float r2 = squaredLength(fine_.point[i] - fine_.point[j]);
            // r2 > far_: a coupling around a periodic box
            if (J < 0 || r2 > far_) return;
            moments[0] += value * r2;
            moments[1] += value * squaredLength(coarse_.point[own] - coarse_.point[J]);
        });
    }

    const multigridLevel& fine_;
    const cellAggregates& agg_;
    const multigridLevel& coarse_;
    const float far_;
    List<entry> row_;  // sums of the current row; the first is for entries inside the aggregate
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
        // the same product as in aggregateByCell: a lattice has rows exactly on the edge of a cell
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

// The off-diagonals of a coarse level in pieces of blockRows rows
class pieceRows : public matrixRows
{
public:
    explicit pieceRows(const List<piece>& pieces) : pieces_(pieces)
    {
        for (const piece& p : pieces)
        {
            label first = 0;
            for (const label length : p.length) first_.push_back(first), first += length;
        }
    }
    label size() const override { return label(first_.size()); }
    scalar diagonalOf(label) const override { return 0; }
    label most(label a) const override { return pieces_[a / blockRows].length[a % blockRows]; }
    label row(label a, std::int32_t* column, scalar* value) const override
    {
        const piece& p = pieces_[a / blockRows];
        std::copy_n(p.column.begin() + first_[a], most(a), column);
        std::copy_n(p.value.begin() + first_[a], most(a), value);
        return most(a);
    }

private:
    const List<piece>& pieces_;
    List<label> first_;  // of each row, in its piece
};

// Joins the pieces and scales the off-diagonals by s
void assemble(const List<piece>& pieces, float s, multigridLevel& coarse)
{
    const label n = label(coarse.point.size());
    const List<scalar> off = coarse.A.assign(pieceRows(pieces), s);
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
    const List<scalar> moments =
        blockSums(aggregates.n, 2, [&](label begin, label end, scalar* sums) {
            sums[0] = sums[1] = 0;
            rowAccumulator rows(fine, aggregates, coarse, cellSize);
            for (label a = begin; a < end; ++a) rows.add(a, pieces[begin / blockRows], sums);
        });
    const scalar s = moments[0] / moments[1];
    assemble(pieces, std::isfinite(s) && s > 0 ? float(s) : 1, coarse);
}

}  // namespace ispf
