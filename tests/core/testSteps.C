// SPDX-License-Identifier: GPL-3.0-or-later
#include "capturedErrors.H"
#include "clockCase.H"
#include "errorOf.H"
#include "relative.H"

#include <cmath>

using namespace ispf;

TEST_CASE("steps are deltaT whatever endTime says; the run ends with the one nearest to it")
{
    const auto steps = [](const word& control) {
        const clockCase c(control + "writeControl timeStep; writeInterval 10;");
        Time t = c.time();
        const word remark = t.remarkOnSteps();
        const record r = runThrough(t);
        for (const scalar s : r.steps) CHECK(s == relative(t.deltaT()));
        CHECK(remark.empty() == (std::abs(r.last - t.endTime()) < 1e-12));
        if (!remark.empty())
            CHECK(remark.find("the run ends at " + str(r.last) + " s") != word::npos);
        CHECK((remark.find("are asked up to there") != word::npos) ==
              (r.last > t.endTime() + 1e-12));
        CHECK(std::abs(r.last - t.endTime()) <= t.deltaT() / 2);
        return r;
    };
    CHECK(steps("deltaT 0.03; endTime 0.1;").last == 0.09);
    CHECK(steps("deltaT 0.04; endTime 0.11;").last == 0.12);
    CHECK(steps("deltaT 0.1; endTime 0.25;").last == 0.2);  // both are as near: the earlier one
    CHECK(steps("deltaT 1; endTime 1;").steps.size() == 1);
    CHECK(steps("deltaT 1; endTime 0.6;").last == 1);
    const record r = steps("deltaT 0.03; endTime 1;");
    CHECK(r.last == 0.99);
    CHECK(r.written == List<scalar>{0.3, 0.6, 0.9});
    CHECK(steps("deltaT 0.1; endTime 1;").last == 1);  // not 0.9999999999999999
    CHECK(steps("startFrom startTime; startTime 0.99; deltaT 0.03; endTime 2.5;").last == 2.49);
}

TEST_CASE("a run to an earlier endTime passes the times of a longer one, bit by bit")
{
    for (const word control : {"deltaT 0.1;", "deltaT 0.0025;", "deltaT 0.0137;", "deltaT 0.7;",
                               "deltaT 1e-5;", "deltaT 0.013; adjustTimeStep yes;"})
        for (const word& kind :
             {word("timeStep; writeInterval 1;"), word("adjustableRunTime; writeInterval 0.1;"),
              word("none; writeTimes (0.2 0.7 1.1);")})
        {
            const word entries = control + "startFrom startTime; startTime 0; writeControl " + kind;
            const auto timesTo = [&](const word& end) {
                const clockCase c(entries + "endTime " + end + ";");
                Time t = c.time();
                List<scalar> times;
                while (t.run() && times.size() < 10000)
                    t.setDeltaT(t.controlDict().get<scalar>("deltaT")), ++t,
                        times.push_back(t.value());
                return times;
            };
            const List<scalar> whole = timesTo("1.4");
            for (const word end : {"0.7", "0.713", "1.1"})
            {
                List<scalar> part = timesTo(end);
                REQUIRE(part.size() > 0);
                const bool keeps = control.find("yes") == word::npos && kind[0] == 't';
                if (!keeps) part.resize(std::max<size_t>(2, part.size()) - 2);  // those hit endTime
                CHECK(std::equal(part.begin(), part.end(), whole.begin()));
            }
        }
}

TEST_CASE("with adjustTimeStep endTime is hit, by the last two steps")
{
    const word control =
        "deltaT 0.03; adjustTimeStep yes; writeControl timeStep; writeInterval 1; endTime ";
    const auto steps = [&](const word& end) {
        const clockCase c(control + end + ";");
        Time t = c.time();
        const record r = runThrough(t);
        CHECK(r.last == t.endTime());
        CHECK(t.remarkOnSteps().empty());
        return r.steps;
    };
    const List<scalar> s = steps("0.1");
    REQUIRE(s.size() == 4);
    for (const size_t k : {0, 1}) CHECK(s[k] == relative(0.03));
    for (const size_t k : {2, 3}) CHECK(s[k] == relative(0.02));
    CHECK(steps("1e-3") == List<scalar>{1e-3});
}

TEST_CASE("a deltaT beyond the run is refused; little left behind the last step is no error")
{
    const word control = "startFrom latestTime; writeControl none; deltaT ";
    CHECK_ERROR(clockCase(control + "1 [min]; endTime 0.26;").time(), "twice as long as the run",
                1);
    const clockCase done(control + "1; startTime 2; endTime 2;");
    CHECK(!done.time().run());
    const clockCase c(control + "0.03; endTime 1;");
    Time t = c.time();
    runThrough(t);
    t.writeState();
    c.write("0.99/particles.hdf", "x");
    const capturedErrors errors;
    CHECK(!c.time().run());
    CHECK(errors.contains(
        "endTime 1 is less than half a step after the start 0.99: there is nothing to run"));
}

TEST_CASE("steps that are shortened to hit an instant: it is said")
{
    const clockCase c(
        "deltaT 0.03; endTime 0.3; writeControl adjustableRunTime; writeInterval 0.1;");
    Time t = c.time();
    CHECK(t.remarkOnSteps() ==
          "deltaT 0.03 s is shortened to 0.025 s: equal steps lead to the instant 0.1 s\n");
    const record r = runThrough(t);
    CHECK(r.last == relative(0.3));
    CHECK(r.written.size() == 3);
}

TEST_CASE("ten steps of 0.1 end at 1, and three of them at a write instant of 0.3")
{
    const clockCase c("deltaT 0.1; endTime 1; writeControl none; writeTimes (0.3);");
    Time t = c.time();
    const record r = runThrough(t);
    CHECK(r.written == List<scalar>{0.3});  // 0.1 + 0.1 + 0.1 is not 0.3
    CHECK(r.last == 1);
    CHECK(t.timeIndex() == 10);
}

TEST_CASE("adjustableRunTime: instants are hit exactly, and no step is tiny")
{
    const clockCase c(
        "deltaT 0.1; endTime 1; writeControl adjustableRunTime; writeInterval 0.25;"
        "writeTimes (0.3 0.61803);");
    Time t = c.time();
    // an irregular requested step: it changes by 30 % and never divides the interval
    const auto wish = [](scalar now) { return 0.017 * (1 + 0.3 * std::sin(40 * now)); };
    const record r = runThrough(t, wish);
    CHECK(r.written == List<scalar>{0.25, 0.3, 0.5, 0.61803, 0.75, 1});
    CHECK(r.last == 1);
    scalar now = 0;
    for (const scalar s : r.steps)
    {
        CHECK(s <= wish(now) * 1.000001);
        CHECK(s > 0.4 * wish(now));
        now += s;
    }
}

TEST_CASE("many small steps far from zero still land on the instants")
{
    const clockCase c(
        "startFrom startTime; startTime 1000; deltaT 1e-6; endTime 1000.001;"
        "writeControl adjustableRunTime; writeInterval 1e-4; timePrecision 12;");
    Time t = c.time();
    const record r = runThrough(t, [](scalar) { return 1.03e-6; });
    CHECK(r.written.size() == 10);
    CHECK(r.last == 1000.001);
    for (const scalar s : r.steps) CHECK(s > 0.5e-6);
    const clockCase tenths(
        "deltaT 0.02; endTime 0.8; writeControl adjustableRunTime; writeInterval 0.1;");
    Time u = tenths.time();
    CHECK(runThrough(u).written == List<scalar>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8});
}

TEST_CASE("runTime writes at the step nearest to an instant; maxDeltaT limits")
{
    const clockCase c(
        "deltaT 0.04; maxDeltaT 0.03; endTime 0.3; writeControl runTime;"
        "writeInterval 0.1;");
    Time t = c.time();
    CHECK(t.deltaT() == 0.03);
    const record r = runThrough(t, [](scalar) { return 0.04; });
    CHECK(r.written == List<scalar>{0.09, 0.21, 0.3});
    const clockCase between("deltaT 0.03; endTime 0.1; writeControl runTime; writeInterval 0.1;");
    Time u = between.time();
    CHECK(runThrough(u).written == List<scalar>{0.09});  // the last step is written
    const clockCase adjusted(
        "deltaT 0.03; adjustTimeStep yes; endTime 0.3; writeControl runTime; writeInterval 0.1;");
    Time v = adjusted.time();
    CHECK(runThrough(v).written == List<scalar>{0.12, 0.21, 0.3});  // the first past it
}

TEST_CASE("clockTime and none")
{
    const clockCase c("deltaT 1; endTime 5; writeControl clockTime; writeInterval 1e-9;");
    Time t = c.time();
    CHECK(runThrough(t).written.size() == 5);
    const clockCase rare("deltaT 1; endTime 5; writeControl cpuTime; writeInterval 1e6;");
    Time u = rare.time();
    CHECK(runThrough(u).written.empty());
    const clockCase none("deltaT 1; endTime 5; writeControl none; writeTimes (2);");
    Time v = none.time();
    CHECK(runThrough(v).written == List<scalar>{2});
}

TEST_CASE("a rejected step leaves no trace")
{
    const clockCase c("deltaT 0.1; endTime 1; writeControl adjustableRunTime; writeInterval 0.5;");
    Time t = c.time();
    List<scalar> written;
    bool rejected = false;
    while (t.run())
    {
        t.setDeltaT(0.1);
        const scalar before = t.value();
        const label index = t.timeIndex();
        ++t;
        if (t.value() == 0.5 && !rejected)
        {
            rejected = true;
            t.rewind(before, index);
            CHECK(t.value() == before);
            t.setDeltaT(0.03);
            ++t;
        }
        if (t.writeTime()) written.push_back(t.value());
    }
    CHECK(written == List<scalar>{0.5, 1});
    CHECK(t.timeIndex() == 11);  // 4 of 0.1, 0.025, 0.075, 5 of 0.1
}
