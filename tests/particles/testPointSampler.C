// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointSampler.H"

#include <doctest/doctest.h>
#include <random>

using namespace ispf;

namespace
{

List<vector> disordered(int nz)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<scalar> shift(-0.3, 0.3);
    List<vector> x;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i)
                x.emplace_back(i + shift(random), j + shift(random),
                               nz == 1 ? 0.0 : k + shift(random));
    return x;
}

}  // namespace

TEST_CASE("sampling is exact on linear fields, inside and at the rim, in two and three dimensions")
{
    for (const int nz : {1, 12})
    {
        const List<vector> x = disordered(nz);
        const vector slope(2, -3, nz == 1 ? 0.0 : 0.5);
        List<scalar> f;
        List<vector> U;
        for (const vector& p : x) f.push_back(7 + slope.dot(p)), U.push_back(p);
        const pointSampler sampler(x, 2.5);
        for (const vector& point : {vector(5.3, 4.1, 0), vector(0, 0, 0), vector(11.2, 6, 0)})
        {
            const auto w = sampler.weights(point);
            REQUIRE(w.size() > 3);
            CHECK(pointSampler::sum(w, f, scalar(0)) ==
                  doctest::Approx(7 + slope.dot(point)).epsilon(1e-12));
            CHECK((pointSampler::sum<vector>(w, U, vector::Zero()) - point).norm() < 1e-12);
        }
    }
}

TEST_CASE("directions that the neighbours do not span carry no slope, and far points no value")
{
    const pointSampler sampler({vector(0, 0, 0), vector(1, 0, 0)}, 2);
    const List<scalar> f = {3, 5};
    CHECK(pointSampler::sum(sampler.weights({0, 0, 0.5}), f, 0.0) == doctest::Approx(3));
    CHECK(pointSampler::sum(sampler.weights({0.5, 0, 0}), f, 0.0) == doctest::Approx(4));
    CHECK(pointSampler::sum(sampler.weights({-1.5, 0, 0}), f, 0.0) == doctest::Approx(3));
    CHECK(sampler.weights({0, 5, 0}).empty());
    CHECK(sampler.weights({1e30, -1e30, 0}).empty());
    CHECK(pointSampler({}, 1).weights({0, 0, 0}).empty());
}

TEST_CASE("the nearest particle agrees with a search through all")
{
    const List<vector> x = disordered(12);
    const pointSampler sampler(x, 2.5);
    std::mt19937 random(2);
    std::uniform_real_distribution<scalar> place(-4, 16);
    for (int n = 0; n < 500; ++n)
    {
        const vector point(place(random), place(random), place(random));
        label best = -1;
        scalar distance = 2.5;
        for (size_t i = 0; i < x.size(); ++i)
            if ((x[i] - point).norm() < distance) best = label(i), distance = (x[i] - point).norm();
        CHECK(sampler.nearest(point).index == best);
    }
}
