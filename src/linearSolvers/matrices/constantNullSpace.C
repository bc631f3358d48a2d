// SPDX-License-Identifier: GPL-3.0-or-later
#include "constantNullSpace.H"

#include "disjointSets.H"
#include <numeric>

namespace ispf
{

label floatingSets(const csrMatrix& A, const List<scalar>& excess, const List<scalar>& weight,
                   List<label>& set)
{
    List<label> parent(A.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (label i = 0; i < A.size(); ++i)
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
            if (A.value[k] != 0) join(parent, i, A.column[k]);

    List<scalar> setExcess(A.size(), 0), setWeight(A.size(), 0);
    set.assign(A.size(), -1);
    for (label i = 0; i < A.size(); ++i)
    {
        const label root = representative(parent, i);
        setExcess[root] += excess[i];
        setWeight[root] += weight[i];
    }
    label nSets = 0;
    for (label i = 0; i < A.size(); ++i)
    {
        const label root = representative(parent, i);
        if (!isFloating(setExcess[root], setWeight[root])) continue;
        set[i] = root == i ? nSets++ : set[root];
    }
    return nSets;
}

constantNullSpace::constantNullSpace(List<label> set, label nSets)
    : set_(std::move(set)), nSets_(nSets), count_(nSets, 0)
{
    if (nSets_ == 0) set_.clear();
    for (const label s : set_)
        if (s >= 0) ++count_[s];
}

constantNullSpace constantNullSpace::of(const csrMatrix& A)
{
    List<scalar> excess(A.diagonal), weight(A.diagonal);
    for (label i = 0; i < A.size(); ++i)
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k) excess[i] += A.value[k];
    List<label> set;
    const label nSets = floatingSets(A, excess, weight, set);
    return {std::move(set), nSets};
}

List<label> constantNullSpace::firstRows() const
{
    List<label> first(nSets_, -1);
    for (label i = label(set_.size()) - 1; i >= 0; --i)
        if (set_[i] >= 0) first[set_[i]] = i;
    return first;
}

void constantNullSpace::project(List<scalar>& v) const
{
    if (empty()) return;
    List<scalar> mean(nSets_, 0);
    for (size_t i = 0; i < set_.size(); ++i)
        if (set_[i] >= 0) mean[set_[i]] += v[i];
    for (label s = 0; s < nSets_; ++s) mean[s] /= count_[s];
    for (size_t i = 0; i < set_.size(); ++i)
        if (set_[i] >= 0) v[i] -= mean[set_[i]];
}

}  // namespace ispf
