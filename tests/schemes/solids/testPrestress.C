// SPDX-License-Identifier: GPL-3.0-or-later
// A ring that starts under pressure stays where it starts, theory 7.11.  tests/runs/prestress.sh looks at the rest
#include "elasticRing.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::elasticRing;

namespace
{

const word rubber = "structureModel totalLagrangian; material { type neoHookean; G 1e4; } ";

word loaded(scalar p)
{
    word zones;
    for (int k = 0; k < nRings; ++k) zones += "ring" + std::to_string(k) + " " + str(p, 17) + "; ";
    return rubber + "prestress { pressures { " + zones + "} }";
}

}  // namespace

TEST_CASE("a ring under pressure stays as it starts")
{
    for (const scalar p : {240.0, 1250.0})
    {
        CAPTURE(p);
        const ringCase ring("prestress", loaded(p), false);
        capturedLog log;
        Time time(ring.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        const List<vec4> start(c.cloud.x.begin(), c.cloud.x.begin() + c.cloud.nSolid());
        CHECK(innerPressure(c.cloud) == relative(p, 1e-9));
        runSteps(c, *scheme, 0.01, 100);
        CHECK(innerPressure(c.cloud) == relative(p, 1e-3));
        scalar most = 0;
        for (label i = 0; i < c.cloud.nSolid(); ++i)
            most = std::max(most, (c.cloud.x[i].xyz() - start[i].xyz()).norm() / dx);
        CHECK(most < 1e-2);
    }
}
