// SPDX-License-Identifier: GPL-3.0-or-later
#include "supernodalFactor.H"
#include "messages.H"

#include <algorithm>
#include <cholmod.h>
#include <queue>

namespace ispf
{

namespace
{

constexpr label nParts = 16;      // of the tree below `top_`; a fixed number
constexpr label blockWidth = 64;  // columns of a supernode in one pass
// least rows and columns of a block for one thread
constexpr label rowGrain = 128, columnGrain = 16;

// y -= A x for rows [begin, end) of A, n columns that are `stride` apart
ISPF_HOT void subtractProduct(const float* A, label stride, label begin, label end, label n,
                              const float* x, float* y)
{
    label j = 0;
    for (; j + 4 <= n; j += 4)
    {
        const float *a = A + std::int64_t(j) * stride, *b = a + stride, *c = b + stride,
                    *d = c + stride;
        const float p = x[j], q = x[j + 1], r = x[j + 2], s = x[j + 3];
        for (label i = begin; i < end; ++i) y[i] -= (a[i] * p + b[i] * q) + (c[i] * r + d[i] * s);
    }
    for (; j < n; ++j)
    {
        const float* a = A + std::int64_t(j) * stride;
        for (label i = begin; i < end; ++i) y[i] -= a[i] * x[j];
    }
}

// x_j -= sum_i A_ij y_i for columns [begin, end) of A
ISPF_HOT void subtractTransposed(const float* A, label stride, label begin, label end, label n,
                                 const float* y, float* x)
{
    constexpr label lanes = 16;
    for (label j = begin; j < end; ++j)
    {
        const float* a = A + std::int64_t(j) * stride;
        float sum[lanes] = {};
        label i = 0;
        for (; i + lanes <= n; i += lanes)
            for (label k = 0; k < lanes; ++k) sum[k] += a[i + k] * y[i + k];
        for (; i < n; ++i) sum[0] += a[i] * y[i];
        float total = 0;
        for (const float s : sum) total += s;
        x[j] -= total;
    }
}

// Solves with the lower triangle of n columns in place
void solveTriangle(const float* L, label stride, label n, float* x)
{
    for (label j = 0; j < n; ++j)
    {
        const float* a = L + std::int64_t(j) * stride;
        x[j] /= a[j];
        subtractProduct(a, stride, j + 1, n, 1, x + j, x);
    }
}

void solveTransposedTriangle(const float* L, label stride, label n, float* x)
{
    for (label j = n - 1; j >= 0; --j)
    {
        const float* a = L + std::int64_t(j) * stride;
        subtractTransposed(a + j + 1, stride, 0, 1, n - j - 1, x + j + 1, x + j);
        x[j] /= a[j];
    }
}

}  // namespace

void supernodalFactor::copy(const cholmod_factor_struct& L)
{
    if (!L.is_super || L.xtype != CHOLMOD_REAL || L.itype != CHOLMOD_LONG)
        throw fatalError("supernodalFactor: the factor is not a real supernodal one");
    const auto* super = static_cast<const SuiteSparse_long*>(L.super);
    const auto* pi = static_cast<const SuiteSparse_long*>(L.pi);
    const auto* px = static_cast<const SuiteSparse_long*>(L.px);
    const auto* s = static_cast<const SuiteSparse_long*>(L.s);
    const auto* x = static_cast<const double*>(L.x);
    const auto* perm = static_cast<const SuiteSparse_long*>(L.Perm);
    nodes_.clear();
    for (size_t k = 0; k < L.nsuper; ++k)
        nodes_.push_back({label(super[k]), label(super[k + 1] - super[k]), label(pi[k + 1] - pi[k]),
                          pi[k], px[k]});
    rows_.assign(s, s + L.ssize), permutation_.assign(perm, perm + L.n);
    values_.resize(L.xsize);
    parallelFor(
        label(L.nsuper),
        [&](label begin, label end) {
            std::copy(x + px[begin], x + px[end], values_.begin() + px[begin]);
        },
        16);
    chooseParts();
}

// Divides the heaviest subtrees until none has more work than a part's share, then distributes them to the parts
void supernodalFactor::chooseParts()
{
    const label nNodes = label(nodes_.size()), n = size();
    List<label> nodeOf(n), first(nNodes);
    List<scalar> work(nNodes, 0);
    for (label k = 0; k < nNodes; ++k)
        std::fill_n(nodeOf.begin() + nodes_[k].column, nodes_[k].nColumns, k), first[k] = k;
    List<List<label>> children(nNodes);
    std::priority_queue<std::pair<scalar, label>> queue;  // work of a subtree, its root
    scalar total = 0;
    mostRows_ = 0;
    for (label k = 0; k < nNodes; ++k)  // postordered: a subtree's nodes follow one another
    {
        const supernode& node = nodes_[k];
        const scalar own = scalar(node.nRows) * node.nColumns;
        work[k] += own, total += own, mostRows_ = std::max(mostRows_, node.nRows);
        if (node.nRows == node.nColumns)
        {
            queue.push({work[k], k});
            continue;
        }
        const label parent = nodeOf[rows_[node.row + node.nColumns]];
        work[parent] += work[k];
        children[parent].push_back(k), first[parent] = std::min(first[parent], first[k]);
    }
    top_.clear();
    while (!queue.empty() && queue.top().first > total / nParts)
    {
        const label k = queue.top().second;
        queue.pop(), top_.push_back(k);
        for (const label child : children[k]) queue.push({work[child], child});
    }
    std::sort(top_.begin(), top_.end());
    parts_.assign(nParts, {});
    List<scalar> load(nParts, 0);
    for (; !queue.empty(); queue.pop())  // the heaviest first, each to the part with the least work
    {
        const auto [own, k] = queue.top();
        const label p = label(std::min_element(load.begin(), load.end()) - load.begin());
        load[p] += own;
        for (label m = first[k]; m <= k; ++m) parts_[p].push_back(m);
    }
    aboveColumn_.clear(), aboveIndex_.assign(n, -1);
    for (const label k : top_)
        for (label c = 0; c < nodes_[k].nColumns; ++c)
        {
            aboveIndex_[nodes_[k].column + c] = label(aboveColumn_.size());
            aboveColumn_.push_back(nodes_[k].column + c);
        }
}

// y: right side of the node's own rows, then zeros, on entry; on return the solution, then the contributions
// to the rows below
void supernodalFactor::forward(const supernode& s, float* y) const
{
    for (label j = 0; j < s.nColumns; j += blockWidth)
    {
        const label n = std::min(blockWidth, s.nColumns - j), next = j + n;
        const float* L = values_.data() + s.value + std::int64_t(j) * s.nRows;
        solveTriangle(L + j, s.nRows, n, y + j);
        parallelFor(
            s.nRows - next,
            [&](label begin, label end) {
                subtractProduct(L, s.nRows, next + begin, next + end, n, y + j, y);
            },
            rowGrain);
    }
}

// y: right side of the node's own rows, then the solution below, on entry; on return the own solution
void supernodalFactor::backward(const supernode& s, float* y) const
{
    for (label next = s.nColumns; next > 0;)
    {
        const label j = (next - 1) / blockWidth * blockWidth;
        const float* L = values_.data() + s.value + std::int64_t(j) * s.nRows;
        parallelFor(
            next - j,
            [&](label begin, label end) {
                subtractTransposed(L + next, s.nRows, begin, end, s.nRows - next, y + next, y + j);
            },
            s.nRows - next > 2 * rowGrain ? columnGrain : blockWidth);
        solveTransposedTriangle(L + j, s.nRows, next - j, y + j);
        next = j;
    }
}

// Forward solution of node s; calls add(row, value) for the rows below
template <class Add>
void supernodalFactor::forward(const supernode& s, List<float>& y, Add&& add) const
{
    float* own = work_.data() + s.column;
    std::copy_n(own, s.nColumns, y.begin());
    std::fill_n(y.begin() + s.nColumns, s.nRows - s.nColumns, 0.0f);
    forward(s, y.data());
    std::copy_n(y.begin(), s.nColumns, own);
    for (label q = s.nColumns; q < s.nRows; ++q) add(rows_[s.row + q], y[q]);
}

void supernodalFactor::backward(const supernode& s, List<float>& y) const
{
    for (label q = 0; q < s.nRows; ++q) y[q] = work_[rows_[s.row + q]];
    backward(s, y.data());
    std::copy_n(y.begin(), s.nColumns, work_.begin() + s.column);
}

void supernodalFactor::solve(const List<float>& b, List<float>& x) const
{
    const label n = size(), nAbove = label(aboveColumn_.size()), nParts = label(parts_.size());
    work_.resize(n), x.resize(n);
    for (label i = 0; i < n; ++i) work_[i] = b[permutation_[i]];
    above_.assign(size_t(nAbove) * nParts, 0);
    const auto eachPart = [&](auto&& body) {
        parallelFor(
            nParts,
            [&](label begin, label end) {
                List<float> y(mostRows_);
                for (label p = begin; p < end; ++p) body(p, y);
            },
            1);
    };
    eachPart([&](label p, List<float>& y) {
        float* above = above_.data() + size_t(p) * nAbove;
        const auto add = [&](label row, float value) {
            (aboveIndex_[row] < 0 ? work_[row] : above[aboveIndex_[row]]) += value;
        };
        for (const label k : parts_[p]) forward(nodes_[k], y, add);
    });
    for (label p = 0; p < nParts; ++p)
        for (label c = 0; c < nAbove; ++c) work_[aboveColumn_[c]] += above_[size_t(p) * nAbove + c];
    List<float> y(mostRows_);
    const auto add = [&](label row, float value) { work_[row] += value; };
    for (const label k : top_) forward(nodes_[k], y, add);
    for (label t = label(top_.size()); t-- > 0;) backward(nodes_[top_[t]], y);
    eachPart([&](label p, List<float>& own) {
        for (label m = label(parts_[p].size()); m-- > 0;) backward(nodes_[parts_[p][m]], own);
    });
    for (label i = 0; i < n; ++i) x[permutation_[i]] = work_[i];
}

}  // namespace ispf
