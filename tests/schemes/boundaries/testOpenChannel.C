// SPDX-License-Identifier: GPL-3.0-or-later
// A pressure drives the fluid of a channel through open faces at both ends, to and fro or in one direction.  The
// channel must keep its volume, and no gap may open.  One face is flat, the other has any shape.  Between two flat
// faces the steady flow is Poiseuille's.
#include "boundary/scene.H"
#include "boxCase.H"
#include "relative.H"
#include "widestGap.H"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, length = 40 * dx, height = 24 * dx;

struct face
{
    triSurface surface;
    std::function<scalar(const vector&)> depth;
};

// A face at x = length at the lower wall and, if oblique, further right at the upper wall
face straightFace(scalar lean)
{
    face f;
    f.surface = scene::sheet({length, 0, -2 * dx}, {lean, height, 0}, {0, 0, 4 * dx}, 4);
    const vector normal = vector(height, -lean, 0).normalized();
    f.depth = [=](const vector& x) { return (x - vector(length, 0, 0)).dot(normal); };
    return f;
}

// An arc that bulges outward, about (centre, height/2)
face curvedFace()
{
    const scalar R = 0.75 * height, half = std::asin(0.5 * height / R);
    const vector centre(length - R * std::cos(half), 0.5 * height, 0);
    face f;
    f.surface = scene::parametric(
        [=](scalar s, scalar t) -> vector {
            const scalar a = half * (2 * s - 1);
            return centre + R * vector(std::cos(a), std::sin(a), 0) +
                   vector(0, 0, (4 * t - 2) * dx);
        },
        24, 2,
        [=](const vector& x) -> vector {
            return {x[0] - centre[0], x[1] - centre[1], 0};
        });
    f.depth = [=](const vector& x) {
        const vector r(x[0] - centre[0], x[1] - centre[1], 0);
        return r[0] > 0 ? r.norm() - R : -R;
    };
    return f;
}

struct scenario
{
    face right;
    word coupling = "projection", kind = "particles", pressure = "0;";
    scalar mu = 0.05;

    static bool inside(const vector& x) { return x[1] > 0 && x[1] < height; }
    scalar depth(const vector& x) const { return std::max(-x[0], right.depth(x)); }
};

word patch(const word& name, const word& type, const vector& point, const vector& normal)
{
    const auto text = [](const vector& v) {
        return "(" + str(v[0], 17) + " " + str(v[1], 17) + " " + str(v[2], 17) + ")";
    };
    return name + " { " + type + " point " + text(point) + "; normal " + text(normal) + "; }";
}

void addPoints(particleTable& t, const List<vector>& points)
{
    for (const vector& x : points)
    {
        t.x.push_back(x), t.vectors["U"].push_back(vector::Zero()), t.scalars["p"].push_back(0);
        t.integers["id"].push_back(globalId(t.x.size()) - 1), t.integers["zone"].push_back(0);
    }
}

void write(const scenario& s, caseOnDisk& files)
{
    const word wall = "type wall; surface plane; representation " + s.kind + ";";
    files.boundary =
        patch("bottom", wall, {0, 0, 0}, {0, -1, 0}) +
        patch("top", wall, {0, height, 0}, {0, 1, 0}) +
        patch("left", "type open; surface plane; p " + s.pressure, {0, 0, 0}, {-1, 0, 0}) +
        "right { type open; p 0; }";
    files.properties = "rho 1000; mu " + str(s.mu) + ";";
    files.schemes = "kernel WendlandC2; hByDx 1.3;";
    files.solution = "coupling " + s.coupling + "; densityFeedback 1;";
    files.control = "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
    files.fill(0, 0, dx);
    const auto points = [&](scalar from, scalar to) {
        return scene::lattice(
            dx, {-3 * dx, 0, 0}, {length + height, height, 0},
            [&](const vector& x) { return s.inside(x) && s.depth(x) > from && s.depth(x) <= to; },
            2);
    };
    const List<vector> beyond = points(0, 1.6 * dx);
    addPoints(files.particles(), points(-length, 0)), addPoints(files.particles(), beyond);
    files.write();
    particleTable sites;
    for (const vector& x : beyond)
        sites.x.push_back(x), sites.integers["patch"].push_back(x[0] > 0);
    sites.attributes["patches"] = "left right";
    writeParticles(sites, files.path() + "/constant/openSites.hdf");
    std::filesystem::create_directories(files.path() + "/constant/triSurface");
    writeSTL(s.right.surface, files.path() + "/constant/triSurface/right.stl");
}

struct running
{
    caseOnDisk files{"openChannel"};
    capturedLog log;
    Time time;
    fsiCase c;
    std::unique_ptr<couplingScheme> scheme;

    explicit running(const scenario& s)
        : time((write(s, files), files.path())), c(time), scheme(couplingScheme::New(c))
    {
    }
};

// Number of particles between the faces, counted smoothly across them
scalar inChannel(const scenario& s, const particleCloud& cloud)
{
    scalar sum = 0;
    for (label i = 0; i < cloud.n(); ++i)
        sum += std::clamp(0.5 - 0.5 * s.depth(cloud.x[i].xyz()) / dx, 0.0, 1.0);
    return sum;
}

// Points between the faces at which fluid is expected
List<vector> spots(const scenario& s)
{
    return scene::lattice(
        0.25 * dx, {0, 0, 0}, {length + height, height, 0},
        [&](const vector& p) { return s.inside(p) && s.depth(p) <= 0; }, 2);
}

// Checks the volume as a mean over the last `counted` steps, because at one instant it scatters with the particles that pass
// the faces.  Checks gaps at all times
void check(const scenario& s, scalar dt, int steps, int counted = 1)
{
    CAPTURE(s.coupling);
    CAPTURE(s.kind);
    running r(s);
    fsiCase& c = r.c;
    const scalar before = inChannel(s, c.cloud);
    scalar gap = 0, way = 0;  // [dx]
    scalar after = 0;
    for (int step = 0; step < steps; ++step)
    {
        runSteps(c, *r.scheme, dt, 1);
        scalar u = 0;
        for (label i = 0; i < c.cloud.n(); ++i) u += c.cloud.Up[i][0] / c.cloud.n();
        way += dt * std::abs(u) / dx;
        if (step % 10 == 0) gap = std::max(gap, widestGap(c, spots(s)));
        if (step >= steps - counted) after += inChannel(s, c.cloud) / counted;
    }
    CHECK(way > 50);
    MESSAGE("number over that at the start, less 1: ", after / before - 1);
    CHECK(std::abs(after / before - 1) < 0.005);
    CHECK(gap < 1.3);
}

// Five periods to and fro
void checkReversals(scenario s)
{
    s.pressure = "{ type sine; t0 -0.1; frequency 2.5; amplitude 40; level 0; scale 1; }";
    check(s, 4e-3, 500, 100);
}

// Steady mean velocity along the channel over that of Poiseuille flow
scalar steadyFlow(const scenario& s, scalar pressure, scalar dt)
{
    running r(s);
    fsiCase& c = r.c;
    const scalar tau = 1000 * height * height / (s.mu * M_PI * M_PI);
    runSteps(c, *r.scheme, dt, label(5 * tau / dt));
    scalar sum = 0, n = 0, flux = 0;
    for (int k = 0; k < 10; ++k)
    {
        runSteps(c, *r.scheme, dt, label(0.05 * tau / dt) + 1);
        flux += 0.1 * c.walls->balance()[3].flux;
        for (label i = 0; i < c.cloud.n(); ++i)
            if (const scalar x = c.cloud.x[i][0]; x > 0 && x < length) sum += c.cloud.Up[i][0], ++n;
    }
    CHECK(flux == relative(sum / n * height, 0.02));  // however thick the slice
    return sum / n / (pressure / length * height * height / (12 * s.mu));
}

}  // namespace

TEST_CASE("Poiseuille flow between two open faces, with both couplings")
{
    scenario s{straightFace(0)};
    s.mu = 0.2, s.pressure = "3.3; backflow 0;";
    for (const auto& [coupling, dt] :
         {std::pair("projection", 1.5e-3), std::pair("monolithic", 8e-3)})
        for (const char* kind : {"particles", "mirror"})
        {
            s.coupling = coupling, s.kind = kind;
            CAPTURE(s.coupling);
            CAPTURE(s.kind);
            CHECK(steadyFlow(s, 3.3, dt) == relative(1, 0.015));
        }
}

TEST_CASE("steps far beyond dx^2/nu: what enters a channel leaves it")
{
    const std::vector<std::pair<word, scalar>> steps = {{"monolithic", 20}, {"projection", 4}};
    for (const auto& [coupling, times] : steps)
        for (const word kind : {"particles", "mirror"})
        {
            CAPTURE(coupling);
            CAPTURE(kind);
            const word wall = "type wall; representation " + kind + ";";
            boxCase b;
            b.patch = {"type open; p 1; backflow 0;", "type open; p 0; backflow 0;", wall, wall};
            b.coupling = coupling, b.mu = 0.2;
            runningBox r(b);
            const scalar dt = times * b.dx * b.dx * 1000 / b.mu,
                         law = std::pow(b.height(), 3) / (12 * b.mu * b.length());
            r.run(dt, label(600 / times));
            scalar in = 0, out = 0;
            for (int k = 0; k < 30; ++k)
            {
                r.run(dt, 1);
                in -= r.c.walls->balance()[0].flux / 30, out += r.c.walls->balance()[1].flux / 30;
            }
            CHECK(out == relative(in, 0.01));
            CHECK(out == relative(law, 0.04));
        }
}

TEST_CASE("ten reversals of a driven flow between walls, flat faces")
{
    checkReversals({straightFace(0), "projection", "mirror"});
}

TEST_CASE("ten reversals of a driven flow between walls, a curved face")
{
    checkReversals({curvedFace()});
}

TEST_CASE("ten reversals of a driven flow between walls, an oblique face, with both couplings")
{
    for (const char* coupling : {"projection", "monolithic"})
        checkReversals({straightFace(0.5 * height), coupling});
}

TEST_CASE("a flow through a channel, several times its volume")
{
    scenario s{straightFace(0.5 * height)};
    s.pressure = "2.5;";
    check(s, 4e-3, 700);
}

TEST_CASE("with a reflection the level of pressure does not count, whatever the steps")
{
    scalar flow[2];
    for (const int high : {0, 1})
    {
        boxCase b;
        const scalar level = high ? 1000 : 0;
        b.patch = {"type open; p " + str(level + 1) + ";", "type open; p " + str(level) + ";",
                   "type wall;", "type wall;"};
        b.coupling = "projection", b.mu = 0.2, b.solution = "projection { reflection 1; }";
        runningBox r(b);
        for (const scalar dt : {1e-3, 1e-3, 0.9e-3, 0.9e-3, 1.2e-3}) r.run(dt, 2);
        flow[high] = r.c.walls->balance()[1].flux;
        CHECK(flow[high] > 0);
    }
    CHECK(flow[1] == relative(flow[0], 0.01));  // the solver's tolerance is one of the level
}
