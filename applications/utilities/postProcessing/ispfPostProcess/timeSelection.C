// SPDX-License-Identifier: GPL-3.0-or-later
#include "timeSelection.H"

#include "token.H"
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace ispf
{

namespace
{

constexpr scalar sameTime = 1e-6;  // relative

scalar numberOf(const word& text, const word& ranges, scalar absent)
{
    scalar value = absent;
    if (!text.empty() && !readNumber(text, value))
        throw fatalError("Option '-time': '" + ranges +
                         "' is not a list of times and ranges such as '0,0.5:1,2:'.");
    return value;
}

const Time::folderOfTime& nearest(const List<Time::folderOfTime>& times, scalar t)
{
    return *std::min_element(times.begin(), times.end(), [t](const auto& a, const auto& b) {
        return std::abs(a.t - t) < std::abs(b.t - t);
    });
}

}  // namespace

List<Time::folderOfTime> selectTimes(const Time& time, const List<Time::folderOfTime>& times,
                                     const word& ranges)
{
    word blanks = ranges;
    std::replace(blanks.begin(), blanks.end(), ',', ' ');
    std::istringstream in(blanks);
    List<char> chosen(times.size(), 0);
    size_t n = 0;
    for (word range; in >> range; ++n)
    {
        const size_t colon = range.find(':');
        constexpr scalar all = std::numeric_limits<scalar>::max();
        scalar low = numberOf(range.substr(0, colon), ranges, -all), high = low;
        if (colon != word::npos) high = numberOf(range.substr(colon + 1), ranges, all);
        const scalar slack = sameTime * std::max(std::abs(low) < all ? std::abs(low) : 0,
                                                 std::abs(high) < all ? std::abs(high) : 0);
        bool any = false;
        const auto choose = [&](size_t k, scalar t) {
            if (t >= low - slack && t <= high + slack) chosen[k] = any = true;
        };
        for (size_t k = 0; k < times.size(); ++k) choose(k, times[k].t);
        for (size_t k = 0; k < times.size() && !any; ++k) choose(k, time.timeOf(times[k]));
        if (!any && colon == word::npos)
            throw fatalError("No particles were written at time " + range +
                             "; the nearest time is " + nearest(times, low).name + ".");
        if (!any) throw fatalError("No particles were written at times " + range + ".");
    }
    numberOf(n == 0 ? "none" : "", ranges, 0);
    List<Time::folderOfTime> result;
    for (size_t k = 0; k < times.size(); ++k)
        if (chosen[k]) result.push_back(times[k]);
    return result;
}

}  // namespace ispf
