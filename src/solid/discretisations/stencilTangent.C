// SPDX-License-Identifier: GPL-3.0-or-later
#include "stencilTangent.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

stencilTangent::stencilTangent(const structureReference& ref, const referenceGradient& fit,
                               const List<char>& active)
    : ref_(ref),
      fit_(fit),
      pairs_(fit.neighbours()),
      active_(active),
      reverse_(pairs_.reverse(ref)),
      slope_(size_t(pairs_.nPairs())),
      own_(size_t(ref.n()), vector::Zero()),
      ownWeight_(size_t(ref.n()), 0)
{
    forPairs<among::all>(pairs_, 0, ref_.n(), [&](label k, pairIndex p, label) {
        slope_[p] = fit_.slope(k, p);
        own_[k] -= slope_[p], ownWeight_[k] += fit_.weight(p);
    });
    makePattern();
}

const tensor* stencilTangent::turnOf(std::int64_t member) const
{
    return member == itself || pairs_.image[member] == 0 ? nullptr
                                                         : &ref_.images[pairs_.image[member] - 1].R;
}

template <class Visit>
void stencilTangent::forPoints(label i, const Visit& visit) const
{
    if (active_[i]) visit(i, itself);
    forNeighbours<among::all>(pairs_, i, [&](pairIndex p, label k) {
        if (active_[k]) visit(k, reverse_[p]);
    });
}

template <class Visit>
void stencilTangent::forMembers(label k, const Visit& visit) const
{
    visit(itself, k);
    forNeighbours<among::all>(pairs_, k, visit);
}

// Columns of the row of i, ascending.  seen: zero on entry and on return
List<std::int32_t> stencilTangent::columnsOf(label i, List<char>& seen) const
{
    List<std::int32_t> columns;
    forPoints(i, [&](label k, std::int64_t a) {
        forMembers(k, [&](std::int64_t b, label j) {
            if (b == a || seen[j]) return;
            seen[j] = 1, columns.push_back(j);
        });
    });
    for (const std::int32_t j : columns) seen[j] = 0;
    std::sort(columns.begin(), columns.end());
    return columns;
}

void stencilTangent::makePattern()
{
    const label n = ref_.n();
    List<List<std::int32_t>> rows(n);
    parallelFor(
        n,
        [&](label begin, label end) {
            List<char> seen(n, 0);
            for (label i = begin; i < end; ++i) rows[i] = columnsOf(i, seen);
        },
        256);
    pattern_.rowStart.push_back(0);
    for (const List<std::int32_t>& row : rows)
    {
        pattern_.column.insert(pattern_.column.end(), row.begin(), row.end());
        pattern_.rowStart.push_back(label(pattern_.column.size()));
    }
}

// slot: place of each column in the row's values, for the columns of the row
void stencilTangent::assembleRow(label i, const List<modulusMatrix>& modulus,
                                 const List<scalar>& star, List<label>& slot, blockMatrix3& K) const
{
    K.diagonal[i].setZero();
    for (label s = K.rowStart[i]; s < K.rowStart[i + 1]; ++s)
        K.value[s].setZero(), slot[K.column[s]] = s;
    const vector ones(1, 1, ref_.nDims == 3);
    forPoints(i, [&](label k, std::int64_t a) {
        const vector& g = slopeOf(k, a);
        const modulusMatrix& C = modulus[k];
        const Eigen::Matrix<scalar, 3, 9> half =
            g[0] * C.topRows<3>() + g[1] * C.middleRows<3>(3) + g[2] * C.bottomRows<3>();
        const tensor* turn = turnOf(a);
        forMembers(k, [&](std::int64_t b, label j) {
            const vector& h = slopeOf(k, b);
            tensor block = h[0] * half.leftCols<3>() + h[1] * half.middleCols<3>(3) +
                           h[2] * half.rightCols<3>();
            if (a == b)
                block.diagonal() += star[k] * (a == itself ? ownWeight_[k] : fit_.weight(a)) * ones;
            else if (a == itself || b == itself)
                block.diagonal() -= star[k] * fit_.weight(std::max(a, b)) * ones;
            if (turn) block = (turn->transpose() * block).eval();
            if (const tensor* other = turnOf(b)) block = (block * *other).eval();
            (a == b ? K.diagonal[i] : K.value[slot[j]]) += block;
        });
    });
}

void stencilTangent::assemble(const List<modulusMatrix>& modulus, const List<scalar>& star,
                              blockMatrix3& K) const
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            List<label> slot(ref_.n(), 0);
            for (label i = begin; i < end; ++i) assembleRow(i, modulus, star, slot, K);
        },
        256);
}

}  // namespace ispf
