// SPDX-License-Identifier: GPL-3.0-or-later
// Profiles of a given flow rate.  The largest velocity over the mean is 2 in a circle, 2.0963 in a square (the series of
// Poiseuille's flow in a duct), 3/2 between plates closed by slip walls.  A quarter has a quarter of the flow.  Tables of
// r/R
#include "core/errorOf.H"
#include "inflow.H"
#include "relative.H"
#include "scene.H"

#include <cmath>
#include <complex>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, R = 10 * dx;

struct face
{
    particleCloud cloud;
    imageGroup group;
    faceMesh mesh;

    face(const triSurface& surface, bool quarter)
        : cloud(scene::fluid({{dx, dx, -dx}, {R, R, -dx}}, dx))
    {
        if (quarter)
            group.addSymmetryPlane("x", {0, 0, 0}, {-1, 0, 0}),
                group.addSymmetryPlane("y", {0, 0, 0}, {0, -1, 0});
        group.close(cloud, 2.6 * dx);
        mesh = faceMesh(surface, group, cloud);
    }
    inflow given(
        const word& text, faceMesh::heldRim held = [](const vector&) { return true; },
        scalar nu = 1e-6) const
    {
        inflow q(dictionary::fromString(text), ".",
                 {mesh, held, group.symmetryFactor(), mesh.normal(), dims::flowRate, nu});
        q.setStep(0, 1);
        return q;
    }
};

triSurface disc()
{
    return scene::parametric(
        [](scalar r, scalar a) -> vector {
            return {R * r * std::cos(2 * M_PI * a), R * r * std::sin(2 * M_PI * a), 0};
        },
        4, 96,
        [](const vector&) -> vector {
            return {0, 0, 1};
        });
}

}  // namespace

TEST_CASE(
    "a parabolic profile is Poiseuille's, of a circle, a quarter of it, a square, and between "
    "plates")
{
    const word text = "flowRate 1e-6; profile parabolic;";
    for (const bool quarter : {false, true})
    {
        const face f(disc(), quarter);
        const inflow q = f.given(text);
        const scalar mean = 1e-6 / (M_PI * R * R);
        CHECK(q.mean() == relative(mean, 2e-3));
        for (const scalar r : {0.0, 0.3, 0.6, 0.9})
        {
            const vector u =
                q.velocity({r * R / std::sqrt(2.0), r * R / std::sqrt(2.0), 0}, {0, 0, 1});
            CHECK(-u[2] == relative(2 * mean * (1 - r * r), 0.03));
            CHECK(std::hypot(u[0], u[1]) == 0);
        }
    }
    const face square(scene::sheet({0, 0, 0}, {R, 0, 0}, {0, R, 0}), false);
    const vector middle(R / 2, R / 2, 0), n(0, 0, 1);
    CHECK(-square.given(text).velocity(middle, n)[2] == relative(2.0963 * 1e-6 / (R * R), 0.01));
    const auto plates = [](const vector& x) { return x[1] < dx / 10 || x[1] > R - dx / 10; };
    CHECK(-square.given(text, plates).velocity(middle, n)[2] ==
          relative(1.5 * 1e-6 / (R * R), 0.01));
}

TEST_CASE("a profile by table, a direction, a vector, and what cannot be")
{
    const face f(disc(), false);
    const vector n(0, 0, 1);
    const inflow cone = f.given("velocity 0.1; profile table ((0 1) (1 0));");  // 1 - r/R: mean 1/3
    CHECK(-cone.velocity({0.5 * R, 0, 0}, n)[2] == relative(0.1 * 3 * 0.5, 0.03));
    const inflow skew = f.given("velocity 0.1; direction (1 0 -1);");
    CHECK((skew.velocity({0, 0, 0}, n) - vector(0.1, 0, -0.1)).norm() < 1e-12);
    const inflow whole = f.given("velocity (0.2 0 -0.1);");
    CHECK((whole.velocity({0, 0, 0}, n) - vector(0.2, 0, -0.1)).norm() < 1e-12);
    CHECK(whole.mean() == relative(0.1, 1e-9));

    for (const word v :
         {"table ((0 (0 0 0)) (1 (0.4 0 -0.2)))", "{ type polynomial; coeffs (((0.4 0 -0.2) 1)); }",
          "{ type scale; scale { type linearRamp; duration 1; } value (0.4 0 -0.2); }"})
    {
        const inflow grows = f.given("velocity " + v + (v[0] == '{' ? "" : ";"));
        CHECK((grows.velocity({0, 0, 0}, n) - vector(0.2, 0, -0.1)).norm() < 1e-12);
    }
    CHECK_ERROR(f.given("velocity table ((0 (0 0 1)) (1 (1 0 1)));"),
                "direction of the velocity changes", 1);
    CHECK_ERROR(f.given("velocity table ((0 0.1) (1 x));"), "finite number is wanted", 1);

    // errors of a vector are reported too
    CHECK_ERROR(
        f.given("velocity { type table; values ((0 (1 0 0)) (1 (1 0 0))); units ([s] [m]); }"),
        "Nor is it a vector over time: ", 1);

    CHECK_THROWS_AS(f.given("velocity 0.1; direction (1 0 0);"), fatalError);  // along the face
    CHECK_THROWS_AS(f.given("velocity 0.1; direction (0 0 1);"), fatalError);  // out of the fluid
    CHECK_THROWS_AS(f.given("velocity 0.1; profile round;"), fatalError);
    CHECK_THROWS_AS(f.given("flowRate 1 [m/s];"), fatalError);
    CHECK_THROWS_AS(inflow::given(dictionary::fromString("p 0; velocity 1;")), fatalError);
    CHECK_THROWS_AS(inflow::given(dictionary::fromString("profile flat;")), fatalError);
}

namespace
{

using complexNumber = std::complex<scalar>;

// Bessel's function of order 0 or 1 by its power series
complexNumber Bessel(int order, complexNumber z)
{
    complexNumber term = order == 0 ? complexNumber(1) : 0.5 * z, sum = term;
    for (int k = 1; k < 60; ++k) term *= -0.25 * z * z / scalar(k * (k + order)), sum += term;
    return sum;
}

}  // namespace

// J. R. Womersley 1955, J. Physiol. 127: w over the mean velocity for the flow Re(exp(i omega t))
TEST_CASE(
    "profile Womersley: an oscillating flow in a pipe, a quarter of it and between plates; a "
    "restart continues it")
{
    constexpr scalar frequency = 1, alpha = 4, nu = R * R * 2 * M_PI * frequency / (alpha * alpha);
    const complexNumber I(0, 1), L = std::pow(I, 1.5) * alpha;
    const auto inPipe = [&](scalar r) {
        return (Bessel(0, L) - Bessel(0, L * r)) / (Bessel(0, L) - 2.0 * Bessel(1, L) / L);
    };
    const auto betweenPlates = [&](scalar y) {  // y from -1 to 1, half the distance is R/2
        const complexNumber l = std::sqrt(I) * alpha / 2.0;
        return (1.0 - std::cosh(l * y) / std::cosh(l)) / (1.0 - std::tanh(l) / l);
    };
    const vector n(0, 0, 1);
    constexpr int perPeriod = 200;
    const word text = "velocity { type sine; amplitude 0.1; frequency 1; } profile Womersley;";
    const auto run = [&](inflow& q, const auto& exact, const auto& pointAt, bool restarts) {
        List<scalar> kept;
        scalar worst = 0;
        for (int step = 0; step < 4 * perPeriod; ++step)
        {
            const scalar dt = 1 / (frequency * perPeriod), t = step * dt;
            q.setStep(t, t + dt);
            const List<scalar> first = q.develop(kept);
            if (restarts) CHECK(q.develop(kept) == first);  // a step that is repeated
            kept = first;
            CHECK(q.develop(kept) == first);  // after it has been accepted
            if (step < 3 * perPeriod) continue;
            const complexNumber phase = -I * std::exp(I * (2 * M_PI * frequency * (t + dt / 2)));
            for (const scalar at : {0.0, 0.3, 0.6, 0.9})
                worst = std::max(worst, std::abs(-q.velocity(pointAt(at), n)[2] -
                                                 0.1 * (exact(at) * phase).real()));
        }
        return worst / 0.1;
    };
    for (const bool quarter : {false, true})
    {
        const face f(disc(), quarter);
        inflow q = f.given(
            text, [](const vector&) { return true; }, nu);
        const auto at = [](scalar r) -> vector { return {r * R * 0.8, r * R * 0.6, 0}; };
        CHECK(run(q, inPipe, at, quarter) < 0.03);
        CHECK(q.speed() > 10 * std::abs(q.mean()));  // the flow turns, the profile does not
    }
    const face square(scene::sheet({0, 0, 0}, {R, 0, 0}, {0, R, 0}), false);
    inflow q = square.given(
        text, [](const vector& x) { return x[1] < dx / 10 || x[1] > R - dx / 10; }, nu);
    const auto at = [](scalar y) -> vector { return {R / 2, R / 2 * (1 + y), 0}; };
    CHECK(run(q, betweenPlates, at, false) < 0.03);
}
