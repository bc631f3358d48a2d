// SPDX-License-Identifier: GPL-3.0-or-later
// Ten flow reversals through open faces of every shape, with a prescribed divergence-free velocity.
// The zone must keep its number of particles and must have no gap.
#include <doctest/doctest.h>
#include "pointGrid.H"
#include <set>
#include "scene.H"

using namespace scene;

namespace
{

struct reversal
{
    std::map<word, triSurface> open;
    word otherPatches;                              // dictionary text
    region column;                                  // inside all other patches
    std::function<scalar(const vector&)> depth;     // beyond the open faces
    vector low, high;                               // box of the zone
    std::function<vector(const vector&)> velocity;  // times cos(2 pi t): displacement ~ 1/(2 pi)
    vector shift = vector::Zero();                  // of the lattice
    triSurface walls;                               // patch walls, may be empty
    scalar swept = 0;                               // no gaps are searched up to this height
};

struct outcome
{
    scalar before, after;
    scalar hole = 0;  // [dx], largest distance of a point of the zone from a particle
    label created, deleted;
    bool idsDiffer;
};

outcome run(const reversal& r, int cycles, int stepsPerCycle)
{
    const scalar dx = 1;
    folder f;
    const vector margin = vector::Constant(3 * dx);
    word text = r.otherPatches;
    const auto beyond = lattice(
        dx, r.low - margin, r.high + margin,
        [&](const vector& x) { return r.column(x) && r.depth(x) > 0 && r.depth(x) < 1.6; }, 3,
        r.shift);
    std::map<word, List<vector>> sites;
    for (const auto& [name, surface] : r.open)
    {
        f.surface(name, surface);
        sites[name] = beyond;
        text += name + " { type open; p 0; }\n";
    }
    f.points("openSites.hdf", sites);
    if (!r.walls.empty()) f.surface("walls", r.walls);
    const auto inZone = [&](const vector& x) { return r.column(x) && r.depth(x) <= 0; };
    List<vector> all = lattice(dx, r.low - margin, r.high + margin, inZone, 3, r.shift);
    all.insert(all.end(), beyond.begin(), beyond.end());
    particleCloud cloud = fluid(all, dx);
    boundary b(f.path, dictionary::fromString(text), cloud, 2.6 * dx);

    // smoothed over two spacings, so that layers of the lattice do not count all at once
    const auto volume = [&] {
        scalar sum = 0;
        for (label i = 0; i < cloud.n(); ++i)
            sum += std::clamp(0.5 - 0.5 * r.depth(cloud.x[i].xyz()) / dx, 0.0, 1.0);
        return sum;
    };
    outcome o;
    o.before = volume();
    const scalar dt = 1.0 / stepsPerCycle;
    std::mt19937 random(1);
    std::uniform_real_distribution<scalar> unit(0, 1);
    for (int step = 0; step < cycles * stepsPerCycle; ++step)
    {
        const scalar t = step * dt;
        b.setStep(t, t + dt);
        b.setFlags(cloud, 1000, {});
        cloud.sortFluid(2.6 * dx);
        for (label i = 0; i < cloud.n(); ++i)
        {
            const vector x = cloud.x[i].xyz();
            const vector u = std::cos(2 * M_PI * (t + 0.5 * dt)) * r.velocity(x);
            const vector mid = x + 0.5 * dt * u;
            const vector v = std::cos(2 * M_PI * (t + 0.5 * dt)) * r.velocity(mid);
            cloud.Up[i] = vec4::from(v), cloud.x[i].setXyz(x + dt * v);
        }
        b.exchange(cloud, t + dt);
        if (step % 15) continue;
        b.updateGhosts(cloud);
        pointGrid near(2 * dx);
        for (label i = 0; i < cloud.nAll(); ++i) near.add(cloud.x[i].xyz());
        for (int k = 0; k < 5000; ++k)
        {
            vector x;
            for (int d = 0; d < 3; ++d) x[d] = r.low[d] + unit(random) * (r.high[d] - r.low[d]);
            if (inZone(x) && x[2] > r.swept)
                o.hole = std::max(o.hole, near.nearest(x, 2 * dx) / dx);
        }
    }
    o.after = volume();
    o.created = o.deleted = 0;
    for (const patchBalance& p : b.balance()) o.created += p.created, o.deleted += p.deleted;
    const std::set<globalId> ids(cloud.id.begin(), cloud.id.end());
    o.idsDiffer = label(ids.size()) == cloud.n();
    return o;
}

const char* sidesXY =
    "xLow { type cyclic; point (0 0 0); separation (12 0 0); }"
    "yLow { type cyclic; point (0 0 0); separation (0 12 0); }";

reversal flatScene()
{
    reversal r;
    r.low = {0, 0, 0}, r.high = {12, 12, 16};
    const auto column = [](const vector& x) {
        return x[0] > 0 && x[0] < 12 && x[1] > 0 && x[1] < 12;
    };
    r.column = column;
    r.depth = [](const vector& x) { return std::max(-x[2], x[2] - 16); };
    r.open["top"] = sheet({0, 0, 16}, {12, 0, 0}, {0, 12, 0}, 4);
    r.open["bottom"] = sheet({0, 0, 0}, {0, 12, 0}, {12, 0, 0}, 4);
    r.otherPatches = sidesXY;
    return r;
}

reversal obliqueScene()
{
    reversal r;
    r.low = {0, 0, 0}, r.high = {12, 12, 22};
    const auto column = [](const vector& x) {
        return x[0] > 0 && x[0] < 12 && x[1] > 0 && x[1] < 12;
    };
    const scalar c = 1 / std::sqrt(1.25);
    r.column = column;
    r.depth = [=](const vector& x) { return std::max(-x[2], (x[2] - 16 - 0.5 * x[0]) * c); };
    r.open["top"] = sheet({0, 0, 16}, {12, 0, 6}, {0, 12, 0}, 4);
    r.open["bottom"] = sheet({0, 0, 0}, {0, 12, 0}, {12, 0, 0}, 4);
    r.otherPatches =
        "x0 { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
        "x1 { type symmetryPlane; point (12 0 0); normal (1 0 0); }"
        "yLow { type cyclic; point (0 0 0); separation (0 12 0); }";
    return r;
}

reversal domeScene()
{
    reversal r;
    const scalar R = 12;
    r.low = {0, 0, 0}, r.high = {R, R, 8 + R};
    const auto quarter = [](const vector& x) { return x[0] > 0 && x[1] > 0; };
    const auto depth = [=](const vector& x) {
        const scalar rho = std::hypot(x[0], x[1]);
        return x[2] < 8 ? rho - R : std::hypot(rho, x[2] - 8) - R;
    };
    r.column = quarter;
    r.depth = [=](const vector& x) { return std::max(-x[2], depth(x)); };
    const auto outward = [](const vector& x) {
        return vector(x[0], x[1], std::max(0.0, x[2] - 8));
    };
    triSurface dome = parametric(
        [=](scalar s, scalar t) {
            return vector(R * std::cos(0.5 * M_PI * t) * std::cos(0.5 * M_PI * s),
                          R * std::cos(0.5 * M_PI * t) * std::sin(0.5 * M_PI * s),
                          8 + R * std::sin(0.5 * M_PI * t));
        },
        32, 32, outward);
    dome.append(parametric(
        [=](scalar s, scalar t) {
            return vector(R * std::cos(0.5 * M_PI * s), R * std::sin(0.5 * M_PI * s), 8 * t);
        },
        32, 8, outward));
    r.open["dome"] = dome;
    r.open["bottom"] = sheet({0, 0, 0}, {0, R + 3, 0}, {R + 3, 0, 0}, 4);
    r.otherPatches =
        "x0 { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
        "y0 { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
    return r;
}

reversal cylinderScene()
{
    reversal r;
    const scalar R = 9, H = 16;
    r.low = {-R, -R, 0}, r.high = {R, R, H};
    const auto rho = [](const vector& x) { return std::hypot(x[0], x[1]); };
    r.column = [](const vector&) { return true; };
    r.depth = [=](const vector& x) {
        const scalar a = rho(x) - R, b = std::max(-x[2], x[2] - H);
        return std::max(a, b) < 0 ? std::max(a, b) : std::hypot(std::max(a, 0.0), std::max(b, 0.0));
    };
    const auto outward = [=](const vector& x) { return vector(x[0], x[1], 0); };
    triSurface s = parametric(
        [=](scalar p, scalar t) {
            return vector(R * std::cos(2 * M_PI * p), R * std::sin(2 * M_PI * p), H * t);
        },
        96, 8, outward);
    for (const scalar z : {0.0, H})
        s.append(parametric(
            [=](scalar p, scalar t) {
                return vector(R * t * std::cos(2 * M_PI * p), R * t * std::sin(2 * M_PI * p), z);
            },
            96, 4, [=](const vector&) { return vector(0, 0, z > 0 ? 1 : -1); }));
    r.open["outside"] = s;
    r.shift = {0.1, 0.2, 0.3};
    return r;
}

// A duct between two walls that end at an oblique face; the other two sides are symmetry planes
reversal ductScene()
{
    reversal r;
    r.low = {0, 0, 0}, r.high = {12, 12, 22};
    r.column = [](const vector& x) { return x[0] > 0 && x[0] < 12 && x[1] > 0 && x[1] < 12; };
    const scalar c = 1 / std::sqrt(1.25);
    r.depth = [=](const vector& x) { return std::max(-x[2], (x[2] - 16 - 0.5 * x[0]) * c); };
    r.open["top"] = sheet({0, 0, 16}, {12, 0, 6}, {0, 12, 0}, 4);
    r.open["bottom"] = sheet({0, 0, 0}, {0, 12, 0}, {12, 0, 0}, 4);
    r.walls = sheet({0, 0, 0}, {0, 0, 16}, {0, 12, 0}, 4);
    r.walls.append(sheet({12, 0, 0}, {0, 12, 0}, {0, 0, 22}, 4));
    r.otherPatches =
        "walls { type wall; representation mirror; }"
        "y0 { type symmetryPlane; point (0 0 0); normal (0 -1 0); }"
        "y1 { type symmetryPlane; point (0 12 0); normal (0 1 0); }";
    // no slip
    r.velocity = [](const vector& x) -> vector {
        return {0, 0, 2 * M_PI * 3.5 * x[0] * (12 - x[0]) / 36};
    };
    return r;
}

reversal uniform(reversal r, const vector& displacement)
{
    r.velocity = [=](const vector&) -> vector { return 2 * M_PI * displacement; };
    return r;
}

// Ten reversals; the displacement swings by the given number of spacings to both sides
outcome tenReversals(const reversal& r, const vector& displacement)
{
    return run(uniform(r, displacement), 5, 40);
}

void check(const outcome& o)
{
    CAPTURE(o.before);
    CAPTURE(o.after);
    CHECK(std::abs(o.after / o.before - 1) < 0.005);
    CHECK(o.hole < 1.3);
    CHECK(o.created > 1000);
    CHECK(o.idsDiffer);
}

}  // namespace

TEST_CASE("ten reversals through flat faces")
{
    check(tenReversals(flatScene(), {0, 0, 3}));
}

TEST_CASE("ten reversals through an oblique face between symmetry planes")
{
    check(tenReversals(obliqueScene(), {0, 0, 2.5}));
}

TEST_CASE("ten reversals through a dome in a quarter model")
{
    check(tenReversals(domeScene(), {0, 0, 2.5}));
}

TEST_CASE("ten reversals across a cylinder with lids")
{
    check(tenReversals(cylinderScene(), {2, 0, -1.5}));
}

// A wall that moves with the fluid comes as near as 4 dx to the face.  The fluid that it displaces from the layer
// before the face must not count as missing
TEST_CASE("ten reversals between an open face and a piston")
{
    reversal r = flatScene();
    r.open.erase("bottom");
    r.otherPatches =
        sidesXY +
        word(
            "base { type wall; representation mirror; surface plane;"
            "point (0 0 0); normal (0 0 -1); motion { direction (0 0 1);"
            "displacement { type sine; t0 0; frequency 1; amplitude 8; level 0; scale 1; } } }");
    r.depth = [](const vector& x) { return x[2] - 12; };
    r.column = [](const vector& x) {
        return x[0] > 0 && x[0] < 12 && x[1] > 0 && x[1] < 12 && x[2] > 0;
    };
    r.swept = 8;
    r.open["top"] = sheet({0, 0, 12}, {12, 0, 0}, {0, 12, 0}, 4);
    r.high[2] = 12;
    check(run(uniform(r, {0, 0, 8}), 5, 120));
}

TEST_CASE("ten reversals between walls with no slip, through an oblique face")
{
    check(run(ductScene(), 5, 60));
}
