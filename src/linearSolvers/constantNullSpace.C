// SPDX-License-Identifier: GPL-3.0-or-later
#include "constantNullSpace.H"

#include <numeric>

namespace ispf
{

namespace
{

label findRoot(List<label>& parent, label i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

}  // namespace

template <class Real>
label floatingSets(const rowGraph<Real>& graph, const List<Real>& excess, const List<Real>& weight,
                   List<label>& set)
{
    List<label> parent(graph.n);
    std::iota(parent.begin(), parent.end(), 0);
    for (label i = 0; i < graph.n; ++i)
        for (label k = graph.rowStart[i]; k < graph.rowStart[i + 1]; ++k)
            if (graph.value[k] != 0)
            {
                const label a = findRoot(parent, i), b = findRoot(parent, graph.column[k]);
                if (a != b) parent[std::max(a, b)] = std::min(a, b);
            }

    List<scalar> setExcess(graph.n, 0), setWeight(graph.n, 0);
    set.assign(graph.n, -1);
    for (label i = 0; i < graph.n; ++i)
    {
        const label root = findRoot(parent, i);
        setExcess[root] += excess[i];
        setWeight[root] += weight[i];
    }
    label nSets = 0;
    for (label i = 0; i < graph.n; ++i)
    {
        const label root = findRoot(parent, i);
        if (!isFloating(setExcess[root], setWeight[root])) continue;
        set[i] = root == i ? nSets++ : set[root];
    }
    return nSets;
}

template label floatingSets(const rowGraph<float>&, const List<float>&, const List<float>&,
                            List<label>&);
template label floatingSets(const rowGraph<scalar>&, const List<scalar>&, const List<scalar>&,
                            List<label>&);

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
    const rowGraph<scalar> graph{A.size(), A.rowStart.data(), A.column.data(), A.value.data()};
    const label nSets = floatingSets(graph, excess, weight, set);
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
