// SPDX-License-Identifier: GPL-3.0-or-later
// A soft channel with nothing outside, clamped at its ends.  The ends extend beyond the open faces, through which a pressure
// drives fluid to and fro
#include "boxCase.H"
#include "capturedLog.H"
#include "caseOnDisk.H"
#include "core/errorOf.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3;
constexpr int nx = 24, ny = 10, thick = 3, strip = 2, clampedLength = 3;

// Places columns of the walls from -beyond to nx + beyond
void place(caseOnDisk& files, int beyond)
{
    particleTable& t = files.particles();
    files.fill(0, 0, dx);
    particleTable sites;
    const auto add = [&](int i, int j, int zone) {
        t.x.emplace_back((i + 0.5) * dx, (j + 0.5) * dx, 0);
        t.vectors["U"].emplace_back(0, 0, 0), t.scalars["p"].push_back(0);
        t.integers["id"].push_back(globalId(t.x.size()) - 1), t.integers["zone"].push_back(zone);
    };
    for (int zone = 0; zone < 2; ++zone)
        for (int j = -thick; j < ny + thick; ++j)
            for (int i = -beyond; i < nx + beyond; ++i)
                if (const bool end = i < clampedLength || i >= nx - clampedLength;
                    (j < 0 || j >= ny) && end == (zone == 0))
                    add(i, j, zone);
    for (int j = 0; j < ny; ++j)
        for (int i = -strip; i < nx + strip; ++i)
        {
            add(i, j, 2);
            if (i < 0 || i >= nx)
                sites.x.push_back(t.x.back()), sites.integers["patch"].push_back(i < 0 ? 0 : 1);
        }
    t.attributes["zones"] = "ends wall water", t.attributes["phases"] = "clamped solid fluid";
    files.write();
    sites.attributes["patches"] = "left right";
    std::filesystem::create_directories(files.path() + "/constant");
    writeParticles(sites, files.path() + "/constant/openSites.hdf");
    setContent(files.path() + "/constant/structureProperties",
               "structureModel springNetwork; E 3000; links radius; radius 2.1;");
}

caseOnDisk vessel(int beyond)
{
    caseOnDisk files("vessel");
    files.boundary =
        "left { type open; surface plane; point (0 0 0); normal (-1 0 0); "
        "p { type sine; amplitude 20; frequency 2.5; scale 1; level 0; t0 0; } }"
        "right { type open; surface plane; point (24e-3 0 0); normal (1 0 0); p 0; }";
    files.properties = "rho 1000; mu 0.05;";
    files.solution = "coupling monolithic; densityFeedback 1;";
    files.schemes = "kernel WendlandC2; hByDx 1.3;";
    files.control =
        "startTime 0; endTime 10; deltaT 4e-3; writeControl timeStep; writeInterval 1e6;";
    place(files, beyond);
    return files;
}

scalar fluidInside(const particleCloud& cloud)
{
    scalar n = 0;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        const scalar x = cloud.x[i][0] / dx;
        n += std::clamp(0.5 + 0.5 * std::min(x, nx - x), 0.0, 1.0);
    }
    return n;
}

// Number of cells between the innermost rows of the walls
scalar room(const particleCloud& cloud)
{
    const List<vec4>& rest = cloud.vectors.at("x0");
    scalar area = 0;
    for (label i = 0; i < cloud.nSolid(); ++i)
    {
        const scalar x = rest[i][0] / dx, y = rest[i][1] / dx - 0.5 * ny;
        if (x < 0 || x > nx || std::abs(y) > 0.5 * ny + 1) continue;
        area += std::abs(cloud.x[i][1] / dx - 0.5 * ny) - 0.5;
    }
    return area;
}

}  // namespace

TEST_CASE("a soft vessel whose clamped ends cross open faces")
{
    caseOnDisk files = vessel(strip + 1);
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    REQUIRE(room(c.cloud) == relative(nx * ny, 1e-9));
    scalar widest = 0, travelled = 0, least = 0, most = 0;
    for (int s = 0; s < 100; ++s)  // one period
    {
        runSteps(c, *scheme, 4e-3, 1);
        travelled += std::abs(c.walls->balance()[0].flux) * 4e-3 / (ny * dx);
        const scalar over = fluidInside(c.cloud) / room(c.cloud) - 1;
        least = std::min(least, over), most = std::max(most, over);
        const List<vec4>& rest = c.cloud.vectors.at("x0");
        for (label i = 0; i < c.cloud.nSolid(); ++i)
            widest = std::max(widest, (c.cloud.x[i].xyz() - rest[i].xyz()).norm());
        for (label i = c.cloud.nSolid(); i < c.cloud.n(); ++i)  // not into the ends
            if (std::abs(c.cloud.x[i][0] - 0.5 * nx * dx) > (0.5 * nx - clampedLength) * dx)
                REQUIRE(std::abs(c.cloud.x[i][1] - 0.5 * ny * dx) < (0.5 * ny + 0.25) * dx);
    }
    CHECK(travelled > 8 * dx);
    CHECK(widest > 0.1 * dx);
    CHECK(least > -0.005);
    CHECK(most < 0.01);  // 0.7 %: the order of the start breaks as the flow turns round
}

TEST_CASE("a vessel that ends at an open face leaves what is beyond without a wall: refused")
{
    caseOnDisk files = vessel(0);
    capturedLog log;
    Time time(files.path());
    CHECK_THROWS_WITH_AS(fsiCase c(time), doctest::Contains("reach 3 dx beyond the face"),
                         fatalError);
}

TEST_CASE("a free disc that the flow takes out of an open face ends the run, with its place")
{
    boxCase box;
    box.coupling = "monolithic", box.velocity = {0.1, 0, 0};
    box.patch = {"type open; velocity 0.1;", "type open; p 0;", "type wall; slip yes;",
                 "type wall; slip yes;"};
    caseOnDisk files("leavingDisc");
    box.write(files);
    particleTable& t = files.particles();
    const particleTable all = t;
    size_t n = 0;
    for (const bool solid : {true, false})  // solids first
        for (const vector& x : all.x)
            if (((x - vector(24e-3, 6e-3, 0)).norm() < 2.5e-3) == solid)
                t.x[n] = x, t.integers["zone"][n] = solid, ++n;
    t.attributes["zones"] = "water disc", t.attributes["phases"] = "fluid solid";
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel totalLagrangian; material { type neoHookean; G 1000; }");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 2e-3, 5);
    CHECK_ERROR(runSteps(c, *scheme, 2e-3, 60), "leaves through the open face right with particle",
                0);
}
