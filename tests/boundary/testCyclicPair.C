// SPDX-License-Identifier: GPL-3.0-or-later
// The flux through a cyclic pair is that at its planes, not the mean over the sections between them
#include "capturedLog.H"
#include "relative.H"
#include "cyclicPair.H"
#include "scene.H"

#include <doctest/doctest.h>

using namespace scene;

namespace
{

constexpr scalar L = 4, H = 1, dx = 0.1, support = 0.26;

// u = 1 + cos(2 pi x/L) along x, on a shifted lattice
particleCloud channel(const vector& shift)
{
    particleCloud cloud = fluid(
        lattice(
            dx, {0, 0, 0}, {L, H, 0},
            [](const vector& x) { return x[0] > 0 && x[0] < L && x[1] > 0 && x[1] < H; }, 2, shift),
        dx, 2);
    for (label i = 0; i < cloud.n(); ++i)
        cloud.Up[i].setXyz({1 + std::cos(2 * M_PI * cloud.x[i][0] / L), 0.3, 0});
    return cloud;
}

}  // namespace

TEST_CASE("the flux through a cyclic pair: with the separation, in the log beside the sum")
{
    // mean of cos with a hat function of half width a
    const scalar q = M_PI * 2 * support / L, exact = H * (1 + std::pow(std::sin(q) / q, 2));
    const folder files;
    const word walls =
        "lid { type wall; surface plane; representation mirror; point (0 1 0); normal (0 1 0);"
        "motion { velocity (0 0.1 0); } }"
        "floor { type wall; surface plane; representation mirror; point (0 0 0); normal (0 -1 0); "
        "}";
    for (const scalar way : {1, -1})
        for (const scalar shift : {0.0, 0.03})
        {
            particleCloud cloud = channel({shift, 0, 0});
            const word ends = "ends { type cyclic; point (" + str(way > 0 ? 0 : L) +
                              " 0 0); separation (" + str(way * L) + " 0 0); }";
            boundary b(files.path, dictionary::fromString(walls + ends), cloud, support);
            b.setStep(0, 0.01);
            b.exchange(cloud, 0.01);
            const patchBalance& passed = b.balance()[2];
            CHECK(passed.flux == relative(way * exact, 0.005));
            CHECK(passed.volume == relative(0.01 * passed.flux, 1e-12));
            capturedLog log;
            b.printBalance(cloud);
            CHECK(log.contains(
                "patch flux [m2/s, out]: lid 0.4, sum 0.4; [m2/s, along the separation]: ends " +
                str(passed.flux) + "\n"));
        }
}

TEST_CASE("what lies beyond an open face does not count")
{
    particleCloud cloud = channel({0, 0, 0});
    const cyclicPair pair = {"ends", {0, 0, 0}, {L, 0, 0}};
    const scalar all = pair.flux(cloud, support);
    cloud.pFixed.assign(size_t(cloud.n()), 0);
    for (label i = 0; i < cloud.n(); ++i) cloud.pFixed[i] = cloud.x[i][1] > 0.5;
    CHECK(pair.flux(cloud, support) == relative(0.5 * all, 1e-12));
}
