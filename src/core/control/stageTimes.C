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

size_t stageTimes::enter(size_t stage)
{
    const clock::time_point t = clock::now();
    stages_[now_].seconds += std::chrono::duration<scalar>(t - since_).count();
    since_ = t;
    return std::exchange(now_, stage);
}

word stageTimes::table()
{
    enter(now_);
    scalar whole = 0;
    for (const stage& s : stages_) whole += s.seconds;
    const auto line = [&](const word& name, scalar seconds) {
        char text[128];
        std::snprintf(text, sizeof text, "    %-40s %10.2f s %6.1f %%\n", name.c_str(), seconds,
                      whole > 0 ? 100 * seconds / whole : 0);
        return word(text);
    };
    word text = "Stages of the run, seconds by the clock and share:\n";
    for (const stage& s : stages_) text += line(s.name, s.seconds);
    return text + line("together", whole);
}

}  // namespace ispf
