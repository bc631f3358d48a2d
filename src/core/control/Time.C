// SPDX-License-Identifier: GPL-3.0-or-later
#include "Time.H"

#include "fileNames.H"
#include "token.H"
#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <limits>

namespace ispf
{

namespace
{

volatile std::sig_atomic_t stopSignal = 0;

constexpr scalar never = std::numeric_limits<scalar>::infinity();

// t rounded to 15 digits, if that is within the tolerance
scalar inFewDigits(scalar t, scalar tolerance)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", t);
    const scalar rounded = std::strtod(text, nullptr);
    return std::abs(rounded - t) <= tolerance ? rounded : t;
}

}  // namespace

Time::Time(const word& caseFolder, bool postProcessing)
    : case_(caseFolder), postProcessing_(postProcessing), start_(std::chrono::steady_clock::now())
{
    control_ = dictionary::fromFile(controlFile());
    controlStamp_ = modificationStamp(controlFile());
    readControls(control_);
}

Time Time::postProcess(const word& caseFolder)
{
    return Time(caseFolder, true);
}

Time::Time(const word& caseFolder) : Time(caseFolder, false)
{
    startTime_ = value_ = previous_ = chosenStart();
    readState();
    if (run()) return;
    if (endTime_ > value_ + slack() && index_ == 0)
        control_.fail("deltaT",
                      "deltaT " + str(steadyDeltaT()) +
                          " s is twice as long as the run or longer, from " + str(value_) +
                          " to endTime " + str(endTime_) +
                          " s: not one step ends near there. Lower deltaT or raise endTime");
    warning("endTime " + str(endTime_) +
            (endTime_ > value_ + slack() ? " is less than half a step" : " is not") +
            " after the start " + str(value_) +
            ": there is nothing to run. Raise endTime, or let startFrom choose an earlier start");
}

void Time::goTo(scalar t)
{
    const scalar start = startTime_;
    stateFolder_.clear();
    startTime_ = value_ = previous_ = t, deltaTBehind_ = 0;
    precision_ = askedPrecision(control_), grownPrecision_ = 0;  // each folder has its own
    writeNow_ = answer::unknown;
    readState();
    if (started_) startTime_ = start;
    started_ = true;
}

// Bound of the clock's rounding errors, far below any step
scalar Time::slack() const
{
    return 1e-9 * deltaT_ + 2e-15 * std::abs(value_);
}

bool Time::keepsDeltaT() const
{
    return !adjust_ && writeControl_ != "adjustableRunTime" && hitIntervals_.empty() &&
           writeTimes_.empty();
}

bool Time::endIsAhead() const
{
    return reach() < endTime_;
}

bool Time::run() const
{
    if (stopAfterThis_ || (stop_ && !stopWrites_)) return false;
    return endIsAhead();
}

scalar Time::nextTarget() const
{
    const scalar now = value_ + slack();
    scalar target = never;
    const auto multiple = [&](scalar interval) {
        const scalar next = interval * (std::floor(now / interval) + 1);
        target = std::min(target,
                          inFewDigits(next, slack()));  // 3 times 0.1 becomes 0.3, like an endTime
    };
    if (writeControl_ == "adjustableRunTime") multiple(writeInterval_);
    for (const scalar interval : hitIntervals_) multiple(interval);
    const auto next = std::upper_bound(writeTimes_.begin(), writeTimes_.end(), now);
    if (next != writeTimes_.end()) target = std::min(target, *next);
    // only the last two steps depend on endTime
    const bool endsSoon = !keepsDeltaT() && endTime_ > now && endTime_ - value_ < 2 * deltaT_;
    return endsSoon && endTime_ + slack() < target ? endTime_ : target;
}

// Length of equal steps to the next instant: none is shorter than half of dt
scalar Time::nextStep(scalar dt) const
{
    const scalar remaining = nextTarget() - value_;
    if (!std::isfinite(remaining)) return dt;
    return remaining / std::max(1.0, std::ceil(remaining / dt * (1 - 1e-9)));
}

void Time::setDeltaT(scalar dt)
{
    if (!(dt > 0))
        throw fatalError("The time step is " + str(dt) + " s at time " + timeName() +
                         "; it must be positive.");
    deltaT_ = std::min(dt, maxDeltaT_);
    deltaT_ = nextStep(deltaT_);
}

word Time::remarkOnSteps() const
{
    if (adjust_ || !run()) return "";
    const scalar dt = steadyDeltaT(), step = nextStep(dt);
    if (step < dt * (1 - 1e-6))
        return "deltaT " + str(dt) + " s is shortened to " + str(step) +
               " s: equal steps lead to the instant " + str(nextTarget()) + " s\n";
    const scalar end = value_ + dt * std::ceil((endTime_ - value_ - slack()) / dt - 0.5);
    if (!keepsDeltaT() || !std::isfinite(end) || std::abs(end - endTime_) < 1e-6 * dt) return "";
    return "endTime " + str(endTime_) + " s lies between two steps of deltaT " + str(dt) +
           " s: the run ends at " + str(end) + " s" +
           (end > endTime_ ? ", and tables over time are asked up to there" : "") + "\n";
}

Time& Time::operator++()
{
    const scalar target = nextTarget();
    stateFolder_.clear();
    previous_ = value_;
    value_ += deltaT_, deltaTBehind_ = deltaT_;
    // end exactly at the instant; without one, ten steps of 0.1 must make 1
    if (std::abs(value_ - target) < slack()) value_ = target;
    else if (target == never) value_ = inFewDigits(value_, 1e-6 * deltaT_);
    ++index_;
    growPrecision(deltaT_ / 10);
    writeNow_ = answer::unknown;
    return *this;
}

void Time::rewind(scalar value, label index)
{
    stateFolder_.clear();
    value_ = previous_ = value;
    index_ = index;
    writeNow_ = answer::unknown;
    stopAfterThis_ = false, stoppedBy_ = 0;
}

// Increases the digits until the folder's name reads as its time within the tolerance (OpenFOAM: a tenth of the step).
// Then no other folder has this name, and no later folder seems to be earlier
void Time::growPrecision(scalar tolerance)
{
    const int before = precision_;
    const word name = timeName();
    const auto isOff = [&] {
        scalar named = 0;
        return !readNumber(timeName(), named) || std::abs(named - value_) > tolerance;
    };
    while (precision_ < 17 && isOff()) ++precision_;
    if (precision_ == before) return;
    grownPrecision_ = precision_;
    if (!postProcessing_)
        warning("timePrecision raised from " + std::to_string(before) + " to " +
                std::to_string(precision_) + ": the time is " + timeName() + ", not " + name + ".");
}

scalar Time::reach() const
{
    return value_ + slack() + (keepsDeltaT() ? steadyDeltaT() / 2 : 0);
}

bool Time::passesWriteInstant() const
{
    const auto inStep = [&](scalar t) { return t > previous_ + slack() && t <= value_ + slack(); };
    if (std::any_of(writeTimes_.begin(), writeTimes_.end(), inStep)) return true;
    if (writeControl_ == "none") return false;
    if (writeControl_ == "timeStep") return index_ % label(writeInterval_) == 0;
    if (writeControl_ == "clockTime" || writeControl_ == "cpuTime")
        return clockStamp() > lastStamp_;
    const bool isHit = writeControl_ == "adjustableRunTime";
    const scalar now = isHit ? value_ + slack() : reach(), step = value_ - previous_;
    return std::floor(now / writeInterval_) > std::floor((now - step) / writeInterval_);
}

label Time::clockStamp() const
{
    const scalar elapsed = writeControl_ == "cpuTime" ? elapsedCpuTime() : elapsedClockTime();
    return label(elapsed / writeInterval_);
}

// Decided at the first call in a step, so that everybody gets the same answer, even if a signal
// or a tick of the clock comes in between
bool Time::writeTime() const
{
    if (writeNow_ == answer::unknown)
    {
        const bool instant = passesWriteInstant();
        const int signal = stopSignal;
        if (signal != 0 && endIsAhead())
        {
            stoppedBy_ = signal;
            warning(word(signal == SIGINT ? "SIGINT" : "SIGTERM") +
                    " asks to stop: the state of time " + timeName() + " is written, endTime " +
                    str(endTime_) + " is not reached");
        }
        stopAfterThis_ = signal != 0 || stop_ || stopAt_ == "writeNow" || stopAt_ == "noWriteNow" ||
                         (stopAt_ == "nextWrite" && instant);
        const bool stopWrites = signal != 0 || (stop_ && stopWrites_) || stopAt_ == "writeNow";
        writeNow_ = instant || stopWrites ? answer::yes : answer::no;
    }
    return writeNow_ == answer::yes;
}

List<word> Time::toPurge()
{
    lastStamp_ = writeControl_ == "clockTime" || writeControl_ == "cpuTime" ? clockStamp() : 0;
    written_.push_back(timeName());
    List<word> old;
    while (purge_ > 0 && label(written_.size()) > purge_)
    {
        old.push_back(written_.front());
        written_.erase(written_.begin());
    }
    return old;
}

void Time::requestStop(bool write)
{
    stop_ = true;
    stopWrites_ = stopWrites_ || write;
}

void Time::alsoHit(const List<scalar>& intervals)
{
    hitIntervals_ = intervals;
}

void Time::stopOnSignals()
{
    struct sigaction action = {};
    action.sa_handler = [](int signal) { stopSignal = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    ::sigaction(SIGTERM, &action, nullptr);
    ::sigaction(SIGINT, &action, nullptr);
    // a log without a reader, or a file that may not grow, is an error of writing
    for (const int s : {SIGPIPE, SIGXFSZ}) std::signal(s, SIG_IGN);
}

scalar Time::elapsedCpuTime() const
{
    return scalar(std::clock()) / CLOCKS_PER_SEC;
}

scalar Time::elapsedClockTime() const
{
    return std::chrono::duration<scalar>(std::chrono::steady_clock::now() - start_).count();
}

scalar Time::etaSeconds() const
{
    const scalar done = value_ - startTime_;
    return done > 0 ? elapsedClockTime() * std::max(0.0, endTime_ - value_) / done : 0;
}

}  // namespace ispf
