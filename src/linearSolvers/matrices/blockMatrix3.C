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

blockMatrix3 blockMatrix3::with(List<entry> entries) const
{
    std::stable_sort(entries.begin(), entries.end(), [](const entry& a, const entry& b) {
        return std::tie(a.row, a.column) < std::tie(b.row, b.column);
    });
    blockMatrix3 sum;
    sum.diagonal = diagonal, sum.rowStart = {0};
    const auto add = [&](std::int32_t to, const tensor& block) {
        const bool same = label(sum.column.size()) > sum.rowStart.back() && sum.column.back() == to;
        if (same) sum.value.back() += block;
        else sum.column.push_back(to), sum.value.push_back(block);
    };
    auto next = entries.begin();
    for (label i = 0; i < size(); ++i)
    {
        label k = rowStart[i];
        while (k < rowStart[i + 1] || (next != entries.end() && next->row == i))
        {
            const bool own = next == entries.end() || next->row != i ||
                             (k < rowStart[i + 1] && column[k] <= next->column);
            if (own) add(column[k], value[k]), ++k;
            else if (next->column == i) sum.diagonal[i] += next->value, ++next;
            else add(std::int32_t(next->column), next->value), ++next;
        }
        sum.rowStart.push_back(label(sum.column.size()));
    }
    return sum;
}

void blockMatrix3::addScaled(scalar a, const blockMatrix3& A)
{
    forEach(0, label(value.size()), [&](label e) { value[e] += a * A.value[e]; });
    forEach(0, size(), [&](label i) { diagonal[i] += a * A.diagonal[i]; });
}

}  // namespace ispf
