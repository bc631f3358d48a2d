// SPDX-License-Identifier: GPL-3.0-or-later
// The scheme in a complete case: dictionaries, boundary, limits
#include "caseOnDisk.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

const char* const slipBox = R"(
    left   { type symmetryPlane; point (0 0 0); normal (-1 0 0); }
    right  { type symmetryPlane; point (0.2 0 0); normal (1 0 0); }
    bottom { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
    top    { type symmetryPlane; point (0 0.4 0); normal (0 1 0); })";

const char* const endlessBox = R"(
    sides  { type cyclic; point (0 0 0); separation (0.32 0 0); }
    bottom { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
    top    { type symmetryPlane; point (0 0.4 0); normal (0 1 0); })";

// The first box with walls
word walls(const word& representation)
{
    const auto plane = [&](const word& name, const word& point, const word& normal) {
        return name + " { type wall; surface plane; representation " + representation + "; point " +
               point + "; normal " + normal + "; }\n";
    };
    return plane("left", "(0 0 0)", "(-1 0 0)") + plane("right", "(0.2 0 0)", "(1 0 0)") +
           plane("bottom", "(0 0 0)", "(0 -1 0)") + plane("top", "(0 0.4 0)", "(0 1 0)");
}

void disorder(particleTable& table, scalar most)
{
    std::uint64_t state = 1;
    const auto next = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return most * (scalar(state >> 11) / scalar(1ull << 52) - 1);
    };
    for (vector& x : table.x) x += vector(next(), next(), 0);
}

// Disordered water in that box under the acceleration a, with the pressure that balances it
void fillBox(caseOnDisk& files, const word& coupling, const word& representation, const vector& a)
{
    files.fill(10, 20, 0.02);
    particleTable& t = files.particles();
    disorder(t, 0.004);
    for (size_t i = 0; i < t.size(); ++i) t.scalars["p"][i] = 1000 * t.x[i].dot(a);
    files.boundary = walls(representation), files.solution = "coupling " + coupling + ";";
    files.g = "(" + str(a[0]) + " " + str(a[1]) + " 0)";
}

}  // namespace

TEST_CASE("fluid at rest under gravity stays at rest, with the pressure of its depth")
{
    caseOnDisk files("hydrostatic");
    files.fill(10, 20, 0.02);
    disorder(files.particles(), 0.004);
    files.boundary = slipBox, files.g = "(1 -9.81 0)";
    files.write();
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 0.01, 20);

    const particleCloud& cloud = c.cloud;
    const auto hydrostatic = [&](label i) { return 1000 * (cloud.x[i][0] - 9.81 * cloud.x[i][1]); };
    const scalar level = cloud.Up[0][3] - hydrostatic(0);
    for (label i = 0; i < cloud.n(); ++i)
    {
        CHECK(cloud.Up[i].xyz().norm() < 1e-12);
        CHECK(std::abs(cloud.Up[i][3] - level - hydrostatic(i)) < 1e-8 * 1000 * 9.81);
    }
    CHECK(log.contains("time step continuity errors : sum local = "));
    CHECK(log.contains("Courant Number mean: 0 max: 0"));
}

TEST_CASE("fluid stays at rest between rigid and between mirror walls, with both couplings")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const auto& [representation, mu] : {std::pair<word, word>("particles", "1e-3"),
                                                 {"mirror", "1e-3"},
                                                 {"particles", "8"},
                                                 {"mirror", "8"}})
        {
            CAPTURE(coupling);
            CAPTURE(representation);
            CAPTURE(mu);
            caseOnDisk files("restInBox");
            fillBox(files, coupling, representation, {1, -9.81, 0});
            files.properties = "rho 1000; mu " + mu + ";";
            if (mu == "8") files.particles().scalars["p"].assign(files.particles().size(), 0);
            files.write();
            capturedLog log;
            Time time(files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            runSteps(c, *scheme, 0.01, 20);
            const auto depth = [&](label i) {
                return 1000 * c.cloud.x[i].xyz().dot(vector(1, -9.81, 0));
            };
            const scalar level = mu == "8" ? c.cloud.Up[0][3] - depth(0) : 0;
            for (label i = 0; i < c.cloud.n(); ++i)
            {
                CHECK(c.cloud.Up[i].xyz().norm() <
                      (mu == "8" ? 1e-7 : 1e-12));  // from p = 0, by the solvers
                CHECK(std::abs(c.cloud.Up[i][3] - level - depth(i)) < 1e-8 * 1000 * 9.81);
            }
        }
}

// A stream along walls has no divergence for any arrangement of particles; with no-slip images it would have one
TEST_CASE("the pressure leaves a stream along mirror walls alone")
{
    caseOnDisk files("streamAlongMirror");
    files.fill(10, 20, 0.02);
    disorder(files.particles(), 0.004);
    for (vector& u : files.particles().vectors["U"]) u = {0, 1, 0};
    files.boundary = R"(
        left  { type wall; surface plane; representation mirror; point (0 0 0); normal (-1 0 0); }
        right { type wall; surface plane; representation mirror; point (0.2 0 0); normal (1 0 0); }
        ends  { type cyclic; point (0 0 0); separation (0 0.4 0); })";
    files.properties = "rho 1000; mu 1e-12;";
    files.solution = "coupling projection; shifting { type none; }";
    files.write();
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 1e-4, 1);
    scalar off = 0;
    for (label i = 0; i < c.cloud.n(); ++i)
        off = std::max(off, (c.cloud.Up[i].xyz() - vector(0, 1, 0)).norm());
    CHECK(off < 1e-10);
}

TEST_CASE("accelerations that differ a little between zones move the fluid a little")
{
    constexpr scalar g = 9.81, more = 1e-8 * g;
    for (const word coupling : {"projection", "monolithic"})
        for (const word representation : {"particles", "mirror"})
        {
            CAPTURE(coupling);
            CAPTURE(representation);
            caseOnDisk files("restOfTwoZones");
            fillBox(files, coupling, representation, {0, -g, 0});
            particleTable& t = files.particles();
            t.attributes["zones"] = "lower upper", t.attributes["phases"] = "fluid fluid";
            for (size_t i = 0; i < t.size(); ++i) t.integers["zone"][i] = t.x[i][1] > 0.2;
            files.properties =
                "rho 1000; mu 1e-3; bodyForce { upper (" + str(more, 17) + " 0 0); }";
            files.write();
            capturedLog log;
            Time time(files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            runSteps(c, *scheme, 0.01, 20);
            scalar speed = 0;
            for (label i = 0; i < c.cloud.n(); ++i)
                speed = std::max(speed, c.cloud.Up[i].xyz().norm());
            CHECK(speed > 0.01 * more * 0.2);
            CHECK(speed < 10 * more * 0.2);
        }
}

TEST_CASE("fluid below an open face stays at rest under gravity, with both couplings")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        caseOnDisk files("openHydrostatic");
        files.fill(10, 22, 0.02);  // the two uppermost rows lie beyond the face
        files.solution = "coupling " + coupling +
                         "; monolithic { tolerance 1e-10; }"
                         "solvers { p { solver PCG; preconditioner multigrid; tolerance 1e-10; } }";
        files.boundary = R"(
            left   { type symmetryPlane; point (0 0 0); normal (-1 0 0); }
            right  { type symmetryPlane; point (0.2 0 0); normal (1 0 0); }
            bottom { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
            top    { type open; p 50; surface plane; point (0 0.4 0); normal (0 1 0); })";
        files.g = "(0 -9.81 0)";
        files.write();
        particleTable sites;
        for (const vector& x : files.particles().x)
            if (x[1] > 0.4) sites.x.push_back(x);
        sites.integers["patch"].assign(sites.size(), 0);
        sites.integers["zone"].assign(sites.size(), 0);
        sites.attributes["patches"] = "top", sites.attributes["zones"] = "fluid";
        writeParticles(sites, files.path() + "/constant/openSites.hdf");
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, 0.01, 20);
        scalar speed = 0, error = 0;
        for (label i = 0; i < c.cloud.n(); ++i)
        {
            const scalar exact = 50 + 9810 * (0.4 - c.cloud.x[i][1]);
            speed = std::max(speed, c.cloud.Up[i].xyz().norm());
            error = std::max(error, std::abs(c.cloud.Up[i][3] - exact));
        }
        // free fall would be 2 m/s.  The monolithic scheme remembers that p was zero at first
        CHECK(speed < (coupling == "projection" ? 1e-6 : 1e-3));
        CHECK(error < 1e-3 * 9810 * 0.4);
        CHECK(c.walls->balance()[3].created == 0);
        CHECK(c.walls->balance()[3].deleted == 0);
    }
}

TEST_CASE("a body force along a cyclic direction accelerates, all else of it is pressure")
{
    caseOnDisk files("freeFall");
    files.fill(16, 20, 0.02);
    files.boundary = endlessBox;
    files.g = "(2 -9.81 0)";
    files.write();
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 0.01, 10);
    for (label i = 0; i < c.cloud.n(); ++i)
        CHECK((c.cloud.Up[i].xyz() - vector(0.2, 0, 0)).norm() < 1e-7);
}

// The velocity is the integral of the force, exact for a ramp; p belongs to the instant
TEST_CASE("a body force that grows with time")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        caseOnDisk files("rampedForce");
        files.fill(16, 20, 0.02);
        files.solution = "coupling " + coupling +
                         "; monolithic { tolerance 1e-10; }"
                         "solvers { p { solver PCG; preconditioner multigrid; tolerance 1e-10; } }";
        files.boundary = endlessBox;
        files.g = "table ((0 (0 0 0)) (1 (20 -98.1 0)))";
        files.write();
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, 0.01, 10);
        const scalar y = c.cloud.x[0][1], p = c.cloud.Up[0][3];
        for (label i = 0; i < c.cloud.n(); ++i)
        {
            CHECK((c.cloud.Up[i].xyz() - vector(0.1, 0, 0)).norm() < 1e-7);
            CHECK(std::abs(c.cloud.Up[i][3] - p + c.rho * 9.81 * (c.cloud.x[i][1] - y)) <
                  1e-6 * c.rho * 9.81 * 0.4);
        }
    }
}

TEST_CASE("the limit that rules is named")
{
    caseOnDisk files("limits");
    files.fill(10, 20, 0.02);
    files.boundary = slipBox;
    const scalar h = 1.3 * 0.02;
    const auto limitOf = [&](const word& projection, const word& properties, const vector& u) {
        files.solution = "coupling projection; projection { " + projection + " }";
        files.properties = properties;
        for (vector& U : files.particles().vectors["U"]) U = u;
        files.write();
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        return couplingScheme::New(c)->limit();
    };
    const vector none = vector::Zero(), some(0, 2, 0);
    const auto cfl = limitOf("", "rho 1; mu 0.01;", some);
    CHECK(cfl.rule == "CFL");
    CHECK(cfl.dt == relative(0.4 * h / 2));

    const auto viscous = limitOf("viscosity explicit;", "rho 1; mu 0.5;", some);
    CHECK(viscous.rule == "explicit viscosity");
    CHECK(viscous.dt == relative(0.125 * h * h / 0.5));
    CHECK(limitOf("viscosity implicit;", "rho 1; mu 0.5;", none).rule == "none");
    CHECK(limitOf("limits { CFL 0.1; }", "rho 1; mu 0.01;", some).dt == relative(0.1 * h / 2));

    const word pushed = "rho 2; mu 0.01; bodyForce { fluid (3 0 0); }";
    CHECK(limitOf("", "rho 2; mu 0.01; bodyForce { fluid (0 0 0); }", some).rule == "CFL");
    files.fill(16, 20, 0.02), files.boundary = endlessBox;
    const auto force = limitOf("", pushed, none);
    CHECK(force.rule == "force");
    CHECK(force.dt == relative(0.25 * std::sqrt(h / 3)));
    CHECK(limitOf("limits { force 0.1; }", pushed, none).dt == relative(0.1 * std::sqrt(h / 3)));
    // a pressure drop acts as a force before the first step too: 1.92 Pa over 2 kg/m^3 x 0.32 m
    word& sides = files.boundary;
    sides.insert(sides.find("separation"), "pressureDrop 1.92; ");
    const auto drop = limitOf("", "rho 2; mu 0.01;", none);
    CHECK(drop.rule == "force");
    CHECK(drop.dt == relative(0.25 * std::sqrt(h / 3)));
}
