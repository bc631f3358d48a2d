// SPDX-License-Identifier: GPL-3.0-or-later
// Fills a geometry with particles.  Reads system/particleDict and constant/boundary; writes 0/particles.hdf,
// wall particles, sites of open faces and surfaces.
#include "argList.H"
#include "caseWriter.H"
#include "fileNames.H"
#include "packing.H"
#include "packingReport.H"
#include "particleDict.H"
#include "token.H"

using namespace ispf;

// Warns of later times: a run would continue from the latest of them, with the old particles
void warnOfOldTimes(const word& folder)
{
    word old;
    for (const word& name : folderNames(folder))
        if (scalar t; readNumber(name, t) && t != 0 &&
                      (isFile(folder + "/" + name + "/particles.hdf") ||
                       isFile(folder + "/" + name + "/uniform/particles")))
            old += " " + name;
    if (!old.empty())
        warning("There are times of an earlier run:" + old +
                ". ispfFsiFoam goes on from the latest, if system/controlDict does not say "
                "'startFrom startTime; startTime 0;'. Remove them to start with the new particles");
}

int main(int argc, char** argv)
{
    return runMain([&] {
        argList args("generateParticles",
                     "Fills the geometry of system/particleDict with particles.");
        if (!args.parse(argc, argv)) return 0;
        args.printHeader();
        const word folder = args.caseFolder();

        particleDict dict(folder);
        info() << "Reading the geometry" << std::endl;
        const zoneGeometry geometry = dict.geometry();
        const exterior outside(geometry, dict.wallThickness(), dict.stripWidth());

        info() << "Placing particles" << std::endl;
        const placedParticles placed =
            dict.bodyFitted ? placeBodyFitted(geometry, outside, dict.support)
                            : placeOnLattice(geometry, outside, dict.origin, dict.support);
        const List<zoneOverlap> overlaps = zoneOverlaps(geometry, placed);
        reportPacking(geometry, placed, overlaps, dict.support, dict.bodyFitted);
        dict.checkOverlaps(overlaps);
        writeCase(folder, geometry, placed, dict.initial(), dict.sources, dict.stripLayers);
        warnOfOldTimes(folder);
        info() << "End" << std::endl;
        return 0;
    });
}
