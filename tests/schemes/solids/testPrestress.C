// SPDX-License-Identifier: GPL-3.0-or-later
// A ring that starts under pressure: its rest is found, and it stays where it starts, theory 7.11
#include "elasticRing.H"
#include "relative.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::elasticRing;

namespace
{

// little stiffness against motions without strain: the ring at rest has none of it, the one that is inflated does
const word rubber =
    "structureModel totalLagrangian; material { type neoHookean; G 1e4; } zeroEnergy 0.02; ";

word loaded(scalar p)
{
    word zones;
    for (int k = 0; k < nRings; ++k) zones += "ring" + std::to_string(k) + " " + str(p, 17) + "; ";
    return rubber + "prestress { pressures { " + zones + "} }";
}

// Pressure in the ring once `share` of its inner area has been added
scalar inflated(scalar share)
{
    const ringCase ring("prestressForward", rubber, false);
    Time time(ring.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    for (int step = 0; step < 50; ++step)
    {
        addArea(c, share * M_PI * innerRadius * innerRadius / 50 / 0.01);
        runSteps(c, *scheme, 0.01, 1);
    }
    c.source.clear();
    runSteps(c, *scheme, 0.01, 50);
    return innerPressure(c.cloud);
}

// Share of the inner area at rest by which the ring has grown, from what its particles have moved; rest: their rest places
scalar grown(const particleCloud& cloud, const List<vec4>& rest)
{
    scalar sum = 0;
    for (label i = 0; i < cloud.nSolid(); ++i)
        sum += cloud.x[i].xyz().squaredNorm() - rest[i].xyz().squaredNorm();
    const scalar added = sum / cloud.nSolid();  // r^2 - R^2, the same for all
    return added / (innerRadius * innerRadius - added);
}

// The growth from rest to the ring of the case that has the pressure which the ring itself has once it has grown by `share`
scalar sameLoad(scalar share)
{
    const scalar p = neoHookean(1, share * M_PI);
    scalar low = 0, high = 1;
    for (int k = 0; k < 60; ++k)
    {
        const scalar s = 0.5 * (low + high),
                     in2 = 1 / (1 + s);  // square of the inner radius at rest
        const scalar a = std::sqrt(1 / in2),
                     b = outerRadius / std::sqrt(outerRadius * outerRadius - 1 + in2);
        (std::log(a / b) + 0.5 * (1 / (b * b) - 1 / (a * a)) < p ? low : high) = s;
    }
    return low;
}

}  // namespace

TEST_CASE("the rest of a ring under pressure grows by the share that gives it this pressure")
{
    capturedLog log;
    const scalar p = inflated(0.05);
    const ringCase ring("prestress", loaded(p), false);
    Time time(ring.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    CHECK(grown(c.cloud, c.cloud.vectors.at(restPlaces)) == relative(sameLoad(0.05), 0.03));
}

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
