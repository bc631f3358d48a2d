// SPDX-License-Identifier: GPL-3.0-or-later
// A quarter of an elastic ring around a quarter of four vortices that no open face drains.  No volume passes its surface,
// but the divergence of the stirred particles misses some volume in every step
#include "caseOnDisk.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.05, inner = 1, outer = 1.3;

// Psi = 3.5 x y (1 - r^2)^2, at rest on the wall; largest speed 1
vector vortices(const vector& x)
{
    const scalar s = 1 - x.squaredNorm();
    if (s < 0) return vector::Zero();
    return 3.5 * s * vector(x[0] * (s - 4 * x[1] * x[1]), -x[1] * (s - 4 * x[0] * x[0]), 0);
}

void fillRing(particleTable& t)
{
    t.setAttribute("dx", dx), t.setAttribute("nDims", 2);
    t.attributes["zones"] = "wall lumen", t.attributes["phases"] = "solid fluid";
    const int n = int(outer / dx) + 1;
    for (const bool solid : {true, false})
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                const vector x = dx * vector(i + 0.5, j + 0.5, 0);
                if (x.norm() > outer || (x.norm() > inner) != solid) continue;
                t.x.push_back(x), t.vectors["U"].push_back(vortices(x));
                t.scalars["p"].push_back(0), t.integers["zone"].push_back(!solid);
                t.integers["id"].push_back(globalId(t.integers["id"].size()));
            }
}

}  // namespace

TEST_CASE("an elastic ring keeps its area while the fluid within is stirred")
{
    caseOnDisk files("stirredRing");
    fillRing(files.particles());
    files.solution = "coupling monolithic;", files.properties = "rho 1; mu 0.005;";
    files.control = "startTime 0; endTime 2; deltaT 0.01; writeControl none;";
    files.boundary =
        "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
        "below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel springNetwork; G 50; links radius; radius 2.1;");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 0.01, 25);
    scalar growth = 0;  // of r^2, the same in all layers
    for (label i = 0; i < c.cloud.nSolid(); ++i)
        growth +=
            (c.cloud.x[i].xyz().squaredNorm() - c.cloud.vectors.at("x0")[i].xyz().squaredNorm()) /
            scalar(c.cloud.nSolid());
    MESSAGE("relative change of the area: ", growth / (inner * inner));
    CHECK(std::abs(growth) < 5e-4);
}
