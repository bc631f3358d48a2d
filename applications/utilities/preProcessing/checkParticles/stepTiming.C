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

constexpr scalar longEnough = 60;  // [s] no further step is begun after so long

scalar peakMemory()  // [MB]
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return scalar(usage.ru_maxrss) / 1024;
}

struct stepCost
{
    scalar seconds, cpuSeconds;  // by the clock; of all threads
};

// The solver takes no longer step than this unless it may adjust it
void checkLimit(const Time& time, const couplingScheme::stepLimit& limit, findings& found)
{
    if (!time.adjustTimeStep() && time.deltaT() > limit.dt * (1 + 1e-9))
        found.fail("deltaT " + str(time.deltaT()) + " s is beyond the " + limit.rule +
                   " limit: the largest admissible value now is " + str(limit.dt) + " s");
}

List<stepCost> makeSteps(fsiCase& c, label most, findings& found)
{
    using clock = std::chrono::steady_clock;
    const auto coupling = couplingScheme::New(c);
    checkLimit(c.time, coupling->limit(), found);
    List<stepCost> costs;
    scalar spent = 0;
    while (label(costs.size()) < most && spent < longEnough && c.time.run())
    {
        const auto start = clock::now();
        const scalar cpuStart = c.time.elapsedCpuTime();
        const scalar t0 = c.time.value();
        const label index = c.time.timeIndex();
        c.time.setDeltaT(std::min(c.time.deltaT(), coupling->limit().dt));
        ++c.time;
        if (!coupling->step(t0, c.time.deltaT()))
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

}  // namespace

void timeSteps(fsiCase& c, label most, findings& found)
{
    found.heading("Making steps of coupling " + c.coupling + " to time them...");
    List<stepCost> costs;
    try
    {
        costs = makeSteps(c, most, found);
    }
    catch (const fatalError& error)
    {
        return found.fail(word("The case does not step: ") + error.what());
    }
    if (costs.empty()) return found.note("None: endTime is reached");
    // the first pays for factorisations and starts; the others are what a run is made of
    valueRange usual, cpu;
    for (size_t k = costs.size() > 1; k < costs.size(); ++k)
        usual.add(costs[k].seconds), cpu.add(costs[k].cpuSeconds);
    const scalar left = (c.time.endTime() - c.time.value()) / c.time.deltaT();
    found.note(
        "Time per step " + str(usual.mean(), 3) + " s by the clock, " + str(cpu.mean(), 3) +
        " s CPU of " + std::to_string(nThreads()) + " threads (mean of " + std::to_string(usual.n) +
        ", " + str(usual.least, 3) + " to " + str(usual.most, 3) + " s" +
        (costs.size() > 1 ? "; first step " + str(costs[0].seconds, 3) + " s" : word()) + ")");
    found.note("To endTime " + str(c.time.endTime()) + " s: " + str(std::ceil(left), 9) +
               " more steps of " + str(c.time.deltaT(), 3) + " s at this pace take " +
               str(left * usual.mean() / 60, 3) + " min");
    found.note("Memory " + str(peakMemory(), 4) + " MB (the most this program has used so far)");
}

}  // namespace ispf
