// SPDX-License-Identifier: GPL-3.0-or-later
// A plunger moved by a table: the volume that it sweeps and that it drives out of a channel
#include "boundary/scene.H"
#include "caseOnDisk.H"
#include "relative.H"
#include "widestGap.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace scene;

namespace
{

// A quarter of a disc; the fluid is above it
triSurface quarterDisc(scalar radius)
{
    return parametric(
        [=](scalar s, scalar t) {
            return vector(radius * t * std::cos(0.5 * M_PI * s),
                          radius * t * std::sin(0.5 * M_PI * s), 0);
        },
        16, 4,
        [](const vector&) -> vector {
            return {0, 0, -1};
        });
}

}  // namespace

TEST_CASE("the volume a plunger sweeps along an oblique path is exact, also in pieces and back")
{
    const scalar radius = 3;
    const triSurface disc = quarterDisc(radius);
    folder files;
    files.surface("plunger", disc);
    particleCloud cloud = fluid({{1, 1, 1}}, 1);
    boundary walls(files.path,
                   dictionary::fromString(
                       "plunger { type wall; representation mirror; motion { direction (1 2 2);"
                       "displacement table ((0 0) (1 0.6) (2 0.9) (3 -0.3)); } }"),
                   cloud, 2.6);
    const scalar perMetre = disc.area() * 2 / 3;  // normal component of the direction
    scalar t = 0;
    const auto to = [&](scalar end, int steps) {
        for (int k = 0; k < steps; ++k)
        {
            const scalar next = t + (end - t) / (steps - k);
            walls.setStep(t, next);
            walls.exchange(cloud, next);
            t = next;
        }
        return walls.balance()[0].swept;
    };
    CHECK(to(0.5, 7) == relative(0.3 * perMetre, 1e-12));
    CHECK(to(1.7, 5) == relative(0.81 * perMetre, 1e-12));
    CHECK(to(3, 11) == relative(-0.3 * perMetre, 1e-12));
    walls.setStep(0.2, 0.9);
    CHECK(walls.maxGivenSpeed() == relative(0.6, 1e-12));
}

namespace
{

constexpr int nx = 24, ny = 12;
constexpr scalar dx = 1e-3, length = nx * dx, height = ny * dx, strip = 2 * dx;

void placeChannel(caseOnDisk& files)
{
    files.fill(nx, ny, dx);
    particleTable& t = files.particles();
    particleTable sites, rigid;
    for (scalar depth = 0.5 * dx; depth < strip; depth += dx)
        for (int j = 0; j < ny; ++j) sites.x.emplace_back(length + depth, (j + 0.5) * dx, 0);
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < ny; ++j) rigid.x.emplace_back(-(k + 0.5) * dx, (j + 0.5) * dx, 0);
    for (const vector& x : sites.x)
    {
        t.x.push_back(x), t.vectors["U"].push_back(vector::Zero()), t.scalars["p"].push_back(0);
        t.integers["id"].push_back(globalId(t.x.size()) - 1), t.integers["zone"].push_back(0);
    }
    files.write();
    sites.attributes["patches"] = "right", rigid.attributes["patches"] = "plunger";
    sites.integers["patch"].assign(sites.x.size(), 0);
    rigid.integers["patch"].assign(rigid.x.size(), 0);
    writeParticles(sites, files.path() + "/constant/openSites.hdf");
    writeParticles(rigid, files.path() + "/constant/wallParticles.hdf");
    std::filesystem::create_directories(files.path() + "/constant/triSurface");
    // taller than the channel: only the part between the sides counts
    writeSTL(sheet({0, -1e-2, -dx}, {0, 0, 2 * dx}, {0, height + 2e-2, 0}, 3),
             files.path() + "/constant/triSurface/plunger.stl");
}

// Number of particles before the face, counted smoothly across it
scalar inChannel(const particleCloud& cloud)
{
    scalar sum = 0;
    for (label i = 0; i < cloud.n(); ++i)
        sum += std::clamp(0.5 - 0.5 * (cloud.x[i][0] - length) / dx, 0.0, 1.0);
    return sum;
}

const word slip = "type symmetryPlane;";

// A channel with a plunger at one end, sides, and an open face at the other end
void writeChannel(caseOnDisk& files, const word& coupling, const word& plunger,
                  const word& side = slip)
{
    files.solution += "coupling " + coupling + ";";
    files.control = "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
    files.boundary = "plunger { type wall; " + plunger + " } bottom { " + side +
                     " point (0 0 0); normal (0 -1 0); } top { " + side + " point (0 " +
                     str(height, 17) +
                     " 0); normal (0 1 0); }"
                     "right { type open; surface plane; point (" +
                     str(length, 17) + " 0 0); normal (1 0 0); p 0; }";
    placeChannel(files);
}

// The plunger moves to and fro by a spacing, twenty times a second; largest cell Reynolds number 126
const word toAndFro =
    "motion { direction (1 0 0); displacement { type sine; amplitude 1e-3; frequency 20; } }";
constexpr scalar step = 5e-4, fastest = 1e-3 * 40 * M_PI;
scalar displacement(scalar t)
{
    return 1e-3 * std::sin(40 * M_PI * t);
}

}  // namespace

TEST_CASE("what a plunger sweeps leaves the channel")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const word kind : {"mirror", "particles"})
        {
            CAPTURE(coupling);
            CAPTURE(kind);
            caseOnDisk files("plunger");
            files.properties = "rho 1000; mu 0.05;";
            writeChannel(files, coupling,
                         "representation " + word(kind) +
                             "; motion { direction (1 0 0); displacement table ((0 0) (0.1 0.0002) "
                             "(0.6 0.0102) (0.7 0.0104) (2 0.0104)); }");
            capturedLog log;
            Time time(files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            const scalar before = inChannel(c.cloud);
            const auto error = [&](label steps) {
                runSteps(c, *scheme, 5e-3, steps);
                const scalar swept = c.walls->balance()[0].swept / c.cloud.volume();
                return (before - inChannel(c.cloud)) / swept - 1;
            };
            // during the motion, after ten spacings, and after the stop
            CHECK(std::abs(error(120)) < 0.002);
            CHECK(std::abs(error(40)) < 0.005);
            CHECK(c.walls->balance()[0].swept == relative(0.0104 * height, 1e-9));
        }
}

TEST_CASE("fluid between slip walls moves with its plunger as one, in and out")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        caseOnDisk files("plug");
        writeChannel(files, coupling, toAndFro);
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, step, 10);
        scalar uError = 0, pError = 0;
        for (label n = 0; n < 300; ++n)
        {
            runSteps(c, *scheme, step, 1);
            const scalar t = c.time.value();
            const scalar u = (displacement(t) - displacement(t - step)) / step;
            const scalar before = (displacement(t - step) - displacement(t - 2 * step)) / step;
            const scalar total = before < 0 ? 0.5 * 1000 * before * before : 0;
            for (label i = 0; i < c.cloud.n(); ++i)
            {
                if (c.cloud.x[i][0] > length - dx) continue;
                const scalar p = 1000 * (u - before) / step * (length - c.cloud.x[i][0]) - total;
                uError = std::max(uError, (c.cloud.Up[i].xyz() - vector(u, 0, 0)).norm());
                pError = std::max(pError, std::abs(c.cloud.Up[i][3] - p));
            }
        }

        const scalar perSpacing = 1000 * fastest * 40 * M_PI * dx;
        CHECK(uError < 0.01 * fastest);
        CHECK(pError < 0.3 * perSpacing);
    }
}

TEST_CASE("a plunger and a force along the open face: no jet inwards feeds itself in ten periods")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        caseOnDisk files("backflow");
        files.g = "(0 6 0)";
        writeChannel(files, coupling, toAndFro);
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        scalar u = 0;
        for (label n = 0; n < 1000; ++n)
        {
            runSteps(c, *scheme, step, 1);
            for (label i = 0; i < c.cloud.n(); ++i) u = std::max(u, c.cloud.Up[i].xyz().norm());
        }
        CHECK(u < 3.5 * fastest);  // at static pressure (backflow 0): 4.2
    }
}

namespace
{

struct loss
{
    scalar volume = 0;  // of the channel's, mean of the last period
    scalar gap = 0;     // [dx]
};

// Five strokes of eight spacings to and fro between walls that the fluid sticks to
loss afterTenReversals(const word& coupling, const word& kind, const word& solution)
{
    caseOnDisk files("reversals");
    files.properties = "rho 1000; mu 0.05;";
    files.solution = solution;
    writeChannel(files, coupling,
                 "motion { direction (1 0 0); displacement { type sine; level 4e-3; "
                 "amplitude 4e-3; frequency 2; t0 0.125; } }",
                 "type wall; surface plane; representation " + kind + ";");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    const scalar before = inChannel(c.cloud), dt = 2e-3;
    loss result;
    for (int n = 0; n < 125; ++n)
    {
        runSteps(c, *scheme, dt, 10);
        const scalar plunger = 4e-3 * (1 - std::cos(4 * M_PI * c.time.value()));
        const List<vector> spots = lattice(
            0.25 * dx, {plunger, 0, 0}, {length, height, 0},
            [&](const vector& x) { return x[0] > plunger; }, 2);
        result.gap = std::max(result.gap, widestGap(c, spots));
        if (n < 100) continue;
        const scalar swept = plunger * height / c.cloud.volume();
        result.volume += ((inChannel(c.cloud) + swept) / before - 1) / 25;
    }
    return result;
}

}  // namespace

TEST_CASE("ten reversals of a plunger between walls")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const word kind : {"mirror", "particles"})
        {
            CAPTURE(coupling);
            CAPTURE(kind);
            const loss l = afterTenReversals(coupling, kind, "");
            CHECK(std::abs(l.volume) < 0.005);
            CHECK(l.gap < 1.3);
        }
}
