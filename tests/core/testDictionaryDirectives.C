// SPDX-License-Identifier: GPL-3.0-or-later
// #calc #eval #neg, #if and related directives, macros in all spellings.  Expected values are those that OpenFOAM v1912's
// foamDictionary -expand prints (tests/utilities/foamDictionary.sh compares with the program itself), or arithmetic.
#include "dictionary.H"
#include "errorOf.H"
#include "relative.H"
#include "temporaryFolder.H"

#include <cmath>

using namespace ispf;

namespace
{

dictionary parsed(const word& text)
{
    return dictionary::fromString(text, "test");
}

}  // namespace

TEST_CASE("#calc, #eval and ${{ }}: formulas with macros")
{
    const dictionary d = parsed(R"dict(
        r 0.5; angle 30; n -3; L 20;
        x #calc "$r*cos(degToRad($angle))";
        y #eval{ $r*sin(degToRad($angle)) };
        z ${{ 2*pi()*$r }};
        v #eval #{ pow($r, 2) + sqr(3) #};
        minus #eval{ 2-$n*3 };
        list (1 #eval{ 2*3 } 4 ${{ 1/4 }});
        which #eval{ $r > 1 ? 10 : 20 };
        odd #calc "Foam::sqrt(16.0) + std::max(1, 2) + constant::mathematical::pi";
        s { r 7; inner { a #eval{ $r + ${...angle} + $:n }; } }
        deflt #eval{ ${nope:-5} + 1 };
        big ${{ 1e300 * 1e-300 }};
    )dict");
    CHECK(d.get<scalar>("x") == relative(0.5 * std::sqrt(3) / 2));
    CHECK(d.get<scalar>("y") == relative(0.25));
    CHECK(d.get<scalar>("z") == relative(M_PI));
    CHECK(d.get<scalar>("v") == 9.25);
    CHECK(d.get<scalar>("minus") == 11);
    CHECK(d.get<List<scalar>>("list") == List<scalar>{1, 6, 4, 0.25});
    CHECK(d.get<scalar>("which") == 20);
    CHECK(d.get<scalar>("odd") == relative(6 + M_PI));
    CHECK(d.get<scalar>("deflt") == 6);
    CHECK(d.get<scalar>("big") == relative(1));
    CHECK(d.subDict("s").subDict("inner").get<scalar>("a") == 34);
}

TEST_CASE("comments in formulas")
{
    const dictionary d = parsed(R"dict(
        x 4;
        a #eval{ 1 + 2 // c
        };
        b #eval{ 3 /* c */ + 4 };
        c #eval "3 /* c */ + 4 // d";
        d #eval{ 1 + $x // $undefined
        + 1 };
        e #calc #{ 8 /* two
            lines / */ / 2 #};
        f ${{ 1 + 2 // c }};
        g #eval{ 1 /* + 1 };
        list (#eval{ 1 // one
        } 2);
    )dict");
    for (const auto& [key, value] : std::map<word, scalar>{
             {"a", 3}, {"b", 7}, {"c", 7}, {"d", 6}, {"e", 4}, {"f", 3}, {"g", 1}})
        CHECK(d.get<scalar>(key) == value);
    CHECK(d.get<List<scalar>>("list") == List<scalar>{1, 2});
}

TEST_CASE("functions that users of OpenFOAM expect in formulas")
{
    const auto value = [](const word& formula) {
        return parsed("a #eval{ " + formula + " };").get<scalar>("a");
    };
    // values printed by foamDictionary
    CHECK(value("pos0(0) + 10*pos(0) + 100*neg0(0) + 1000*neg(0) + 10000*sign(-0.0)") == 10101);
    CHECK(value("pos0(-1) + pos(2) + neg0(3) + neg(-1) + sign(-2)") == 1);
    CHECK(value("rand()") == relative(0.749902, 1e-6));
    CHECK(value("rand( ) - rand(0)") == 0);
    CHECK(value("rand(3)") == relative(0.863673, 1e-6));
    CHECK(value("pos0 (0) + sqrt  (9) + 2*(1 + (3 - 1)) + pow (2, 3)*( 1 )") == 18);
    CHECK(value("rand (3)") == relative(0.863673, 1e-6));
    CHECK(value("rand(7.9)") == relative(0.386626, 2e-6));
    CHECK(value("sqrt(9) + cbrt(8) + mag(-2) + magSqr(3) + abs(-1)") == 17);
    CHECK(value("min(3, 1) + max(2, 5) + hypot(3, 4) + pow(2, 10)") == 1035);
    CHECK(value("radToDeg(atan2(1, 1)) + radToDeg(asin(1))") == relative(135));
    CHECK(value("floor(-0.5) + ceil(0.2) + round(2.6) + trunc(-1.7)") == 2);
    CHECK(value("log(exp(2)) + log10(1000) + ln(exp(1))") == relative(6));
    CHECK(value("pos(1) + neg(-1) + sign(-3) + bool(2*pi())") == 2);
    CHECK(value("10 % 4 + mod(7, 4) + 2^3") == 13);
    CHECK(value("1 < 2 && !(3 == 4) || 0") == 1);
    CHECK(value("1 >= 1 ? (2 != 2 ? 5 : 6) : 7") == 6);
    CHECK(value("pi - pi()") == 0);
    CHECK(value("2--3 + -(-1)") == 6);
    CHECK(value("sinh(1) + cosh(1)") == relative(std::exp(1.0)));
}

TEST_CASE("vectors in formulas: linear ones, and their length")
{
    const dictionary d = parsed(R"dict(
        v (1 -2 2); w #eval{ 2*$v + vector(0, 0, 1)/2 }; n #eval{ mag($v) };
        unit #eval{ $v/mag($v) };  m #calc "magSqr($v - vector(1, 0, 0))";
    )dict");
    CHECK(d.get<vector>("w") == vector(2, -4, 4.5));
    CHECK(d.get<scalar>("n") == 3);
    CHECK((d.get<vector>("unit") - vector(1, -2, 2) / 3).norm() < 1e-15);
    CHECK(d.get<scalar>("m") == 8);
    CHECK_ERROR(parsed("v (1 2 3);\nw #eval{ $v*$v };"), "vectors can be added", 2);
    CHECK_ERROR(parsed("v (1 2 3);\nw #eval{ $v + 1 };"), "vectors can be added", 2);
}

TEST_CASE("mistakes in formulas name the formula and its line")
{
    CHECK_ERROR(parsed("\na #eval{ 1/0 };"), "\" 1/0 \" is inf", 2);
    CHECK_ERROR(parsed("\na #calc \"foo(1)\";"), "unknown name 'foo'. Valid names are: M_PI abs",
                2);
    CHECK_ERROR(parsed("\na #calc \"1 +\";"), "Unexpected end of expression", 2);
    CHECK_ERROR(parsed("\na #calc \"$nope + 1\";"), "$nope names no entry", 2);
    CHECK_ERROR(parsed("s { }\na #calc \"$s + 1\";"), "is a dictionary", 2);
    CHECK_ERROR(parsed("\na #calc \"int i = 3\";"), "must not assign", 2);
    CHECK_ERROR(parsed("\na #calc #{ os << 1; #};"), "is no formula", 2);
    CHECK_ERROR(parsed("\na #calc 5;"), "wants a formula", 2);
    CHECK_ERROR(parsed("\na #eval{ 1 + ;"), "never closed", 2);
    CHECK_ERROR(parsed("a #eval{ " + word(5000, '(') + " };"), "more than 4000 characters", 1);
    CHECK_ERROR(parsed("a #eval{ " + word(3000, '(') + " };"), "formula", 1);
    CHECK_ERROR(parsed("a #eval{ " + word(3000, '-') + "1 1 };"), "formula", 1);
}

TEST_CASE("#neg")
{
    const dictionary d = parsed("a 2.5; b -3e-2; x #neg $a; y #neg $b; z (1 #neg $a #neg 4);");
    CHECK(d.get<scalar>("x") == -2.5);
    CHECK(d.get<scalar>("y") == 3e-2);
    CHECK(d.get<vector>("z") == vector(1, -2.5, -4));
    CHECK_ERROR(parsed("a b;\nx #neg $a;"), "#neg wants a number", 2);
    CHECK_ERROR(parsed("a 3;\nx -$a;").get<scalar>("x"), "#neg $name changes a sign", 2);
}

TEST_CASE("#if and #ifeq, nested, with #else")
{
    const dictionary d = parsed(R"dict(
        mode fast; n 3; on1 yes;
        #ifeq $mode fast
            a 1;
            #if $on1
                b { x 2; #if 0
                    y 3; { unbalanced (in what is skipped
                    #else
                    y 4;
                    #endif
                }
            #else
                c 5;
            #endif
        #else
            d 6;
            #if 1
                e 7;
            #else
                f 8;
            #endif
        #endif
        #if #eval{ $n > 2 }
        g 9;
        #endif
        #ifeq 1.0 1
        h 10;
        #endif
        #if #calc "$n < 2";
        i 11;
        #endif
        #ifeq "fast" $mode
        j 12;
        #endif
        #if false
        k 13;
        #endif
    )dict");
    CHECK(join(d.keys()) == "mode n on1 a b g h j");
    CHECK(d.subDict("b").keys() == List<word>{"x", "y"});
    CHECK(d.subDict("b").get<label>("y") == 4);
}

// As in foamDictionary, see tests/utilities/foamDictionary.sh
TEST_CASE("#ifeq compares numbers with numbers, and the text of words and strings")
{
    const auto equal = [](const word& a, const word& b) {
        const word text = "x 5; y abc; s { t 1; }\n#ifeq " + a + " " + b + "\nsame 1;\n#endif\n";
        return parsed(text).found("same");
    };
    for (const auto& [a, b] : {std::pair("5", "5.0"),
                               {"\"5\"", "\"5\""},
                               {"\"$x\"", "5"},
                               {"$x", "\"$x\""},
                               {"\"$y\"", "abc"},
                               {"\"abc\"", "$y"},
                               {"\"${y}\"", "abc"},
                               {"\"$s.t\"", "1"},
                               {"\"$nothing\"", "\"\""}})
    {
        CAPTURE(a);
        CHECK(equal(a, b));
        CHECK(equal(b, a));
    }
    for (const auto& [a, b] : {std::pair("5", "\"5\""),
                               {"$x", "\"5\""},
                               {"\"5\"", "\"5.0\""},
                               {"$y", "$x"},
                               {"\"$x$x\"", "55"}})
    {
        CAPTURE(a);
        CHECK(!equal(a, b));
        CHECK(!equal(b, a));
    }
}

TEST_CASE("mistakes in conditions")
{
    CHECK_ERROR(parsed("a 1;\n#if 1\nb 2;"), "The #if here has no #endif", 2);
    CHECK_ERROR(parsed("a 1;\n#if 0\nb 2;"), "The #if here has no #endif", 2);
    CHECK_ERROR(parsed("s {\n#ifeq 1 1\nb 2; }\n#endif"), "has no #endif", 2);
    CHECK_ERROR(parsed("a 1;\n#endif"), "#endif without an #if", 2);
    CHECK_ERROR(parsed("a 1;\n#else"), "#else without an #if", 2);
    CHECK_ERROR(parsed("#if 1\n#else\n#else\n#endif"), "second #else", 3);
    CHECK_ERROR(parsed("#if 0\n#else\n#else\n#endif"), "second #else", 3);
    CHECK_ERROR(parsed("\n#if perhaps\n#endif"), "wants a number or a switch", 2);
    CHECK_ERROR(parsed("\n#ifeq a {\n#endif"), "found '{'", 2);
    CHECK_ERROR(parsed("\n#if $nope\n#endif"), "names no entry", 2);
}

TEST_CASE("macros: slashes, nested braces, defaults, as OpenFOAM's later versions")
{
    const dictionary d = parsed(R"dict(
        a 1; q w; w 5; n 2; a2 7; s { b { c 5; } t $/a; u $../a; x $!a;  }
        d $s/b/c; e ${s/b/c}; f ${/s/b/c}; g ${${q}}; h ${a$n}; i ${a${n}};
        j ${nope:-3}; k ${nope:-${a}}; l ${a:-9}; m ${a:+8}; o (${nope:-1 2} 3);
        p.r 3; p { r 4; } dotted $p.r;
        y 5; z { y 1; } z { here $y; }
        "r.*" 1; rr { "x.*" { y 2; } } copied { $rr.xx; }
    )dict");
    const auto of = [&](const char* key) { return d.get<label>(key); };
    CHECK(d.subDict("s").get<label>("t") == 1);
    CHECK(d.subDict("s").get<label>("u") == 1);
    CHECK(d.subDict("s").get<label>("x") == 1);
    CHECK((of("d") == 5 && of("e") == 5 && of("f") == 5));
    CHECK((of("g") == 5 && of("h") == 7 && of("i") == 7));
    CHECK((of("j") == 3 && of("k") == 1 && of("l") == 1 && of("m") == 8));
    CHECK(d.get<vector>("o") == vector(1, 2, 3));
    CHECK(of("dotted") == 3);
    CHECK(d.subDict("z").get<label>("here") == 5);  // not what merges with it later
    CHECK(d.subDict("copied").get<label>("y") == 2);
    CHECK_ERROR(parsed("\"a.*\" 1;\nb $abc;"), "names no entry", 2);  // patterns are no macros
    CHECK_ERROR(parsed("a ${b;\n"), "never closed", 1);
    CHECK_ERROR(parsed("s { a $..../b; }"), "outside the file", 1);
}

TEST_CASE("$dict within the braces of a list, and values from files")
{
    const temporaryFolder f;
    f.write("rows", "(1 2\n 3)");
    f.write("tooMuch", "1; b 2;");
    const word top = f.write("top", "v #include \"rows\"; list ( { $base } ); base { a 1; }");
    CHECK_ERROR(dictionary::fromFile(top), "names no entry", 1);
    const dictionary d = dictionary::fromFile(
        f.write("good",
                "v #include \"rows\"; base { a 1; s { b 2; } } list ( { $base } );"
                "name rows; w #include \"$name\"; z #sinclude \"none\";"));
    CHECK(d.get<vector>("v") == vector(1, 2, 3));
    CHECK(d.get<vector>("w") == vector(1, 2, 3));
    CHECK(d.tokens("list") ==
          List<word>{"(", "{", "a", "1", ";", "s", "{", "b", "2", ";", "}", "}", ")"});
    CHECK(d.tokens("z").empty());
    CHECK_ERROR(dictionary::fromFile(f.write("bad", "v #include \"tooMuch\";")), "without any ';'",
                1);
}

TEST_CASE("what a few lines can unfold to is bounded")
{
    word dicts = "d0 { a 1; b 2; }";
    for (int k = 1; k < 40; ++k)
    {
        const word before = "$d" + std::to_string(k - 1) + ";";
        dicts += "\nd" + std::to_string(k) + " { x { " + before + " } y { " + before + " } }";
    }
    CHECK_ERROR(parsed(dicts), "grow beyond", 0);
    const temporaryFolder f;
    for (int k = 0; k < 30; ++k)
    {
        const word next = "#include \"f" + std::to_string(k + 1) + "\"\n";
        f.write("f" + std::to_string(k), next + next);
    }
    f.write("f30", "a 1;");
    CHECK_ERROR(dictionary::fromFile(f.path + "/f0"), "grow beyond", 0);
    word name = "a";
    for (int k = 0; k < 100; ++k) name = "${" + name + "}";
    CHECK_ERROR(parsed("a a; b " + name + ";"), "more than 20 deep", 1);
    CHECK_ERROR(parsed("a " + word(5000, 'x') + ";"), "more than 1024 characters", 1);
    CHECK_ERROR(parsed("a " + word(2000000, '(') + ";"), "( opened here is never closed", 1);
    // an expression on which engines with backtracking run for ever
    const dictionary d = parsed("\"(a|a)*(a|a)*(a|aa)*b\" 1;");
    CHECK(!d.found(word(2000, 'a')));
    CHECK_ERROR(parsed("\"((a{1,200}){1,200}){1,200}\" 1;"), "not a regular expression", 1);
}

TEST_CASE("what OpenFOAM's tutorials write beside")
{
    const auto d = dictionary::fromString(
        "div(phi,Yi) Gauss multivariateSelection { fu vanLeer; };\n"
        "#ifeq $NO_SUCH_VARIABLE \"\"\nx 1;\n#else\nx 2;\n#endif\n\"U\" 3;\n");
    CHECK(d.valueText("div(phi,Yi)") == "Gauss multivariateSelection { fu vanLeer ; }");
    CHECK(d.get<label>("x") == 1);
    CHECK(d.toString("U") == "\"U\"             3;\n");
    CHECK(d.get<label>("U") == 3);
    CHECK_ERROR(dictionary::fromString("a 1\nb { c 2; }\nd 3;"), "Unexpected { in the value of 'a'",
                1);
    const temporaryFolder c;
    c.write("part", "FoamFile { version 2.0; class dictionary; }\nb 1;\n");
    const auto e = dictionary::fromString("a\n{\n    # include \"part\"\n}\n", c.path + "/whole");
    CHECK(e.subDict("a").keys() == List<word>{"b"});
}
