// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid sticks to the surface of a solid, half a dx before its first particles, (2.15): flow between two elastic slabs
#include "elasticSlabs.H"
#include "relative.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar nu = 1e-4, g = 1e-2, dx = elasticSlabs::dx;

}  // namespace

TEST_CASE("flow between two elastic slabs is that of a channel as wide as the gap between them")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const int rows : {6, 10, 20})
        {
            CAPTURE(coupling);
            CAPTURE(rows);
            const elasticSlabs s(rows, coupling, g, "mu " + str(1000 * nu) + ";");
            capturedLog log;
            Time time(s.files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            const scalar H = rows * dx, settled = 0.6 * H * H / nu;
            const scalar dt = coupling == "projection" ? 1e-3 : settled / 40;
            runSteps(c, *scheme, dt, label(std::ceil(settled / dt)));
            const scalar flow = elasticSlabs::flow(c.cloud);
            scalar sway = 0;
            for (label i = 0; i < c.cloud.nSolid(); ++i)
                sway = std::max(sway, c.cloud.Up[i].xyz().norm());
            CHECK(flow == relative(g * H * H * H / (12 * nu), 3.0 / (rows * rows)));
            CHECK(sway < 1e-2 * flow / H);
        }
}
