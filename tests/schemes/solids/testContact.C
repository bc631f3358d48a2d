// SPDX-License-Identifier: GPL-3.0-or-later
// Solids that meet each other, their mirror image and a wall, theory 7.10
#include "caseOnDisk.H"
#include "energyLedger.H"
#include "relative.H"
#include "solidContact.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, G = 1e4, rho = 1000, dt = 2e-3;
constexpr int nx = 30, ny = 14, side = 6;  // of the box and of a block

// A closed box of fluid with square blocks of solid whose lower left cells are given
class blocks
{
public:
    blocks(const word& name, const List<std::array<int, 2>>& corners, const word& bodyForce,
           const word& left = "type wall;")
        : files(name)
    {
        files.fill(nx, ny, dx);
        place(corners);
        files.control =
            "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
        files.solution = "coupling monolithic;";
        files.properties = "rho 1000; mu 1e-2; bodyForce { " + bodyForce + " }";
        const auto plane = [](const word& patch, const word& type, const word& point,
                              const word& normal) {
            return patch + " { " + type + (type == "type wall;" ? " surface plane;" : "") +
                   " point " + point + "; normal " + normal + "; } ";
        };
        files.boundary = plane("left", left, "(0 0 0)", "(-1 0 0)") +
                         plane("right", "type wall;", "(0.03 0 0)", "(1 0 0)") +
                         plane("floor", "type wall;", "(0 0 0)", "(0 -1 0)") +
                         plane("roof", "type wall;", "(0 0.014 0)", "(0 1 0)");
        files.write();
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel totalLagrangian; material { type neoHookean; G 1e4; }");
    }
    caseOnDisk files;

private:
    void place(const List<std::array<int, 2>>& corners)
    {
        particleTable all = files.particles(), &t = files.particles();
        t.x.clear(), t.vectors["U"].clear(), t.scalars["p"].clear();
        t.integers["id"].clear(), t.integers["zone"].clear();
        const auto blockOf = [&](const vector& x) {
            for (size_t b = 0; b < corners.size(); ++b)
                if (const int i = int(x[0] / dx) - corners[b][0],
                    j = int(x[1] / dx) - corners[b][1];
                    i >= 0 && i < side && j >= 0 && j < side)
                    return int(b);
            return -1;
        };
        word zones, phases;
        for (size_t b = 0; b < corners.size(); ++b)
            zones += "block" + std::to_string(b) + " ", phases += "solid ";
        for (const bool solid : {true, false})
            for (const vector& x : all.x)
            {
                const int b = blockOf(x);
                if ((b >= 0) != solid) continue;
                t.x.push_back(x), t.vectors["U"].push_back(vector::Zero());
                t.scalars["p"].push_back(0);
                t.integers["id"].push_back(globalId(t.x.size()) - 1);
                t.integers["zone"].push_back(b >= 0 ? b : int(corners.size()));
            }
        t.attributes["zones"] = zones + "fluid", t.attributes["phases"] = phases + "fluid";
    }
};

// Least distance of two blocks [dx]
scalar apart(const particleCloud& cloud)
{
    scalar least = 1e30;
    for (label i = 0; i < cloud.nSolid(); ++i)
        for (label j = 0; j < cloud.nSolid(); ++j)
            if (cloud.zone[i] == 0 && cloud.zone[j] == 1)
                least = std::min(least, (cloud.x[i].xyz() - cloud.x[j].xyz()).norm() / dx);
    return least;
}

// Least coordinate of the solid along an axis [dx]
scalar lowest(const particleCloud& cloud, int axis)
{
    scalar least = 1e30;
    for (label i = 0; i < cloud.nSolid(); ++i) least = std::min(least, cloud.x[i][axis] / dx);
    return least;
}

}  // namespace

TEST_CASE("two blocks are pressed together, rest on a layer of fluid, and part again")
{
    const blocks scene("contact", {{6, 4}, {18, 4}},
                       "block0 table ((0 (16 0 0)) (1 (16 0 0)) (1.001 (-16 0 0))); "
                       "block1 table ((0 (-16 0 0)) (1 (-16 0 0)) (1.001 (16 0 0)));");
    capturedLog log;
    Time time(scene.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    scalar least = 1e30, atRest = 0;
    for (int k = 0; k < 500; ++k)
    {
        runSteps(c, *scheme, dt, 1);
        least = std::min(least, apart(c.cloud));
    }
    atRest = apart(c.cloud);
    CHECK(least > 1.5);
    CHECK(atRest < 2);
    CHECK(c.cloud.maxSpeed() < 1e-3);
    // 96 Pa over 1e4 Pa: the layers' distance at which (7.18) has this pressure
    runSteps(c, *scheme, dt, 250);
    CHECK(apart(c.cloud) > 3);
}

TEST_CASE("a block falls to a wall, and one to its image beyond a symmetry plane")
{
    const blocks scene("contactWall", {{12, 5}}, "block0 (-8 -16 0);", "type symmetryPlane;");
    capturedLog log;
    Time time(scene.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    scalar floor = 1e30, plane = 1e30;
    for (int k = 0; k < 700; ++k)
    {
        runSteps(c, *scheme, dt, 1);
        floor = std::min(floor, lowest(c.cloud, 1)), plane = std::min(plane, lowest(c.cloud, 0));
    }
    CHECK(floor > 1);
    CHECK(lowest(c.cloud, 1) < 1.5);
    CHECK(plane > 0.75);
}
