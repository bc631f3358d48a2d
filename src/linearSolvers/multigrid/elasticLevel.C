// SPDX-License-Identifier: GPL-3.0-or-later
#include "elasticLevel.H"

#include "cellAggregation.H"
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace ispf
{

namespace
{

constexpr label powerSteps = 12;  // for the largest eigenvalue
constexpr float margin = 1.1f;    // of that estimate, which is from below
// Lower end of the interval that Chebyshev's polynomial damps, over its upper end
constexpr float lowerEnd = 0.2f;
// Share of the largest eigenvalue of a diagonal block; smaller ones are free directions
constexpr double held = 1e-6;
// A level is kept only if it has at most this share of the nodes
constexpr scalar worthwhile = 0.7;

template <int B>
ISPF_INLINE void residualBody(const elasticLevel<B>& L, label begin, label end,
                              const blockEntry<B>* b, const blockEntry<B>* x, blockEntry<B>* r)
{
    for (label i = begin; i < end; ++i)
    {
        pack<B> sum = {};
        addProduct(L.diagonal[i], x[i].s, sum);
        for (label k = L.A.start[i]; k < L.A.start[i + 1]; ++k)
            addProduct(L.A.value[k], x[L.A.column[k]].s, sum);
        r[i].s = b[i].s - sum;
    }
}

ISPF_HOT void residualRange(const elasticLevel<3>& L, label begin, label end,
                            const blockEntry<3>* b, const blockEntry<3>* x, blockEntry<3>* r)
{
    residualBody(L, begin, end, b, x, r);
}

ISPF_HOT void residualRange(const elasticLevel<6>& L, label begin, label end,
                            const blockEntry<6>* b, const blockEntry<6>* x, blockEntry<6>* r)
{
    residualBody(L, begin, end, b, x, r);
}

// The inverse of A on the directions that A holds
template <int B>
block<B, B> inverseOf(const block<B, B>& A)
{
    Eigen::Matrix<double, B, B> M;
    for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) M(r, c) = 0.5 * (A(r, c) + A(c, r));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, B, B>> e(M);
    Eigen::Matrix<double, B, 1> of = e.eigenvalues();
    for (int k = 0; k < B; ++k) of[k] = of[k] > held * of[B - 1] ? 1 / of[k] : 0;
    M = e.eigenvectors() * of.asDiagonal() * e.eigenvectors().transpose();
    block<B, B> inverse = {};
    for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) inverse(r, c) = float(M(r, c));
    return inverse;
}

template <int B>
scalar squaredNorm(const rawList<blockEntry<B>>& x)
{
    return parallelSum(label(x.size()), [&](label i, label e) {
        pack<B> sum = {};
        for (; i < e; ++i) sum += x[i].s * x[i].s;
        scalar all = 0;
        for (int k = 0; k < B; ++k) all += sum[k];
        return all;
    });
}

// y = A_ii^-1 x
template <int B>
void scaleByInverse(const elasticLevel<B>& L, const rawList<blockEntry<B>>& x,
                    rawList<blockEntry<B>>& y)
{
    parallelFor(L.size(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            pack<B> sum = {};
            addProduct(L.inverse[i], x[i].s, sum);
            y[i].s = sum;
        }
    });
}

// Largest eigenvalue of A_ii^-1 A, by powers of it
template <int B>
float largestEigenvalue(const elasticLevel<B>& L)
{
    const label n = L.size();
    rawList<blockEntry<B>> x(n), r(n), zero(n);
    for (label i = 0; i < n; ++i)
    {
        zero[i].s = pack<B>{};
        // no direction is left out: digits of i
        x[i].s = pack<B>{};
        for (int k = 0; k < B; ++k) x[i].s[k] = float((i * 7 + k * 3) % 11) - 5;
    }
    scalar largest = 1;
    for (label step = 0; step < powerSteps; ++step)
    {
        const scalar before = squaredNorm<B>(x);
        L.residual(zero, x, r);
        scaleByInverse(L, r, x);
        const scalar after = squaredNorm<B>(x);
        if (!(before > 0) || !(after > 0)) return float(largest);
        largest = std::sqrt(after / before);
        const float back = float(1 / std::sqrt(after));
        for (blockEntry<B>& v : x) v.s *= back;
    }
    return float(largest);
}

template <int B>
void prepareSmoother(elasticLevel<B>& L)
{
    L.inverse.resize(L.size());
    parallelFor(L.size(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) L.inverse[i] = inverseOf(L.diagonal[i]);
    });
    L.largest = margin * largestEigenvalue(L);
}

// Displacement and rotation of a node that moves with its aggregate: d from the aggregate's point [m]
template <int B>
block<B, 6> rigidMotion(float4 d, float length, float coarseLength)
{
    block<B, 6> P = {};
    for (int c = 0; c < 3; ++c)
    {
        P(c, c) = 1;
        const vector turned = vector::Unit(c).cross(vector(d[0], d[1], d[2])) / coarseLength;
        for (int r = 0; r < 3; ++r) P(r, 3 + c) = float(turned[r]);
        if constexpr (B == 6) P(3 + c, 3 + c) = length / coarseLength;
    }
    return P;
}

// Sums blocks by column, one row after another
template <int R, int C>
class rowSums
{
public:
    explicit rowSums(label nColumns) : place_(nColumns, -1) {}

    block<R, C>& at(label column)
    {
        if (place_[column] < 0)
        {
            place_[column] = label(column_.size());
            column_.push_back(column), value_.push_back({});
        }
        return value_[place_[column]];
    }
    template <class Body>
    void forEach(const Body& body)
    {
        for (size_t k = 0; k < column_.size(); ++k) body(column_[k], value_[k]);
    }
    // Appends the row, columns in the order of their first call, and empties it
    void moveTo(blockRows<R, C>& to)
    {
        for (const label c : column_) place_[c] = -1;
        to.column.insert(to.column.end(), column_.begin(), column_.end());
        to.value.insert(to.value.end(), value_.begin(), value_.end());
        to.start.push_back(label(to.column.size()));
        column_.clear(), value_.clear();
    }

private:
    List<label> place_;
    List<std::int32_t> column_;
    rawList<block<R, C>> value_;
};

// Rows made by row(i, sums) for i in [0, n), in parts that threads share
template <int R, int C, class Row>
blockRows<R, C> makeRows(label n, label nColumns, const Row& row)
{
    const auto parts = parallelParts(n, [&](label begin, label end) {
        blockRows<R, C> part;
        rowSums<R, C> sums(nColumns);
        for (label i = begin; i < end; ++i) row(i, sums), sums.moveTo(part);
        return part;
    });
    blockRows<R, C> all;
    all.start.reserve(n + 1);
    size_t entries = 0;
    for (const blockRows<R, C>& p : parts) entries += p.column.size();
    all.column.reserve(entries), all.value.reserve(entries);
    for (const blockRows<R, C>& p : parts)
    {
        const label before = label(all.column.size());
        for (size_t k = 1; k < p.start.size(); ++k) all.start.push_back(before + p.start[k]);
        all.column.insert(all.column.end(), p.column.begin(), p.column.end());
        all.value.insert(all.value.end(), p.value.begin(), p.value.end());
    }
    return all;
}

template <int R, int C>
blockRows<C, R> transposed(const blockRows<R, C>& P, label nColumns)
{
    blockRows<C, R> T;
    T.start.assign(nColumns + 1, 0);
    for (const label c : P.column) ++T.start[c + 1];
    for (label c = 0; c < nColumns; ++c) T.start[c + 1] += T.start[c];
    List<label> next(T.start.begin(), T.start.end() - 1);
    T.column.resize(P.column.size()), T.value.resize(P.column.size());
    for (label i = 0; i < P.size(); ++i)
        for (label k = P.start[i]; k < P.start[i + 1]; ++k)
        {
            const label to = next[P.column[k]]++;
            T.column[to] = i, T.value[to] = transposed(P.value[k]);
        }
    return T;
}

}  // namespace

template <int B>
void elasticLevel<B>::residual(const rawList<blockEntry<B>>& b, const rawList<blockEntry<B>>& x,
                               rawList<blockEntry<B>>& r) const
{
    parallelFor(
        size(),
        [&](label begin, label end) {
            residualRange(*this, begin, end, b.data(), x.data(), r.data());
        },
        256);
    countPairs(label(A.value.size()), sizeof(std::int32_t) + sizeof(block<B, B>));
}

// Chebyshev's iteration on [lowerEnd, 1] times the largest eigenvalue, two steps: the same polynomial before and after the
// coarse level, so that the cycle is symmetric
template <int B>
void elasticLevel<B>::smooth(rawList<blockEntry<B>>& r, rawList<blockEntry<B>>& x,
                             rawList<blockEntry<B>>& way) const
{
    const float middle = 0.5f * (1 + lowerEnd) * largest, half = 0.5f * (1 - lowerEnd) * largest;
    const float sigma = middle / half, rho = 1 / sigma, next = 1 / (2 * sigma - rho);
    rawList<blockEntry<B>>& d = way;
    parallelFor(size(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            pack<B> s = {};
            addProduct(inverse[i], r[i].s, s);
            d[i].s = s / middle;
            x[i].s += d[i].s;
        }
    });
    residual(r, d, r);
    parallelFor(size(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            pack<B> s = {};
            addProduct(inverse[i], r[i].s, s);
            x[i].s += next * rho * d[i].s + 2 * next / half * s;
        }
    });
}

scalar makeFinest(const elasticSystem& system, elasticLevel<3>& fine)
{
    const blockMatrix3& K = system.K;
    const label n = K.size();
    scalar mean = 0;
    for (label i = 0; i < n; ++i)
        mean += system.factor * K.diagonal[i].trace() / 3 + system.added[i];
    const scalar scale = mean > 0 ? mean / n : 1;
    const auto narrow = [&](const tensor& T, scalar added) {
        block<3, 3> b = {};
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                b(r, c) = float((system.factor * T(r, c) + (r == c) * added) / scale);
        return b;
    };
    vector corner = n > 0 ? system.x[0] : vector::Zero();
    for (const vector& p : system.x) corner = corner.cwiseMin(p);
    fine.point.resize(n), fine.diagonal.resize(n);
    for (label i = 0; i < n; ++i)
    {
        const vector p = system.x[i] - corner;
        fine.point[i] = float4{float(p[0]), float(p[1]), float(p[2]), 0};
        fine.diagonal[i] = narrow(K.diagonal[i], system.added[i]);
    }
    fine.A = makeRows<3, 3>(n, n, [&](label i, rowSums<3, 3>& sums) {
        for (label k = K.rowStart[i]; k < K.rowStart[i + 1]; ++k)
        {
            const label j = K.column[k];
            if (system.held[i] || system.held[j]) continue;
            const block<3, 3> b = narrow(K.value[k], 0);
            block<3, 3>& to = j == i ? fine.diagonal[i] : sums.at(j);
            for (int c = 0; c < 3; ++c) to.column[c] += b.column[c];
        }
    });
    prepareSmoother(fine);
    return scale;
}

template <int B>
bool coarsen(elasticLevel<B>& fine, scalar cellSize, elasticLevel<6>& coarse)
{
    const label n = fine.size();
    const cellAggregates groups = aggregateByCell(fine, float(cellSize));
    if (groups.n == 0 || groups.n > worthwhile * groups.member.size()) return false;

    coarse.length = float(cellSize);
    coarse.point.assign(groups.n, float4{});
    for (label I = 0; I < groups.n; ++I)
    {
        for (label m = groups.start[I]; m < groups.start[I + 1]; ++m)
            coarse.point[I] += fine.point[groups.member[m]];
        coarse.point[I] /= float(groups.start[I + 1] - groups.start[I]);
    }
    const auto motion = [&](label j) {
        const label J = groups.of[j];
        return rigidMotion<B>(fine.point[j] - coarse.point[J], fine.length, coarse.length);
    };

    // P = (1 - 4/(3 largest) A_ii^-1 A) P_0, (7.13)
    const float omega = 4 / (3 * fine.largest);
    fine.prolongation = makeRows<B, 6>(n, groups.n, [&](label i, rowSums<B, 6>& P) {
        if (groups.of[i] < 0) return;
        rowSums<B, 6>& AP = P;  // first A P_0, then its blocks are turned into those of P
        addProduct(fine.diagonal[i], motion(i), AP.at(groups.of[i]));
        for (label k = fine.A.start[i]; k < fine.A.start[i + 1]; ++k)
            if (const label j = fine.A.column[k]; groups.of[j] >= 0)
                addProduct(fine.A.value[k], motion(j), AP.at(groups.of[j]));
        P.forEach([&](label J, block<B, 6>& v) {
            block<B, 6> smoothed = J == groups.of[i] ? motion(i) : block<B, 6>{};
            block<B, 6> correction = {};
            addProduct(fine.inverse[i], v, correction);
            for (int c = 0; c < 6; ++c) smoothed.column[c] -= omega * correction.column[c];
            v = smoothed;
        });
    });
    fine.restriction = transposed(fine.prolongation, groups.n);

    // the coarse matrix P^T A P
    const blockRows<B, 6>& P = fine.prolongation;
    const auto addRow = [&](const block<B, B>& a, label j, rowSums<B, 6>& sums) {
        for (label m = P.start[j]; m < P.start[j + 1]; ++m)
            addProduct(a, P.value[m], sums.at(P.column[m]));
    };
    const blockRows<B, 6> AP = makeRows<B, 6>(n, groups.n, [&](label i, rowSums<B, 6>& sums) {
        if (P.start[i] == P.start[i + 1]) return;
        addRow(fine.diagonal[i], i, sums);
        for (label k = fine.A.start[i]; k < fine.A.start[i + 1]; ++k)
            addRow(fine.A.value[k], fine.A.column[k], sums);
    });
    coarse.diagonal.assign(groups.n, {});
    const blockRows<6, B>& R = fine.restriction;
    coarse.A = makeRows<6, 6>(groups.n, groups.n, [&](label I, rowSums<6, 6>& sums) {
        for (label k = R.start[I]; k < R.start[I + 1]; ++k)
        {
            const label i = R.column[k];
            for (label m = AP.start[i]; m < AP.start[i + 1]; ++m)
            {
                const label J = AP.column[m];
                addProduct(R.value[k], AP.value[m], J == I ? coarse.diagonal[I] : sums.at(J));
            }
        }
    });
    prepareSmoother(coarse);
    return true;
}

template struct elasticLevel<3>;
template struct elasticLevel<6>;
template bool coarsen(elasticLevel<3>&, scalar, elasticLevel<6>&);
template bool coarsen(elasticLevel<6>&, scalar, elasticLevel<6>&);

}  // namespace ispf
