// SPDX-License-Identifier: GPL-3.0-or-later
// A disc in fluid that only cyclic pairs bound.  A soft disc moving with all fluid at one speed does not change when it
// passes their planes.  A stiff disc carried by vortices keeps its area
#include "caseOnDisk.H"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.05, side = 20 * dx;
const vector drift = {1, 0.5, 0};
const word cyclicBox = R"(
    sides { type cyclic; point (0 0 0); separation (1 0 0); }
    ends  { type cyclic; point (0 0 0); separation (0 1 0); })";

// The unit square, solids first: those within the radius of the middle or, in a strip, those at middle height
void place(caseOnDisk& files, bool strip)
{
    files.fill(20, 20, dx);
    particleTable& t = files.particles();
    const particleTable all = t;
    const auto isSolid = [&](const vector& x) {
        const vector r = x - vector(0.5 * side, 0.5 * side, 0);
        return strip ? std::abs(r[1]) < 3 * dx : r.norm() < 4 * dx;
    };
    size_t n = 0;
    for (const bool solid : {true, false})
        for (const vector& x : all.x)
            if (isSolid(x) == solid) t.x[n] = x, t.integers["zone"][n] = solid, ++n;
    for (vector& u : t.vectors["U"]) u = drift;
    t.attributes["zones"] = "fluid solid", t.attributes["phases"] = "fluid solid";
}

}  // namespace

TEST_CASE("a solid that drifts over cyclic planes does so unnoticed, with both couplings")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const bool strip : {false, true})
        {
            CAPTURE(coupling);
            CAPTURE(strip);
            caseOnDisk files("driftingSolid");
            place(files, strip);
            files.boundary = cyclicBox;
            files.properties = "rho 1; mu 0.01;", files.solution = "coupling " + coupling + ";";
            files.write();
            setContent(files.path() + "/constant/structureProperties",
                       "structureModel springNetwork; E 10; links radius; radius 2.1;");
            capturedLog log;
            Time time(files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            for (int k = 0; k < 11; ++k)  // a tenth of the side each
            {
                runSteps(c, *scheme, 0.02, 5);
                for (label i = 0; i < c.cloud.n(); ++i)
                {
                    const vector x = c.cloud.x[i].xyz();
                    CHECK((c.cloud.Up[i].xyz() - drift).norm() < 1e-6);
                    CHECK(std::abs(c.cloud.Up[i][3]) < 1e-4);
                    CHECK(c.list.start[i + 1] - c.list.start[i] ==
                          20);  // the lattice, seen whole also beyond planes
                    // a body is never further out than half of its size, and a step
                    CHECK(std::max({-x[0], -x[1], x[0] - side, x[1] - side}) <
                          (strip ? 0.5 * side : 4 * dx) + 0.02);
                }
            }
        }
}

TEST_CASE(
    "a stiff disc among vortices neither swells nor shrinks, and fluid that meets it stretches no "
    "spring")
{
    caseOnDisk files("stiffDisc");
    place(files, false);
    particleTable& t = files.particles();
    for (size_t i = 0; i < t.x.size(); ++i)
    {
        const vector x = 2 * M_PI * t.x[i];
        t.vectors["U"][i] = {std::sin(x[0]) * std::sin(x[1]), std::cos(x[0]) * std::cos(x[1]), 0};
    }
    files.boundary = cyclicBox;
    files.properties = "rho 1; mu 0.01;", files.solution = "coupling monolithic;";
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel springNetwork; E 1e6; links radius; radius 2.1;");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    List<tensor> F;
    for (int k = 0; k < 20; ++k)
    {
        runSteps(c, *scheme, 0.02, 1);
        CHECK(log.count("Solving for Up") == k + 1);  // no step is halved
        c.structure->deformationGradient(c.cloud.x, F);
        scalar J = 0;
        for (const tensor& f : F) J += f.determinant() / scalar(F.size());
        CHECK(std::abs(J - 1) < 2e-5);
    }
}
