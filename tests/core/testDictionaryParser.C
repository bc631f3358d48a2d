// SPDX-License-Identifier: GPL-3.0-or-later
// Macros, directives and broken files.
#include "dictionary.H"
#include "errorOf.H"
#include "temporaryFolder.H"

using namespace ispf;

namespace
{

dictionary parsed(const word& text)
{
    return dictionary::fromString(text, "test");
}

}  // namespace

TEST_CASE("macros: enclosing, dotted, from the top, relative, in braces, inside lists")
{
    const dictionary d = parsed(R"(
        a 1; s { b 2; i { c 3; a 10; } }
        x { a 5; here $a; top $:a; one $s.b; two $s.i.c; braces ${a}; list ($a ($:a $s.b));
            up $..a; deep { a 7; own $.a; }  }
        word name; t { $word 4; }
    )" + word());
    const dictionary& x = d.subDict("x");
    CHECK(x.get<label>("here") == 5);
    CHECK(x.get<label>("top") == 1);
    CHECK(x.get<label>("one") == 2);
    CHECK(x.get<label>("two") == 3);
    CHECK(x.get<label>("braces") == 5);
    CHECK(x.tokens("list") == List<word>{"(", "5", "(", "1", "2", ")", ")"});
    CHECK(x.get<label>("up") == 1);
    CHECK(d.subDict("t").get<label>("name") == 4);
}

TEST_CASE("macros see what stands above them, and are refused otherwise")
{
    CHECK(parsed("a 1; b $a; a 2;").get<label>("b") == 1);
    CHECK_ERROR(parsed("b 1;\nc $a; a 1;"), "$a names no entry above", 2);
    CHECK_ERROR(parsed("s { a 1; }\nb { c $.a; }"), "$.a names no entry", 2);
    CHECK_ERROR(parsed("a 1;\nb $..a;"), "outside the file", 2);
    CHECK_ERROR(parsed("s { a 1; }\nb (1 $s);"), "is a dictionary", 2);
    CHECK_ERROR(parsed("a 1 2;\n$a 3;"), "more than one word", 2);
    ::setenv("ISPF_TEST_WORD", "fromOutside", 1);
    CHECK(parsed("a $ISPF_TEST_WORD;").get<word>("a") == "fromOutside");
}

TEST_CASE("$name; merges a dictionary, and key $name; copies one")
{
    const dictionary d = parsed(R"(
        base { tol 1; n 2; inner { p 1; } }
        full { $base; tol 3; inner { q 2; } }
        copy $base;
        part $base.inner;
        again { $:full }
    )");
    CHECK(d.subDict("full").get<label>("tol") == 3);
    CHECK(d.subDict("full").get<label>("n") == 2);
    CHECK(d.subDict("full").subDict("inner").keys() == List<word>{"p", "q"});
    CHECK(d.subDict("base").subDict("inner").keys() == List<word>{"p"});
    CHECK(d.subDict("copy").get<label>("n") == 2);
    CHECK(d.subDict("part").get<label>("p") == 1);
    CHECK(d.subDict("again").subDict("inner").get<label>("q") == 2);
    CHECK_ERROR(d.subDict("full").subDict("inner").get<label>("z"), "'z' is missing", 0);
}

TEST_CASE("an entry used only through a macro counts as read; its copy does not")
{
    const dictionary d = parsed("value 5; base { a 1; b { c 2; } }\nuse { x $value; $base; }");
    CHECK_ERROR(d.checkAllRead(), "'use'", 2);
    const dictionary& use = d.subDict("use");
    use.get<label>("x");
    use.get<label>("a");
    CHECK_ERROR(d.checkAllRead(), "'b'", 1);
    use.subDict("b").get<label>("c");
    d.checkAllRead();
}

TEST_CASE("#remove and #inputMode")
{
    const dictionary d = parsed(R"(
        a 1; b 2; c1 3; c2 4; d 5;
        #remove a
        #remove (b "c.*")
        #inputMode protect
        d 6; e 7; e 8;
        #inputMode overwrite
        s { x 1; } s { y 2; }
        #inputMode merge
        s { z 3; }
    )");
    CHECK(d.keys() == List<word>{"d", "e", "s"});
    CHECK(d.get<label>("d") == 5);
    CHECK(d.get<label>("e") == 7);
    CHECK(d.subDict("s").keys() == List<word>{"y", "z"});
    CHECK_ERROR(parsed("#inputMode error\na 1;\na 2;"), "stands twice, first at line 2", 3);
    CHECK_ERROR(parsed("#inputMode blend\n"), "Valid modes are: default error merge", 1);
}

TEST_CASE("what is refused says so, with its line")
{
    CHECK_ERROR(parsed("\n#codeStream { }"), "must not run compiled code", 2);
    CHECK_ERROR(parsed("#inclde \"x\""), "Did you mean 'include'?\nValid directives are: calc", 1);
    CHECK_ERROR(parsed("FoamFile { format compressed; }"), "Valid formats are: ascii binary", 1);
    CHECK_ERROR(parsed("\n#calc \"1\";"), "a keyword must stand before it", 2);
    CHECK(parsed("code #{ a; } \"b #};").tokens("code")[0] == " a; } \"b ");
}

TEST_CASE("thousands of keys that are patterns are read; what would take all memory is refused")
{
    const auto patterns = [](int n) {
        word text;
        for (int k = 0; k < n; ++k)
            text += "\"k" + std::to_string(k) + ".*\" " + std::to_string(k) + "; ";
        return text;
    };
    const dictionary d = parsed(patterns(5000));
    CHECK(d.get<label>("k17x") == 17);
    CHECK(d.get<label>("k4999x") == 4999);
    CHECK_ERROR(parsed(patterns(60000)), "take more than 64 MB", 1);
    word copies = "a {" + patterns(4000) + "}";
    for (int k = 0; k < 15; ++k) copies += " b" + std::to_string(k) + " { $a; }";
    CHECK_ERROR(parsed(copies), "take more than 64 MB", 1);
}

TEST_CASE("#codeStream is carried along in a value, and refused where the value is wanted")
{
    const word text = "a\n#codeStream { code #{ os << $x; #}; libs (\"$y\" z); };";
    const dictionary d = parsed(text);
    CHECK(parsed(d.toString()).toString() == d.toString());
    CHECK(d.toString().find("#{ os << $x; #}") != word::npos);
    CHECK_ERROR(d.get<scalar>("a"), "must not run compiled code", 2);
    CHECK_ERROR(parsed("a #codeStream { b;"), "never closed", 1);
}

TEST_CASE("broken files: what is wrong, and the line to look at")
{
    CHECK_ERROR(parsed("a 1;\nb 2"), "';' after the value of 'b' is missing", 2);
    CHECK_ERROR(parsed("s\n{\n a 1\n}"), "';' after the value of 'a' is missing", 3);
    CHECK_ERROR(parsed("a 1\ns { b 2; }"), "the ';' after it is missing", 1);
    CHECK_ERROR(parsed("a 1;\ns {\n b 2;\n"), "opened here is never closed", 2);
    CHECK_ERROR(parsed("a 1;\n}\n"), "closing brace } without", 2);
    CHECK_ERROR(parsed("a (1 2;\nb 3;"), "( opened here is never closed", 1);
    CHECK_ERROR(parsed("a\n(1 2];"), "Unbalanced brackets", 2);
    CHECK_ERROR(parsed("a 1 2);"), "Unbalanced brackets", 1);
    CHECK_ERROR(parsed("a 1;\nb \"open;\nc 2;"), "closing \" is missing", 2);
    CHECK_ERROR(parsed("/* open\n a 1;"), "comment /* begun here is never closed", 1);
    CHECK_ERROR(parsed("x #{ open\n a 1;"), "never closed", 1);
    CHECK_ERROR(parsed("a 1;\n5 b;"), "found the number 5", 2);
    CHECK_ERROR(parsed("a 1;\n\"\" 2;"), "an empty string", 2);
    CHECK_ERROR(parsed("(a b);"), "keyword is wanted", 1);
    CHECK_ERROR(parsed(word("a 1;\0b", 6)), "not a text file", 1);
    word deep;
    for (int k = 0; k < 300; ++k) deep += "a {";
    CHECK_ERROR(parsed(deep), "nested deeper than 200", 1);
    word deeper = "a { x 1; }";
    for (int k = 0; k < 300; ++k) deeper += "\na { a { $:a } }";
    CHECK_ERROR(parsed(deeper), "nest dictionaries deeper than 200", 0);
    word longer = "a0 (1 2 3 4);";
    for (int k = 0; k < 40; ++k)
        longer += "\na" + std::to_string(k + 1) + " ($a" + std::to_string(k) + " $a" +
                  std::to_string(k) + ");";
    CHECK_ERROR(parsed(longer), "grow beyond", 0);
}

TEST_CASE("harmless oddities: no final newline, CRLF, byte order mark, stray semicolons")
{
    CHECK(parsed("a 1;").get<label>("a") == 1);
    CHECK(parsed("a 1;\r\nb on;\r\n").get<bool>("b"));
    CHECK(parsed("\xEF\xBB\xBF"
                 "a 1;")
              .get<label>("a") == 1);
    CHECK(parsed("a 1;;; s { ; b 2; };").subDict("s").get<label>("b") == 2);
    CHECK(parsed("").empty());
    CHECK(parsed("a//comment\n 1;// end").get<label>("a") == 1);
    CHECK(parsed("file data/plunger.csv;").get<word>("file") == "data/plunger.csv");
}

TEST_CASE("#include: relative to the including file, into the current scope, errors in its lines")
{
    const temporaryFolder f;
    f.write("sub/common", "FoamFile { version 2.0; }\ncommon 3;\n#include \"deeper\"\n");
    f.write("sub/deeper", "deeper $common;");
    const word top = f.write("top",
                             "a 1;\ns { #include \"sub/common\" }\n#sinclude \"none\"\n"
                             "#includeIfPresent \"none\"\nb 2;");
    const dictionary d = dictionary::fromFile(top);
    CHECK(d.subDict("s").get<label>("deeper") == 3);
    CHECK(d.get<label>("b") == 2);
    CHECK(d.subDict("s").where("deeper").file == f.path + "/sub/deeper");

    const word broken = f.write("broken", "a 1;\n#include \"bad\"\n");
    f.write("bad", "x 1;\n\ny {");
    CHECK_ERROR(dictionary::fromFile(broken), "never closed", 3);
    CHECK_ERROR(dictionary::fromFile(f.write("lost", "a 1;\n#include \"nowhere\"")), "no file", 2);
    CHECK_ERROR(dictionary::fromFile(f.path + "/absent"), "No such file", 0);
    CHECK_ERROR(dictionary::fromFile(f.path), "it is a folder", 0);
    CHECK(dictionary::fromFileIfPresent(f.path + "/absent").empty());
}

TEST_CASE("#include in a circle is found out")
{
    const temporaryFolder f;
    f.write("one", "a 1;\n#include \"two\"");
    f.write("two", "#include \"./three\"");
    f.write("three", "\n\n#include \"one\"");
    CHECK_ERROR(dictionary::fromFile(f.path + "/one"), "each other in a circle", 3);
    // the same file twice is no circle
    f.write("leaf", "x 1;");
    CHECK(
        dictionary::fromFile(f.write("twice", "#include \"leaf\"\n#include \"leaf\"")).found("x"));
}

TEST_CASE("paths: environment, <case>, the project's etc")
{
    ::setenv("ISPF_TEST_DIR", "/somewhere", 1);
    CHECK(expandPath("$ISPF_TEST_DIR/a/${ISPF_TEST_DIR}b") == "/somewhere/a//somewhereb");
    CHECK_ERROR(expandPath("$ISPF_NOT_SET/a"), "ISPF_NOT_SET is not set", 0);
    ::setenv("FOAM_CASE", "/my/case", 1);
    CHECK(expandPath("<constant>/x") == "/my/case/constant/x");
    CHECK(expandPath("<case>/x") == "/my/case/x");
    CHECK(isFile(etcFile("codingStyleGuide.md")));
    CHECK(etcFile("no/such/file").empty());
    CHECK_ERROR(parsed("\n#includeEtc \"no/such/file\""), "etc folder", 2);
    CHECK(fromFolder("a/b", "c") == "a/b/c");
    CHECK(fromFolder("a/b", "/c") == "/c");
}
