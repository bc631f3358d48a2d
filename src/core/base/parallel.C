// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel.H"

#include <omp.h>
#include <algorithm>
#include <exception>
#include <limits>

namespace ispf
{

namespace
{

constexpr label blockSize = 2048;

ISPF_HOT scalar dotRange(const scalar* a, const scalar* b, label n)
{
    scalar s[8] = {};
    label i = 0;
    for (; i + 8 <= n; i += 8)
        for (int k = 0; k < 8; ++k) s[k] += a[i + k] * b[i + k];
    for (; i < n; ++i) s[0] += a[i] * b[i];
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

// The results of body on every block of [0, n), in order
List<scalar> overBlocks(label n, const std::function<scalar(label, label)>& body)
{
    const label nBlocks = (n + blockSize - 1) / blockSize;
    List<scalar> value(nBlocks);
    parallelFor(
        nBlocks,
        [&](label b, label e) {
            for (label k = b; k < e; ++k)
                value[k] = body(k * blockSize, std::min(n, (k + 1) * blockSize));
        },
        4);
    return value;
}

}  // namespace

void parallelFor(label n, const std::function<void(label, label)>& body, label grain)
{
    const label parts = std::min<label>(4 * omp_get_max_threads(), n / std::max<label>(1, grain));
    if (parts < 2 || omp_get_max_threads() == 1 || omp_in_parallel())
    {
        if (n > 0) body(0, n);
        return;
    }
    // An exception may not leave a thread: the lowest range's is thrown again here
    List<std::exception_ptr> thrown(parts);
#pragma omp parallel for schedule(dynamic, 1)
    for (label k = 0; k < parts; ++k)
    {
        try
        {
            body(label(std::int64_t(n) * k / parts), label(std::int64_t(n) * (k + 1) / parts));
        }
        catch (...)
        {
            thrown[k] = std::current_exception();
        }
    }
    for (const std::exception_ptr& e : thrown)
        if (e) std::rethrow_exception(e);
}

scalar parallelSum(label n, const std::function<scalar(label, label)>& blockSum)
{
    scalar sum = 0;
    for (const scalar v : overBlocks(n, blockSum)) sum += v;
    return sum;
}

scalar maxOf(label n, const std::function<scalar(label, label)>& blockMax)
{
    scalar most = -std::numeric_limits<scalar>::infinity();
    for (const scalar v : overBlocks(n, blockMax)) most = v > most || v != v ? v : most;
    return most;
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

int nThreads()
{
    return omp_get_max_threads();
}

void setThreads(int n)
{
    omp_set_num_threads(n < 1 ? omp_get_num_procs() : n);
}

}  // namespace ispf
