// SPDX-License-Identifier: GPL-3.0-or-later
#include "followWeights.H"

#include <cmath>
#include <functional>
#include <doctest/doctest.h>
#include <random>

using namespace ispf;

namespace
{

// Layers of a jittered lattice above the plane z = 0, spacing 1/3 of the reach
List<vector> layersAbove(label n, scalar jitter)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<scalar> shift(-jitter, jitter);
    List<vector> r;
    for (label k = 0; k < n; ++k)
        for (int j = -3; j <= 3; ++j)
            for (int i = -3; i <= 3; ++i)
                r.push_back(vector(i + 0.3 + shift(random), j - 0.2 + shift(random),
                                   k + 0.5 + shift(random)) /
                            3);
    return r;
}

scalar sumOf(const List<vector>& r, const std::function<scalar(const vector&)>& f)
{
    const List<scalar> w = followWeights(r);
    scalar sum = 0;
    for (size_t j = 0; j < r.size(); ++j) sum += w[j] * f(r[j]);
    return sum;
}

}  // namespace

TEST_CASE("constants and linear fields are followed exactly, by any number of layers from two on")
{
    for (const label n : {2, 3, 4})
    {
        const List<vector> r = layersAbove(n, 0.1);
        CHECK(std::abs(sumOf(r, [](const vector&) { return 1; }) - 1) < 1e-12);
        for (int d = 0; d < 3; ++d)
            CHECK(std::abs(sumOf(r, [d](const vector& x) { return x[d]; })) < 1e-12);
    }
}

TEST_CASE("quadratic fields too, if there are three layers")
{
    for (const label n : {3, 4})
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b <= a; ++b)
                CHECK(std::abs(sumOf(layersAbove(n, 0.1),
                                     [&](const vector& x) { return x[a] * x[b]; })) < 1e-12);
}

TEST_CASE("what is not known is not guessed: noise is never amplified")
{
    for (const label n : {1, 2, 3, 4})
        for (const scalar jitter : {0.0, 0.1, 0.2})
        {
            // one jittered layer leans with its own roughness, so only a flat one is tested
            if (n == 1 && jitter > 0) continue;
            scalar square = 0;
            for (const scalar w : followWeights(layersAbove(n, jitter))) square += w * w;
            CHECK_MESSAGE(square < 1, n << " layers, jitter " << jitter);
        }
}

TEST_CASE("far particles weigh nothing; without near ones there are no weights")
{
    List<vector> r = layersAbove(3, 0);
    r.push_back({0, 0, -1.5});
    CHECK(followWeights(r).back() == 0);
    CHECK(followWeights({}).empty());
    CHECK(followWeights({{2, 0, 0}}).empty());
}
