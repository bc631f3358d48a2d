// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1Table.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

const List<word>& outOfBoundsWords()
{
    static const List<word> words = {"error", "warn", "clamp", "repeat"};
    return words;
}

template <class T>
Function1Table<T>::Function1Table(const List<row>& rows, const word& outOfBounds,
                                  const fileLocation& where)
    : outOfBounds_(outOfBounds), where_(where)
{
    if (rows.empty()) throw fatalError("The table has no rows.", where);
    for (const row& r : rows)
    {
        if (!t_.empty() && !(r.t > t_.back()))
            throw fatalError("The times of a table must increase, but " + str(r.t, 10) +
                                 " follows " + str(t_.back(), 10) + ".",
                             r.where);
        t_.push_back(r.t);
        v_.push_back(r.value);
    }
}

template <class T>
T Function1Table<T>::inside(scalar t) const
{
    const size_t k = size_t(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin());
    if (k == 0) return v_.front();
    if (k == t_.size()) return v_.back();
    const scalar w = (t - t_[k - 1]) / (t_[k] - t_[k - 1]);
    return (1 - w) * v_[k - 1] + w * v_[k];
}

template <class T>
T Function1Table<T>::value(scalar t) const
{
    if ((t >= t_.front() && t <= t_.back()) || outOfBounds_ == "clamp") return inside(t);
    if (outOfBounds_ == "repeat")
    {
        const scalar period = t_.back() - t_.front();
        return period > 0 ? inside(t - period * std::floor((t - t_.front()) / period)) : v_.front();
    }
    // the end of the last step differs from endTime by rounding
    const scalar rounding = 1e-9 * std::max(std::abs(t_.front()), std::abs(t_.back()));
    if (t >= t_.front() - rounding && t <= t_.back() + rounding) return inside(t);
    const word range = str(t_.front(), 10) + " to " + str(t_.back(), 10);
    if (outOfBounds_ == "error")
        throw fatalError("Time " + str(t, 10) + " lies outside the table, which spans " + range +
                             ".\nExtend it, or set outOfBounds to warn, clamp or repeat.",
                         where_);
    warning(where_.file + "." + where_.scope + ": a time outside the table (" + range +
                ") takes the value at its end.",
            1);
    return inside(t);
}

template class Function1Table<scalar>;
template class Function1Table<vector>;

}  // namespace ispf
