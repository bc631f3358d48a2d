// SPDX-License-Identifier: GPL-3.0-or-later
#include "multigridLevel.H"

namespace ispf
{

namespace
{

ISPF_INLINE float rowSum(const multigridLevel& A, label i, const float* x)
{
    const std::int32_t* column = A.column;
    const float* value = A.value.data();
    const label end = A.rowStart[i + 1];
    float sum = 0;
#pragma omp simd reduction(+ : sum)
    for (label k = A.rowStart[i]; k < end; ++k) sum += value[k] * x[column[k]];
    return sum + A.diagonal[i] * x[i];
}

ISPF_INLINE float4 rowSum(const multigridLevel& A, label i, const float4* x)
{
    const std::int32_t* column = A.column;
    const float* value = A.value.data();
    const label end = A.rowStart[i + 1];
    float4 sum = A.diagonal[i] * x[i], odd = {};
    label k = A.rowStart[i];
    for (; k + 2 <= end; k += 2)
    {
        sum += value[k] * x[column[k]];
        odd += value[k + 1] * x[column[k + 1]];
    }
    if (k < end) sum += value[k] * x[column[k]];
    return sum + odd;
}

template <class V>
ISPF_INLINE void residualRows(const multigridLevel& A, label begin, label end, const V* b,
                              const V* x, V* r)
{
    for (label i = begin; i < end; ++i) r[i] = b[i] - rowSum(A, i, x);
}

template <class V>
ISPF_INLINE void smoothRows(const multigridLevel& A, label begin, label end, const V* b, const V* x,
                            V* y)
{
    for (label i = begin; i < end; ++i) y[i] = x[i] + A.relax[i] * (b[i] - rowSum(A, i, x));
}

template <class V>
ISPF_INLINE void multiplyRows(const multigridLevel& A, label begin, label end, const V* x, V* y)
{
    for (label i = begin; i < end; ++i) y[i] = rowSum(A, i, x);
}

template <class V>
ISPF_INLINE void scaleRows(const float* factor, label begin, label end, const V* b, V* x)
{
    for (label i = begin; i < end; ++i) x[i] = factor[i] * b[i];
}

template <class V>
ISPF_INLINE void restrictRows(const multigridLevel& A, label begin, label end, const V* r,
                              V* coarse)
{
    for (label c = begin; c < end; ++c)
    {
        V sum = {};
        for (label k = A.coarseStart[c]; k < A.coarseStart[c + 1]; ++k)
            sum += A.restriction[k] * r[A.fine[k]];
        coarse[c] = sum;
    }
}

template <class V>
ISPF_INLINE void prolongRows(const multigridLevel& A, label begin, label end, const V* coarse, V* x)
{
    for (label i = begin; i < end; ++i)
    {
        const std::int32_t* c = &A.coarse[8 * size_t(i)];
        const float* w = &A.interpolation[8 * size_t(i)];
        V sum = {};
        for (int q = 0; q < 8; ++q) sum += w[q] * coarse[c[q]];
        x[i] += sum;
    }
}

// The clones must be plain functions, so both instances are spelt out
using level = multigridLevel;
ISPF_HOT void hotResidual(const level& A, label i, label e, const float* b, const float* x,
                          float* r)
{
    residualRows(A, i, e, b, x, r);
}
ISPF_HOT void hotResidual(const level& A, label i, label e, const float4* b, const float4* x,
                          float4* r)
{
    residualRows(A, i, e, b, x, r);
}
ISPF_HOT void hotSmooth(const level& A, label i, label e, const float* b, const float* x, float* y)
{
    smoothRows(A, i, e, b, x, y);
}
ISPF_HOT void hotSmooth(const level& A, label i, label e, const float4* b, const float4* x,
                        float4* y)
{
    smoothRows(A, i, e, b, x, y);
}
ISPF_HOT void hotMultiply(const level& A, label i, label e, const float* x, float* y)
{
    multiplyRows(A, i, e, x, y);
}
ISPF_HOT void hotMultiply(const level& A, label i, label e, const float4* x, float4* y)
{
    multiplyRows(A, i, e, x, y);
}
ISPF_HOT void hotScale(const float* factor, label i, label e, const float* b, float* x)
{
    scaleRows(factor, i, e, b, x);
}
ISPF_HOT void hotScale(const float* factor, label i, label e, const float4* b, float4* x)
{
    scaleRows(factor, i, e, b, x);
}
ISPF_HOT void hotRestrict(const level& A, label i, label e, const float* r, float* coarse)
{
    restrictRows(A, i, e, r, coarse);
}
ISPF_HOT void hotRestrict(const level& A, label i, label e, const float4* r, float4* coarse)
{
    restrictRows(A, i, e, r, coarse);
}
ISPF_HOT void hotProlong(const level& A, label i, label e, const float* coarse, float* x)
{
    prolongRows(A, i, e, coarse, x);
}
ISPF_HOT void hotProlong(const level& A, label i, label e, const float4* coarse, float4* x)
{
    prolongRows(A, i, e, coarse, x);
}

}  // namespace

bool multigridLevel::alone(label i) const
{
    for (label k = rowStart[i]; k < rowStart[i + 1]; ++k)
        if (value[k] != 0) return false;
    return true;
}

template <class V>
void residual(const multigridLevel& A, const List<V>& b, const List<V>& x, List<V>& r)
{
    parallelFor(
        A.size(), [&](label i, label e) { hotResidual(A, i, e, b.data(), x.data(), r.data()); },
        levelGrain);
}

template <class V>
void smooth(const multigridLevel& A, const List<V>& b, const List<V>& x, List<V>& y)
{
    parallelFor(
        A.size(), [&](label i, label e) { hotSmooth(A, i, e, b.data(), x.data(), y.data()); },
        levelGrain);
}

template <class V>
void smoothZero(const multigridLevel& A, const List<V>& b, List<V>& x)
{
    parallelFor(
        A.size(), [&](label i, label e) { hotScale(A.relax.data(), i, e, b.data(), x.data()); },
        levelGrain);
}

template <class V>
void multiply(const multigridLevel& A, const List<V>& x, List<V>& y)
{
    parallelFor(
        A.size(), [&](label i, label e) { hotMultiply(A, i, e, x.data(), y.data()); }, levelGrain);
}

template <class V>
void restrictTo(const multigridLevel& A, const List<V>& fine, List<V>& coarse)
{
    parallelFor(
        A.nCoarse, [&](label c, label e) { hotRestrict(A, c, e, fine.data(), coarse.data()); },
        levelGrain / 8);
}

template <class V>
void prolongAdd(const multigridLevel& A, const List<V>& coarse, List<V>& fine)
{
    parallelFor(
        A.size(), [&](label i, label e) { hotProlong(A, i, e, coarse.data(), fine.data()); },
        levelGrain);
}

#define INSTANTIATE(V)                                                                       \
    template void residual(const multigridLevel&, const List<V>&, const List<V>&, List<V>&); \
    template void smooth(const multigridLevel&, const List<V>&, const List<V>&, List<V>&);   \
    template void smoothZero(const multigridLevel&, const List<V>&, List<V>&);               \
    template void multiply(const multigridLevel&, const List<V>&, List<V>&);                 \
    template void restrictTo(const multigridLevel&, const List<V>&, List<V>&);               \
    template void prolongAdd(const multigridLevel&, const List<V>&, List<V>&);
INSTANTIATE(float)
INSTANTIATE(float4)
#undef INSTANTIATE

}  // namespace ispf
