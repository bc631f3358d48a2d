// SPDX-License-Identifier: GPL-3.0-or-later
// A shear wave that stands in a block of solid with a memory, which repeats itself, with both couplings (theory 5.9)
#include "caseOnDisk.H"
#include "core/errorOf.H"
#include "relative.H"

#include <array>
#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, G = 10, rho = 1000;
constexpr int nx = 12, ny = 6;
const scalar k = 2 * M_PI / (nx * dx), period = 2 * M_PI / (k * std::sqrt(G / rho));

struct branch
{
    scalar g, time;
};

// The wave in memory
struct wave
{
    inline static int number = 0;
    caseOnDisk files{"relaxingWave" + std::to_string(++number)};  // several live side by side
    capturedLog log;
    std::unique_ptr<Time> time;
    std::unique_ptr<fsiCase> c;
    std::unique_ptr<couplingScheme> scheme;

    wave(const word& coupling, const word& ddt, const List<branch>& branches, scalar speed)
    {
        files.fill(nx, ny, dx);
        particleTable& t = files.particles();
        t.attributes["zones"] = "solid", t.attributes["phases"] = "solid";
        for (size_t i = 0; i < t.x.size(); ++i)
            t.vectors["U"][i] = {0, speed * std::sin(k * t.x[i][0]), 0};
        files.boundary = "sides { type cyclic; point (0 0 0); separation (" + str(nx * dx, 17) +
                         " 0 0); } ends { type cyclic; point (0 0 0); separation (0 " +
                         str(ny * dx, 17) + " 0); }";
        files.properties = "rho " + str(rho) + "; mu 0;";
        files.schemes = "ddtScheme " + ddt + ";";
        files.solution =
            "coupling " + coupling + "; monolithic { tolerance 1e-6; absTolerance 1e-8; }";
        if (coupling == "projection") files.solution = "coupling projection;";
        files.write();
        word moduli, times;
        for (const branch& b : branches)
            moduli += " " + str(b.g, 17), times += " " + str(b.time, 17);
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel totalLagrangian; material { type neoHookean; G " + str(G) +
                       "; " +
                       (branches.empty()
                            ? ""
                            : "relaxation { moduli (" + moduli + "); times (" + times + "); }") +
                       "}");
        read();
    }
    void read()
    {
        time = std::make_unique<Time>(files.path());
        c = std::make_unique<fsiCase>(*time);
        scheme = couplingScheme::New(*c);
    }
    void run(scalar dt, label n) { runSteps(*c, *scheme, dt, n); }
    scalar part(const List<vec4>& field) const
    {
        scalar sum = 0;
        for (label i = 0; i < c->cloud.n(); ++i)
            sum += 2 * field[i][1] * std::sin(k * c->cloud.vectors.at("x0")[i][0]) /
                   scalar(c->cloud.n());
        return sum;
    }
    scalar speed() const { return part(c->cloud.Up); }
    // Force of the wave's shape over its displacement and the mass of a particle [1/s^2]
    scalar stiffness() const
    {
        const scalar small = 1e-4 * dx;
        List<vec4> x = c->cloud.x, f;
        for (vec4& v : x) v[1] += small * std::sin(k * v[0]);
        c->structure->force(x, f);
        return -part(f) / (small * rho * dx * dx);
    }
    scalar booked(energyLedger::term t) const { return energyLedger::sums(*c)[t]; }
    List<scalar> memory() const { return c->cloud.state.values().at("solidMemory"); }
};

// d'' = - K d - sum q, q' = K_b d' - q/time, Phi' = q d' - Phi/time by Runge and Kutta's method; returns d' and the energy
// lost, the integral of sum Phi/time
struct exactWave
{
    scalar speed, lost;

    exactWave(scalar K, scalar Kb, const List<branch>& branches, scalar start, scalar end)
    {
        using state = Eigen::VectorXd;
        const int n = int(branches.size());
        scalar sum = 0;
        for (const branch& b : branches) sum += b.g;
        const auto slope = [&](const state& y) -> state {
            state s = state::Zero(3 + 2 * n);
            s[0] = y[1], s[1] = -K * y[0];
            for (int b = 0; b < n; ++b)
            {
                const scalar q = y[3 + 2 * b], Phi = y[4 + 2 * b], time = branches[b].time;
                s[1] -= q, s[2] += Phi / time;
                s[3 + 2 * b] = Kb * branches[b].g / sum * y[1] - q / time;
                s[4 + 2 * b] = q * y[1] - Phi / time;
            }
            return s;
        };
        state y = state::Zero(3 + 2 * n);
        y[1] = start;
        constexpr int steps = 20000;
        const scalar h = end / steps;
        for (int step = 0; step < steps; ++step)
        {
            const state a = slope(y), b = slope(y + h / 2 * a), c = slope(y + h / 2 * b),
                        d = slope(y + h * c);
            y += h / 6 * (a + 2 * b + 2 * c + d);
        }
        speed = y[1], lost = y[2];
    }
};

struct choice
{
    word coupling, ddt;
};
const choice choices[] = {{"projection", "Euler"}, {"monolithic", "Euler"}, {"monolithic", "DLN"}};
const List<branch> two = {{0.5, 0.02}, {0.3, 0.15}};

}  // namespace

TEST_CASE("a shear wave of a relaxing solid turns and fades as its Prony series says")
{
    for (const choice& by : choices)
    {
        CAPTURE(by.coupling);
        CAPTURE(by.ddt);
        const scalar start = 0.02 * dx * k * std::sqrt(G / rho);
        const scalar alone = wave(by.coupling, by.ddt, {}, start).stiffness();
        const scalar end = 1.3 * period;
        // sin^2 has the mean 1/2 over the block
        const scalar mass = rho * dx * dx * nx * ny / 2;
        scalar both = 0;
        const auto after = [&](int n) -> std::array<scalar, 2> {
            wave w(by.coupling, by.ddt, two, start);
            both = w.stiffness();
            w.run(end / n, n);
            CHECK(std::abs(energyLedger::sums(*w.c).back()) < 1e-11 * mass * start * start);
            return {w.speed(), -w.booked(energyLedger::viscosity) / mass};
        };
        // backward Euler is of first order: twice as many steps tell where it leads
        const bool extrapolates = by.coupling == "monolithic" && by.ddt == "Euler";
        const int n = by.ddt == "DLN" ? 150 : 600;
        auto [speed, lost] = after(n);
        if (extrapolates)
        {
            const auto [half, lostOfHalf] = after(n / 2);
            speed = 2 * speed - half, lost = 2 * lost - lostOfHalf;
        }
        CHECK(both == relative(1.8 * alone, 0.05));
        const exactWave exact(alone, both - alone, two, start, end);
        MESSAGE(by.coupling, " ", by.ddt, ": speed ", speed / start, ", exact ",
                exact.speed / start, "; lost ", lost / exact.lost, " of the exact loss");
        CHECK(std::abs(speed - exact.speed) < 0.01 * start);
        CHECK(lost == relative(exact.lost, 0.02));
    }
}

TEST_CASE("a relaxing solid: steps of a hundred times of relaxation are stable")
{
    for (const choice& by : choices)
    {
        CAPTURE(by.coupling);
        CAPTURE(by.ddt);
        const scalar dt = period / 100, start = 0.02 * dx * k * std::sqrt(G / rho);
        wave w(by.coupling, by.ddt, {{5, dt / 100}}, start);
        CHECK(w.scheme->limit().dt > dt);
        w.run(dt, 80);
        CHECK(std::abs(w.speed()) < 1.01 * start);
        CHECK(w.c->cloud.maxSpeed() < 1.05 * start);
    }
}

TEST_CASE("a solid with a viscosity is refused by projection, which has no term for it")
{
    wave w("monolithic", "Euler", {}, 0);
    setContent(w.files.path() + "/constant/structureProperties",
               "structureModel totalLagrangian; material { type neoHookean; G 1; viscosity 1; }");
    setContent(w.files.path() + "/system/sphSolution", "coupling projection;");
    CHECK_ERROR(w.read(), "Take coupling monolithic", 1);
}

TEST_CASE("a relaxing solid: a continued run and one whose step was undone are those without")
{
    for (const choice& by : choices)
    {
        CAPTURE(by.coupling);
        CAPTURE(by.ddt);
        const auto equal = [](const wave& a, const wave& b) {
            CHECK(a.memory() == b.memory());
            for (label i = 0; i < a.c->cloud.n(); ++i)
                CHECK(a.c->cloud.x[i].xyz() == b.c->cloud.x[i].xyz());
        };
        const scalar dt = period / 400, start = 0.2 * dx * k * std::sqrt(G / rho);
        wave whole(by.coupling, by.ddt, two, start), parts(by.coupling, by.ddt, two, start);
        whole.run(dt, 20);
        parts.run(dt, 10), parts.c->write();
        setContent(parts.files.path() + "/system/controlDict",
                   "startFrom latestTime; startTime 0; endTime 1; deltaT 0.01; writeControl "
                   "timeStep; writeInterval 1e6;");
        parts.read();
        parts.run(dt, 10);
        equal(whole, parts);
        // moved by 1.6 dx, and neighbours by 0.8 dx against each other: halved
        const scalar fast = 1.6 * dx / dt;
        wave halved(by.coupling, by.ddt, two, fast), half(by.coupling, by.ddt, two, fast);
        halved.run(dt, 1), half.run(dt / 2, 2);
        const auto& kept =
            by.coupling == "projection" ? entries::projectedStep : entries::levelBefore;
        CHECK(halved.c->cloud.state.get(kept, 0) == relative(dt / 2));
        equal(halved, half);
    }
}
