// SPDX-License-Identifier: GPL-3.0-or-later
#include "execution.H"

#include <omp.h>
#include <unistd.h>
#include <chrono>
#include <cmath>
#include <exception>

namespace ispf
{

namespace
{

ISPF_HOT scalar dotOnRange(const scalar* a, const scalar* b, label n)
{
    scalar s[8] = {};
    label i = 0;
    for (; i + 8 <= n; i += 8)
        for (int k = 0; k < 8; ++k) s[k] += a[i + k] * b[i + k];
    for (; i < n; ++i) s[0] += a[i] * b[i];
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

ISPF_HOT void scaleAndAddRange(const scalar* x, scalar a, scalar* y, label n)
{
    for (label i = 0; i < n; ++i) y[i] = x[i] + a * y[i];
}

}  // namespace

void execution::forRanges(label n, label grain, rangeBody body, const void* context)
{
    const label parts = std::min<label>(4 * omp_get_max_threads(), n / std::max<label>(1, grain));
    if (parts < 2 || omp_get_max_threads() == 1 || omp_in_parallel())
    {
        if (n > 0) body(context, 0, n);
        return;
    }
    List<std::exception_ptr> thrown(parts);  // an exception must not leave a thread
#pragma omp parallel for schedule(dynamic, 1)
    for (label k = 0; k < parts; ++k)
    {
        try
        {
            body(context, label(std::int64_t(n) * k / parts),
                 label(std::int64_t(n) * (k + 1) / parts));
        }
        catch (...)
        {
            thrown[k] = std::current_exception();
        }
    }
    for (const std::exception_ptr& e : thrown)
        if (e) std::rethrow_exception(e);
}

workCount& workDone()
{
    static workCount done;
    return done;
}

scalar triadRate()
{
    const label n = std::max<label>(1 << 22, label(2 * sysconf(_SC_LEVEL3_CACHE_SIZE) / 24));
    const std::unique_ptr<scalar[]> a(new scalar[n]), b(new scalar[n]), c(new scalar[n]);
    const auto triad = [&](label begin, label end) {
        for (label i = begin; i < end; ++i) a[i] = b[i] + 3 * c[i];
    };
    // each thread is the first to touch its part
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i) a[i] = 0, b[i] = 1, c[i] = 2;
    });
    scalar best = std::numeric_limits<scalar>::max();
    for (int k = 0; k < 5; ++k)
    {
        const auto start = std::chrono::steady_clock::now();
        parallelFor(n, triad);
        const std::chrono::duration<scalar> took = std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count());
    }
    return 3 * sizeof(scalar) * scalar(n) / best;
}

int nThreads()
{
    return omp_get_max_threads();
}

void setThreads(int n)
{
    omp_set_num_threads(n < 1 ? omp_get_num_procs() : n);
}

scalar dotRange(const scalar* a, const scalar* b, label n)
{
    return dotOnRange(a, b, n);
}

scalar dot(const List<scalar>& a, const List<scalar>& b)
{
    return parallelSum(label(a.size()),
                       [&](label i, label e) { return dotRange(&a[i], &b[i], e - i); });
}

scalar norm(const List<scalar>& a)
{
    return std::sqrt(dot(a, a));
}

void scaleAndAdd(const List<scalar>& x, scalar a, List<scalar>& y)
{
    parallelFor(
        label(y.size()),
        [&](label begin, label end) { scaleAndAddRange(&x[begin], a, &y[begin], end - begin); },
        8192);
}

}  // namespace ispf
