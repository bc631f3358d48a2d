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

// Diagonal block of row i, plus the off-diagonal blocks of the row in its own column
tensor wholeDiagonal(const blockMatrix3& A, label i)
{
    tensor D = A.diagonal[i];
    for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
        if (A.column[k] == i) D += A.value[k];
    return D;
}

}  // namespace

void blockMatrix3::apply(const List<vec4>& x, List<vec4>& y) const
{
    parallelFor(size(), [&](label i, label e) { productRange(*this, i, e, x.data(), y.data()); });
}

csrMatrix blockMatrix3::thirdOfTrace() const
{
    csrMatrix A;
    A.rowStart.assign(1, 0), A.diagonal.resize(size());
    for (label i = 0; i < size(); ++i)
    {
        for (label k = rowStart[i]; k < rowStart[i + 1]; ++k)
            if (column[k] != i)
                A.column.push_back(column[k]), A.value.push_back(value[k].trace() / 3);
        A.rowStart.push_back(label(A.column.size()));
        A.diagonal[i] = wholeDiagonal(*this, i).trace() / 3;
    }
    return A;
}

csrMatrix blockMatrix3::expanded() const
{
    csrMatrix A;
    A.rowStart.assign(1, 0);
    A.rowStart.reserve(3 * size() + 1), A.diagonal.reserve(3 * size());
    A.column.reserve(9 * value.size() + 6 * size()), A.value.reserve(A.column.capacity());
    const auto add = [&](label i, int r, label j, int c, scalar v) {
        if (i != j || r != c) A.column.push_back(3 * j + c), A.value.push_back(v);
    };
    for (label i = 0; i < size(); ++i)
    {
        const tensor D = wholeDiagonal(*this, i);
        for (int r = 0; r < 3; ++r)
        {
            for (int c = 0; c < 3; ++c) add(i, r, i, c, D(r, c));
            for (label k = rowStart[i]; k < rowStart[i + 1]; ++k)
                for (int c = 0; c < 3 && column[k] != i; ++c)
                    add(i, r, column[k], c, value[k](r, c));
            A.diagonal.push_back(D(r, r));
            A.rowStart.push_back(label(A.column.size()));
        }
    }
    return A;
}

}  // namespace ispf
