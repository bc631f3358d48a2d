// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionary.H"
#include "token.H"

#include "errorOf.H"
#include "relative.H"

using namespace ispf;

namespace
{

dictionary parsed(const word& text)
{
    return dictionary::fromString(text, "case/system/test");
}

}  // namespace

TEST_CASE("values of every type")
{
    const dictionary d = parsed(R"(
        // a comment with ; and { in it
        s 1.5e-3; n -7; w Wendland-C2; q "two words"; b yes; off off;
        v (1 -2 3.5); t (1 2 3 4 5 6 7 8 9);
        ls (1 2 3); ln 3(4 5 6); lw (a "b c" div(phi,U)); lv ((1 0 0) (0 1 0));
        /* over
           two lines */ plus +4;
        empty ();
    )");
    CHECK(d.get<scalar>("s") == 1.5e-3);
    CHECK(d.get<label>("n") == -7);
    CHECK(d.get<word>("w") == "Wendland-C2");
    CHECK(d.get<word>("q") == "two words");
    CHECK(d.get<bool>("b"));
    CHECK(!d.get<bool>("off"));
    CHECK(d.get<vector>("v") == vector(1, -2, 3.5));
    CHECK(d.get<tensor>("t")(1, 2) == 6);
    CHECK(d.get<List<scalar>>("ls") == List<scalar>{1, 2, 3});
    CHECK(d.get<List<label>>("ln") == List<label>{4, 5, 6});
    CHECK(d.get<List<word>>("lw") == List<word>{"a", "b c", "div(phi,U)"});
    CHECK(d.get<List<vector>>("lv")[1] == vector(0, 1, 0));
    CHECK(d.get<scalar>("plus") == 4);
    CHECK(d.get<List<scalar>>("empty").empty());
    CHECK(d.getOrDefault<scalar>("absent", 9) == 9);
}

TEST_CASE("dimension sets, uniform and nonuniform before a value")
{
    const dictionary d = parsed(R"(
        nu [0 2 -1 0 0 0 0] 1e-6;
        mu mu [1 -1 -1 0 0 0 0] 2e-3;
        k [m^2/s] 3;
        U uniform (0 0 1);
        T uniform 300;
        g [0 1 -2 0 0 0 0](0 0 -9.81);
        f nonuniform List<scalar> 3(1 2 3);
        h List<vector> 2{(1 2 3)};
        tight uniform(4 5 6);
    )");
    CHECK(d.get<scalar>("nu", dims::kinematicViscosity) == 1e-6);
    CHECK(d.get<scalar>("mu", dims::dynamicViscosity) == 2e-3);
    CHECK(d.get<scalar>("k", dims::kinematicViscosity) == 3);
    CHECK(d.get<vector>("U") == vector(0, 0, 1));
    CHECK(d.get<scalar>("T") == 300);
    CHECK(d.get<vector>("g", dims::acceleration) == vector(0, 0, -9.81));
    CHECK(d.get<List<scalar>>("f") == List<scalar>{1, 2, 3});
    CHECK(d.get<List<vector>>("h") == List<vector>(2, vector(1, 2, 3)));
    CHECK(d.get<vector>("tight") == vector(4, 5, 6));
}

TEST_CASE("later definitions replace values and merge into dictionaries")
{
    const dictionary d = parsed("a 1; a 2; s { x 1; y 1; i { p 1; } } s { y 2; z 3; i { q 2; } }");
    CHECK(d.get<scalar>("a") == 2);
    const dictionary& s = d.subDict("s");
    CHECK(s.get<scalar>("x") == 1);
    CHECK(s.get<scalar>("y") == 2);
    CHECK(s.keys() == List<word>{"x", "y", "i", "z"});
    CHECK(s.dictKeys() == List<word>{"i"});
    CHECK(s.subDict("i").get<scalar>("p") + s.subDict("i").get<scalar>("q") == 3);
    CHECK(parsed("a 1; a { b 2; }").subDict("a").get<scalar>("b") == 2);
}

TEST_CASE("regular-expression keys: exact beats regex, the last regex wins, whole words only")
{
    const dictionary d = parsed(R"(
        "(U|p).*" 1; pFinal 2; "p.*" 3; ".*Final" 4; "(?i)nut" 5; "k" 6; "zone.*" { x 7; }
    )");
    CHECK(d.get<scalar>("pFinal") == 2);
    CHECK(d.get<scalar>("U") == 1);
    CHECK(d.get<scalar>("p") == 3);
    CHECK(d.get<scalar>("UFinal") == 4);
    CHECK(d.get<scalar>("NUT") == 5);
    CHECK(!d.found("xp"));
    CHECK(!d.found("nu"));
    CHECK(d.subDict("zoneWall").get<scalar>("x") == 7);
    CHECK(d.keys() == List<word>{"pFinal", "k"});
    CHECK_ERROR(parsed("a 1;\n\"(p\" 1;"), "not a regular expression", 2);
}

TEST_CASE("wrong values name the entry and the line")
{
    const dictionary d = parsed(
        "a\n1.5.2;\nb 1 2;\nc (1 2);\nd maybe;\ne (1 x);\nf 1.5;\n"
        "g 2(1 2 3);\nh { i nan; }\n j 1e400;");
    CHECK_ERROR(d.get<scalar>("a"), "finite number, found '1.5.2'", 2);
    CHECK_ERROR(d.get<scalar>("b"), "Unexpected '2'", 3);
    CHECK_ERROR(d.get<vector>("c"), "a vector (x y z)", 4);
    CHECK_ERROR(d.get<bool>("d"), "on off yes no true false", 5);
    CHECK_ERROR(d.get<List<scalar>>("e"), "found 'x'", 6);
    CHECK_ERROR(d.get<label>("f"), "whole number", 7);
    CHECK_ERROR(d.get<List<scalar>>("g"), "list of 2 (it has 3)", 8);
    CHECK_ERROR(d.subDict("h").get<scalar>("i"), "finite number", 9);
    CHECK_ERROR(d.get<scalar>("j"), "finite number", 10);
    CHECK_ERROR(d.get<scalar>("h"), "is a dictionary here", 9);
    CHECK_ERROR(d.subDict("a"), "is a value here", 1);
    CHECK_ERROR(d.get<scalar>("aa"), "Did you mean 'a'?", 0);
    CHECK_ERROR(d.subDict("x"), "Present: a b c", 0);
    try
    {
        d.subDict("h").get<scalar>("i");
    }
    catch (const fatalError& e)
    {
        CHECK(e.location().scope == "h.i");
        CHECK(formatted(e).find("file: case/system/test.h.i at line 9.") != word::npos);
    }
}

TEST_CASE("choices and ranges say what is valid")
{
    const dictionary d = parsed("kernel Wendlnd;\nn 3;");
    CHECK_ERROR(d.choose("kernel", {"quintic", "Wendland", "cubic"}),
                "Did you mean 'Wendland'?\nValid kernels are: Wendland cubic quintic", 1);
    CHECK(d.chooseOrDefault("other", {"x"}, "y") == "y");
    CHECK(d.getInRange("n", 3, 4) == 3);
    CHECK_ERROR(d.getInRange("n", 4, 5), "must lie between 4 and 5", 2);
    CHECK(d.getInRangeOrDefault("m", 4, 5, 4.5) == 4.5);
}

TEST_CASE("checkAllRead names what nobody asked for, and what is asked for")
{
    const dictionary d = parsed("tolerance 1;\ns { tolerence 2;\n}\nFoamFile { version 2; }");
    CHECK_ERROR(d.checkAllRead(), "Nothing reads the entry 'tolerance'", 1);
    d.get<scalar>("tolerance");
    CHECK_ERROR(d.checkAllRead(), "Nothing reads the dictionary 's'", 2);
    d.subDict("s").getOrDefault<scalar>("tolerance", 1);
    d.subDict("s").getOrDefault<scalar>("relTol", 1);
    CHECK_ERROR(d.checkAllRead(),
                "'tolerence'. Did you mean 'tolerance'?\nValid entries here are: relTol tolerance",
                2);
    d.markAllRead();
    d.checkAllRead();
}

TEST_CASE("reading a copy is reading the original, but writing it is not")
{
    dictionary d = parsed("a 1; s { b 2; }");
    dictionary copy = d;
    dictionary sub = d.subOrEmptyDict("s");
    copy.get<scalar>("a");
    sub.get<scalar>("b");
    d.checkAllRead();
    copy.set("a", "5");
    CHECK(d.get<scalar>("a") == 1);
    CHECK(copy.get<scalar>("a") == 5);
    copy.subDictOrAdd("s").set("b", "(1 2 3)");
    CHECK(d.subDict("s").get<scalar>("b") == 2);
    CHECK(copy.subDict("s").get<vector>("b") == vector(1, 2, 3));
    CHECK(d.subOrEmptyDict("none").empty());
    CHECK_ERROR(d.subOrEmptyDict("none").get<scalar>("x"), "'x' is missing", 0);
    copy.subDictOrAdd("new").set("c", "word \"two words\"");
    CHECK(copy.subDict("new").tokens("c") == List<word>{"word", "two words"});
}

TEST_CASE("toString can be read again")
{
    const word text =
        R"("two words" 5; div(phi,U) 6; "5" 7; a 1; s { "p.*" (1 (2 3) x); q "c d;"; i { z [0 1 0 0 0 0 0] 3{1}; } })";
    const dictionary d = parsed(parsed(text).toString());
    CHECK(d.toString() == parsed(text).toString());
    CHECK(d.keys() == List<word>{"two words", "div(phi,U)", "5", "a", "s"});
    CHECK(d.subDict("s").tokens("pp") == List<word>{"(", "1", "(", "2", "3", ")", "x", ")"});
    CHECK(d.subDict("s").get<word>("q") == "c d;");
    CHECK(d.subDict("s").subDict("i").get<List<scalar>>("z", dims::length) == List<scalar>(3, 1));
}

TEST_CASE("units are converted to SI, and dimensions checked")
{
    const dictionary d = parsed(R"(
        rho 1.06 [g/cm^3]; dt 2 [ms]; lengths (1 2.5) [mm]; before [cm] 3; numeric [1 -3] 5;
        p 120 [mmHg]; mu 3.5 [cP]; U uniform (1 0 2) [mm/s]; angle 180 [deg]; share 5 [%];
        speed 60 [rpm]; flow 6 [L/min]; odd 1 [(N/m)^2 m^(-3/2)]; named rho [kg m^-3] 7; none [] 3;
        both [mm] 3 [mm]; five [0 1 -1 0 0] 2;
    )");
    CHECK(d.get<scalar>("rho", dims::density) == relative(1060));
    CHECK(d.get<scalar>("dt", dims::time) == relative(2e-3));
    CHECK(d.get<List<scalar>>("lengths", dims::length)[1] == relative(2.5e-3));
    CHECK(d.get<scalar>("before", dims::length) == relative(0.03));
    CHECK(d.get<scalar>("p", dims::pressure) == relative(15998.6865));
    CHECK(d.get<scalar>("mu", dims::dynamicViscosity) == relative(3.5e-3));
    CHECK((d.get<vector>("U", dims::velocity) - vector(1e-3, 0, 2e-3)).norm() < 1e-18);
    CHECK(d.get<scalar>("angle") == relative(3.14159265358979));
    CHECK(d.get<scalar>("share") == relative(0.05));
    CHECK(d.get<scalar>("speed", dims::frequency) == relative(6.28318530717959));
    CHECK(d.get<scalar>("flow", dims::flowRate) == relative(1e-4));
    CHECK(d.get<scalar>("named", dims::density) == 7);
    CHECK(d.get<scalar>("none") == 3);
    CHECK(d.get<scalar>("five", dims::velocity) == 2);
    CHECK_ERROR(d.get<scalar>("rho", dims::pressure), "must have [1 -1 -2 0 0 0 0] (kg m^-1 s^-2)",
                2);
    CHECK_ERROR(d.get<scalar>("dt"), "must have [0 0 0 0 0 0 0] (no unit)", 2);
    CHECK_ERROR(d.get<scalar>("numeric", dims::density), "5 or 7 exponents", 2);
    CHECK_ERROR(d.get<scalar>("both", dims::length), "a unit before and one behind", 5);
    CHECK_ERROR(parsed("a 5 [mmhg];").get<scalar>("a"),
                "Did you mean 'mmHg'?\nValid units are:", 1);
    CHECK_ERROR(parsed("a 5mm;").get<scalar>("a"), "A unit stands in brackets: 5 [mm]", 1);
    CHECK_ERROR(parsed("a 5 [m^];").get<scalar>("a"), "a number is wanted", 1);
    CHECK_ERROR(parsed("a 5 [0];").get<scalar>("a"), "its factor is 0", 1);
}

TEST_CASE("typed lists, ASCII and binary, are kept as numbers and written again")
{
    const auto bytes = [](const auto& list) {
        return word(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
    };
    const auto file = [](const word& arch, const word& list) {
        return parsed("FoamFile { format binary; arch \"" + arch + "\"; }\nf nonuniform " + list +
                      ";\nlast 1;");
    };
    const List<double> values = {1.5, -2, 1e-300, 4, 5, 6};
    const dictionary d =
        file("LSB;label=32;scalar=64", "List<vector> \n2\n(" + bytes(values) + ")");
    CHECK(d.get<List<vector>>("f")[0] == vector(1.5, -2, 1e-300));
    CHECK(d.get<label>("last") == 1);
    CHECK(parsed(d.toString().substr(d.toString().find("f "))).get<List<vector>>("f")[1] ==
          vector(4, 5, 6));
    const List<float> floats = {1.5f, -2};
    CHECK(file("LSB;label=64;scalar=32", "List<scalar> 2(" + bytes(floats) + ")")
              .get<List<scalar>>("f") == List<scalar>{1.5, -2});
    const List<std::int64_t> longs = {7, -8, 9};
    CHECK(file("LSB;label=64;scalar=64", "List<label> 3(" + bytes(longs) + ")")
              .get<List<label>>("f") == List<label>{7, -8, 9});
    const List<std::int32_t> ints = {0x01000000};
    CHECK(file("MSB;label=32;scalar=64", "List<label> 1(" + bytes(ints) + ")")
              .get<List<label>>("f") == List<label>{1});
    CHECK_ERROR(file("LSB;label=32;scalar=64", "List<scalar> 2(" + bytes(floats) + ")"),
                "does not end where it should", 2);
    CHECK_ERROR(file("LSB;label=32;scalar=64", "List<scalar> 999999999(1)"), "does not end", 2);
    CHECK_ERROR(file("LSB;label=16;scalar=64", "List<scalar> 0()"), "is not understood", 1);
    const dictionary s = parsed("t List<symmTensor> 1((1 2 3 4 5 6)); v (1 2 3 4 5 6); n 0();");
    CHECK(s.get<tensor>("v")(1, 0) == 2);
    CHECK(parsed(s.toString()).toString() == s.toString());
    CHECK_ERROR(s.get<List<vector>>("t"), "with 3 components (these have 6)", 1);
}
