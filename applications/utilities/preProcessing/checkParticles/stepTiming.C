// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.H"

#include "couplingScheme.H"
#include <chrono>
#include <cmath>
#include <sys/resource.h>

namespace ispf
{

namespace
{

constexpr scalar longEnough = 20;  // [s] no further step begins after this time
constexpr label fewest = 3;        // steps, however long they take

scalar peakMemory()  // [MB]
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return scalar(usage.ru_maxrss) / 1024;
}

constexpr int nLooks = 200;  // times at which the limits of a run are evaluated

struct stepCost
{
    scalar seconds, cpuSeconds;  // by the clock; of all threads
};

// Without adjustTimeStep the solver refuses a step longer than the limit
void checkLimit(const Time& time, const couplingScheme::stepLimit& limit, findings& found)
{
    if (!time.adjustTimeStep() && time.deltaT() > limit.dt * (1 + 1e-9))
        found.fail("deltaT " + str(time.deltaT()) + " s is beyond the " + limit.rule +
                   " limit: the largest admissible value now is " + str(limit.dt) + " s");
}

List<stepCost> makeSteps(fsiCase& c, couplingScheme& coupling, label most, findings& found)
{
    using clock = std::chrono::steady_clock;
    checkLimit(c.time, coupling.limit(), found);
    List<stepCost> costs;
    scalar spent = 0;
    while (label(costs.size()) < most && (spent < longEnough || label(costs.size()) < fewest) &&
           c.time.run())
    {
        const auto start = clock::now();
        const scalar cpuStart = c.time.elapsedCpuTime();
        const scalar t0 = c.time.value();
        const label index = c.time.timeIndex();
        c.time.setDeltaT(std::min(c.time.deltaT(), coupling.limit().dt));
        ++c.time;
        if (!coupling.step(t0, c.time.deltaT()))
        {
            c.time.rewind(t0, index);
            c.time.setDeltaT(0.5 * c.time.deltaT());
            continue;
        }
        costs.push_back({std::chrono::duration<scalar>(clock::now() - start).count(),
                         c.time.elapsedCpuTime() - cpuStart});
        spent += costs.back().seconds;
    }
    return costs;
}

// The steps that a run will take from here
struct outlook
{
    scalar steps = 0, mean = 0, least = 0;
    word rule;  // of the least
};

// Walls and faces give the coming speed of the fluid; the peak of a profile over its mean is not included
outlook lookAhead(const fsiCase& c, const couplingScheme& coupling)
{
    const Time& time = c.time;
    const dictionary& control = time.controlDict();
    const scalar asked = control.get<scalar>("deltaT", dims::time);
    const scalar longest = control.getOrDefault<scalar>("maxDeltaT", asked, dims::time);
    const scalar left = time.endTime() - time.value();
    outlook ahead{0, asked, std::min(asked, longest), "deltaT"};
    for (int k = 0; k < nLooks; ++k)
    {
        scalar dt = std::min(asked, longest);
        if (time.adjustTimeStep())
        {
            const auto limit = coupling.limitAt(time.value() + k * left / nLooks);
            dt = std::min(limit.dt, longest);
            if (dt < ahead.least) ahead.least = dt, ahead.rule = "the " + limit.rule + " limit";
        }
        ahead.steps += left / (nLooks * dt);
    }
    ahead.mean = ahead.steps > 0 ? left / ahead.steps : asked;
    return ahead;
}

}  // namespace

void timeSteps(fsiCase& c, label most, findings& found)
{
    found.heading("Making steps of coupling " + c.coupling + " to time them...");
    List<stepCost> costs;
    outlook ahead;
    try
    {
        const auto coupling = couplingScheme::New(c);
        costs = makeSteps(c, *coupling, most, found);
        ahead = lookAhead(c, *coupling);
    }
    catch (const fatalError& error)
    {
        return found.fail(word("The case does not step: ") + error.what());
    }
    if (costs.empty()) return found.note("None: endTime is reached");
    // the first steps pay for factorisations and starts; the later ones are typical of a run
    valueRange usual, cpu;
    for (size_t k = costs.size() / 2; k < costs.size(); ++k)
        usual.add(costs[k].seconds), cpu.add(costs[k].cpuSeconds);
    found.note(
        "Time per step " + str(usual.mean(), 3) + " s by the clock, " + str(cpu.mean(), 3) +
        " s CPU of " + std::to_string(nThreads()) + " threads (mean of " + std::to_string(usual.n) +
        ", " + str(usual.least, 3) + " to " + str(usual.most, 3) + " s" +
        (costs.size() > 1 ? "; first step " + str(costs[0].seconds, 3) + " s" : word()) + ")");
    scalar spent = 0;
    for (const stepCost& s : costs) spent += s.seconds;
    found.note("To endTime " + str(c.time.endTime()) + " s: about " +
               str(scalar(costs.size()) + ahead.steps, 3) + " steps of " + str(ahead.mean, 3) +
               " s, the shortest " + str(ahead.least, 3) + " s by " + ahead.rule + ", take " +
               str((spent + ahead.steps * usual.mean()) / 60, 3) + " min without function objects");
    found.note("Memory " + str(peakMemory(), 4) + " MB (the most this program has used so far)");
}

}  // namespace ispf
