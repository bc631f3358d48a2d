// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionary.H"
#include "token.H"

#include "errorOf.H"

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
        CHECK(formatted(e).find("--> FOAM FATAL IO ERROR: \n") != word::npos);
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
