// SPDX-License-Identifier: GPL-3.0-or-later
// Checks whether the particles of a case are fit for a run: counts, spacing, neighbours, kernel sums, layers and
// links of solids, memory and time per step.  Status 1 if a check fails; warnings do not count.
#include "argList.H"
#include "checks.H"
#include "cloudIO.H"

#include <cmath>

using namespace ispf;

namespace
{

// Refuses entries that nobody reads; those of function objects are left to the solver
void checkControls(const dictionary& control)
{
    if (const dictionary* functions = control.findDict("functions")) functions->markAllRead();
    control.checkAllRead();
}

int run(const argList& args)
{
    args.printHeader();
    info() << "Create time\n";
    const double steps = args.numberOr("steps", 21);
    if (steps < 0 || steps > 1e6 || steps != std::floor(steps))
        throw fatalError("-steps wants a whole number from 0 to 1e6.");
    Time time(args.caseFolder());
    checkControls(time.controlDict());
    if (args.found("time")) time.rewind(args.number("time"), 0);
    findings found;
    {
        particleCloud cloud;
        readCloud(time, cloud);
        checkPositions(cloud, time.value(), found);
    }
    if (found.nFailed() > 0) return found.close();  // the other checks would not be reliable

    fsiCase c(time);
    c.updateNeighbours(time.value(), time.value() + time.deltaT());
    printZones(c, found);
    checkSides(c, found);
    checkSpacing(c, found);
    checkNeighbours(c, found);
    checkKernelSums(c, found);
    checkSolids(c, found);
    if (steps > 0) timeSteps(c, label(steps), found);
    return found.close();
}

}  // namespace

int main(int argc, char** argv)
{
    return runMain([&] {
        argList args("checkParticles", "Reports on the particles of a case and checks them.");
        args.addOption("time", "value", "time to look at (default: where a run would start)");
        args.addOption(
            "steps", "n",
            "steps to make for the prediction of time (default 21, fewer in 20 s; 0: none)");
        return args.parse(argc, argv) ? run(args) : 0;
    });
}
