// SPDX-License-Identifier: GPL-3.0-or-later
#include "blockMatrix3.H"

#include "execution.H"

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

}  // namespace ispf
