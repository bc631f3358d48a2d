// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid that no open face drains: a strip of elastic wall above a chamber with a piston and empty space behind the wall, and
// boxes with stiff or yielding walls
#include "caseOnDisk.H"
#include "relative.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.01;
constexpr int nx = 20, nWall = 4, nChamber = 8;

// x = 0 and x = length are symmetry planes; both halves of the strip are free to rise together
struct chamber
{
    caseOnDisk files;

    chamber(const word& name, const word& zones, const word& extra) : files(name)
    {
        particleTable& t = files.particles();
        files.fill(nx, nWall + nChamber,
                   dx);  // rows from below: wall first in the table, as solids are
        for (label i = 0; i < label(t.x.size()); ++i)
        {
            const bool solid = i < nx * nWall;
            t.x[i][1] += solid ? nChamber * dx : -nWall * dx;
            t.integers["zone"][i] = solid ? 0 : 1;
        }
        t.attributes["zones"] = "wall chamber", t.attributes["phases"] = zones;
        files.control =
            "startTime 0; endTime 1; deltaT 0.01; writeControl timeStep; writeInterval 1e6;";
        files.solution = "coupling monolithic;";
        files.properties = "rho 1000; mu 1;";
        files.boundary =
            "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
            "right { type symmetryPlane; point (0.2 0 0); normal (1 0 0); }"
            "piston { type wall; surface plane; point (0 0 0); normal (0 -1 0); " +
            extra;
        files.write();
        if (zones.find("solid") == word::npos) return;
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel springNetwork; E 1e4; links radius; radius 2.1;");
        setContent(files.path() + "/system/sphSolution",
                   files.solution + " monolithic { volumeFeedback 0; }");
    }
};

const word rising = "motion { direction (0 1 0); displacement polynomial ((0.02 1)); } }";

}  // namespace

TEST_CASE("a wall that its chamber alone loads rises as the piston does")
{
    chamber files("enclosedChamber", "solid fluid", rising);
    capturedLog log;
    Time time(files.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 0.01, 50);
    scalar rise = 0;
    for (label i = 0; i < c.cloud.nSolid(); ++i)
        rise += (c.cloud.x[i][1] - c.cloud.vectors.at("x0")[i][1]) / c.cloud.nSolid();
    CHECK(rise == relative(0.02 * 0.5, 0.01));
}

TEST_CASE("walls that push into a box without a way out are refused")
{
    chamber files("enclosedBox", "fluid fluid", rising);
    setContent(files.files.path() + "/constant/boundary",
               files.files.boundary +
                   "top { type wall; surface plane; point (0 0.12 0); normal (0 1 0); }");
    capturedLog log;
    Time time(files.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    const auto second = [&](const word& top) {
        setContent(files.files.path() + "/constant/boundary", files.files.boundary + top);
        Time again(files.files.path());
        fsiCase moving(again);
        runSteps(moving, *couplingScheme::New(moving), 0.01, 1);
    };
    // as much room is added above as is taken below
    second("top { type wall; surface plane; point (0 0.12 0); normal (0 1 0); " + rising);
    CHECK_THROWS_WITH_AS(runSteps(c, *scheme, 0.01, 1), doctest::Contains("no other way out"),
                         fatalError);
}
