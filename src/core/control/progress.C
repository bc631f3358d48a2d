// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress.H"

#include <algorithm>
#include <unistd.h>
#include <cstdio>

namespace ispf
{

progress::progress(const Time& time) : time_(time), terminal_(isatty(STDERR_FILENO)) {}

progress::~progress()
{
    if (terminal_ && last_ >= 0) std::fprintf(stderr, "\n");
}

void progress::update(const word& remark)
{
    if (!terminal_ || time_.elapsedClockTime() < last_ + 0.5) return;
    last_ = time_.elapsedClockTime();
    const int eta = int(time_.etaSeconds());
    const scalar done = (time_.value() - time_.startTime()) / (time_.endTime() - time_.startTime());
    std::fprintf(stderr,
                 "\r%5.1f %%  step %d  time %s s of %s  dt %s s (%s)  ETA %d:%02d:%02d   \r",
                 100 * std::min(1.0, done), time_.timeIndex(), time_.timeName().c_str(),
                 str(time_.endTime()).c_str(), str(time_.deltaT(), 3).c_str(), remark.c_str(),
                 eta / 3600, eta / 60 % 60, eta % 60);
    std::fflush(stderr);
}

}  // namespace ispf
