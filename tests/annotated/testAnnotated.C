// SPDX-License-Identifier: GPL-3.0-or-later
// Compares etc/caseDicts/annotated with the sources, both ways: every key that a program asks for is annotated,
// with its default, its words and its range; every annotated key is asked for.  tests/repository/annotated.sh runs the
// files, which shows that they are valid, with each key in its place.
#include "cellMultigrid.H"
#include "dictionary.H"
#include "fileNames.H"
#include "solverPerformance.H"
#include "sourceScan.H"
#include "token.H"

#include <doctest/doctest.h>
#include <algorithm>
#include <map>
#include <regex>
#include <set>

using namespace ispf;
using annotated::request;

namespace
{

// The annotated file to which a request belongs, by source file and key.  The first matching line counts
struct home
{
    const char *file, *receiver, *annotated;
};
const home homes[] = {
    {"control/Function1", "", "Function1"},
    {"control/TimeControls", "d", "controlDict uniformTime"},
    {"control/TimeControls", "changed.control_", "functions"},
    {"placement/|ispfDictionary", "", "none"},
    {"control/Time", "", "controlDict"},
    {"control/argList|fileFormats|cloudIO|siteFile|ispfPostProcess", "", "none"},
    {".*", "args|file|patches|s\\.patches|.*cloud\\.state|sum|volume_|in", "none"},
    {"functionObjects/bodies/surfaceLeaks", "d", "boundary"},
    {"functionObjects/list/functionObjectList", "c.time.controlDict\\(\\)", "functions"},
    {"functionObjects", "", "functions"},
    {"boundary/|case/cutPlanes", "", "boundary"},
    {"solid/", "", "structureProperties"},
    {"linearSolvers|operators/\\w+/(adjointPair|density|particleSh)", "", "sphSolution"},
    {"case/fsiCase|common/timeScheme", ".*schemes", "sphSchemes"},
    {"common/shiftingFrame", "", "boundary"},
    {"case/fsiCase", "solution", "sphSolution"},
    {"case/fsiCase", "g|dict|", "g"},
    {"case/fsiCase", "physical|zoneRho|perZone", "physicalProperties"},
    {"case/viscosityModel", "", "physicalProperties"},
    {"common/outsideEntry|solids/closedGaps|monolithic/restSearch", "", "structureProperties"},
    {"schemes/resistance/", "", "porosityProperties"},
    {"schemes/", "c.structureProperties|solid", "structureProperties"},
    {"schemes/|case/", "", "sphSolution"},
    {"generateParticles/particleDict", "patch|boundary", "boundary"},
    {"generateParticles/", "", "particleDict"},
    {"calibrateSprings", "schemes", "sphSchemes"},
    {"calibrateSprings/springResponse", "dict", "calibrateSpringsDict"},
    {"calibrateSprings", "", "structureProperties"},
    {"ispfFsiFoam|checkParticles", "control|", "controlDict functions"},
};

word homeOf(const request& r)
{
    for (const home& h : homes)
        if (std::regex_search(r.file, std::regex(h.file)) &&
            (!*h.receiver || std::regex_match(r.receiver, std::regex(h.receiver))))
            return h.annotated;
    return "";
}

// Keys that users choose (names of patches, zones, function objects), and keys that a function was given
// whose callers are scanned
bool isName(const request& r)
{
    static const std::set<word> names = {
        "name",         "w.name", "own.name", "face.name()", "zone",
        "zoneNames[z]", "key",    "found",    "present",     ""};
    return names.count(r.arguments[0]) != 0;
}

struct annotation
{
    word key, comment;
    int line;
};

// Entries, and entries in comments that can replace others
List<annotation> annotations(const word& file)
{
    static const std::regex entry(
        R"((?:^|[{;])\s*(?://)?([A-Za-z_]\w*)(?:[ \t]+[^;{}]*(?=;)|(?=[ \t]*\{)|[ \t]*(?://.*)?$))"),
        prose(R"(^\s*//[ ])");
    List<annotation> all;
    std::istringstream in(
        readText((annotated::root() / "etc/caseDicts/annotated" / file).string()));
    word line;
    for (int n = 1; std::getline(in, line); ++n)
    {
        if (std::regex_search(line, prose)) continue;
        const size_t blank = std::min(line.find("// "), line.size());
        const word code = line.substr(0, blank), comment = line.substr(blank);
        for (std::sregex_iterator m(code.begin(), code.end(), entry), end; m != end; ++m)
            if (word((*m)[1]).rfind("my", 0) != 0) all.push_back({(*m)[1], comment, n});
    }
    return all;
}

List<annotation> annotationsIn(const word& files, const word& key)
{
    List<annotation> found;
    std::istringstream names(files);
    for (word file; names >> file;)
        if (file != "uniformTime" && file != "none")
            for (const annotation& a : annotations(file))
                if (a.key == key) found.push_back(a);
    return found;
}

word unquoted(word text)
{
    text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
    return text;
}

// True if the comment contains the word, or a number of that value after `before`
bool says(const word& comment, const word& before, const word& value)
{
    scalar wanted, given;
    const word text = value == "true" ? "yes" : value == "false" ? "no" : unquoted(value);
    for (size_t at = comment.find(before); at != word::npos; at = comment.find(before, at + 1))
    {
        std::istringstream rest(comment.substr(at + before.size()));
        word first;
        rest >> first;
        while (!first.empty() && word(";,:)").find(first.back()) != word::npos && first != text)
            first.pop_back();
        if (first == text) return true;
        if (readNumber(text, wanted) && readNumber(first, given) && wanted == given) return true;
    }
    return false;
}

bool isConstant(const word& a)
{
    scalar number;
    return a == "true" || a == "false" || readNumber(a, number) ||
           (a.size() > 1 && a.front() == '"' && std::count(a.begin(), a.end(), '"') == 2);
}

// The part of the request that none of the annotations contains; "" if there is none
word unsaid(const request& r, const List<annotation>& at)
{
    const auto anySays = [&](const word& before, const word& value) {
        return std::any_of(at.begin(), at.end(),
                           [&](const annotation& a) { return says(a.comment, before, value); });
    };
    const bool optional = r.function.find("OrDefault") != word::npos;
    if (optional && !std::any_of(at.begin(), at.end(), [](const annotation& a) {
            return a.comment.find("default") != word::npos;
        }))
        return "that it has a default";
    if (optional && isConstant(r.arguments.back()) && !unquoted(r.arguments.back()).empty() &&
        !anySays("default ", r.arguments.back()))
        return "default " + r.arguments.back();
    if (r.function.rfind("choose", 0) == 0 && r.arguments[1].front() == '{')
    {
        static const std::regex quoted("\"([^\"]*)\"");
        const word& list = r.arguments[1];
        for (std::sregex_iterator m(list.begin(), list.end(), quoted), end; m != end; ++m)
            if (std::none_of(at.begin(), at.end(), [&](const annotation& a) {
                    return std::regex_search(a.comment, std::regex("\\b" + word((*m)[1]) + "\\b"));
                }))
                return "the word " + word((*m)[1]);
    }
    scalar low, high;
    if (r.function.rfind("getInRange", 0) == 0 && readNumber(r.arguments[1], low) &&
        readNumber(r.arguments[2], high) && high < 1e9)
        if (!anySays(" to ", r.arguments[2])) return r.arguments[1] + " to " + r.arguments[2];
    return "";
}

}  // namespace

TEST_CASE("every key that a program asks for is annotated, with default, words and range")
{
    const List<request> all = annotated::requests();
    REQUIRE(all.size() > 200);
    for (const request& r : all)
    {
        const word at = r.file + " line " + std::to_string(r.line) + ": " + r.receiver + "." +
                        r.function + "(" + (r.key.empty() ? r.arguments[0] : r.key) + ")";
        const word files = homeOf(r);
        if (files.empty()) FAIL_CHECK(at << ": which dictionary is this? Tell it in homes above.");
        if (files == "none" || files.empty()) continue;
        if (r.key.empty())
        {
            if (!isName(r)) FAIL_CHECK(at << ": a key that is no literal.");
            continue;
        }
        const List<annotation> found = annotationsIn(files, r.key);
        const bool elsewhere = files.find("uniformTime") != word::npos && found.empty() &&
                               (r.key == "value" || r.key == "index" ||
                                r.key == "checksum");  // of <time>/uniform/time
        if (elsewhere) continue;
        if (found.empty())
            FAIL_CHECK(at << ": not annotated in etc/caseDicts/annotated/" << files << ".");
        else if (const word missing = unsaid(r, found); !missing.empty())
            FAIL_CHECK(at << ": the comment in etc/caseDicts/annotated/" << files
                          << " does not say " << missing << ".");
    }
}

TEST_CASE("every annotated key is one that a program asks for")
{
    std::map<word, std::set<word>> asked;
    for (const request& r : annotated::requests())
    {
        std::istringstream names(homeOf(r));
        for (word file; names >> file;) asked[file].insert(r.key);
    }
    asked["functions"].insert("functions");
    const auto folder = annotated::root() / "etc/caseDicts/annotated";
    size_t n = 0;
    for (const auto& f : std::filesystem::directory_iterator(folder))
    {
        const word file = f.path().filename().string();
        for (const annotation& a : annotations(file))
        {
            ++n;
            if (file == "Function1" && a.key == "p") continue;  // the entry that is one
            CHECK_MESSAGE(asked[file].count(a.key) + asked["Function1"].count(a.key),
                          file << " line " << a.line << ": nothing asks for " << a.key);
        }
    }
    CHECK(n > 120);
}

TEST_CASE("defaults that structures hold are the annotated ones, solvers.p absent or empty")
{
    const dictionary all =
        dictionary::fromFile((annotated::root() / "etc/caseDicts/annotated/sphSolution").string());
    const word source =
        readText((annotated::root() / "src/schemes/projection/fractionalStep.C").string());
    std::smatch found;
    REQUIRE(std::regex_search(source, found,
                              std::regex(R"re(defaultPressureSolver\s*=\s*"([^"]*)")re")));
    const dictionary withoutP = dictionary::fromString(found[1], "default of solvers.p");
    const dictionary p = all.subDict("solvers").subDict("p");
    for (const word key : {"solver", "preconditioner"})
        CHECK(withoutP.get<word>(key) == p.get<word>(key));
    const solverControls given = solverControls::fromDict(p);
    for (const dictionary& d : {withoutP, dictionary()})
    {
        const solverControls absent = solverControls::fromDict(d);
        CHECK(absent.tolerance == given.tolerance);
        CHECK(absent.relTol == given.relTol);
        CHECK(absent.absTol == given.absTol);
        CHECK(absent.maxIter == given.maxIter);
    }
    multigridOptions options;
    options.read(all.subDict("monolithic").subDict("multigrid"));
    CHECK(options.coarsestSize == multigridOptions().coarsestSize);
}
