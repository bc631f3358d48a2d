// SPDX-License-Identifier: GPL-3.0-or-later
#include "capturedErrors.H"
#include "errorOf.H"
#include "token.H"

#include <cmath>

using namespace ispf;

TEST_CASE("runMain turns every exception into status 1, and keeps the body's own status")
{
    std::fflush(stderr);
    CHECK(runMain([] { return 7; }) == 7);
    CHECK(runMain([]() -> int { throw fatalError("(wanted by a test)"); }) == 1);
    CHECK(runMain([]() -> int { throw std::runtime_error("(wanted by a test)"); }) == 1);
    CHECK(runMain([]() -> int { throw std::string("(wanted by a test)"); }) == 1);
    CHECK(runMain([]() -> int { throw 5; }) == 1);
}

TEST_CASE("errors read as OpenFOAM's")
{
    const auto printed = [](const fatalError& error) {
        const capturedErrors errors;
        runMain([&]() -> int { throw error; });
        return errors.text();
    };
    const fatalError entry("Bad.", {"c/system/controlDict", "deltaT", 28, 0});
    CHECK(printed(fatalError("No such thing.")) ==
          "\n--> FOAM FATAL ERROR: \nNo such thing.\n\nFOAM exiting\n\n");
    CHECK(printed(entry) ==
          "\n--> FOAM FATAL IO ERROR: \nBad.\n\nfile: c/system/controlDict.deltaT at line 28.\n\n"
          "FOAM exiting\n\n");
    CHECK(formatted(entry) == "Bad.\n\nfile: c/system/controlDict.deltaT at line 28.");
    const fatalError spanning("Bad.", {"c/d", "", 3, 9});
    CHECK(formatted(spanning).find("file: c/d from line 3 to line 9.") != word::npos);
}

TEST_CASE("text helpers")
{
    CHECK(validWords("solver", {"b", "a"}) == "Valid solvers are: a b");
    CHECK(validWords("solver", {}) == "There is no solver");
    CHECK(didYouMean("tolerence", {"tol", "tolerance"}) == " Did you mean 'tolerance'?");
    CHECK(didYouMean("xyz", {"tolerance"}) == "");
    CHECK(join({"a", "b"}, ", ") == "a, b");
    CHECK(str(0.1) == "0.1");
    CHECK(std::stod(str(1.0 / 3, 17)) == 1.0 / 3);
}

TEST_CASE("numbers are taken whole or not at all")
{
    scalar v = 0;
    CHECK((readNumber("+1.5e-3", v) && v == 1.5e-3));
    CHECK((readNumber(".5", v) && v == 0.5));
    CHECK((readNumber("-3.", v) && v == -3));
    for (const char* no : {"", "1.5x", "1 ", "nan", "inf", "-inf", "1e999", "--1", "+-1", "0x10"})
        CHECK_MESSAGE(!readNumber(no, v), no);
}
