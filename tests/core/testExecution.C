// SPDX-License-Identifier: GPL-3.0-or-later
#include "execution.H"
#include "errorOf.H"
#include "relative.H"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

struct threads
{
    explicit threads(int n) { setThreads(n); }
    ~threads() { setThreads(0); }
};

List<scalar> jagged(label n)
{
    List<scalar> a(n);
    for (label i = 0; i < n; ++i) a[i] = std::sin(1.7 * i) * std::pow(10, i % 13 - 6);
    return a;
}

}  // namespace

TEST_CASE("sums are the same to the last bit for any number of threads")
{
    for (const label n : {0, 1, 7, 2048, 2049, 100003})
    {
        const List<scalar> a = jagged(n), b = jagged(n + 1);
        List<scalar> sums, norms, greatest;
        for (const int k : {1, 2, 3})
        {
            const threads t(k);
            sums.push_back(dot(a, List<scalar>(b.begin() + 1, b.end())));
            norms.push_back(norm(a));
            greatest.push_back(
                maxOf(n, [&](label i, label e) { return *std::max_element(&a[i], &a[0] + e); }));
        }
        for (const int k : {1, 2})
        {
            CHECK(sums[k] == sums[0]);
            CHECK(norms[k] == norms[0]);
            CHECK(greatest[k] == greatest[0]);
        }
    }
}

TEST_CASE("dot and norm against the plain sums")
{
    const label n = 5001;
    List<scalar> a(n), b(n, 2.0);
    for (label i = 0; i < n; ++i) a[i] = i;
    CHECK(dot(a, b) == scalar(n) * (n - 1));  // integers: exact
    CHECK(norm(b) == relative(2 * std::sqrt(scalar(n))));
    CHECK(parallelSum(n, [](label i, label e) { return scalar(e - i); }) == n);
}

TEST_CASE("maxOf keeps a NaN")
{
    List<scalar> a(10000, 1.0);
    const auto greatest = [&] {
        return maxOf(label(a.size()), [&](label i, label e) {
            scalar m = a[i];
            for (; i < e; ++i) m = a[i] > m || a[i] != a[i] ? a[i] : m;
            return m;
        });
    };
    a[9000] = 5;
    CHECK(greatest() == 5);
    a[9999] = NAN;
    CHECK(std::isnan(greatest()));
}

TEST_CASE("parallelFor covers every index once")
{
    const threads t(2);
    for (const label n : {0, 1, 1023, 50000})
    {
        List<std::atomic<int>> hits(n);
        parallelFor(
            n,
            [&](label i, label e) {
                for (; i < e; ++i) ++hits[i];
            },
            10);
        label wrong = 0;
        for (const auto& h : hits) wrong += h != 1;
        CHECK(wrong == 0);
    }
}

TEST_CASE("an error in a thread reaches the caller")
{
    const threads t(2);
    const auto wrong = [](label begin, label end) {
        if (begin <= 4567 && 4567 < end) throw fatalError("at 4567");
    };
    CHECK_ERROR(parallelFor(10000, wrong, 10), "at 4567", 0);
    CHECK_ERROR(parallelFor(5000, wrong, 5000), "at 4567", 0);
}
