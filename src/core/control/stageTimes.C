// SPDX-License-Identifier: GPL-3.0-or-later
#include "stageTimes.H"

#include <algorithm>
#include <utility>

namespace ispf
{

size_t stageTimes::indexOf(const word& name)
{
    const auto at = std::find_if(stages_.begin(), stages_.end(),
                                 [&](const stage& s) { return s.name == name; });
    if (at != stages_.end()) return size_t(at - stages_.begin());
    stages_.push_back({name});
    return stages_.size() - 1;
}

size_t stageTimes::enter(size_t next)
{
    const clock::time_point t = clock::now();
    const workCount& work = workDone();
    stage& ends = stages_[now_];
    ends.seconds += std::chrono::duration<scalar>(t - since_).count();
    ends.work.pairs += work.pairs - workBefore_.pairs;
    ends.work.bytes += work.bytes - workBefore_.bytes;
    ends.work.iterations += work.iterations - workBefore_.iterations;
    since_ = t, workBefore_ = work;
    return std::exchange(now_, next);
}

scalar stageTimes::seconds()
{
    enter(now_);
    scalar sum = 0;
    for (const stage& s : stages_) sum += s.seconds;
    return sum;
}

word stageTimes::table(scalar triad)
{
    stage whole{"together"};
    whole.seconds = seconds();
    for (const stage& s : stages_)
        whole.work.pairs += s.work.pairs, whole.work.bytes += s.work.bytes,
            whole.work.iterations += s.work.iterations;
    const auto cell = [](scalar value, const char* format) {
        char text[32] = "-";
        if (value > 0) std::snprintf(text, sizeof text, format, value);
        return word(text);
    };
    const auto line = [&](const stage& s) {
        const scalar rate = s.seconds > 0 ? s.work.bytes / s.seconds : 0;
        char text[160];
        std::snprintf(
            text, sizeof text, "    %-32s %10.2f s %6.1f %% %10s %10s %8s %8s\n", s.name.c_str(),
            s.seconds, whole.seconds > 0 ? 100 * s.seconds / whole.seconds : 0,
            cell(1e-6 * s.work.pairs, "%.4g").c_str(), cell(s.work.iterations, "%.0f").c_str(),
            cell(1e-9 * rate, "%.2f").c_str(), cell(triad > 0 ? rate / triad : 0, "%.2f").c_str());
        return word(text);
    };
    char head[160];
    std::snprintf(head, sizeof head, "%-36s %12s %8s %10s %10s %8s %8s\n", "Stages of the run",
                  "clock", "share", "1e6 pairs", "iterations", "GB/s", "of triad");
    word text = head;
    for (const stage& s : stages_) text += line(s);
    text += line(whole);
    if (triad > 0)
        text += "STREAM triad, " + std::to_string(nThreads()) +
                " threads: " + cell(1e-9 * triad, "%.1f") + " GB/s\n";
    return text;
}

}  // namespace ispf
