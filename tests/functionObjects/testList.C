// SPDX-License-Identifier: GPL-3.0-or-later
// When function objects write, and which entries are refused
#include "capturedErrors.H"
#include "core/errorOf.H"
#include "dataFile.H"
#include "testCase.H"

using namespace ispf;

namespace
{

List<scalar> timesOf(const testCase& t, const word& file)
{
    List<scalar> times;
    for (const auto& row : t.rows(file)) times.push_back(row[0]);
    return times;
}

word wrong(const word& functions, const word& control = "")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {3, 3, 3});
    t.control += control;
    t.functions = functions;
    auto r = t.start();
    functionObjectList f(*r.c);
    return "";
}

}  // namespace

TEST_CASE("write controls")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {3, 3, 3});
    t.control = "endTime 1; deltaT 0.125; writeControl timeStep; writeInterval 3;";
    t.functions =
        "a { type minMax; }"
        "b { type minMax; writeInterval 4; }"
        "c { type minMax; writeControl runTime; writeInterval 0.3; }"
        "d { type minMax; writeControl writeTime; libs (\"libany.so\"); }"
        "e { type minMax; writeControl none; }"
        "f { type minMax; timeStart 0.25; timeEnd 0.5; }"
        "g { type nothingLikeThis; enabled no; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    CHECK(f.names() == List<word>{"a", "b", "c", "d", "e", "f"});
    f.start();
    while (r.time->run()) ++*r.time, f.execute();
    f.end();
    CHECK(timesOf(t, "a/0/minMax.dat").size() == 9);
    CHECK(timesOf(t, "b/0/minMax.dat") == List<scalar>{0, 0.5, 1});
    CHECK(timesOf(t, "c/0/minMax.dat") ==
          List<scalar>{0, 0.25, 0.625, 0.875});  // nearest to 0.3, 0.6, 0.9
    CHECK(timesOf(t, "d/0/minMax.dat") == List<scalar>{0, 0.375, 0.75});
    CHECK(!isFile(t.path + "/postProcessing/e/0/minMax.dat"));
    CHECK(timesOf(t, "f/0/minMax.dat") == List<scalar>{0.25, 0.375, 0.5});
}

TEST_CASE("functions that change during a run")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {3, 3, 3});
    t.control =
        "endTime 1; deltaT 0.125; writeControl timeStep; writeInterval 3; runTimeModifiable yes;";
    t.functions = "a { type minMax; } b { type minMax; } c { type minMax; writeInterval 2; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    f.start();
    const auto change = [&](const word& functions) {
        t.write("system/controlDict", t.control + "functions {" + functions + "}");
        r.time->rereadIfModified(), ++*r.time, f.execute();
    };
    ++*r.time, f.execute();
    change("a { type minMax; } c { type minMax; writeInterval 1; } d { type minMax; }");
    CHECK(f.names() == List<word>{"a", "c", "d"});
    {
        const capturedErrors errors;
        change("a { type nothingLikeThis; }");
        change("e { type minMax; feilds (p); }");
        CHECK(errors.contains("functions are not used, those of before go on:\n"));
        CHECK(errors.contains("Did you mean 'fields'?"));
        CHECK(!errors.contains("FATAL"));
        CHECK(!errors.contains("exiting"));
    }
    CHECK(f.names() == List<word>{"a", "c", "d"});
    change("d { type minMax; } a { type minMax; enabled no; } x { type minMax; timeStart 0.7; }");
    while (r.time->run()) ++*r.time, f.execute();
    f.end();
    CHECK(timesOf(t, "a/0/minMax.dat") == List<scalar>{0, 0.125, 0.25, 0.375, 0.5});
    CHECK(timesOf(t, "b/0/minMax.dat") == List<scalar>{0, 0.125});
    CHECK(timesOf(t, "c/0/minMax.dat") == List<scalar>{0});
    CHECK(timesOf(t, "c/0.25/minMax.dat") == List<scalar>{0.25, 0.375, 0.5});
    CHECK(timesOf(t, "d/0.25/minMax.dat") == List<scalar>{0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1});
    CHECK(timesOf(t, "x/0.625/minMax.dat") == List<scalar>{0.75, 0.875, 1});
    CHECK(!isFile(t.path + "/postProcessing/e/0.5/minMax.dat"));
}

TEST_CASE("mistakes in functions")
{
    CHECK_ERROR(wrong("a { type probe; }"),
                "Valid types are: cavityVolume energy errorNorm forces lineProfile", 3);
    CHECK_ERROR(wrong("a { type minMax; feilds (p); }"), "Did you mean 'fields'?", 3);
    CHECK_ERROR(wrong("a { type minMax; fields (T); }"), "Valid fields are: U p", 3);
    CHECK_ERROR(wrong("a { type minMax; zones (wall); }"), "Valid zones are: chamber", 3);
    CHECK_ERROR(wrong("a { type minMax; zones (); }"), "At least one zone", 3);
    CHECK_ERROR(wrong("a { type minMax; phase solid; }"), "No zone of the case is solid", 3);
    CHECK_ERROR(wrong("a { type patchFlux; surface no; }"), "There is no surface", 3);
    CHECK_ERROR(wrong("a { type cavityVolume; surface no; }"), "the case has none", 3);
    CHECK_ERROR(wrong("a { type lineProfile; start (0 0 0); end (1 0 0); nPoints 2.5; }"),
                "a whole number", 3);
    CHECK_ERROR(wrong("a { type minMax; phase gas; }"), "Valid phases are: all fluid solid", 3);
    CHECK_ERROR(wrong("a { type minMax; phase all; zones (chamber); }"), "not both", 3);
    CHECK_ERROR(wrong("a { type probes; }"), "'probeLocations' is missing", 3);
    CHECK_ERROR(wrong("a { type materialProbes; probeLocations ((0 0 0)); }"),
                "No zone of the case is solid", 3);
    CHECK_ERROR(wrong("a { type minMax; writeInterval 0.5; }"), "a whole number", 3);
    CHECK_ERROR(wrong("a { type minMax; writeControl writeTime; writeInterval 2; }"),
                "takes no writeInterval", 3);
    CHECK_ERROR(wrong("a { type patchFlux; }"), "either a patch or a surface", 3);
    CHECK_ERROR(wrong("a { type lineProfile; start (0 0 0); end (0 0 0); }"), "no length", 3);
    CHECK_ERROR(wrong("", "maxCo 1;"), "Nothing reads the entry 'maxCo'", 1);
    CHECK(wrong("", "application ispfFsiFoam; writeInterval 1; libs ();") == "");
}

TEST_CASE("data files: header, columns, NaN")
{
    const temporaryFolder f;
    const word path = f.path + "/a/b.dat";
    {
        dataFile d(path, {"remark"}, {"x", "v"}, 3);
        CHECK(!isFile(path));
        d.begin(0.125) << 1.0 / 3 << vector(1, -2, std::nan(""));
        d.endRow();
    }
    CHECK(readText(path) ==
          "# remark\n# Time        \tx\tv\n0.125         \t3.333e-01\t"
          "(1.000e+00 -2.000e+00 NaN)\n");
    dataFile again(path, {}, {"y"});  // replaces the earlier file at its first row
    again.begin(1) << 2;
    again.endRow();
    CHECK(readText(path).find("remark") == word::npos);
    dataFile nowhere("/proc/none/x.dat", {}, {});
    CHECK_ERROR(nowhere.begin(0), "/proc/none/x.dat", 0);
}
