// SPDX-License-Identifier: GPL-3.0-or-later
// Steady plane Poiseuille flow in a complete case: triangulated walls, cyclic ends, both couplings, both
// representations of a wall
#include "caseOnDisk.H"
#include "relative.H"
#include "triSurface.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr int nAcross = 20, nAlong = 10;
constexpr scalar H = 1e-3, dx = H / nAcross, nu = 1e-6, F = 1e-4;

// Both walls and their rigid particles, from three spacings before the channel to three behind it, as
// generateParticles makes them
void writeWalls(const word& path)
{
    triSurface s;
    particleTable rigid;
    const label patch = s.addPatch("walls");
    for (const scalar side : {0.0, 1.0})
    {
        const vector a(0, side * H, -0.5 * dx), b(nAlong * dx, side * H, 0.5 * dx);
        const vector c(b[0], a[1], a[2]), d(a[0], a[1], b[2]);
        if (side > 0) s.add(a, b, c, patch), s.add(a, d, b, patch);
        else s.add(a, c, b, patch), s.add(a, b, d, patch);
        for (int i = -3; i < nAlong + 3; ++i)
            for (const scalar depth : {0.5, 1.5, 2.5})
                rigid.x.emplace_back((i + 0.5) * dx, side * H + (2 * side - 1) * depth * dx, 0);
    }
    std::filesystem::create_directories(path + "/constant/triSurface");
    writeSTL(s, path + "/constant/triSurface/walls.stl");
    rigid.integers["patch"].assign(rigid.size(), 0), rigid.attributes["patches"] = "walls";
    writeParticles(rigid, path + "/constant/wallParticles.hdf");
}

// Largest error of u over the peak; checks that all particles stay in the plane
scalar steadyError(const word& coupling, const word& representation)
{
    caseOnDisk files("channelCase");
    files.fill(nAlong, nAcross, dx);
    files.solution = "coupling " + coupling + ";";
    files.properties = "rho 1000; nu " + str(nu) + ";";
    files.boundary = "walls { type wall; representation " + representation +
                     "; } ends { type cyclic; point (0 0 0); separation (" + str(nAlong * dx) +
                     " 0 0); }";
    files.g = "(" + str(F) + " 0 0)";
    files.write();
    writeWalls(files.path());
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 0.02, 50);
    scalar worst = 0;
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        const scalar y = c.cloud.x[i][1], exact = F * y * (H - y) / (2 * nu);
        worst = std::max(worst, std::abs(c.cloud.Up[i][0] - exact));
        CHECK(c.cloud.x[i][2] == 0);
        CHECK(c.cloud.Up[i][2] == 0);
    }
    CHECK(c.walls->balance()[1].flux == relative(F * H * H * H / (12 * nu), 0.01));
    CHECK(c.walls->balance()[1].volume > 0);
    c.walls->printBalance(c.cloud);
    CHECK(log.contains("\npatch flux [m2/s, along the separation]: ends 8."));
    return worst / (F * H * H / (8 * nu));
}

}  // namespace

TEST_CASE("steady Poiseuille flow between triangulated walls, both couplings")
{
    for (const word representation : {"particles", "mirror"})
    {
        CAPTURE(representation);
        for (const word coupling : {"projection", "monolithic"})
        {
            CAPTURE(coupling);
            CHECK(steadyError(coupling, representation) < 0.005);
        }
    }
}
