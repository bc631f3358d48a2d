// SPDX-License-Identifier: GPL-3.0-or-later
#include "smoothingKernel.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

TEST_CASE("kernels integrate to one")
{
    for (const word& name : smoothingKernel::valid())
        for (const int nDims : {2, 3})
        {
            const auto kernel = smoothingKernel::New(name, nDims, 0.7);
            const int n = 20000;
            const scalar dr = kernel->support() / n;
            scalar sum = 0;
            for (int k = 0; k < n; ++k)
            {
                const scalar r = (k + 0.5) * dr;
                sum += kernel->W(r) * (nDims == 3 ? 4 * M_PI * r * r : 2 * M_PI * r) * dr;
            }
            CHECK(sum == doctest::Approx(1).epsilon(1e-7));
            CHECK(kernel->W(kernel->support() * 1.0001) == 0);
        }
}

TEST_CASE("F is the slope of W over r")
{
    for (const word& name : smoothingKernel::valid())
        for (const int nDims : {2, 3})
        {
            const auto kernel = smoothingKernel::New(name, nDims, 0.7);
            const scalar step = 1e-6, top = kernel->W(0);
            for (scalar r = 0.01; r < 1.02 * kernel->support(); r += 0.0137)
            {
                const scalar r2 = r * r;
                scalar F;
                kernel->F(&r2, &F, 1);
                const scalar slope = (kernel->W(r + step) - kernel->W(r - step)) / (2 * step);
                CHECK(std::abs(F * r - slope) < 1e-7 * top);
                CHECK(F <= 0);
            }
        }
}

TEST_CASE("the lattice sum is one where the kernel is wide enough, and counts the particle itself")
{
    const auto quintic = smoothingKernel::New("quintic", 3, 1);
    CHECK(quintic->latticeSum(1) == doctest::Approx(1).epsilon(1e-3));
    CHECK(smoothingKernel::New("cubic", 2, 0.4)->latticeSum(1) ==
          doctest::Approx(10 / (7 * M_PI) / 0.16));
}

TEST_CASE("an unknown kernel is answered with the known ones")
{
    CHECK_THROWS_WITH_AS(smoothingKernel::New("gauss", 3, 1),
                         doctest::Contains("WendlandC2 WendlandC4 cubic quintic"), fatalError);
}
