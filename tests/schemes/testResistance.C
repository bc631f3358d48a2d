// SPDX-License-Identifier: GPL-3.0-or-later
// Zones of resistance against exact solutions, (1.11) to (1.13), in both couplings
#include "boxCase.H"
#include "core/errorOf.H"
#include "region.H"
#include "relative.H"
#include "triSurface.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

const word slips = "type wall; slip yes;", sticks = "type wall; representation mirror;";
constexpr scalar rho = 1000;

// A channel that repeats itself, under the pressure drop P
boxCase channel(const word& coupling, const word& wall, scalar P)
{
    boxCase box;
    box.coupling = coupling, box.mu = 0.01;
    box.patch = {"type cyclic; pressureDrop " + str(P, 17) + ";", "", wall, wall};
    return box;
}

scalar meanOf(const fsiCase& c, int component, scalar from, scalar to)
{
    scalar sum = 0, n = 0;
    for (label i = 0; i < c.cloud.n(); ++i)
        if (c.cloud.x[i][0] > from && c.cloud.x[i][0] < to) sum += c.cloud.Up[i][component], ++n;
    return sum / n;
}

// Sum of a term of the energy ledger since the start
scalar booked(const fsiCase& c, energyLedger::term term)
{
    return energyLedger::sums(c)[term];
}

}  // namespace

TEST_CASE("a plug takes the pressure (mu d + rho f U/2) U L, wherever its ends are")
{
    struct numbers
    {
        scalar d, f;
    };
    constexpr scalar U = 0.02, dt = 0.015;
    for (const word coupling : {"projection", "monolithic"})
        for (const numbers n : {numbers{1e8, 0}, numbers{0, 1e5}, numbers{5e7, 5e4}})
        {
            CAPTURE(coupling);
            CAPTURE(n.d);
            CAPTURE(n.f);
            boxCase box = channel(coupling, slips, 0);
            const scalar from = 10.3 * box.dx, L = 9.6 * box.dx,
                         P = (box.mu * n.d + rho * n.f * U / 2) * U * L;
            box = channel(coupling, slips, P);
            box.velocity = {0.8 * U, 0, 0};
            box.porosity = "plug { type DarcyForchheimer; d " + str(n.d, 17) + "; f " +
                           str(n.f, 17) + "; shape box; min (" + str(from, 17) + " -1 0); max (" +
                           str(from + L, 17) + " 1 0); }";
            runningBox run(box, "plug");
            run.run(dt, 40);
            const scalar u = meanOf(run.c, 0, 0, 1);
            CHECK((box.mu * n.d + rho * n.f * u / 2) * u * L == relative(P, 0.01));
            // the pressure is that of a plug, too
            const scalar before = meanOf(run.c, 3, 5 * box.dx, from - 2 * box.dx),
                         behind = meanOf(run.c, 3, from + L + 2 * box.dx, 25 * box.dx);
            CHECK(before - behind == relative(P, 0.01));
            CHECK(!run.log.contains("halved"));
            // steady: the drop's work goes into the medium
            const scalar lost = booked(run.c, energyLedger::viscosity),
                         given = booked(run.c, energyLedger::forces);
            run.run(dt, 10);
            CHECK(booked(run.c, energyLedger::viscosity) - lost ==
                  relative(given - booked(run.c, energyLedger::forces), 0.01));
            CHECK(std::abs(energyLedger::sums(run.c).back()) < 1e-9 * given);
            CHECK(std::abs(booked(run.c, energyLedger::solver)) < 1e-3 * given);
        }
}

TEST_CASE("a channel full of a porous medium has the profile of Brinkman's equation")
{
    constexpr scalar G = 1;
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box = channel(coupling, sticks, 0);
        box.nx = 10, box.ny = 40, box.mu = 1;
        const scalar H = box.height(), d = std::pow(8 / H, 2);
        box = channel(coupling, sticks, G * box.length());
        box.nx = 10, box.ny = 40, box.mu = 1;
        box.porosity = "all { type DarcyForchheimer; permeability " + str(1 / d, 17) +
                       "; shape formula; formula \"x < 1\"; }";
        runningBox run(box, "Brinkman");
        run.run(0.05, 40);
        scalar worst = 0, most = 0;
        for (label i = 0; i < run.c.cloud.n(); ++i)
        {
            const scalar y = run.c.cloud.x[i][1],
                         exact = G / (box.mu * d) *
                                 (1 - std::cosh(std::sqrt(d) * (y - H / 2)) /
                                          std::cosh(std::sqrt(d) * H / 2));
            worst = std::max(worst, std::abs(run.c.cloud.Up[i][0] - exact));
            most = std::max(most, exact);
        }
        CHECK(worst < 0.01 * most);
    }
}

TEST_CASE("a resistance of 1e12 per square metre limits no step, and lets nearly nothing through")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const bool whole : {true, false})
        {
            CAPTURE(coupling);
            CAPTURE(whole);
            constexpr scalar P = 0.1;
            boxCase box = channel(coupling, slips, P);
            // whole: a plug over all the height; else fluid flows past it
            box.porosity =
                "block { type DarcyForchheimer; d 1e12; shape box; min (0.01 -1 0); max "
                "(0.02 " +
                str(whole ? 1 : 0.006) + " 0); }";
            runningBox run(box, "block");
            run.run(whole ? 0.1 : 0.02, 20);  // rho/chi is 1e-7 s
            CHECK(!run.log.contains("halved"));
            const scalar most = run.c.cloud.maxSpeed();
            if (whole)
            {
                // the plug's own flow is P/(mu d L) = 1e-9 m/s
                CHECK(most < 1e-6);
                CHECK(meanOf(run.c, 3, 0.003, 0.008) - meanOf(run.c, 3, 0.022, 0.027) ==
                      relative(P, 0.01));
                continue;
            }
            for (label i = 0; i < run.c.cloud.n(); ++i)
                if (const vector x = run.c.cloud.x[i].xyz();
                    x[0] > 0.0115 && x[0] < 0.0185 && x[1] < 0.0045)
                    CHECK(run.c.cloud.Up[i].xyz().norm() < 1e-4 * most);
            CHECK(meanOf(run.c, 0, 0, 1) > 0.1 * most);
        }
}

TEST_CASE("a thrombus grows where the fluid is old and hardly sheared, at its rate")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        constexpr scalar G = 100, dt = 0.01, T = 10, limit = 0.3;
        boxCase box = channel(coupling, sticks, 0);
        box.nx = 10;
        box = channel(coupling, sticks, G * box.length());
        box.nx = 10, box.mu = 1;
        box.porosity =
            "clot { type thrombus; d 1e-9; residenceTime 5; shearRate 0.3; growthTime 10; }";
        runningBox run(box, "thrombus");
        particleCloud& cloud = run.c.cloud;
        List<scalar>& age = cloud.scalars["residenceTime"];
        age.assign(cloud.n(), 0);
        // before the flow is developed nothing is old
        run.run(dt, 30);
        for (label i = 0; i < cloud.n(); ++i)
            cloud.scalars["residenceTime"][i] = cloud.id[i] % 2 ? 6 : 4;
        for (const scalar s : cloud.scalars.at("thrombus")) CHECK(s == 0);
        run.run(dt, 5);
        int grown = 0;
        for (label i = 0; i < cloud.n(); ++i)
        {
            const scalar rate = G / box.mu * std::abs(cloud.x[i][1] - box.height() / 2),
                         s = cloud.scalars.at("thrombus")[i];
            const bool old = cloud.id[i] % 2;
            if (old && rate < 0.9 * limit)
            {
                CHECK(s == relative(5 * dt / T, 1e-12));
                ++grown;
            }
            if (!old || rate > 1.1 * limit) CHECK(s == 0);
        }
        CHECK(grown > 10);
    }
}

TEST_CASE("a clot that has grown resists as its state says, and fluid without its age is refused")
{
    boxCase box = channel("monolithic", slips, 0);
    constexpr scalar d = 1e8, U = 0.02;
    box = channel("monolithic", slips, 0.25 * box.mu * d * U * box.length());
    box.velocity = {U, 0, 0};
    box.porosity = "clot { type thrombus; d 1e8; residenceTime 1e9; shearRate 1; growthTime 1; }";
    runningBox run(box, "clot");
    CHECK_ERROR(run.run(0.015, 1), "residenceTime", 0);
    for (const word field : {"residenceTime", "thrombus"})
        run.c.cloud.scalars[field].assign(run.c.cloud.n(), 0.25);
    run.run(0.015, 20);
    CHECK(meanOf(run.c, 0, 0, 1) == relative(U, 0.001));
}

TEST_CASE("a zone without effect, or described twice or wrongly, is refused with the reason")
{
    const auto begin = [](const word& entries) {
        boxCase box = channel("monolithic", slips, 0);
        box.porosity = "zone { " + entries + " }";
        runningBox run(box, "wrongZone");
    };
    const word all = " shape formula; formula \"1\";";
    CHECK_ERROR(begin("type porous; d 1;" + all), "DarcyForchheimer", 0);
    CHECK_ERROR(begin("type DarcyForchheimer;" + all), "resists nothing", 0);
    CHECK_ERROR(begin("type DarcyForchheimer; d 1; permeability 1;" + all), "permeability", 0);
    CHECK_ERROR(begin("type DarcyForchheimer; d 1;"), "shape", 0);
    CHECK_ERROR(begin("type DarcyForchheimer; d -1;" + all), "d", 0);
    CHECK_ERROR(begin("type DarcyForchheimer; d 1; growthTime 1;" + all), "growthTime", 0);
    CHECK_ERROR(begin("type DarcyForchheimer; d 1; shape box; min (1 1 0); max (2 2 0);"),
                "No fluid particle", 0);
    CHECK_ERROR(begin("type thrombus; d 1; residenceTime 1; shearRate 1; growthTime 1; } other { "
                      "type thrombus; d 1; residenceTime 1; shearRate 1; growthTime 1;"),
                "one thrombus", 0);
}

// A border of the width W adds what a curved surface has more outside than inside
TEST_CASE("the shares of a region add up to its volume, wherever the particles are")
{
    constexpr scalar dx = 0.05, W = region::border * dx;
    const scratchFolder folder("region");
    const auto volume = [&](const word& text, int nDims, const vector& shift) {
        const auto part = region::New(dictionary::fromString(text), dx, nDims, word(folder / "."));
        scalar sum = 0;
        const int n = 30, nz = nDims == 3 ? n : 0;
        for (int i = -n; i <= n; ++i)
            for (int j = -n; j <= n; ++j)
                for (int k = -nz; k <= nz; ++k) sum += part->share(dx * (vector(i, j, k) + shift));
        return sum * std::pow(dx, nDims);
    };
    triSurface cube;
    const label patch = cube.addPatch("cube");
    for (int axis = 0; axis < 3; ++axis)
        for (const scalar side : {-1.0, 1.0})
        {
            const auto at = [&](scalar a, scalar b) {
                vector x;
                x[axis] = side, x[(axis + 1) % 3] = side * a, x[(axis + 2) % 3] = b;
                return vector(500 * x);
            };
            cube.add(at(-1, -1), at(1, -1), at(1, 1), patch);
            cube.add(at(-1, -1), at(1, 1), at(-1, 1), patch);
        }
    writeSTL(cube, folder / "cube.stl");
    for (const vector& shift : {vector(0, 0, 0), vector(0.3, 0.45, 0)})
    {
        CHECK(volume("shape box; min (-0.31 -0.2 0); max (0.4 0.26 0);", 2, shift) ==
              relative(0.71 * 0.46, 1e-9));
        CHECK(volume("shape sphere; centre (0 0 0); radius 0.5;", 3, shift) ==
              relative(4 * M_PI / 3 * (0.125 + 0.5 * W * W / 4), 1e-3));
        CHECK(volume("shape cylinder; point1 (0 0 -0.5); point2 (0 0 0.5); radius 0.6;", 3,
                     shift) == relative(M_PI * (0.36 + W * W / 12), 1e-3));
        CHECK(volume("shape cylinder; point1 (0.1 0 0); radius 0.6;", 2, shift) ==
              relative(M_PI * (0.36 + W * W / 12), 1e-3));
        CHECK(volume("file cube.stl; unit mm;", 3, shift) == relative(1, 0.05));
    }
    CHECK_ERROR(volume("shape cube;", 3, vector::Zero()), "formula", 0);
    CHECK_ERROR(volume("shape box; min (1 0 0); max (0 1 1);", 3, vector::Zero()), "max", 0);
}
