// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellList.H"

#include "execution.H"

namespace ispf
{

namespace
{

ISPF_HOT label closeInRun(const scalar* x, const scalar* y, const scalar* z, label n,
                          const scalar* at, scalar limit, label first, label* hit, scalar* distSqr)
{
    for (label k = 0; k < n; ++k)
    {
        const scalar a = x[k] - at[0], b = y[k] - at[1], c = z[k] - at[2];
        distSqr[k] = a * a + b * b + c * c;
    }
    label found = 0;
    for (label k = 0; k < n; ++k)
    {
        hit[found] = first + k, distSqr[found] = distSqr[k];
        found += distSqr[k] <= limit;
    }
    return found;
}

}  // namespace

cellList::cellList(const List<vector>& points, scalar width) : width_(width), perWidth_(1 / width)
{
    boundBox box;
    for (const vector& p : points) box.add(p);
    if (points.empty()) box.add(vector::Zero());
    low_ = box.min;
    for (int k = 0; k < 3; ++k) n_[k] = label((box.max[k] - low_[k]) * perWidth_) + 1;
    start_.assign(size_t(n_[0]) * n_[1] * n_[2] + 1, 0);
    List<size_t> cell(points.size());
    for (size_t i = 0; i < points.size(); ++i)
    {
        cell[i] = cellOf(points[i]);
        ++start_[cell[i] + 1];
    }
    for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    index_.resize(points.size());
    for (List<scalar>& s : sorted_) s.resize(points.size());
    List<label> next(start_.begin(), start_.end() - 1);
    for (size_t i = 0; i < points.size(); ++i)
    {
        const label k = next[cell[i]]++;
        index_[k] = label(i);
        for (int d = 0; d < 3; ++d) sorted_[d][k] = points[i][d];
    }
}

size_t cellList::cellOf(const vector& x) const
{
    label c[3];
    for (int k = 0; k < 3; ++k)
        c[k] = std::clamp(label((x[k] - low_[k]) * perWidth_), label(0), n_[k] - 1);
    return (size_t(c[2]) * n_[1] + c[1]) * n_[0] + c[0];
}

label cellList::closeOnes(const vector& x, scalar limitSqr, label from, label to, label* hit,
                          scalar* distSqr) const
{
    return closeInRun(&sorted_[0][from], &sorted_[1][from], &sorted_[2][from], to - from, x.data(),
                      limitSqr, from, hit, distSqr);
}

}  // namespace ispf
