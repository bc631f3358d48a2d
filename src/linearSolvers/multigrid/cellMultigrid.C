// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellMultigrid.H"

#include "execution.H"
#include "cellTransfer.H"
#include "coarsening.H"
#include <algorithm>

namespace ispf
{

namespace
{

// A level is kept only if it has at most this share of the rows of the finer level
constexpr scalar worthwhile = 0.7;

ISPF_HOT scalar dotRange(const float* a, const float* b, label n)
{
    float s[16] = {};
    label i = 0;
    for (; i + 16 <= n; i += 16)
        for (int k = 0; k < 16; ++k) s[k] += a[i + k] * b[i + k];
    for (; i < n; ++i) s[0] += a[i] * b[i];
    scalar sum = 0;
    for (int k = 0; k < 16; ++k) sum += s[k];
    return sum;
}

// y = a x + b y
ISPF_HOT void combineRange(float a, const float* x, float b, float* y, label n)
{
    for (label i = 0; i < n; ++i) y[i] = a * x[i] + b * y[i];
}

// x = factor b, entry by entry
void scale(const List<float>& factor, const List<float>& b, List<float>& x)
{
    parallelFor(
        label(x.size()),
        [&](label i, label e) {
            for (; i < e; ++i) x[i] = factor[i] * b[i];
        },
        levelGrain);
}

void combine(scalar a, const List<float>& x, scalar b, List<float>& y)
{
    parallelFor(
        label(y.size()),
        [&](label i, label e) { combineRange(float(a), &x[i], float(b), &y[i], e - i); },
        levelGrain);
}

}  // namespace

struct cellMultigrid::workspace
{
    struct vectors
    {
        List<float> b, x, r;
        List<float> c, v;  // K-cycle: first correction and A times it
    };
    List<vectors> at;

    void resize(const List<multigridLevel>& levels, bool kCycle)
    {
        at.resize(levels.size());
        for (size_t l = 0; l < levels.size(); ++l)
        {
            const label n = slicedMatrix::padded(levels[l].size());
            for (List<float>* v : {&at[l].b, &at[l].x, &at[l].r}) v->assign(n, 0);
            if (kCycle && l > 0) at[l].c.assign(n, 0), at[l].v.assign(n, 0);
        }
    }
};

void multigridOptions::read(const dictionary& dict)
{
    cycle = dict.chooseOrDefault("cycle", {"V", "K"}, cycle);
    omega = dict.getInRangeOrDefault("omega", 0.1, 1.9, omega);
    coarsestSize = dict.getInRangeOrDefault<label>("coarsestSize", 1, 5000, coarsestSize);
}

cellMultigrid::cellMultigrid(const matrixRows& A, const List<vector>& x,
                             const multigridOptions& options, const List<std::uint8_t>& group)
    : options_(options), work_(new workspace)
{
    if (!(options.cellSize > 0))
        throw fatalError("cellMultigrid: the cell size (the support of the kernel) must be given");
    rebuild(A, x, group);
}

void cellMultigrid::rebuild(const matrixRows& A, const List<vector>& x,
                            const List<std::uint8_t>& group)
{
    if (label(x.size()) != A.size() || (!group.empty() && label(group.size()) != A.size()))
        throw fatalError("cellMultigrid: " + std::to_string(x.size()) + " points and " +
                         std::to_string(group.size()) + " groups for a matrix of " +
                         std::to_string(A.size()) + " rows");
    buildFinest(A, x, group);
    buildLevels();
    buildNullSpace();
    setRelaxation();
    work_->resize(level_, options_.cycle == "K");
}

cellMultigrid::~cellMultigrid() = default;

List<label> cellMultigrid::levelSizes() const
{
    List<label> sizes;
    for (const multigridLevel& l : level_) sizes.push_back(l.size());
    return sizes;
}

// Converts values to float, divided by the mean diagonal so that they stay far from the ends of the
// range of float
void cellMultigrid::buildFinest(const matrixRows& A, const List<vector>& x,
                                const List<std::uint8_t>& group)
{
    const label n = A.size();
    level_.resize(std::max<size_t>(1, level_.size()));
    multigridLevel& f = level_[0];
    const scalar sum = parallelSum(n, [&](label i, label e) {
        scalar part = 0;
        for (; i < e; ++i) part += std::abs(A.diagonalOf(i));
        return part;
    });
    matrixScale_ = sum > 0 ? sum / n : 1;
    const scalar scale = 1 / matrixScale_;
    const List<scalar> off = f.A.assign(A, scale);
    f.excess.resize(n), f.weight.resize(n), f.point.resize(n);
    f.nRows.assign(n, 1);
    f.group = group.empty() ? List<std::uint8_t>(n, 0) : group;
    vector corner = vector::Zero();
    if (n > 0) corner = x[0];
    for (label i = 0; i < n; ++i)
    {
        corner = corner.cwiseMin(x[i]);
        if (!x[i].allFinite())
            throw fatalError("cellMultigrid: the point of row " + std::to_string(i) +
                             " is not finite");
    }
    parallelFor(n, [&](label i, label end) {
        for (; i < end; ++i)
        {
            f.A.diagonal()[i] = f.weight[i] = float(scale * A.diagonalOf(i));
            f.excess[i] = float(scale * (A.diagonalOf(i) + off[i]));
            const vector p = x[i] - corner;
            f.point[i] = float4{float(p[0]), float(p[1]), float(p[2]), 0};
        }
    });
}

void cellMultigrid::buildLevels()
{
    float extent = 0;
    for (const float4& p : level_[0].point) extent = std::max({extent, p[0], p[1], p[2]});
    float cellSize = float(options_.cellSize);
    size_t last = 0;  // levels beyond it remain from an earlier use
    while (level_[last].size() > options_.coarsestSize)
    {
        cellAggregates aggregates = aggregateByCell(level_[last], cellSize);
        const bool useful = aggregates.n <= worthwhile * aggregates.member.size();
        if (useful && !aggregates.member.empty())
        {
            if (level_.size() == last + 1) level_.emplace_back();
            if (transfer_.size() == last) transfer_.emplace_back();
            coarsen(level_[last], aggregates, cellSize, level_[last + 1]);
            transfer_[last].assign(level_[last], aggregates, level_[last + 1], cellSize);
            level_[last].aggregate = std::move(aggregates.of);
            ++last;
        }
        else if (cellSize > 2 * extent) break;  // all rows that can be joined have been joined
        cellSize *= 2;
    }
    level_.resize(last + 1);
    transfer_.resize(last);
}

// All levels have the same sets of connected rows: finds the floating sets on the coarsest level
void cellMultigrid::buildNullSpace()
{
    const multigridLevel& last = level_.back();
    List<csrMatrix::triplet> entries;
    for (label i = 0; i < last.size(); ++i)
        last.A.forRow(i, [&](label j, float value) { entries.push_back({i, j, value}); });
    List<label> set, pinned;
    label nSets = floatingSets(csrMatrix::fromTriplets(last.size(), entries),
                               {last.excess.begin(), last.excess.end()},
                               {last.weight.begin(), last.weight.end()}, set);
    for (label i = 0, next = 0; i < last.size(); ++i)
        if (set[i] == next) pinned.push_back(i), ++next;
    coarsest_ = std::make_unique<coarsestSolver>(last.A, pinned);

    for (label l = label(level_.size()) - 2; l >= 0; --l)
    {
        const multigridLevel& f = level_[l];
        List<label> fineSet(f.size(), -1);
        for (label i = 0; i < f.size(); ++i)
            if (f.aggregate[i] >= 0) fineSet[i] = set[f.aggregate[i]];
            else if (isFloating(f.excess[i], f.weight[i])) fineSet[i] = nSets++;
        set = std::move(fineSet);
    }
    nullSpace_ = constantNullSpace(std::move(set), nSets);
}

// Jacobi factors over the diagonal.  A row without neighbours is solved exactly; its factor is 0 if
// nothing determines it
void cellMultigrid::setRelaxation()
{
    relax_.clear();
    for (const multigridLevel& f : level_)
    {
        relax_.emplace_back(slicedMatrix::padded(f.size()), 0);
        parallelFor(
            f.size(),
            [&](label i, label end) {
                for (; i < end; ++i)
                    if (f.A.hasEntries(i))
                        relax_.back()[i] = float(options_.omega) / f.A.diagonal()[i];
                    else if (!isFloating(f.excess[i], f.weight[i]))
                        relax_.back()[i] = 1 / f.A.diagonal()[i];
            },
            levelGrain);
    }
}

// x = an approximation of A^-1 b on level l
void cellMultigrid::cycle(workspace& work, label l) const
{
    const slicedMatrix& A = level_[l].A;
    auto& w = work.at[l];
    scale(relax_[l], w.b, w.x);
    if (l + 1 == label(level_.size())) return coarsest_->solve(w.b, w.x);
    A.residual(w.b, w.x, w.r);
    transfer_[l].restrictTo(w.r, work.at[l + 1].b);
    solveCoarse(work, l + 1);
    transfer_[l].prolongAdd(work.at[l + 1].x, w.x);
    A.smooth(relax_[l], w.b, w.x, w.r);
    w.x.swap(w.r);
}

// One cycle; with the K-cycle at most two steps of flexible conjugate gradients that it
// preconditions.  Y. Notay, P. S. Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473.
void cellMultigrid::solveCoarse(workspace& work, label l) const
{
    cycle(work, l);
    if (options_.cycle == "V" || l + 1 == label(level_.size())) return;
    constexpr scalar goodEnough = 0.25;

    const slicedMatrix& A = level_[l].A;
    const label n = A.size();
    auto& w = work.at[l];
    w.c.swap(w.x);
    A.multiply(w.c, w.v);
    const auto first = blockSums(n, 3, [&](label i, label e, scalar* sum) {
        sum[0] = dotRange(&w.c[i], &w.v[i], e - i);
        sum[1] = dotRange(&w.c[i], &w.b[i], e - i);
        sum[2] = dotRange(&w.b[i], &w.b[i], e - i);
    });
    if (!(first[0] > 0)) return w.c.swap(w.x);
    const scalar alpha = first[1] / first[0];
    combine(-alpha, w.v, 1, w.b);
    const auto rr = blockSums(
        n, 1, [&](label i, label e, scalar* sum) { sum[0] = dotRange(&w.b[i], &w.b[i], e - i); });
    if (rr[0] <= goodEnough * goodEnough * first[2]) return combine(alpha, w.c, 0, w.x);

    cycle(work, l);
    A.multiply(w.x, w.r);
    const auto second = blockSums(n, 3, [&](label i, label e, scalar* sum) {
        sum[0] = dotRange(&w.x[i], &w.v[i], e - i);
        sum[1] = dotRange(&w.x[i], &w.r[i], e - i);
        sum[2] = dotRange(&w.x[i], &w.b[i], e - i);
    });
    const scalar rho = second[1] - second[0] * second[0] / first[0];
    if (!(rho > 0)) return combine(alpha, w.c, 0, w.x);
    combine(alpha - second[0] * second[2] / (first[0] * rho), w.c, second[2] / rho, w.x);
}

void cellMultigrid::apply(const List<scalar>& r, List<scalar>& z) const
{
    const label n = level_[0].size();
    List<scalar> projected;
    if (!nullSpace_.empty()) projected = r, nullSpace_.project(projected);
    const List<scalar>& right = nullSpace_.empty() ? r : projected;
    const scalar rms = norm(right) / std::sqrt(scalar(std::max(n, 1)));
    if (rms == 0) return z.assign(n, 0);

    auto& finest = work_->at[0];
    parallelFor(n, [&](label i, label e) {
        for (; i < e; ++i) finest.b[i] = float(right[i] / rms);
    });
    cycle(*work_, 0);
    parallelFor(n, [&](label i, label e) {
        for (; i < e; ++i) z[i] = finest.x[i] * (rms / matrixScale_);
    });
    nullSpace_.project(z);
}

}  // namespace ispf
