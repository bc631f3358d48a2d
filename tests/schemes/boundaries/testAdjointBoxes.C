// SPDX-License-Identifier: GPL-3.0-or-later
// Flows that dx does not resolve lose energy in every step and keep their particles apart
// (doc/theory/2-operators.md, 7-monolithic.md)
#include "caseOnDisk.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

struct flow
{
    word name, boundary;
    std::function<vector(const vector&)> velocity;
};

const flow flows[] = {
    {"vortices",
     "sides { type cyclic; point (0 0 0); separation (1 0 0); }"
     "ends { type cyclic; point (0 0 0); separation (0 1 0); }",
     [](const vector& x) {
         const scalar a = 2 * M_PI * x[0], b = 2 * M_PI * x[1];
         return vector(-std::cos(a) * std::sin(b) + 0.3 * std::sin(2 * b),
                       std::sin(a) * std::cos(b) + 0.3 * std::sin(2 * a + 1), 0);
     }},
    {"swirl between walls",
     "low { type wall; surface plane; point (0 0 0); normal (0 -1 0); }"
     "high { type wall; surface plane; point (0 1 0); normal (0 1 0); }"
     "left { type wall; surface plane; point (0 0 0); normal (-1 0 0); }"
     "right { type wall; representation mirror; surface plane; point (1 0 0); normal (1 0 0); }",
     [](const vector& x) {
         const scalar a = M_PI * x[0], b = M_PI * x[1];
         return vector(1.3 * std::pow(std::sin(a), 2) * std::sin(2 * b),
                       -1.3 * std::sin(2 * a) * std::pow(std::sin(b), 2), 0);
     }}};

constexpr int across = 20;
constexpr scalar dx = 1.0 / across;

scalar kineticEnergy(const particleCloud& cloud)
{
    scalar sum = 0;
    for (label i = 0; i < cloud.n(); ++i) sum += 0.5 * cloud.Up[i].xyz().squaredNorm();
    return sum;
}

// Closest pair of fluid particles [dx]
scalar closestPair(const fsiCase& c)
{
    scalar least = 1e30;
    for (label i = 0; i < c.cloud.n(); ++i)
        for (std::int64_t k = c.list.start[i]; k < c.list.mid[i]; ++k)
            least = std::min(least,
                             (c.cloud.x[i].xyz() - c.cloud.x[c.list.index[k]].xyz()).norm() / dx);
    return least;
}

}  // namespace

TEST_CASE(
    "with the adjoint pair a flow that is not resolved gains no energy and keeps its particles "
    "apart")
{
    for (const flow& f : flows)
        for (const word coupling : {"monolithic", "projection"})
            for (const scalar cellReynolds : {50.0, 1000.0})
            {
                CAPTURE(f.name);
                CAPTURE(coupling);
                CAPTURE(cellReynolds);
                caseOnDisk files("adjointBox");
                files.fill(across, across, dx);
                particleTable& t = files.particles();
                for (size_t i = 0; i < t.x.size(); ++i) t.vectors["U"][i] = f.velocity(t.x[i]);
                files.schemes = "kernel WendlandC2; hByDx 1.3;";
                files.solution = "coupling " + coupling + ";";
                files.properties = "rho 1; mu " + str(dx / cellReynolds) + ";";
                files.boundary = f.boundary;
                files.write();
                capturedLog log;
                Time time(files.path());
                fsiCase c(time);
                const auto scheme = couplingScheme::New(c);
                const scalar start = kineticEnergy(c.cloud);
                scalar before = start, gain = 0, least = 1e30;
                for (int step = 0; step < 250; ++step)
                {
                    runSteps(c, *scheme, 0.2 * dx, 1);
                    const scalar now = kineticEnergy(c.cloud);
                    gain = std::max(gain, (now - before) / start), before = now;
                    least = std::min(least, closestPair(c));
                }
                CHECK(gain < 1e-6);
                CHECK(before < start);
                CHECK(least > 0.3);
                // and not more than step and viscosity damp
                CHECK(before > (cellReynolds < 100 ? 0.2 : 0.4) * start);
            }
}
