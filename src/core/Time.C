// SPDX-License-Identifier: GPL-3.0-or-later
#include "Time.H"

#include "fileNames.H"
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
    if (!run())
        warning(
            "endTime " + str(endTime_) + " is not after the start " + str(value_) +
            ": there is nothing to run. Raise endTime, or let startFrom choose an earlier start");
}

void Time::goTo(scalar t)
{
    const scalar start = startTime_;
    startTime_ = value_ = previous_ = t;
    writeNow_ = answer::unknown;
    readState();
    if (started_) startTime_ = start;
    started_ = true;
}

// Rounding errors of the clock, far below any step
scalar Time::slack() const
{
    return 1e-9 * deltaT_ + 2e-15 * std::abs(value_);
}

bool Time::run() const
{
    if (stopAfterThis_ || (stop_ && !stopWrites_)) return false;
    return value_ + slack() < endTime_;
}

scalar Time::nextTarget() const
{
    const scalar now = value_ + slack();
    scalar target = endTime_ > now ? endTime_ : never;
    const auto multiple = [&](scalar interval) {
        target = std::min(target, interval * (std::floor(now / interval) + 1));
    };
    if (writeControl_ == "adjustableRunTime") multiple(writeInterval_);
    for (const scalar interval : hitIntervals_) multiple(interval);
    const auto next = std::upper_bound(writeTimes_.begin(), writeTimes_.end(), now);
    return next == writeTimes_.end() ? target : std::min(target, *next);
}

void Time::setDeltaT(scalar dt)
{
    if (!(dt > 0))
        throw fatalError("The time step is " + str(dt) + " s at time " + timeName() +
                         "; it must be positive.");
    deltaT_ = std::min(dt, maxDeltaT_);
    const scalar remaining = nextTarget() - value_;
    // Equal steps up to the next instant: none is shorter than half of what was asked for
    if (std::isfinite(remaining))
        deltaT_ = remaining / std::max(1.0, std::ceil(remaining / deltaT_ * (1 - 1e-9)));
}

Time& Time::operator++()
{
    if (modifiable_) rereadIfModified();
    const scalar target = nextTarget();
    previous_ = value_;
    value_ += deltaT_;
    // Land on the instant itself, not beside it by rounding
    if (std::abs(value_ - target) < slack()) value_ = target;
    ++index_;
    growPrecision();
    writeNow_ = answer::unknown;
    return *this;
}

void Time::rewind(scalar value, label index)
{
    value_ = previous_ = value;
    index_ = index;
    writeNow_ = answer::unknown;
    stopAfterThis_ = false, stoppedBy_ = 0;
}

// Two different instants must not share a folder name
void Time::growPrecision()
{
    if (value_ == previous_) return;
    const int before = precision_;
    while (precision_ < 17 && timeName(value_) == timeName(previous_)) ++precision_;
    if (precision_ == before) return;
    grownPrecision_ = precision_;
    warning("timePrecision raised from " + std::to_string(before) + " to " +
            std::to_string(precision_) + " to tell the times " + timeName(previous_) + " and " +
            timeName(value_) + " apart.");
}

bool Time::passesWriteInstant() const
{
    const auto inStep = [&](scalar t) { return t > previous_ + slack() && t <= value_ + slack(); };
    if (std::any_of(writeTimes_.begin(), writeTimes_.end(), inStep)) return true;
    if (writeControl_ == "none") return false;
    if (writeControl_ == "timeStep") return index_ % label(writeInterval_) == 0;
    if (writeControl_ == "clockTime" || writeControl_ == "cpuTime")
        return clockStamp() > lastStamp_;
    return std::floor((value_ + slack()) / writeInterval_) >
           std::floor((previous_ + slack()) / writeInterval_);
}

label Time::clockStamp() const
{
    const scalar elapsed = writeControl_ == "cpuTime" ? elapsedCpuTime() : elapsedClockTime();
    return label(elapsed / writeInterval_);
}

// Decided at the first question in a step, so that everybody gets the same answer even if a signal
// or a tick of the clock comes in between
bool Time::writeTime() const
{
    if (writeNow_ == answer::unknown)
    {
        const bool instant = passesWriteInstant();
        const int signal = stopSignal;
        if (signal != 0 && value_ + slack() < endTime_)
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
    // a log that nobody reads any more, or a file that may not grow, is an error of writing
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
