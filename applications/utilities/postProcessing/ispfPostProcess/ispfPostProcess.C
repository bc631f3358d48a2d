// SPDX-License-Identifier: GPL-3.0-or-later
// Runs function objects on the written times of a case, like OpenFOAM's postProcess: those of `functions` in
// system/controlDict, of the dictionary -dict, or of -func by name.  The rows equal those that the run has written
// or would have written.
#include "argList.H"
#include "fileNames.H"
#include "functionObjectList.H"
#include "timeSelection.H"

#include <ostream>
#include <sstream>

namespace
{

using namespace ispf;

List<word> namesIn(word text)
{
    for (char& c : text)
        if (c == '(' || c == ')' || c == ',') c = ' ';
    std::istringstream in(text);
    List<word> names;
    for (word name; in >> name;) names.push_back(name);
    return names;
}

// The function from `all`, else from system/<name>: the entries of the file, or its sub-dictionary of that name
dictionary functionOf(const Time& time, const dictionary& all, const word& name)
{
    if (all.isDict(name)) return all.subDict(name);
    if (const word file = time.systemFile(name); isFile(file))
    {
        const dictionary d = dictionary::fromFile(file);
        return d.isDict(name) ? d.subDict(name) : d;
    }
    throw fatalError("There is no function '" + name + "', nor " + time.systemFile(name) + "." +
                     didYouMean(name, all.dictKeys()) + "\n" +
                     validWords("function", all.dictKeys()));
}

dictionary chosenFunctions(const Time& time, const argList& args)
{
    dictionary all = time.controlDict().subOrEmptyDict("functions");
    if (args.found("dict"))
    {
        const dictionary d =
            dictionary::fromFile(fromFolder(args.caseFolder(), args.option("dict")));
        all = d.isDict("functions") ? d.subDict("functions") : d;
    }
    dictionary chosen;
    const List<word> names = args.found("func") ? namesIn(args.option("func")) : all.dictKeys();
    if (names.empty())
        throw fatalError(
            "There is no function to execute: name them in `functions` of "
            "system/controlDict, in a dictionary -dict, or one of system/ with -func",
            all.where());
    for (const word& name : names) chosen.subDictOrAdd(name) = functionOf(time, all, name);
    return chosen;
}

List<Time::folderOfTime> chosenTimes(const Time& time, const argList& args)
{
    List<Time::folderOfTime> times;
    for (const Time::folderOfTime& f : time.folders())
        if (time.hasState(f.name)) times.push_back(f);
    if (times.empty())
        throw fatalError("There is no time folder with particles in '" + args.caseFolder() + "'");
    if (args.found("time")) return selectTimes(time, times, args.option("time"));
    if (args.found("latestTime")) return {times.back()};
    return times;
}

int run(int argc, char** argv)
{
    argList args("ispfPostProcess", "Executes function objects on the written times of a case.");
    args.addOption("func", "name", "of controlDict, of -dict or of system/<name>; or '(a b)'");
    args.addOption("dict", "file", "with the functions, instead of system/controlDict");
    args.addOption("time", "ranges", "only these times, e.g. '0,0.5:1,2:' (default: all)");
    args.addSwitch("latestTime", "only the last time");
    if (!args.parse(argc, argv)) return 0;
    args.printHeader();
    info() << "Create time\n\n";
    Time time = Time::postProcess(args.caseFolder());
    const List<Time::folderOfTime> times = chosenTimes(time, args);
    const dictionary chosen = chosenFunctions(time, args);

    time.goTo(times.front().t);
    fsiCase c(time);
    functionObjectList functions(c, chosen);
    for (const word& name : chosen.dictKeys()) chosen.subDict(name).checkAllRead();
    info() << "function objects: " << join(functions.names()) << "\n\n";
    for (const Time::folderOfTime& at : times)
    {
        time.goTo(at.t);
        if (&at != &times.front()) c.read();
        info() << "Time = " << at.name << "\n";
        functions.writeNow();
    }
    functions.end();
    info() << "\nEnd\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    return ispf::runMain([&] { return run(argc, argv); });
}
