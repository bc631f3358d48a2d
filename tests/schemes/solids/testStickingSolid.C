// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid sticks to the surface of a solid, half a dx before its first particles, (2.15): flow between two elastic slabs
#include "caseOnDisk.H"
#include "relative.H"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar nu = 1e-4, g = 1e-2, dx = 1e-3;
constexpr int columns = 8, thick = 4;

// Slabs of `thick` rows, the outermost clamped, with `rows` rows of fluid between
struct slabs
{
    caseOnDisk files{"stickingSolid"};

    slabs(int rows, const word& coupling)
    {
        files.fill(columns, rows + 2 * thick, dx);
        particleTable& t = files.particles();
        const particleTable all = t;
        const scalar middle = (0.5 * rows + thick) * dx;
        size_t n = 0;
        for (const int zone : {2, 1, 0})  // clamped, free, fluid
            for (const vector& x : all.x)
            {
                const scalar depth = (std::abs(x[1] - middle) / dx - 0.5 * rows);
                if ((depth < 0 ? 0 : depth > thick - 1 ? 2 : 1) == zone)
                    t.x[n] = x, t.integers["zone"][n] = zone, ++n;
            }
        t.attributes["zones"] = "water wall ends", t.attributes["phases"] = "fluid solid clamped";
        files.boundary =
            "sides { type cyclic; point (0 0 0); separation (" + str(columns * dx) + " 0 0); }";
        files.properties =
            "rho 1000; mu " + str(1000 * nu) + "; bodyForce { water (" + str(g) + " 0 0); }";
        files.solution = "coupling " + coupling + ";";
        files.write();
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel springNetwork; E 100; links radius; radius 2.1;");
    }
};

}  // namespace

TEST_CASE("flow between two elastic slabs is that of a channel as wide as the gap between them")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const int rows : {6, 10, 20})
        {
            CAPTURE(coupling);
            CAPTURE(rows);
            const slabs s(rows, coupling);
            capturedLog log;
            Time time(s.files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            const scalar H = rows * dx, settled = 0.6 * H * H / nu;
            const scalar dt = coupling == "projection" ? 1e-3 : settled / 40;
            runSteps(c, *scheme, dt, label(std::ceil(settled / dt)));
            scalar flow = 0, sway = 0;
            for (label i = 0; i < c.cloud.n(); ++i)
                if (c.cloud.isFluid(i)) flow += c.cloud.Up[i][0] * dx / columns;
                else sway = std::max(sway, c.cloud.Up[i].xyz().norm());
            CHECK(flow == relative(g * H * H * H / (12 * nu), 3.0 / (rows * rows)));
            CHECK(sway < 1e-2 * flow / H);
        }
}
