// SPDX-License-Identifier: GPL-3.0-or-later
#include "capturedErrors.H"
#include "clockCase.H"
#include "errorOf.H"
#include "fileNames.H"
#include "relative.H"

#include <cmath>
#include <csignal>

using namespace ispf;

TEST_CASE("a continued run takes the steps of an uninterrupted one, bit by bit")
{
    const word control =
        "deltaT 0.013; adjustTimeStep on; writeControl adjustableRunTime;"
        "writeInterval 0.1; startFrom latestTime; endTime ";
    const auto wish = [](scalar now) { return 0.013 * (1 + 0.2 * std::sin(9 * now)); };
    const clockCase whole(control + "0.7;"), parts(control + "0.7; stopAt nextWrite;");
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
    const clockCase c(control + "latestTime;");
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
    const clockCase c("deltaT 0.1; endTime 7; writeControl none; adjustTimeStep yes;");
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
        const clockCase c(control + "endTime;");
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

TEST_CASE(
    "a deltaT that changes while running is taken by no step before it is asked for, and leads to "
    "instants")
{
    const word control =
        "endTime 2; writeControl adjustableRunTime; writeInterval 0.5; runTimeModifiable yes; "
        "deltaT ";
    const clockCase c(control + "0.1;");
    Time t = c.time();
    t.setDeltaT(0.1), ++t;
    c.write("system/controlDict", control + "0.09;");
    t.setDeltaT(0.1), ++t;
    CHECK(t.value() == 0.2);
    t.rereadIfModified();
    REQUIRE(t.controlDict().get<scalar>("deltaT") == 0.09);
    t.setDeltaT(0.09);
    CHECK(t.deltaT() == relative(0.3 / 4));
}

TEST_CASE("requestStop ends the step, with or without writing")
{
    const clockCase c("deltaT 1; endTime 9; writeControl none;");
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
    const clockCase c("deltaT 1; endTime 5; writeControl timeStep; writeInterval 1; purgeWrite 2;");
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
    const clockCase c("deltaT 1e-9; endTime 1; writeControl none; timePrecision 3;");
    CHECK(c.time().timeName(0.125) == "0.125");
    CHECK(c.time().timeName(-0.0) == "0");
    CHECK(c.time().timeName(1.23456) == "1.23");
    Time t = c.time();
    t.rewind(0.5, 0);
    ++t;  // would be called 0.5 again
    CHECK(t.timeName() == "0.500000001");
    const clockCase f("deltaT 1; endTime 1; writeControl none; timeFormat fixed; timePrecision 4;");
    CHECK(f.time().timeName(0.5) == "0.5000");
}

TEST_CASE("folder names tell the times, after a restart too")
{
    const word control =
        "startFrom latestTime; deltaT 2e-6; writeControl timeStep; writeInterval 1; endTime ";
    const clockCase c(control + "1.000004;");
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

TEST_CASE("startTime may be what the folder's name says, or its state to the last digit")
{
    const clockCase c(
        "startFrom startTime; startTime 0.0125; deltaT 0.0125; endTime 1; writeControl none; "
        "timePrecision 2;");
    c.write("0.013/particles.hdf", "x");
    c.write("0.013/uniform/time", "value 0.0125; index 1; deltaT 0.0125;");
    CHECK(c.time().value() == 0.0125);
    CHECK(c.time().timeIndex() == 1);
    CHECK(c.time().folder() == c.path + "/0.013");
    CHECK(c.time().timeName() == "0.013");
}

TEST_CASE("the time of a state is that of its folder to all digits")
{
    const clockCase c(
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
    const auto with = [](const word& text) { return clockCase(text).time(); };
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
    const clockCase c("deltaT 1; endTime 1; writeControl none;");
    Time t = c.time();
    CHECK_ERROR(t.setDeltaT(NAN), "must be positive", 0);
}

// The last test, because the flag is set for the whole program
TEST_CASE("a signal: the step is finished, written, and the run ends")
{
    const clockCase c("deltaT 1; endTime 9; writeControl none;");
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
    const clockCase whole("deltaT 1; endTime 2; writeControl none;");
    Time last = whole.time();  // in the last step it stops nothing
    last.rewind(1, 1);
    ++last;
    CHECK(last.writeTime());
    CHECK(last.exitStatus() == 0);
    std::signal(SIGINT, SIG_DFL);
}
