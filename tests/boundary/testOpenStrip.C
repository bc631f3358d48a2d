// SPDX-License-Identifier: GPL-3.0-or-later
// The strip beyond an open face takes velocity, pressure and slope from the fluid before it
#include "relative.H"
#include "scene.H"
#include <doctest/doctest.h>

using namespace scene;

namespace
{

constexpr scalar top = 16, given = 100, rho = 1000, dt = 0.1;

// A column of fluid from z = bottom up to the open face at z = 16, two layers beyond it.  From x = otherFrom on it is zone `other`
struct column
{
    folder f;
    particleCloud cloud;
    std::unique_ptr<boundary> b;

    explicit column(scalar bottom,
                    const word& xLow = "type cyclic; point (0 0 0); separation (12 0 0);",
                    scalar otherFrom = 12)
    {
        const auto within = [](const vector& x) {
            return x[0] > 0 && x[0] < 12 && x[1] > 0 && x[1] < 12;
        };
        const auto layers = [&](scalar from, scalar to) {
            return lattice(1, {0, 0, from}, {12, 12, to},
                           [&](const vector& x) { return within(x) && x[2] > from && x[2] < to; });
        };
        const List<vector> beyond = layers(top, top + 1.6);
        List<vector> all = layers(bottom, top);
        all.insert(all.end(), beyond.begin(), beyond.end());
        f.surface("top", sheet({0, 0, top}, {12, 0, 0}, {0, 12, 0}, 4));
        f.points("openSites.hdf", {{"top", beyond}});
        cloud = fluid(all, 1);
        cloud.zones.push_back({"other", phaseType::fluid, false});
        for (label i = 0; i < cloud.n(); ++i) cloud.zone[i] = cloud.x[i][0] > otherFrom;
        const word sides = "xLow { " + xLow +
                           " }"
                           "yLow { type cyclic; point (0 0 0); separation (0 12 0); }";
        b = std::make_unique<boundary>(
            f.path, dictionary::fromString(sides + "top { type open; p " + str(given) + "; }"),
            cloud, 2.6);
        b->setStep(0, dt);
    }

    scalar depth(label i) const { return cloud.x[i][2] - top; }
    // checks p of the strip over p of its face, at a depth of one metre
    void checkSlope(scalar expected)
    {
        for (label i = 0; i < cloud.n(); ++i)
        {
            CHECK(bool(cloud.pFixed[i]) == (depth(i) > 0));
            if (depth(i) > 0) CHECK(cloud.pGiven[i] - given == relative(expected * depth(i), 1e-9));
        }
    }
};

}  // namespace

TEST_CASE(
    "the pressure's slope beyond an open face is that of body force, acceleration and friction")
{
    column c(0);
    const List<vector> g = {{0, 0, -9.81}};
    c.b->setFlags(c.cloud, rho, g);
    c.checkSlope(-9.81 * rho);

    // the friction near the face belongs to the strip; the acceleration is that of the next three layers
    List<vec4> friction(c.cloud.n());
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        c.cloud.Up[i] = vec4::from({0.3, 0, c.depth(i) > -3 ? 0.2 : 0});
        friction[i] = vec4::from({7, 0, c.depth(i) > -2.4 ? 1000.0 : -40.0});
    }
    c.b->setOpenVelocity(c.cloud, friction, rho, dt);
    c.b->setFlags(c.cloud, rho, g);
    c.checkSlope(-9.81 * rho - rho * 0.2 / dt - 40);
}

TEST_CASE("two layers of fluid before an open face tell no friction")
{
    column c(top - 2);
    c.b->setFlags(c.cloud, rho, {});
    for (label i = 0; i < c.cloud.n(); ++i) c.cloud.Up[i] = vec4::from({0, 0, 0.2});
    c.b->setOpenVelocity(c.cloud, List<vec4>(c.cloud.n(), vec4::from({0, 0, 1000})), rho, dt);
    c.b->setFlags(c.cloud, rho, {});
    c.checkSlope(-rho * 0.2 / dt);
}

TEST_CASE("the strip follows the fluid before it, of its own zone where the face has sites of both")
{
    column both(0, "type cyclic; point (0 0 0); separation (12 0 0);", 9), one(0);
    for (column* c : {&both, &one})
    {
        c->b->setFlags(c->cloud, rho, {});
        for (label i = 0; i < c->cloud.n(); ++i)
        {
            const bool other = c->cloud.x[i][0] > 9, beyond = c->depth(i) > 0;
            // fluid of a zone without sites comes to the face
            if (c == &one && other && !beyond) c->cloud.zone[i] = 1;
            c->cloud.Up[i] = vec4::from({0, 0, beyond ? 7.0 : other ? 2.0 : 1.0});
        }
        c->b->setOpenVelocity(c->cloud, List<vec4>(c->cloud.n(), vec4{}), rho, dt);
        const auto strip = [&](scalar x) {
            for (label i = 0; i < c->cloud.n(); ++i)
                if (c->depth(i) > 0 && std::abs(c->cloud.x[i][0] - x) < 0.1)
                    return c->cloud.Up[i][2];
            return scalar(0);
        };
        CHECK(strip(5.5) == relative(1, 1e-12));
        if (c == &both)
        {
            CHECK(strip(8.5) == relative(1, 1e-12));
            CHECK(strip(9.5) == relative(2, 1e-12));
        }
        else
        {
            // it counts as the fluid of the face: no jump between the two
            CHECK(strip(8.5) > 1.02);
            CHECK(strip(9.5) < 1.98);
        }
    }
}

TEST_CASE("the strip carries as much of Poiseuille's flow as the fluid before it")
{
    column c(0);
    c.b->setFlags(c.cloud, rho, {});
    const auto flow = [&](const auto& isOf) {
        scalar sum = 0, n = 0;
        for (label i = 0; i < c.cloud.n(); ++i)
            if (isOf(c.depth(i))) sum += c.cloud.Up[i][2], ++n;
        return sum / n;
    };
    for (label i = 0; i < c.cloud.n(); ++i)
        c.cloud.Up[i] = vec4::from({0, 0, c.cloud.x[i][0] * (12 - c.cloud.x[i][0])});
    c.b->setOpenVelocity(c.cloud, List<vec4>(c.cloud.n(), vec4{}), rho, dt);
    const scalar before = flow([](scalar depth) { return depth < 0; });
    CHECK(flow([](scalar depth) { return depth > 0; }) == relative(before, 0.001));
}

TEST_CASE("near an open face: 0.6 dx before it; beyond its strip there is nothing")
{
    column c(0);
    c.b->setFlags(c.cloud, rho, {});
    label nearWrong = 0, beyondWrong = 0;
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        nearWrong += c.b->nearOpen(i) != (c.depth(i) > -0.6);
        for (const scalar reach : {1.9, 3.0})
            beyondWrong += c.b->reachesBeyondOpen(i, reach) != (c.depth(i) > 2 - reach);
    }
    CHECK(nearWrong == 0);
    CHECK(beyondWrong == 0);
}

TEST_CASE("the area of an open face is what a wall that moves along it has not passed over")
{
    column c(0,
             "type wall; surface plane; point (0 0 0); normal (-1 0 0); "
             "motion { displacement table ((0 (0 0 0)) (0.1 (3 0 0)) (0.2 (4.5 0 0))); }");
    for (const scalar passed : {0.0, 3.0, 4.5})
    {
        CAPTURE(passed);
        c.b->setFlags(c.cloud, rho, {});
        REQUIRE(c.cloud.stripArea.size() == 2);
        CHECK(c.cloud.stripArea[1][2] == relative(12 * (12 - passed), 0.01));
        const scalar now = passed == 0 ? 0.1 : 0.2;
        c.b->exchange(c.cloud, now), c.b->setStep(now, now + 0.1);
    }
}
