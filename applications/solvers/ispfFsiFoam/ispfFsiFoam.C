// SPDX-License-Identifier: GPL-3.0-or-later
// Incompressible SPH for fluid and elastic solid in one system.
#include "argList.H"
#include "couplingScheme.H"
#include "functionObjectList.H"
#include "progress.H"
#include "volumeLedger.H"

using namespace ispf;

namespace
{

// The step the user asked for, within what the scheme admits
scalar chooseDeltaT(const Time& time, const couplingScheme::stepLimit& limit)
{
    const dictionary& control = time.controlDict();
    const scalar asked = control.getInRange("deltaT", 1e-30, 1e30);
    if (time.adjustTimeStep())
        return std::min(limit.dt, control.getOrDefault<scalar>("maxDeltaT", asked));
    if (asked > limit.dt * (1 + 1e-9))
        control.fail("deltaT", "deltaT " + str(asked) + " s is beyond the " + limit.rule +
                                   " limit: the largest admissible value now is " + str(limit.dt) +
                                   " s. Lower deltaT or set adjustTimeStep yes");
    return asked;
}

int run(const argList& args)
{
    args.printHeader();
    info() << "Create time\n\n";
    Time time(args.caseFolder());
    Time::stopOnSignals();
    fsiCase c(time);
    const auto coupling = couplingScheme::New(c);
    volumeLedger ledger(c);
    c.report();
    functionObjectList functions(c);
    progress bar(time);

    info() << "\nStarting time loop\n\n";
    functions.start();
    while (time.run())
    {
        const couplingScheme::stepLimit limit = coupling->limit();
        const scalar t0 = time.value();
        time.setDeltaT(chooseDeltaT(time, limit));
        ++time;
        const word rule =
            limit.rule + " limit" + (limit.dt < 1e29 ? " " + str(limit.dt, 3) + " s" : "");
        info() << "Step size: " << rule << "\ndeltaT = " << str(time.deltaT())
               << "\nTime = " << time.timeName() << "\n\n";

        coupling->step(t0, time.deltaT());
        ledger.update(time.deltaT());
        ledger.writeLine();
        functions.execute();
        if (time.writeTime()) c.write();

        info() << "ExecutionTime = " << str(time.elapsedCpuTime(), 4)
               << " s  ClockTime = " << str(time.elapsedClockTime(), 4) << " s\n\n";
        bar.update(rule);
    }
    functions.end();
    info() << "End\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    return runMain([&] {
        argList args("ispfFsiFoam",
                     "Incompressible SPH for fluid and elastic solid in one system.");
        return args.parse(argc, argv) ? run(args) : 0;
    });
}
