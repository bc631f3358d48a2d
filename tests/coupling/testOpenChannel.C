// SPDX-License-Identifier: GPL-3.0-or-later
// An oscillating pressure drives the fluid of a channel to and fro through open faces at both ends
#include "caseOnDisk.H"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr int nx = 20, ny = 12;
constexpr scalar dx = 1e-3, length = nx * dx, height = ny * dx, strip = 2 * dx;
constexpr scalar period = 0.4, dt = 4e-3;

void placeStrips(caseOnDisk& files)
{
    files.fill(nx, ny, dx);
    particleTable& t = files.particles();
    particleTable sites;
    for (int side = 0; side < 2; ++side)
        for (scalar depth = 0.5 * dx; depth < strip; depth += dx)
            for (int j = 0; j < ny; ++j)
            {
                sites.x.emplace_back(side ? length + depth : -depth, (j + 0.5) * dx, 0);
                sites.integers["patch"].push_back(side);
            }
    sites.attributes["patches"] = "left right";
    for (const vector& x : sites.x)
    {
        t.x.push_back(x), t.vectors["U"].push_back(vector::Zero()), t.scalars["p"].push_back(0);
        t.integers["id"].push_back(globalId(t.x.size()) - 1), t.integers["zone"].push_back(0);
    }
    files.write();
    writeParticles(sites, files.path() + "/constant/openSites.hdf");
}

// Particles between the faces, counted smoothly across them
scalar inChannel(const particleCloud& cloud)
{
    scalar sum = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar depth = std::max(-cloud.x[i][0], cloud.x[i][0] - length);
        sum += std::clamp(0.5 - 0.5 * depth / dx, 0.0, 1.0);
    }
    return sum;
}

}  // namespace

TEST_CASE("ten reversals of a driven flow between walls keep the volume of the channel")
{
    for (const char* coupling : {"projection", "monolithic"})
        for (const char* kind : {"mirror", "particles"})
        {
            CAPTURE(coupling);
            CAPTURE(kind);
            caseOnDisk files("openChannel");
            files.properties = "rho 1000; mu 0.05;";
            files.solution = "coupling " + word(coupling) + ";";
            files.control =
                "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
            const word wall = "type wall; surface plane; representation " + word(kind) + ";";
            files.boundary = "bottom { " + wall + " point (0 0 0); normal (0 -1 0); } top { " +
                             wall + " point (0 " + str(height, 17) +
                             " 0); normal (0 1 0); }"
                             "left { type open; surface plane; point (0 0 0); normal (-1 0 0); p {"
                             "type sine; t0 -" +
                             str(0.25 * period) + "; frequency " + str(1 / period) +
                             "; amplitude 20; level 0; scale 1; } }"
                             "right { type open; surface plane; point (" +
                             str(length, 17) + " 0 0); normal (1 0 0); p 0; }";
            placeStrips(files);
            capturedLog log;
            Time time(files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            const scalar before = inChannel(c.cloud);
            scalar worst = 0, way = 0;
            for (int step = 0; step < 500; ++step)
            {
                runSteps(c, *scheme, dt, 1);
                worst = std::max(worst, std::abs(inChannel(c.cloud) / before - 1));
                scalar u = 0;
                for (label i = 0; i < c.cloud.n(); ++i) u += c.cloud.Up[i][0] / c.cloud.n();
                way += dt * std::abs(u);
            }
            CHECK(way > 50 * dx);
            // measured 0.6 to 3 %, where one particle is 0.4 %; strips that nothing accelerated lost 20 %
            CHECK(worst < 0.04);
        }
}
