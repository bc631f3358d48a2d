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

constexpr scalar smallestStep = 1e-6;  // of deltaT
constexpr scalar mostCellReynolds = 100;

// The step that the user asks for; with adjustTimeStep at most the limit of the scheme
scalar chooseDeltaT(const Time& time, const couplingScheme::stepLimit& limit)
{
    const dictionary& control = time.controlDict();
    const scalar asked = control.getInRange("deltaT", 1e-30, 1e30, dims::time);
    if (time.adjustTimeStep())
    {
        if (limit.dt < smallestStep * asked)
            throw fatalError("Time " + time.timeName() + " s: the " + limit.rule + " limit is " +
                             str(limit.dt, 3) + " s, less than " + str(smallestStep) +
                             " of deltaT " + str(asked) +
                             " s: either deltaT is far off, or the run has become unstable; then "
                             "start from an earlier time with a smaller maxDeltaT, or refine. The "
                             "times written so far are intact");
        return std::min(limit.dt, control.getOrDefault<scalar>("maxDeltaT", asked, dims::time));
    }
    if (asked > limit.dt * (1 + 1e-9))
        control.fail("deltaT", "deltaT " + str(asked) + " s is beyond the " + limit.rule +
                                   " limit: the largest admissible value now is " + str(limit.dt) +
                                   " s. Lower deltaT or set adjustTimeStep yes");
    return asked;
}

// True for a large U dx/nu: viscosity then does not resolve structures of a few dx.  No energy is gained, doc/theory 8
bool isUnresolved(const fsiCase& c)
{
    if (c.cloud.nSolid() == c.cloud.n()) return false;
    const scalar Re = c.rho * c.cloud.maxSpeed() * c.cloud.dx / c.mu;
    if (!(Re > mostCellReynolds)) return false;
    warning("time " + c.time.timeName() + " s: cell Reynolds number U dx/nu is " + str(Re, 3) +
            ", above " + str(mostCellReynolds) +
            ": viscosity does not damp eddies of a few dx, the stabiliser and the step do (see the "
            "energy ledger). "
            "Refine to resolve them");
    return true;
}

// Takes a step from the present time, shorter if the scheme asks for it.  Returns the rule that has limited its length
word advance(Time& time, couplingScheme& coupling)
{
    const couplingScheme::stepLimit limit = coupling.limit();
    const scalar t0 = time.value();
    const label index = time.timeIndex();
    word rule = limit.rule + " limit" + (limit.dt < 1e29 ? " " + str(limit.dt, 3) + " s" : "");
    for (scalar dt = chooseDeltaT(time, limit);; dt = 0.5 * time.deltaT())
    {
        time.setDeltaT(dt);
        ++time;
        info() << "Step size: " << rule << "\ndeltaT = " << str(time.deltaT())
               << "\nTime = " << time.timeName() << "\n\n";
        if (coupling.step(t0, time.deltaT())) return rule;
        time.rewind(t0, index);
        rule = "half of one that was refused";
    }
}

void timeLoop(Time& time, fsiCase& c, couplingScheme& coupling, volumeLedger& ledger,
              functionObjectList& functions)
{
    progress bar(time);
    bool unresolved = false;  // the warning is printed once
    functions.start();
    while (time.run())
    {
        unresolved = unresolved || isUnresolved(c);
        const word rule = advance(time, coupling);
        ledger.update(time.deltaT());
        ledger.writeLine();
        coupling.writeEnergy();
        c.walls->printBalance(c.cloud);
        functions.execute();
        if (time.writeTime()) time.stages.in("writing", [&] { c.write(); });

        info() << "ExecutionTime = " << str(time.elapsedCpuTime(), 4)
               << " s  ClockTime = " << str(time.elapsedClockTime(), 4) << " s\n\n";
        bar.update(rule);
        time.rereadIfModified();
    }
    functions.end();
}

int run(const argList& args)
{
    Time::stopOnSignals();
    args.printHeader();
    info() << "Create time\n\n";
    Time time(args.caseFolder());
    fsiCase c(time);
    auto coupling = couplingScheme::New(c);
    volumeLedger ledger(c);
    c.report();
    functionObjectList functions(c);

    info() << time.remarkOnSteps() << "\nStarting time loop\n\n";
    time.stages.in("rest of the steps", [&] { timeLoop(time, c, *coupling, ledger, functions); });
    constexpr scalar longRun = 60;  // [s]: the triad then takes little of it
    coupling.reset();               // the triad gets the memory
    info() << time.stages.table(time.stages.seconds() > longRun ? triadRate() : 0) << "\n";
    info() << "End\n";
    return time.exitStatus();
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
