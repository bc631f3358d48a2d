// SPDX-License-Identifier: GPL-3.0-or-later
// Samples the particles of written times on planes, for maps: see samplePlane.H for the dictionary.
// Writes postProcessing/planeSample/<time>/<plane>.dat and, of a slice, <plane>.slice.dat.
#include "argList.H"
#include "fileNames.H"
#include "samplePlane.H"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace
{

using namespace ispf;

struct timeFolder
{
    scalar value;
    word name;
};

// The case's time folders that hold particles, ascending
List<timeFolder> timeFolders(const word& caseFolder)
{
    List<timeFolder> times;
    for (const auto& entry : std::filesystem::directory_iterator(caseFolder))
    {
        const word name = entry.path().filename().string();
        char* end = nullptr;
        const scalar value = std::strtod(name.c_str(), &end);
        if (end != name.c_str() && *end == '\0' &&
            std::filesystem::exists(entry.path() / "particles.hdf"))
            times.push_back({value, name});
    }
    if (times.empty())
        throw fatalError("There is no time folder with particles.hdf in '" + caseFolder + "'");
    std::sort(times.begin(), times.end(),
              [](const timeFolder& a, const timeFolder& b) { return a.value < b.value; });
    return times;
}

// Those nearest to the asked times, which must lie within `tolerance`
List<timeFolder> select(const List<timeFolder>& times, const word& asked, scalar tolerance)
{
    List<timeFolder> chosen;
    std::istringstream stream(asked);
    for (scalar t; stream >> t;)
    {
        const auto nearest = std::min_element(
            times.begin(), times.end(), [t](const timeFolder& a, const timeFolder& b) {
                return std::abs(a.value - t) < std::abs(b.value - t);
            });
        if (std::abs(nearest->value - t) > tolerance)
            throw fatalError("No particles were written at time " + str(t) +
                             "; the nearest time is " + nearest->name);
        chosen.push_back(*nearest);
    }
    if (!stream.eof() || chosen.empty())
        throw fatalError("Option '-times': '" + asked +
                         "' is not a list of numbers such as '0 1.5'");
    return chosen;
}

int run(int argc, char** argv)
{
    argList args("planeSample", "Samples particles on planes: system/planeSampleDict.");
    args.addOption("times", "list", "only these times, e.g. '0 1.5' (default: all)");
    args.addSwitch("latestTime", "only the last time");
    if (!args.parse(argc, argv)) return 0;
    args.printHeader();
    const word root = args.caseFolder();
    const dictionary dict = dictionary::fromFile(root + "/system/planeSampleDict");
    List<samplePlane> planes;
    for (const word& name : dict.dictKeys()) planes.emplace_back(name, dict.subDict(name));
    dict.checkAllRead();
    if (planes.empty())
        throw fatalError("There is no plane: give one or more <name> { point ...; normal ...; }",
                         dict.where());

    List<timeFolder> times = timeFolders(root);
    if (args.found("latestTime")) times = {times.back()};
    if (args.found("times")) times = select(times, args.option("times"), 1e-3);
    for (const timeFolder& time : times)
    {
        const particleTable particles = readParticles(root + "/" + time.name + "/particles.hdf");
        const word out = root + "/postProcessing/planeSample/" + time.name + "/";
        for (const samplePlane& plane : planes)
        {
            writeText(out + plane.name() + ".dat", plane.grid(particles));
            if (plane.hasSlice())
                writeText(out + plane.name() + ".slice.dat", plane.slice(particles));
        }
        info() << "planeSample: time " << time.name << ", " << planes.size() << " planes\n";
    }
    info() << "End\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    return ispf::runMain([&] { return run(argc, argv); });
}
