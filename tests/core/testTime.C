// SPDX-License-Identifier: GPL-3.0-or-later
#include "Time.H"
#include "capturedErrors.H"
#include "errorOf.H"
#include "fileNames.H"
#include "temporaryFolder.H"
#include "relative.H"

#include <csignal>
#include <cmath>

using namespace ispf;

namespace
{

struct testCase : temporaryFolder
{
    explicit testCase(const word& control) { write("system/controlDict", control); }
    Time time() const { return Time(path); }
};

// Runs to the end with the steps that `dt` asks for, or controlDict; the times at which to write
struct record
{
    List<scalar> written, steps;
    scalar last = 0;
};

record runThrough(Time& t, const std::function<scalar(scalar)>& dt = nullptr)
{
    record r;
    const scalar asked = t.deltaT();
    while (t.run() && r.steps.size() < 10000)
    {
        t.setDeltaT(dt ? dt(t.value()) : asked);
        const scalar before = t.value();
        ++t;
        r.steps.push_back(t.value() - before);
        if (t.writeTime()) r.written.push_back(t.value());
    }
    r.last = t.value();
    return r;
}

}  // namespace

TEST_CASE("steps are deltaT whatever endTime says; the run ends with the one nearest to it")
{
    const auto steps = [](const word& control) {
        const testCase c(control + "writeControl timeStep; writeInterval 10;");
        Time t = c.time();
        const word remark = t.remarkOnSteps();
        const record r = runThrough(t);
        for (const scalar s : r.steps) CHECK(s == relative(t.deltaT()));
        CHECK(remark.empty() == (std::abs(r.last - t.endTime()) < 1e-12));
        if (!remark.empty())
            CHECK(remark.find("the run ends at " + str(r.last) + " s\n") != word::npos);
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
                const testCase c(entries + "endTime " + end + ";");
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
        const testCase c(control + end + ";");
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
    CHECK_ERROR(testCase(control + "1 [min]; endTime 0.26;").time(), "twice as long as the run", 1);
    const testCase done(control + "1; startTime 2; endTime 2;");
    CHECK(!done.time().run());
    const testCase c(control + "0.03; endTime 1;");
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
    const testCase c(
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
    const testCase c("deltaT 0.1; endTime 1; writeControl none; writeTimes (0.3);");
    Time t = c.time();
    const record r = runThrough(t);
    CHECK(r.written == List<scalar>{0.3});  // 0.1 + 0.1 + 0.1 is not 0.3
    CHECK(r.last == 1);
    CHECK(t.timeIndex() == 10);
}

TEST_CASE("adjustableRunTime: instants are hit exactly, and no step is tiny")
{
    const testCase c(
        "deltaT 0.1; endTime 1; writeControl adjustableRunTime; writeInterval 0.25;"
        "writeTimes (0.3 0.61803);");
    Time t = c.time();
    // An irregular wish, changing by 30 % and never a divisor of the interval
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
    const testCase c(
        "startFrom startTime; startTime 1000; deltaT 1e-6; endTime 1000.001;"
        "writeControl adjustableRunTime; writeInterval 1e-4; timePrecision 12;");
    Time t = c.time();
    const record r = runThrough(t, [](scalar) { return 1.03e-6; });
    CHECK(r.written.size() == 10);
    CHECK(r.last == 1000.001);
    for (const scalar s : r.steps) CHECK(s > 0.5e-6);
    const testCase tenths(
        "deltaT 0.02; endTime 0.8; writeControl adjustableRunTime; writeInterval 0.1;");
    Time u = tenths.time();
    CHECK(runThrough(u).written == List<scalar>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8});
}

TEST_CASE("runTime writes at the step nearest to an instant; maxDeltaT limits")
{
    const testCase c(
        "deltaT 0.04; maxDeltaT 0.03; endTime 0.3; writeControl runTime;"
        "writeInterval 0.1;");
    Time t = c.time();
    CHECK(t.deltaT() == 0.03);
    const record r = runThrough(t, [](scalar) { return 0.04; });
    CHECK(r.written == List<scalar>{0.09, 0.21, 0.3});
    const testCase between("deltaT 0.03; endTime 0.1; writeControl runTime; writeInterval 0.1;");
    Time u = between.time();
    CHECK(runThrough(u).written == List<scalar>{0.09});  // the last step is written
    const testCase adjusted(
        "deltaT 0.03; adjustTimeStep yes; endTime 0.3; writeControl runTime; writeInterval 0.1;");
    Time v = adjusted.time();
    CHECK(runThrough(v).written == List<scalar>{0.12, 0.21, 0.3});  // the first past it
}

TEST_CASE("clockTime and none")
{
    const testCase c("deltaT 1; endTime 5; writeControl clockTime; writeInterval 1e-9;");
    Time t = c.time();
    CHECK(runThrough(t).written.size() == 5);
    const testCase rare("deltaT 1; endTime 5; writeControl cpuTime; writeInterval 1e6;");
    Time u = rare.time();
    CHECK(runThrough(u).written.empty());
    const testCase none("deltaT 1; endTime 5; writeControl none; writeTimes (2);");
    Time v = none.time();
    CHECK(runThrough(v).written == List<scalar>{2});
}

TEST_CASE("a rejected step leaves no trace")
{
    const testCase c("deltaT 0.1; endTime 1; writeControl adjustableRunTime; writeInterval 0.5;");
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

TEST_CASE("a continued run takes the steps of an uninterrupted one, bit by bit")
{
    const word control =
        "deltaT 0.013; adjustTimeStep on; writeControl adjustableRunTime;"
        "writeInterval 0.1; startFrom latestTime; endTime ";
    const auto wish = [](scalar now) { return 0.013 * (1 + 0.2 * std::sin(9 * now)); };
    const testCase whole(control + "0.7;"), parts(control + "0.7; stopAt nextWrite;");
    Time t = whole.time();
    const record r = runThrough(t, wish);
    List<scalar> steps;
    for (int k = 0; k < 7; ++k)
    {
        Time u = parts.time();
        const record part = runThrough(u, wish);
        steps.insert(steps.end(), part.steps.begin(), part.steps.end());
        u.writeState();
        parts.write(u.timeName() + "/particles.hdf", "x");
    }
    CHECK(steps == r.steps);
    Time end = parts.time();
    CHECK(end.value() == t.value());
    CHECK(end.timeIndex() == t.timeIndex());
    CHECK(end.deltaT() == t.deltaT());
    CHECK(!end.run());
}

TEST_CASE("startFrom: only folders that hold a state count as latest")
{
    const word control = "deltaT 1; endTime 9; writeControl none; startTime 0.5; startFrom ";
    const testCase c(control + "latestTime;");
    CHECK(c.time().value() == 0.5);
    c.write("0/U", "x");
    c.write("2/particles.hdf", "x");
    c.write("10/uniform/other", "x");
    c.write("1.5/uniform/time", "value 1.6; index 3; deltaT 0.1;");
    c.write("1.5/particles.hdf", "x");
    c.write("3/uniform/time", "value 3; index 3; deltaT 0.1;");
    CHECK_ERROR(c.time(), "uniform/time is there, but neither particles.hdf nor", 0);
    c.write("3/particles.hdf.tmp", "x");  // killed before it was complete
    CHECK(c.time().value() == 2);
    List<word> folders;
    for (const Time::folderOfTime& f : c.time().folders()) folders.push_back(f.name);
    CHECK(folders == List<word>{"0", "1.5", "2", "3", "10"});
    std::filesystem::remove_all(c.path + "/2");
    CHECK(c.time().value() == 1.5);  // uniform/time contradicts the folder's name
    c.write("0.333333/uniform/time", "value 0.33333333333333331; index 3; deltaT 0.1;");
    c.write("0.333333/particles.hdf", "x");
    std::filesystem::remove_all(c.path + "/1.5");
    CHECK(c.time().value() == 1.0 / 3);
    CHECK(c.time().timeIndex() == 3);
    CHECK(c.time().deltaT() == 1);                                    // adjustTimeStep is off
    c.write("0.50/uniform/time", "value 0.5; index 7; deltaT 0.1;");  // spelt by hand
    c.write("0.50/particles.hdf", "x");
    CHECK(c.time().timeIndex() == 7);
    c.write("system/controlDict", control + "firstTime;");
    CHECK(c.time().value() == 0);
    c.write("system/controlDict", control + "startTime;");
    CHECK(c.time().value() == 0.5);
}

TEST_CASE("uniform/time: what is changed in it is told")
{
    const testCase c("deltaT 0.1; endTime 7; writeControl none; adjustTimeStep yes;");
    Time t = c.time();
    t.setDeltaT(0.07);
    ++t;
    t.writeState();
    c.write("0.07/particles.hdf", "x");
    CHECK(c.time().timeIndex() == 1);
    CHECK(c.time().deltaT() == 0.07);
    const word file = c.path + "/0.07/uniform/time", written = readText(file);
    for (const auto& [from, to] : {std::pair("0.07000", "0.07001"), {"index       1", "index 2"}})
    {
        CAPTURE(from);
        word changed = written;
        changed.replace(changed.rfind(from), word(from).size(), to);
        c.write("0.07/uniform/time", changed);
        CHECK_ERROR(c.time(), "0.07/uniform/time was damaged, or edited", 14);
        c.write("0.07/uniform/time", changed.substr(0, changed.find("checksum")));
        c.time();
    }
    c.write("0.07/positions", "x");
    std::filesystem::remove(c.path + "/0.07/particles.hdf");
    CHECK_ERROR(c.time(), "0.07 is incomplete: positions is there", 0);
}

TEST_CASE("stopAt, and changes to controlDict while running")
{
    const word control =
        "deltaT 1; endTime 9; writeControl timeStep; writeInterval 3;"
        "runTimeModifiable yes; stopAt ";
    const auto changed = [&](const word& stopAt) {
        const testCase c(control + "endTime;");
        Time t = c.time();
        ++t;
        CHECK(t.run());
        c.write("system/controlDict", control + stopAt + ";");
        return runThrough(t);
    };
    CHECK(changed("writeNow").written == List<scalar>{2});
    CHECK(changed("noWriteNow").written.empty());
    CHECK(changed("noWriteNow").last == 2);
    CHECK(changed("nextWrite").written == List<scalar>{3});
    CHECK(changed("endTime; endTime 5").last == 5);
    {
        const capturedErrors errors;
        CHECK(changed("endTime; deltaT").last == 9);  // a broken file is not used
        CHECK(errors.contains("--> FOAM Warning : The changed controlDict is not used:\n"));
        CHECK(errors.contains("system/controlDict"));
        CHECK(!errors.contains("FATAL"));
        CHECK(!errors.contains("exiting"));
    }
    CHECK(changed("endTime; endTime 5; enTime 7").last == 9);  // nor one with a word nobody reads
    CHECK(changed("endTime; endTime 5; writeInterval 0").last == 9);
}

TEST_CASE("requestStop ends the step, with or without writing")
{
    const testCase c("deltaT 1; endTime 9; writeControl none;");
    for (const bool write : {true, false})
    {
        Time t = c.time();
        ++t;
        t.requestStop(write);
        CHECK(t.writeTime() == write);
        CHECK(!t.run());
        CHECK(t.exitStatus() == 0);
    }
    Time late = c.time();  // asked for after the decision to write: one more step, then written
    ++late;
    CHECK(!late.writeTime());
    late.requestStop(true);
    CHECK(late.run());
    ++late;
    CHECK(late.writeTime());
    CHECK(!late.run());
}

TEST_CASE("purgeWrite keeps the last few")
{
    const testCase c("deltaT 1; endTime 5; writeControl timeStep; writeInterval 1; purgeWrite 2;");
    Time t = c.time();
    List<word> removed;
    while (t.run())
    {
        ++t;
        for (const word& name : t.toPurge()) removed.push_back(name);
    }
    CHECK(removed == List<word>{"1", "2", "3"});
}

TEST_CASE("folder names")
{
    const testCase c("deltaT 1e-9; endTime 1; writeControl none; timePrecision 3;");
    CHECK(c.time().timeName(0.125) == "0.125");
    CHECK(c.time().timeName(-0.0) == "0");
    CHECK(c.time().timeName(1.23456) == "1.23");
    Time t = c.time();
    t.rewind(0.5, 0);
    ++t;  // would be called 0.5 again
    CHECK(t.timeName() == "0.500000001");
    const testCase f("deltaT 1; endTime 1; writeControl none; timeFormat fixed; timePrecision 4;");
    CHECK(f.time().timeName(0.5) == "0.5000");
}

TEST_CASE("folder names tell the times, after a restart too")
{
    const word control =
        "startFrom latestTime; deltaT 2e-6; writeControl timeStep; writeInterval 1; endTime ";
    const testCase c(control + "1.000004;");
    const auto goOn = [&](const word& more) {
        c.write("system/controlDict", control + more);
        Time t = c.time();
        List<word> names{t.timeName()};
        while (t.run())
        {
            t.setDeltaT(2e-6), ++t, t.writeState();
            c.write(t.timeName() + "/particles.hdf", "x");
            names.push_back(t.timeName());
        }
        return names;
    };
    c.write("1/particles.hdf", "x");
    c.write("1/uniform/time", "value 1; index 100; deltaT 0.01;");
    const capturedErrors errors;
    CHECK(goOn("1.000004;") == List<word>{"1", "1.000002", "1.000004"});
    CHECK(goOn("1.000008;") == List<word>{"1.000004", "1.000006", "1.000008"});
    CHECK(goOn("1.00001;") == List<word>{"1.000008", "1.00001"});
    CHECK(goOn("1.00001; timePrecision 1;") == List<word>{"1.00001"});
    Time post = Time::postProcess(c.path);
    for (const Time::folderOfTime& f : post.folders())
    {
        post.goTo(f.t);
        CHECK(post.timeName() == f.name);
    }
}

TEST_CASE("the time of a state is that of its folder to all digits")
{
    const testCase c(
        "deltaT 0.013; endTime 0.039; writeControl timeStep; writeInterval 1; timePrecision 1;");
    const capturedErrors errors;
    Time t = c.time();
    while (t.run()) t.setDeltaT(0.013), ++t, t.writeState();
    c.write("0.333333/uniform/time", "value 0.33333333333333331; index 3; deltaT 0.1;");
    c.write("0.5/uniform/time", "value 0.7; index 3; deltaT 0.1;");  // of another time
    c.write("0.6/uniform/time", "value 0.6; index");
    List<word> names;
    List<scalar> times;
    const Time post = Time::postProcess(c.path);
    for (const Time::folderOfTime& f : post.folders())
        names.push_back(f.name), times.push_back(post.timeOf(f));
    CHECK(names == List<word>{"0.013", "0.026", "0.039", "0.333333", "0.5", "0.6"});
    CHECK(times == List<scalar>{0.013, 0.026, 0.039, 1.0 / 3, 0.5, 0.6});
}

TEST_CASE("mistakes in controlDict")
{
    const auto with = [](const word& text) { return testCase(text).time(); };
    CHECK_ERROR(with("deltaT 0; endTime 1; writeControl none;"), "must lie between", 1);
    CHECK_ERROR(with("deltaT 1; writeControl none;"), "'endTime' is missing", 0);
    CHECK_ERROR(with("deltaT 1; endTime 9; stopAt nextWrite; writeControl none;"),
                "There is no next write", 1);
    CHECK_ERROR(with("deltaT 1; endTime 1; writeControl runtime; writeInterval 1;"),
                "Did you mean 'runTime'?", 1);
    CHECK_ERROR(with("deltaT 1; endTime 1;\nwriteControl timeStep; writeInterval 0.5;"),
                "whole number", 2);
    CHECK_ERROR(with("deltaT 1; endTime 1; writeControl runTime;"), "'writeInterval' is missing",
                0);
    const testCase c("deltaT 1; endTime 1; writeControl none;");
    Time t = c.time();
    CHECK_ERROR(t.setDeltaT(NAN), "must be positive", 0);
}

// Last, because the flag is for the whole program
TEST_CASE("a signal: the step is finished, written, and the run ends")
{
    const testCase c("deltaT 1; endTime 9; writeControl none;");
    Time t = c.time();
    Time::stopOnSignals();
    ++t;
    CHECK(!t.writeTime());
    ++t;
    CHECK(t.run());
    std::raise(SIGTERM);
    CHECK(t.run());  // not before the state is written
    CHECK(t.exitStatus() == 0);
    CHECK(t.writeTime());
    CHECK(!t.run());
    CHECK(t.exitStatus() == 128 + SIGTERM);
    const testCase whole("deltaT 1; endTime 2; writeControl none;");
    Time last = whole.time();  // in the last step it stops nothing
    last.rewind(1, 1);
    ++last;
    CHECK(last.writeTime());
    CHECK(last.exitStatus() == 0);
    std::signal(SIGINT, SIG_DFL);
}
