// SPDX-License-Identifier: GPL-3.0-or-later
// STREAM's triad a = b + s c on arrays that no cache holds: the memory bandwidth that the benchmark compares with
// (J. D. McCalpin, https://www.cs.virginia.edu/stream/).  Prints the best of ten repetitions in GB/s
#include <chrono>
#include <cstdio>
#include <memory>

int main()
{
    constexpr long n = 1L << 27;
    const std::unique_ptr<double[]> a(new double[n]), b(new double[n]), c(new double[n]);
    double *x = a.get(), *y = b.get(), *z = c.get();
#pragma omp parallel for
    for (long i = 0; i < n; ++i) x[i] = 0, y[i] = 1, z[i] = 2;
    double best = 1e30;
    for (int k = 0; k < 10; ++k)
    {
        const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for
        for (long i = 0; i < n; ++i) x[i] = y[i] + 3 * z[i];
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        if (took.count() < best) best = took.count();
    }
    if (x[n / 2] != 7) return 1;
    std::printf("%.1f\n", 3 * sizeof(double) * n / best * 1e-9);
}
