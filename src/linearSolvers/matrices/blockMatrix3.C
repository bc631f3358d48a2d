// SPDX-License-Identifier: GPL-3.0-or-later
#include "blockMatrix3.H"

#include "disjointSets.H"
#include "execution.H"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace ispf
{

namespace
{

// B x: the columns of the block times the components of x
ISPF_INLINE simd4 product(const tensor& B, const vec4& x)
{
    const double* b = B.data();
    return simd4{b[0], b[1], b[2], 0} * x.s[0] + simd4{b[3], b[4], b[5], 0} * x.s[1] +
           simd4{b[6], b[7], b[8], 0} * x.s[2];
}

ISPF_HOT void productRange(const blockMatrix3& A, label begin, label end, const vec4* x, vec4* y)
{
    for (label i = begin; i < end; ++i)
    {
        simd4 sum = product(A.diagonal[i], x[i]);
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
            sum += product(A.value[k], x[A.column[k]]);
        y[i].s = sum;
    }
}

}  // namespace

void blockMatrix3::apply(const List<vec4>& x, List<vec4>& y) const
{
    parallelFor(size(), [&](label i, label e) { productRange(*this, i, e, x.data(), y.data()); });
    countPairs(label(value.size()), sizeof(std::int32_t) + sizeof(tensor));
}

List<label> blockMatrix3::connectedSets() const
{
    List<label> parent(rowStart.size() - 1);
    std::iota(parent.begin(), parent.end(), 0);
    for (label i = 0; i < label(parent.size()); ++i)
        for (label k = rowStart[i]; k < rowStart[i + 1]; ++k) join(parent, i, column[k]);
    for (label i = 0; i < label(parent.size()); ++i) parent[i] = representative(parent, i);
    return parent;
}

blockMatrix3 blockMatrix3::ofEntries(label n, List<entry> entries)
{
    std::stable_sort(entries.begin(), entries.end(), [](const entry& a, const entry& b) {
        return std::tie(a.row, a.column) < std::tie(b.row, b.column);
    });
    blockMatrix3 A;
    A.rowStart.assign(n + 1, 0), A.diagonal.assign(n, tensor::Zero());
    label row = -1, column = -1;  // of the last block
    for (const entry& e : entries)
    {
        if (e.row == e.column) A.diagonal[e.row] += e.value;
        else if (e.row == row && e.column == column) A.value.back() += e.value;
        else
        {
            A.column.push_back(std::int32_t(e.column)), A.value.push_back(e.value);
            ++A.rowStart[e.row + 1], row = e.row, column = e.column;
        }
    }
    std::partial_sum(A.rowStart.begin(), A.rowStart.end(), A.rowStart.begin());
    return A;
}

// Columns ascend in every row
blockMatrix3 blockMatrix3::plus(const blockMatrix3& A) const
{
    blockMatrix3 sum;
    sum.rowStart = {0}, sum.diagonal = diagonal;
    sum.column.reserve(column.size()), sum.value.reserve(value.size());
    for (label i = 0; i < size(); ++i)
    {
        label k = rowStart[i], m = A.rowStart[i];
        const label end = rowStart[i + 1], endOfA = A.rowStart[i + 1];
        while (k < end || m < endOfA)
        {
            const bool own = k < end && (m == endOfA || column[k] <= A.column[m]);
            const bool other = m < endOfA && (k == end || A.column[m] <= column[k]);
            sum.column.push_back(own ? column[k] : A.column[m]);
            sum.value.push_back(own ? value[k] : A.value[m]);
            if (own && other) sum.value.back() += A.value[m];
            k += own, m += other;
        }
        sum.diagonal[i] += A.diagonal[i];
        sum.rowStart.push_back(label(sum.column.size()));
    }
    return sum;
}

void blockMatrix3::addScaled(scalar a, const blockMatrix3& A)
{
    forEach(0, label(value.size()), [&](label e) { value[e] += a * A.value[e]; });
    forEach(0, size(), [&](label i) { diagonal[i] += a * A.diagonal[i]; });
}

void blockMatrix3::scaleColumns(const List<tensor>& by)
{
    for (label i = 0; i < size(); ++i) diagonal[i] *= by[i];
    for (size_t k = 0; k < value.size(); ++k) value[k] *= by[column[k]];
}

}  // namespace ispf
