// SPDX-License-Identifier: GPL-3.0-or-later
// The energy ledger closes to rounding, term by term, for all boundaries of the fluid (doc/theory 6.4, 7.3).  Steps that
// cannot be accepted are undone and halved
#include "boxCase.H"
#include "core/errorOf.H"
#include "relative.H"

#include <doctest/doctest.h>
#include <numeric>

using namespace ispf;

namespace
{

struct bounds
{
    word name;
    std::array<word, 4> patch;  // left, right, bottom, top
    word g;
};

const word still = "type wall;";
const bounds scenes[] = {
    {"lid", {still, still, still, "type wall; velocity (0.05 0 0);"}, ""},
    {"lid of mirrors",
     {still, "type wall; representation mirror;", still,
      "type wall; representation mirror; velocity (0.05 0 0);"},
     ""},
    {"pressures, a wall that slips",
     {"type open; p 2;", "type open; p 0;", still, "type wall; slip yes;"},
     ""},
    {"flow rate, symmetry plane",
     {"type open; velocity 0.02;", "type open; p 100;", "type symmetryPlane;", still},
     ""},
    {"pressure drop", {"type cyclic; pressureDrop 1;", "", still, still}, ""},
    {"plunger under gravity",
     {"type wall; motion { velocity (0.02 0 0); }", "type open; p 0;", still, still},
     "(1 -9.81 0)"},
};

scalar at(const fsiCase& c, int k)
{
    return c.cloud.state.values().at("energyLedger").at(k);
}

scalar largest(const fsiCase& c)
{
    scalar most = 0;
    for (int k = 0; k < energyLedger::nStores + energyLedger::nTerms; ++k)
        most = std::max(most, std::abs(at(c, k)));
    return most;
}

// A slab of springs on fluid, stretched by one per cent; half of both, between symmetry planes
struct stretchedBlock
{
    caseOnDisk files{"energyLedgerSolid"};

    stretchedBlock(const word& coupling, const word& ddt)
    {
        files.fill(10, 16, 0.01);
        particleTable& t = files.particles();
        t.attributes["zones"] = "block bath", t.attributes["phases"] = "solid fluid";
        t.vectors["x0"] = t.x;
        for (size_t i = 0; i < t.x.size(); ++i) t.integers["zone"][i] = i < 60 ? 0 : 1;
        for (size_t i = 0; i < 60; ++i) t.x[i][0] *= 1.01, t.x[i][1] *= 0.99;
        files.boundary =
            "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
            "right { type symmetryPlane; point (0.101 0 0); normal (1 0 0); }"
            "low { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
        files.schemes += "ddtScheme " + ddt + ";";
        files.solution = "coupling " + coupling + ";";
        files.write();
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel springNetwork; E 100; links radius; radius 2.1;");
    }
};

}  // namespace

TEST_CASE("the energy ledger closes with walls, open faces and forces of every kind")
{
    label gaveBack = 0;
    for (const bounds& s : scenes)
        for (const word coupling : {"projection", "monolithic"})
            for (const word ddt : {"Euler", "DLN"})
            {
                CAPTURE(s.name);
                CAPTURE(coupling);
                CAPTURE(ddt);
                boxCase box;
                box.nx = 16, box.patch = s.patch, box.coupling = coupling;
                box.schemes = "ddtScheme " + ddt + ";";
                caseOnDisk files("energyLedger");
                files.g = s.g;
                box.write(files);
                capturedLog log;
                Time time(files.path());
                fsiCase c(time);
                const auto scheme = couplingScheme::New(c);
                scalar put = 0;
                const auto energy = [&] { return at(c, 0) + at(c, 1) + at(c, 2); };
                runSteps(c, *scheme, 0.005, 1);
                const scalar first = energy();
                const List<scalar> sums = energyLedger::sums(c);
                put -= std::accumulate(sums.begin(), sums.end(), scalar(0));
                for (int step = 0; step < 20; ++step)
                {
                    const List<scalar> old = energyLedger::sums(c);
                    runSteps(c, *scheme, 0.005, 1);
                    const auto gained = [&](energyLedger::term t) {
                        return energyLedger::sums(c)[t] - old[t];
                    };
                    // monolithic: G p of a pressure drop over a cyclic patch is not a part of the square of p
                    CHECK(gained(energyLedger::stabiliser) <=
                          (s.name == "pressure drop" ? 1e-5 : 1e-12) * largest(c));
                    CHECK(gained(energyLedger::viscosity) <= 0);
                    if (!c.walls->hasOpen())
                        CHECK(gained(energyLedger::shifting) <=
                              -gained(energyLedger::viscosity) + 1e-14 * largest(c));
                    // (8.45): the energy that shifting gives back was taken before
                    if (gained(energyLedger::shifting) > 0)
                    {
                        const List<scalar> all = energyLedger::sums(c);
                        CHECK(all[energyLedger::step] + all[energyLedger::stabiliser] +
                                  all[energyLedger::shifting] <=
                              1e-14 * largest(c));
                        ++gaveBack;
                    }
                }
                CHECK(std::abs(energyLedger::sums(c).back()) < 1e-11 * largest(c));
                const List<scalar> now = energyLedger::sums(c);
                put += std::accumulate(now.begin(), now.end(), scalar(0));
                CHECK(energy() - first == doctest::Approx(put).epsilon(1e-9));
                CHECK(at(c, energyLedger::nStores + energyLedger::viscosity) < 0);
                CHECK(std::abs(at(c, energyLedger::nStores + energyLedger::solver)) <
                      1e-3 * largest(c));
                if (ddt == "Euler") CHECK(at(c, energyLedger::nStores + energyLedger::step) < 0);
            }
    CHECK(gaveBack > 20);
}

TEST_CASE("the energy ledger closes with a solid, and goes on after a restart")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const word ddt : {"Euler", "DLN"})
        {
            if (coupling == "projection" && ddt == "DLN") continue;
            CAPTURE(coupling);
            CAPTURE(ddt);
            stretchedBlock block(coupling, ddt);
            capturedLog log;
            Time time(block.files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            runSteps(c, *scheme, 1e-3, 10);
            CHECK(at(c, energyLedger::elastic) > 0);
            CHECK(std::abs(energyLedger::sums(c).back()) < 1e-11 * largest(c));
            const List<scalar> before = energyLedger::sums(c);
            c.write();
            setContent(block.files.path() + "/system/controlDict",
                       "startFrom latestTime; startTime 0; endTime 1; deltaT 1e-3; writeControl "
                       "timeStep; writeInterval 1e6;");
            Time later(block.files.path());
            fsiCase again(later);
            CHECK(energyLedger::sums(again) == before);
        }
    stretchedBlock block("projection", "DLN");
    Time time(block.files.path());
    fsiCase c(time);
    CHECK_ERROR(couplingScheme::New(c), "takes springs explicitly", 1);
}

TEST_CASE("a step in which particles would pass each other is halved, with either coupling")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box;
        box.patch = {"type cyclic;", "", "type cyclic;", ""}, box.coupling = coupling;
        runningBox run(box);
        const scalar k = 2 * M_PI / box.height();
        for (label i = 0; i < run.c.cloud.n(); ++i)
            run.c.cloud.Up[i][0] = 0.7 * std::sin(k * run.c.cloud.x[i][1]);
        run.run(2e-3, 1);  // layers slide by 0.73 of their distance; in half of it by 0.36
        CHECK(run.time.value() == relative(2e-3, 1e-12));
        const auto& kept = coupling == "projection" ? entries::projectedStep : entries::levelBefore;
        CHECK(run.c.cloud.state.get(kept, 0) == relative(1e-3, 1e-12));
        run.run(1e-3, 1);
        CHECK(run.c.cloud.state.get(kept, 0) == relative(1e-3, 1e-12));
    }
}

TEST_CASE("a step in which particles move far together is accepted, with either coupling")
{
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box;
        box.patch = {"type cyclic;", "", still, still}, box.coupling = coupling;
        box.mu = 1e-6, box.velocity = {0.5, 0, 0};
        runningBox run(box);
        run.run(2e-3, 1);  // a spacing
        const auto& kept = coupling == "projection" ? entries::projectedStep : entries::levelBefore;
        CHECK(run.c.cloud.state.get(kept, 0) == relative(2e-3, 1e-12));
    }
}

TEST_CASE(
    "a step in which velocities change too fast for its order is halved, with either coupling")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const scalar way :
             {0.35, 0.45})  // in a step from rest, half of which is uncertain [dx]
        {
            CAPTURE(coupling);
            CAPTURE(way);
            boxCase box;
            const scalar dt = 2e-3, drop = 1000 * box.length() * way * box.dx / (dt * dt);
            box.patch = {"type cyclic; pressureDrop " + str(drop) + ";", "", still, still};
            box.coupling = coupling;
            runningBox run(box);
            run.run(dt, 1);
            CHECK(run.time.value() == relative(dt, 1e-12));
            const auto& kept =
                coupling == "projection" ? entries::projectedStep : entries::levelBefore;
            CHECK(run.c.cloud.state.get(kept, 0) == relative(way < 0.4 ? dt : dt / 2, 1e-12));
        }
}
