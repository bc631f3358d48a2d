// SPDX-License-Identifier: GPL-3.0-or-later
// The step by the change of the pairs, (8.46), where it is known: layers of a periodic square slide along each other with
//     u = drift + (f sin 2 pi y, 0)
// in a square of side 1.  Their largest rate of change is 2 pi f, for any spacing and any drift
#include "boxCase.H"
#include "capturedErrors.H"
#include "relative.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar f = 0.1, rate = 2 * M_PI * f;

// The square at its start
struct slidingLayers
{
    runningBox run;

    slidingLayers(int n, const vector& drift) : run(square(n))
    {
        particleCloud& cloud = run.c.cloud;
        for (label i = 0; i < cloud.n(); ++i)
            cloud.Up[i] = vec4::from(drift + vector(f * std::sin(2 * M_PI * cloud.x[i][1]), 0, 0));
    }
    static boxCase square(int n)
    {
        boxCase box;
        box.nx = box.ny = n, box.dx = 1. / n, box.mu = 1e-3, box.coupling = "monolithic";
        box.patch = {"type cyclic;", "", "type cyclic;", ""}, box.control = "adjustTimeStep yes;";
        return box;
    }
    // True if the step was accepted
    bool step(scalar dt)
    {
        const capturedErrors errors;
        const scalar t = run.time.value();
        run.time.setDeltaT(dt);
        ++run.time;
        return run.scheme->step(t, dt);
    }
};

}  // namespace

TEST_CASE("the step follows the change of the pairs, for any spacing and any drift")
{
    for (const int n : {20, 40})
        for (const vector& drift : {vector(0, 0, 0), vector(0.3, -0.2, 0)})
        {
            CAPTURE(n);
            CAPTURE(drift[0]);
            slidingLayers layers(n, drift);
            const auto first = layers.run.scheme->limit();
            CHECK(first.rule == "CFL");  // no step tells yet how pairs change
            REQUIRE(layers.step(first.dt));
            const auto next = layers.run.scheme->limitAt(layers.run.time.value());
            CHECK(next.rule == "deformation");
            CHECK(next.dt == doctest::Approx(0.4 / rate).epsilon(0.1));
        }
}

TEST_CASE("a step in which pairs change too much is refused, however far all move together")
{
    for (const vector& drift : {vector(0, 0, 0), vector(0.3, -0.2, 0)})
    {
        CAPTURE(drift[0]);
        CHECK(slidingLayers(40, drift).step(0.5 / rate));
        CHECK_FALSE(slidingLayers(40, drift).step(0.8 / rate));
    }
}
