// SPDX-License-Identifier: GPL-3.0-or-later
// Plug flow between slip walls, driven by P from a face with given pressure to a face with a resistance (doc/theory 4.11):
//     rho L/H dQ/dt = P - R Q,   Q = P/R (1 - exp(-t/T)),   T = rho L/(H R)
#include "boxCase.H"
#include "core/errorOf.H"
#include "outlet.H"
#include "relative.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

const word slips = "type wall; slip yes;";
constexpr scalar P = 2, rho = 1000;

boxCase channel(const word& coupling, scalar R)
{
    boxCase box;
    box.nx = 16, box.ny = 8, box.coupling = coupling;
    box.patch = {"type open; p 2; backflow 0;",
                 "type open; outlet resistance; p 0; resistance " + str(R, 17) + ";", slips, slips};
    return box;
}

scalar flow(const fsiCase& c)
{
    return c.cloud.state.values().at("outlet right").at(0);
}

// Largest p in the strip of the resistance; its slope is negligible
scalar pressureBeyond(const fsiCase& c, scalar length)
{
    scalar most = -1e30;
    for (label i = 0; i < c.cloud.n(); ++i)
        if (c.cloud.x[i][0] > length && c.cloud.pFixed[i]) most = std::max(most, c.cloud.Up[i][3]);
    return most;
}

}  // namespace

TEST_CASE(
    "flow through a resistance: at rest, on its way and from any step, however large the "
    "resistance")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const scalar ofInertia : {0.1, 1.0, 1e3, 1e7})
        {
            CAPTURE(coupling);
            CAPTURE(ofInertia);
            constexpr scalar dt = 0.01;
            boxCase box = channel(coupling, 1);
            const scalar inertance = rho * box.length() / box.height(),
                         R = ofInertia * inertance / dt;
            box = channel(coupling, R);
            runningBox run(box, "outlet");
            scalar Q = 0;
            for (int step = 0; step < 20; ++step)
            {
                run.run(dt, 1);
                Q = (Q * inertance + dt * P) / (inertance + dt * R);  // backward Euler
                // in the first step the slope of p in the strip is not known yet
                const scalar small = 0.1 * dt * P / (inertance + dt * R) + 1e-9;
                CHECK(std::abs(flow(run.c) - Q) < 0.02 * Q + small);
                if (step > 2)
                    CHECK(std::abs(pressureBeyond(run.c, box.length()) - R * Q) < 0.04 * P);
            }
        }
}

TEST_CASE("a quarter of a face has a quarter of the flow: the resistance is that of the whole")
{
    boxCase box = channel("monolithic", 2e5);
    box.patch[boxCase::bottom] = "type symmetryPlane;";
    runningBox half(box, "outletHalf");
    half.run(0.01, 40);
    box = channel("monolithic", 2e5);
    box.ny = 16;
    runningBox whole(box, "outletWhole");
    whole.run(0.01, 40);
    CHECK(flow(half.c) == relative(flow(whole.c), 0.01));
}

TEST_CASE(
    "an outlet of no kind that there is, or a resistance that pushes, is refused with what would "
    "be right")
{
    const auto begin = [](const word& entries) {
        boxCase box = channel("monolithic", 1);
        box.patch[boxCase::right] = "type open; p 0; " + entries;
        runningBox run(box, "outletWrong");
    };
    CHECK_ERROR(begin("outlet resistence;"), "resistance", 0);
    CHECK_ERROR(begin("outlet resistance; resistance -1;"), "resistance", 0);
    CHECK_ERROR(begin("resistance 1;"), "resistance", 0);  // without effect
    CHECK_ERROR(begin("outlet nonReflecting; waveSpeed -1;"), "waveSpeed", 0);
}

// Plug flow as above into a Windkessel, both equations by the implicit Euler rule:
//     (L + dt Z) Q1 + dt pC1 = L Q0 + dt P,   C (pC1 - pC0)/dt = Q1 - pC1/R
TEST_CASE(
    "a Windkessel: flow and pressure in its compliance over time, for short and for long times "
    "of it, from its initial pressure on")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const scalar steps : {0.05, 5.0, 5e3})  // R C over dt
        {
            CAPTURE(coupling);
            CAPTURE(steps);
            constexpr scalar dt = 0.01;
            boxCase box = channel(coupling, 1);
            const scalar inertance = rho * box.length() / box.height(), Z = 0.3 * inertance / dt,
                         R = 2 * inertance / dt, C = steps * dt / R, first = 0.4 * P;
            box.patch[boxCase::right] = "type open; outlet Windkessel; p 0; proximal " +
                                        str(Z, 17) + "; distal " + str(R, 17) + "; compliance " +
                                        str(C, 17) + "; initialPressure " + str(first, 17) + ";";
            runningBox run(box, "Windkessel");
            scalar Q = 0, stored = first;
            for (int step = 0; step < 20; ++step)
            {
                run.run(dt, 1);
                // eliminate pC1
                const scalar share = 1 / (1 + dt / (R * C)), rise = dt / C * share;
                Q = (inertance * Q + dt * (P - share * stored)) / (inertance + dt * (Z + rise));
                stored = share * stored + rise * Q;
                const List<scalar> kept = run.c.cloud.state.values().at("outlet right");
                const scalar small = 0.1 * dt * P / (inertance + dt * Z) + 1e-9;
                CHECK(std::abs(kept.at(0) - Q) < 0.02 * std::abs(Q) + small);
                CHECK(std::abs(kept.at(2) - stored) < 0.03 * P);
                // p of the face is that of its own flow
                if (step > 2)
                    CHECK(std::abs(pressureBeyond(run.c, box.length()) - Z * kept.at(0) -
                                   kept.at(2)) < 0.01 * P);
            }
        }
}

TEST_CASE("a run that is continued with an outlet of another kind starts that one's memory anew")
{
    const outlet::step step{0, 0.01, 1};
    const auto made = [&](const word& text) {
        return outletPressure(outlet::New(dictionary::fromString(text), "", dims::flowRate));
    };
    const word vessels = "outlet Windkessel; p 0; distal 1e8; compliance 1; initialPressure ";
    outletPressure resistance = made("outlet resistance; p 0; resistance 1e5;"),
                   Windkessel = made(vessels + "1000;"), later = made(vessels + "5;");
    resistance.begin(step, {1e-6, 0, -1e-9});  // flow, no state, dQ/dp
    CHECK(Windkessel.begin(step, resistance.accept(step, 1e-6)) == relative(1000, 1e-6));
    CHECK(Windkessel.flow() == 1e-6);
    CHECK(later.begin(step, Windkessel.accept(step, 1e-6)) == relative(1000, 1e-6));
}

TEST_CASE(
    "resistances and compliances in the units of the clinic; a unit of something else is refused")
{
    const auto made = [](const word& text, const dimensionSet& flow = dims::flowRate) {
        return outlet::New(dictionary::fromString("outlet " + text), "", flow);
    };
    constexpr scalar mmHg = 133.322387415, ml = 1e-6;
    const outlet::step step{0, 0.01, 1};
    const word minutes = "resistance; p 0; resistance 2 [mmHg min/l];";
    CHECK(made(minutes)->slope(step) == relative(2 * mmHg * 60 / 1e-3, 1e-9));
    CHECK_ERROR(made(minutes, dims::kinematicViscosity), "resistance", 0);
    const scalar p = made(
                         "Windkessel; p 0; distal 1 [mmHg s/ml]; compliance 2 [ml/mmHg]; "
                         "initialPressure 80 [mmHg];")
                         ->pressure(step, 3 * ml);
    // implicit Euler: C (p - p0)/dt = Q - p/R
    CHECK(p == relative((2 * 80 / 0.01 + 3) / (2 / 0.01 + 1) * mmHg, 1e-9));
}

TEST_CASE("an end without reflection is a resistance rho c/A, of the whole face of all images")
{
    constexpr scalar c = 3, dt = 0.01;
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        const auto run = [&](const word& outlet, const word& low) {
            boxCase box = channel(coupling, 1);
            box.patch[boxCase::right] = "type open; p 0; outlet " + outlet;
            box.patch[boxCase::bottom] = low;
            runningBox r(box, "nonReflecting");
            r.run(dt, 10);
            return flow(r.c);
        };
        const scalar H = channel(coupling, 1).height();
        const word waves = "nonReflecting; waveSpeed " + str(c, 17) + ";";
        const scalar Q = run(waves, slips);
        CHECK(Q ==
              relative(run("resistance; resistance " + str(rho * c / H, 17) + ";", slips), 1e-9));
        CHECK(run(waves, "type symmetryPlane;") == relative(2 * Q, 0.01));
    }
}

// Slow flow out of a box at the pressure P through three outlets: each has the flow that it alone would have
TEST_CASE("outlets of different kinds in one case")
{
    constexpr scalar R = 4e5, Z = 1e5, D = 2e5, c = 5, dt = 0.05;
    for (const word coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box = channel(coupling, 1);
        box.mu = 1e-3;
        box.patch = {"type open; p 2; backflow 0;",
                     "type open; p 0; outlet nonReflecting; waveSpeed " + str(c, 17) + ";",
                     "type open; p 0; outlet resistance; resistance " + str(R, 17) + ";",
                     "type open; p 0; outlet Windkessel; proximal " + str(Z, 17) + "; distal " +
                         str(D, 17) + "; compliance 1e-7;"};
        runningBox run(box, "manyOutlets");
        run.run(dt, 20);
        const auto out = [&](const char* face) {
            return run.c.cloud.state.values().at(word("outlet ") + face).at(0);
        };
        CHECK(out("right") == relative(P * box.height() / (rho * c), 0.02));
        CHECK(out("bottom") == relative(P / R, 0.02));
        CHECK(out("top") == relative(P / (Z + D), 0.02));
    }
}
