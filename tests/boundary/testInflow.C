// SPDX-License-Identifier: GPL-3.0-or-later
// Profiles of a given flow rate.  The largest velocity over the mean is 2 in a circle, 2.0963 in a square (the series of
// Poiseuille's flow in a duct), 3/2 between plates closed by slip walls.  A quarter has a quarter of the flow.  Tables of
// r/R
#include "core/errorOf.H"
#include "inflow.H"
#include "relative.H"
#include "scene.H"

#include <cmath>
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
        const word& text, faceMesh::heldRim held = [](const vector&) { return true; }) const
    {
        inflow q(dictionary::fromString(text), ".",
                 {mesh, held, group.symmetryFactor(), mesh.normal(), dims::flowRate});
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
    CHECK_ERROR(f.given("velocity table ((0 (0 0 1)) (1 (1 0 1)));"), "direction of the velocity changes", 1);
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
