// SPDX-License-Identifier: GPL-3.0-or-later
#include "argList.H"
#include "errorOf.H"
#include "execution.H"
#include "temporaryFolder.H"

using namespace ispf;

namespace
{

argList program()
{
    argList args("testProgram", "Does nothing.");
    args.addSwitch("quick", "be quick");
    args.addOption("dx", "length", "spacing [m]");
    return args;
}

}  // namespace

TEST_CASE("options, switches and values")
{
    argList args = program();
    CHECK(args.parse({"-quick", "-dx", "-1e-3"}));
    CHECK(args.found("quick"));
    CHECK(!args.found("case"));
    CHECK(args.number("dx") == -1e-3);
    CHECK(args.optionOr("time", "latest") == "latest");
    CHECK(args.numberOr("other", 3) == 3);
    CHECK_ERROR(args.option("time"), "-time is needed", 0);
}

TEST_CASE("mistakes on the command line")
{
    CHECK_ERROR(program().parse({"-quik"}),
                "Did you mean 'quick'?\nValid options are: case dx help quick threads version", 0);
    CHECK_ERROR(program().parse({"-dx"}), "wants a value <length>", 0);
    CHECK_ERROR(program().parse({"stray"}), "Unexpected argument 'stray'", 0);
    CHECK_ERROR(program().parse({"-case", "/no/such/folder"}), "does not exist", 0);
    CHECK_ERROR(program().parse({"-threads", "many"}), "wants a number, found 'many'", 0);
    CHECK_ERROR(program().parse({"-threads", "0"}), "from 1 on", 0);
    argList args = program();
    args.parse({"-dx", "1mm"});
    CHECK_ERROR(args.number("dx"), "found '1mm'", 0);
}

TEST_CASE("the case folder, made absolute and told to the environment")
{
    const temporaryFolder f;
    argList args = program();
    CHECK(args.parse({"-case", f.path + "/../" + f.path.substr(f.path.rfind('/') + 1)}));
    CHECK(args.caseFolder() == f.path);
    CHECK(word(::getenv("FOAM_CASE")) == f.path);
}

TEST_CASE("arguments by position")
{
    argList args = program();
    args.addArgument("file", "what to read");
    CHECK_ERROR(args.parse(List<word>{}), "The argument <file> is missing: what to read", 0);
    CHECK(args.parse({"-quick", "a.igs"}));
    CHECK(args.argument(0) == "a.igs");
    CHECK_ERROR(args.parse({"b", "c"}), "Unexpected argument", 0);
}

TEST_CASE("help lists everything; threads are set")
{
    const word help = program().help();
    for (const char* part : {"Usage: testProgram [OPTIONS]", "-dx <length>", "spacing [m]",
                             "-quick", "-case <dir>", "-threads <n>", "-help", "-version"})
        CHECK_MESSAGE(help.find(part) != word::npos, part);
    argList args = program();
    CHECK(args.parse({"-threads", "1"}));
    CHECK(nThreads() == 1);
    setThreads(0);
}
