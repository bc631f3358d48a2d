// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1.H"
#include "errorOf.H"
#include "temporaryFolder.H"
#include "relative.H"

#include <cmath>

using namespace ispf;

namespace
{

std::unique_ptr<Function1> made(const word& text, const word& caseFolder = ".")
{
    return Function1::New("f", dictionary::fromString(text, "test"), caseFolder);
}

}  // namespace

TEST_CASE("a function may be a number")
{
    for (const char* text :
         {"f 2.5;", "f constant 2.5;", "f [0 1 0 0 0 0 0] 2.5;", "f { type constant; value 2.5; }"})
        CHECK(made(text)->value(7) == 2.5);
    CHECK_ERROR(made("f foo 2.5;"), "Valid types are: constant csvFile", 1);
    for (const char* v : {"1e400", "-1e400", "nan", "-inf", "1.5x"})
        CHECK_ERROR(made(word("f ") + v + ";"), word("a finite number, found '") + v + "'", 1);
    CHECK_ERROR(made("\nf;"), "is a function of time", 2);
    CHECK_ERROR(made("f { type tabel; values ((0 0)); }"), "Did you mean 'table'?", 1);
    CHECK_ERROR(made("g 1;"), "'f' is missing", 0);
}

TEST_CASE("tables are linear between their rows, and clamp outside")
{
    for (const char* text : {"f table ((0 0) (1 10) (3 -10));", "f table 3((0 0) (1 10) (3 -10));",
                             "f { type table; values ((0 0) (1 10) (3 -10)); }"})
    {
        const auto f = made(text);
        CHECK(f->value(0.25) == relative(2.5));
        CHECK(std::abs(f->value(2)) < 1e-12);
        CHECK(f->value(1) == 10);
        CHECK(f->value(-1) == 0);
        CHECK(f->value(9) == -10);
        CHECK(std::abs(f->rate(0.5, 1.5)) < 1e-12);  // up 5, down 5
        CHECK(f->rate(0, 0.5) == relative(10));
    }
}

TEST_CASE("outOfBounds")
{
    const auto with = [](const word& how) {
        return made("f { type table; values ((1 0) (3 4)); outOfBounds " + how + "; }");
    };
    CHECK(with("clamp")->value(5) == 4);
    CHECK(with("warn")->value(0) == 0);
    CHECK_ERROR(with("error")->value(3.5), "spans 1 to 3", 1);
    CHECK(with("error")->value(3) == 4);
    CHECK(with("error")->value(3 + 1e-15) == 4);  // the end of the last step
    CHECK(with("error")->value(1 - 1e-15) == 0);
    const auto f = with("repeat");
    CHECK(f->value(3) == 4);
    CHECK(f->value(4) == relative(2));
    CHECK(f->value(0) == relative(2));
    CHECK(f->value(1002.5) == relative(3));
    CHECK_ERROR(with("wrap"), "Valid outOfBounds are: clamp error repeat warn", 1);
}

TEST_CASE("broken tables name file and line")
{
    CHECK_ERROR(made("f table ((0 0)\n(1 1)\n(1 2));"), "must increase, but 1 follows 1", 3);
    CHECK_ERROR(made("f table ((0 0)\n(1 nan));"), "finite number is wanted, found 'nan'", 2);
    CHECK_ERROR(made("f table ((0 0)\n(1 1 1));"), ") is wanted, found '1'", 2);
    CHECK_ERROR(made("f table\n();"), "no rows", 1);
    CHECK_ERROR(made("f table ((0 0) 1);"), "( is wanted, found '1'", 1);
}

TEST_CASE("tableFile")
{
    const temporaryFolder c;
    c.write("constant/t.dat", "// time value\n(\n(0 1)\n(2 5)\n)\n");
    const word text = "f { type tableFile; file \"constant/t.dat\"; }";
    CHECK(made(text, c.path)->value(1) == relative(3));
    c.write("constant/t.dat", "(\n(0 1)\n(-2 5)\n)\n");
    CHECK_ERROR(made(text, c.path), "must increase", 3);
    CHECK_ERROR(made("\nf { type tableFile; file \"no.dat\"; }", c.path), "There is no file", 2);
}

TEST_CASE("csvFile: columns by number and by name, scale, comments, separators")
{
    const temporaryFolder c;
    c.write("a.csv", "# volumes\r\ntime, \"left\" ,right\r\n0,0,1\r\n\r\n# half\r\n2,4,3\r\n");
    const auto f = [&](const word& rest) {
        return made("f { type csvFile; file \"a.csv\"; " + rest + " }", c.path);
    };
    CHECK(f("nHeaderLine 2;")->value(1) == relative(2));
    CHECK(f("nHeaderLine 2; componentColumns (2); scale 1e-3;")->value(1) == relative(2e-3));
    CHECK(f("nHeaderLine 2; refColumn time; componentColumns (right);")->value(2) == relative(3));
    CHECK(f("nHeaderLine 2; componentColumns (left);")->value(2) == relative(4));
    CHECK_ERROR(f("nHeaderLine 2; componentColumns (lft);"), "Valid columns are: left right time",
                1);
    CHECK_ERROR(f("componentColumns (left);"), "nHeaderLine 1 tells", 1);
    CHECK_ERROR(f("nHeaderLine 2; componentColumns (3);"), "has 3 columns", 3);
    CHECK_ERROR(f(""), "found 'time'", 2);
    CHECK_ERROR(f("nHeaderLine 1;"), "found 'time'.\nnHeaderLine tells how many", 2);
    c.write("a.csv", "0  1\n1   3\n2 nan\n");
    CHECK_ERROR(f("separator \" \"; mergeSeparators on;"), "finite number", 3);
    c.write("a.csv", "0  1\n1   3\n");
    CHECK(f("separator \" \"; mergeSeparators on;")->value(0.5) == relative(2));
    c.write("a.csv", "0\t1\n0\t3\n");
    CHECK_ERROR(f("separator \"\\t\";"), "must increase", 2);
}

TEST_CASE("csvFile: the header is so many lines, and names may stand behind a #")
{
    const temporaryFolder c;
    const auto at = [&](scalar t, const word& rest) {
        return made("f { type csvFile; file \"a.csv\"; nHeaderLine " + rest + " }", c.path)
            ->value(t);
    };
    c.write("a.csv", "# t,v\n0,0.1\n0.01,0.3\n");
    CHECK(at(0, "1;") == 0.1);
    CHECK(at(0, "0;") == 0.1);  // a # is skipped anyhow
    CHECK(at(0.01, "1; columns (t v);") == 0.3);
    CHECK_ERROR(at(0, "1; columns (t w);"), "Valid columns are: t v", 1);
    c.write("a.csv", "\n# t  v\n\n# measured\n0  5\n#\n\n10  7\n");
    CHECK(at(10, "4; separator \" \"; mergeSeparators yes;") == 7);
    c.write("a.csv", "\r\n# t [ms], v [cm]\r\n# measured\r\n0,5\r\n10,7\r\n");
    CHECK(at(0.01, "3; columns (t v);") == relative(0.07));
    CHECK(at(0.01, "3;") == relative(0.07));
    c.write("a.csv", "# of [3], Fig. 1\nt,v\n# s,m\n0,5\n1,7\n");
    CHECK(at(1, "3;") == 7);
    CHECK(at(1, "3; columns (t v);") == 7);
}

TEST_CASE("csvFile: a byte order mark is no part of the first name")
{
    const temporaryFolder c;
    c.write("flow.csv", "\xef\xbb\xbftime,flow\n0,1\n1,3\n");
    const dictionary d = dictionary::fromString(
        "f { type csvFile; file \"flow.csv\"; nHeaderLine 1; columns (time flow); }");
    CHECK(Function1::New("f", d, c.path)->value(0.5) == doctest::Approx(2));
}

TEST_CASE("formulas")
{
    const auto s = made("f { type sine; frequency 2; amplitude 3; scale 0.5; level 1; t0 0.125; }");
    CHECK(s->value(0.125) == relative(1));
    CHECK(s->value(0.25) == relative(2.5));
    const auto q = made("f { type square; frequency 0.5; amplitude 3; markSpace 3; level 1; }");
    CHECK(q->value(0.1) == 4);
    CHECK(q->value(1.49) == 4);
    CHECK(q->value(1.51) == -2);
    CHECK(q->value(-0.1) == -2);
    const auto p = made("f polynomial ((2 0) (3 2));");
    CHECK(p->value(2) == relative(14));
    CHECK(made("f { type polynomial; coeffs ((1 1)); }")->value(5) == 5);
    CHECK(made("f polynomial ((1 -1));")->value(4) == 0.25);
    CHECK_ERROR(made("f polynomial ((1 -1));")->value(0), "has no value at 0 s", 1);
    CHECK_ERROR(made("f polynomial ((1 0.5));")->value(-1), "a fractional one", 1);
    CHECK_ERROR(made("f #codeStream { code #{ #}; };"), "must not run compiled code", 1);
    const auto r = made(
        "f { type scale; scale table ((0 0) (1 1)); value { type sine; frequency 1; "
        "amplitude 2; } }");
    CHECK(r->value(0.25) == relative(0.5));
    CHECK(r->value(1.25) == relative(2));
}

TEST_CASE("units: behind a number, of a table, of the columns of a csv file")
{
    const auto inUnits = [](const word& text, const dimensionSet& wanted,
                            const word& folder = ".") {
        return Function1::New("f", dictionary::fromString(text, "test"), folder, wanted);
    };
    CHECK(inUnits("f 120 [mmHg];", dims::pressure)->value(0) == relative(15998.6865));
    CHECK(inUnits("f constant 6 [l/min];", dims::flowRate)->value(0) == relative(1e-4));
    CHECK(inUnits("f table ((0 0) (1 120)) [mmHg];", dims::pressure)->value(1) ==
          relative(15998.6865));
    CHECK_ERROR(inUnits("f table ((0 0) (1 120)) [mm];", dims::pressure), "is given in [mm]", 1);
    CHECK_ERROR(inUnits("f { type table; values ((0 0) (1 120)) [mmHg]; }", dims::pressure),
                "A unit cannot stand here: 'units ([s] [m]);'", 1);
    const auto table =
        inUnits("f { type table; values ((0 0) (20 3)); units ([ms] [cm]); }", dims::length);
    CHECK(table->value(0.01) == relative(0.015));
    const auto sine =
        inUnits("f { type sine; frequency 60 [1/min]; amplitude 2 [mm]; }", dims::length);
    CHECK(sine->value(0.25) == relative(0.002));
    CHECK_ERROR(inUnits("f 120 [mmHg];", dims::length), "must have [0 1 0 0 0 0 0] (m)", 1);
    CHECK_ERROR(inUnits("f { type table; values ((0 0)); units ([m] [m]); }", dims::length),
                "must have [0 0 1 0 0 0 0] (s)", 1);
    CHECK_ERROR(inUnits("f { type table; values ((0 0)); units ([s]); }", dims::length),
                "two units", 1);
    const temporaryFolder c;
    c.write("a.csv", "time [ms], flow [ml/min], p [mmHg]\n0, 0, 80\n500, 60, 120\n");
    const word csv = "f { type csvFile; file \"a.csv\"; nHeaderLine 1; columns (time ";
    CHECK(inUnits(csv + "flow); }", dims::flowRate, c.path)->value(0.25) == relative(0.5e-6));
    CHECK(inUnits(csv + "p); }", dims::pressure, c.path)->value(0.5) == relative(15998.6865));
    CHECK_ERROR(inUnits(csv + "p); }", dims::flowRate, c.path), "Column 'p' is in [mmHg]", 1);
    // the unit given twice counts once
    CHECK(inUnits(csv + "p); units ([ms] [mmHg]); }", dims::pressure, c.path)->value(0.5) ==
          relative(15998.6865));
    CHECK_ERROR(inUnits(csv + "p); units ([s] [mmHg]); }", dims::pressure, c.path),
                "Column 'time' is in [ms] by the header of", 1);
    CHECK_ERROR(inUnits(csv + "p); units ([ms] [Pa]); }", dims::pressure, c.path),
                "Column 'p' is in [mmHg] by the header of", 1);
    c.write("b.csv", "time, p [mmHg]\n0, 80\n500, 120\n");
    CHECK(inUnits("f { type csvFile; file \"b.csv\"; nHeaderLine 1; units ([ms] [mmHg]); }",
                  dims::pressure, c.path)
              ->value(0.5) == relative(15998.6865));
    c.write("a.csv", "time [ms], flow [ml/mn]\n0, 0\n");
    CHECK_ERROR(inUnits(csv + "flow); }", dims::flowRate, c.path), "Unknown unit 'mn'", 1);
}

TEST_CASE("OpenFOAM's older form: the word, and its entries in a dictionary beside it")
{
    CHECK(made("f sine; fCoeffs { frequency 1; amplitude 2; level 3; }")->value(0.25) ==
          relative(5));
    CHECK(made("f halfCosineRamp; fCoeffs { duration 2; }")->value(1) == relative(0.5));
    CHECK(made("f table; fCoeffs { values ((0 1) (2 3)); }")->value(1) == relative(2));
    CHECK_ERROR(made("f snie; fCoeffs { frequency 1; amplitude 2; }"), "Unknown f 'snie'", 1);
    CHECK_ERROR(made("f sine;\nfCoeffs { amplitude 2; }"), "'frequency' is missing", 2);
    CHECK_ERROR(made("f sine; gCoeffs { frequency 1; amplitude 2; }"), "is a function of time", 1);
}

TEST_CASE("ramps")
{
    const auto at = [](const word& type, scalar t) {
        return made("f { type " + type + "; start 1; duration 2; }")->value(t);
    };
    for (const char* type :
         {"linearRamp", "quadraticRamp", "halfCosineRamp", "quarterCosineRamp", "quarterSineRamp"})
        CHECK((at(type, 0.5) == 0 && at(type, 3.5) == relative(1)));
    CHECK(at("linearRamp", 1.5) == 0.25);
    CHECK(at("quadraticRamp", 2) == 0.25);
    CHECK(at("halfCosineRamp", 2) == relative(0.5));
    CHECK(at("quarterCosineRamp", 2) == relative(1 - std::sqrt(0.5)));
    CHECK(at("quarterSineRamp", 2) == relative(std::sqrt(0.5)));
    CHECK((made("f zero;")->value(1) == 0 && made("f { type one; }")->value(1) == 1));
    CHECK((made("f uniform 3;")->value(1) == 3 && made("f uniform 3;")->value(2) == 3));
}

TEST_CASE("functions whose values are vectors")
{
    const temporaryFolder c;
    const auto at = [&](const word& text, scalar t, const dimensionSet& wanted = dims::any) {
        return vector(
            vectorFunction1::New("f", dictionary::fromString(text, "test"), c.path, wanted)
                ->value(t));
    };
    const auto isNear = [](const vector& a, const vector& b) {
        return (a - b).norm() <= 1e-14 * (1 + b.norm());
    };
    CHECK(at("f (1 2 3);", 5) == vector(1, 2, 3));
    CHECK(isNear(at("f (1 2 3) [mm];", 5, dims::length), {1e-3, 2e-3, 3e-3}));
    CHECK(at("f constant (1 2 3);", 5) == vector(1, 2, 3));
    CHECK(at("f { type uniform; value (1 2 3); }", 5) == vector(1, 2, 3));
    CHECK((at("f zero;", 1) == vector(0, 0, 0) && at("f one;", 1) == vector(1, 1, 1)));
    CHECK(isNear(at("f table ((0 (0 0 8)) (2 (2 -4 8)));", 0.5), {0.5, -1, 8}));
    CHECK(isNear(at("f { type table; values ((0 (0 0 0)) (2 (2 4 6))); outOfBounds repeat; "
                    "units ([ms] [cm]); }",
                    2.5e-3, dims::length),
                 {0.005, 0.01, 0.015}));
    c.write("t", "2((0 (0 0 0)) (1 (3 2 1)))");
    CHECK(isNear(at("f { type tableFile; file t; }", 0.5), {1.5, 1, 0.5}));
    c.write("a.csv", "gz [mm/s^2], t [ms], gx [m/s^2], gy [m/s^2]\n0, 0, 0, 0\n4000, 10, 1, 2\n");
    const word csv = "f { type csvFile; file \"a.csv\"; nHeaderLine 1; ";
    CHECK(isNear(at(csv + "columns (t gx gy gz); }", 5e-3, dims::acceleration), {0.5, 1, 2}));
    CHECK(
        isNear(at(csv + "refColumn t; componentColumns (gx gy gz); scale 2; }", 5e-3), {1, 2, 4}));
    CHECK(isNear(at("f { type sine; frequency 1; amplitude (1 0 2); level (0 3 0); }", 0.25),
                 {1, 3, 2}));
    CHECK(isNear(at("f polynomial (((1 0 2) 0) ((0 3 0) 2));", 2), {1, 12, 2}));
    CHECK(isNear(at("f { type scale; scale { type linearRamp; duration 4; } value (4 0 8); }", 1),
                 {1, 0, 2}));
    CHECK_ERROR(at("f 3;", 0), "a vector (x y z), 'constant (x y z)', 'table ((t (x y z)) ...)'",
                1);
    CHECK_ERROR(at("f table ((0 1));", 0), "A table is written ((t (x y z))", 1);
    CHECK_ERROR(at("f { type linearRamp; }", 0), "Unknown type 'linearRamp'", 1);
    CHECK_ERROR(at(csv + "columns (t gx gy); }", 0), "Four columns are wanted: (time x y z)", 1);
    CHECK_ERROR(at("f { type csvFile; file a.csv; componentColumns (1); }", 0),
                "Three columns are wanted here: (x y z)", 1);
    CHECK_ERROR(at("f (1 2 3) [mm];", 0, dims::velocity), "must have [0 1 -1", 1);
}
