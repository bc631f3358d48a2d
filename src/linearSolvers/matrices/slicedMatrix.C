// SPDX-License-Identifier: GPL-3.0-or-later
#include "slicedMatrix.H"

#include <algorithm>

namespace ispf
{

namespace
{

constexpr label width = slicedMatrix::width;

struct slices
{
    const label* start;
    const std::int32_t* column;
    const float* value;
    const float* diagonal;
};

// sum = A x on the 16 rows of slice s
ISPF_INLINE void sliceProduct(const slices& A, label s, const float* x, float* sum)
{
    for (label q = 0; q < width; ++q) sum[q] = A.diagonal[s * width + q] * x[s * width + q];
    for (label k = A.start[s]; k < A.start[s + 1]; ++k)
    {
        const float* value = A.value + size_t(k) * width;
        const std::int32_t* column = A.column + size_t(k) * width;
        // Without this pragma the compiler makes vectors along k, with permuted entries
#pragma omp simd
        for (label q = 0; q < width; ++q) sum[q] += value[q] * x[column[q]];
    }
}

ISPF_HOT void multiplySlices(const slices& A, label s, label end, const float* x, float* y)
{
    for (; s < end; ++s)
    {
        float sum[width];
        sliceProduct(A, s, x, sum);
        for (label q = 0; q < width; ++q) y[s * width + q] = sum[q];
    }
}

ISPF_HOT void residualSlices(const slices& A, label s, label end, const float* b, const float* x,
                             float* r)
{
    for (; s < end; ++s)
    {
        float sum[width];
        sliceProduct(A, s, x, sum);
        for (label q = 0; q < width; ++q) r[s * width + q] = b[s * width + q] - sum[q];
    }
}

ISPF_HOT void smoothSlices(const slices& A, label s, label end, const float* relax, const float* b,
                           const float* x, float* y)
{
    for (; s < end; ++s)
    {
        float sum[width];
        sliceProduct(A, s, x, sum);
        for (label q = 0, i = s * width; q < width; ++q, ++i)
            y[i] = x[i] + relax[i] * (b[i] - sum[q]);
    }
}

}  // namespace

List<scalar> slicedMatrix::assign(const matrixRows& rows, scalar factor)
{
    const label n = rows.size(), nSlices = padded(n) / width;
    n_ = n;
    diagonal_.assign(padded(n), 0);
    start_.assign(nSlices + 1, 0);
    label longest = 0;
    for (label i = 0; i < n; ++i)
    {
        label& length = start_[i / width + 1];
        length = std::max(length, rows.most(i)), longest = std::max(longest, length);
    }
    for (label s = 0; s < nSlices; ++s) start_[s + 1] += start_[s];
    remake(column_, size_t(start_[nSlices]) * width), remake(value_, column_.size());
    List<scalar> offSum(padded(n), 0);
    parallelFor(
        nSlices,
        [&](label s, label e) {
            List<std::int32_t> column(longest);
            List<scalar> value(longest);
            for (label i = s * width; i < e * width; ++i)
            {
                const label length = i < n ? rows.row(i, column.data(), value.data()) : 0;
                size_t at = entry(i);
                const size_t end = at + rowSpan(i);
                for (label k = 0; k < length; ++k, at += width)
                {
                    column_[at] = column[k];
                    value_[at] = float(factor * value[k]);
                    offSum[i] += value[k];
                }
                for (; at < end; at += width) column_[at] = std::min(i, n - 1), value_[at] = 0;
            }
        },
        levelGrain / width);
    offSum.resize(n);
    return offSum;
}

bool slicedMatrix::hasEntries(label i) const
{
    for (size_t k = entry(i), end = k + rowSpan(i); k < end; k += width)
        if (value_[k] != 0) return true;
    return false;
}

void slicedMatrix::multiply(const List<float>& x, List<float>& y) const
{
    const slices A{start_.data(), column_.data(), value_.data(), diagonal_.data()};
    parallelFor(
        padded(n_) / width, [&](label s, label e) { multiplySlices(A, s, e, x.data(), y.data()); },
        levelGrain / width);
    countPairs(std::int64_t(value_.size()), sizeof(std::int32_t) + sizeof(float));
}

void slicedMatrix::residual(const List<float>& b, const List<float>& x, List<float>& r) const
{
    const slices A{start_.data(), column_.data(), value_.data(), diagonal_.data()};
    parallelFor(
        padded(n_) / width,
        [&](label s, label e) { residualSlices(A, s, e, b.data(), x.data(), r.data()); },
        levelGrain / width);
    countPairs(std::int64_t(value_.size()), sizeof(std::int32_t) + sizeof(float));
}

void slicedMatrix::smooth(const List<float>& relax, const List<float>& b, const List<float>& x,
                          List<float>& y) const
{
    const slices A{start_.data(), column_.data(), value_.data(), diagonal_.data()};
    parallelFor(
        padded(n_) / width,
        [&](label s, label e) {
            smoothSlices(A, s, e, relax.data(), b.data(), x.data(), y.data());
        },
        levelGrain / width);
    countPairs(std::int64_t(value_.size()), sizeof(std::int32_t) + sizeof(float));
}

}  // namespace ispf
