// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarsestSolver.H"

namespace ispf
{

coarsestSolver::coarsestSolver(const slicedMatrix& A, const List<label>& pinned)
{
    List<label> number(A.size(), -1);
    for (label i = 0; i < A.size(); ++i)
        if (A.hasEntries(i)) number[i] = label(row_.size()), row_.push_back(i);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(row_.size(), row_.size());
    for (size_t k = 0; k < row_.size(); ++k)
    {
        dense(k, k) = A.diagonal()[row_[k]];
        A.forRow(row_[k], [&](label j, float value) {
            if (number[j] >= 0) dense(k, number[j]) += value;
        });
    }
    // With a compatible right-hand side a doubled diagonal gives zero in the pinned row and changes nothing else
    for (const label i : pinned)
        if (number[i] >= 0) dense(number[i], number[i]) *= 2;
    if (!row_.empty()) factors_.compute(dense);
}

template <class V>
void coarsestSolver::solve(const List<V>& b, List<V>& x) const
{
    if (row_.empty()) return;
    constexpr label lanes = sizeof(V) / sizeof(float);
    const float* right = reinterpret_cast<const float*>(b.data());
    float* left = reinterpret_cast<float*>(x.data());
    Eigen::MatrixXd values(row_.size(), lanes);
    for (size_t k = 0; k < row_.size(); ++k)
        for (label c = 0; c < lanes; ++c) values(k, c) = right[row_[k] * lanes + c];
    values = factors_.solve(values);
    for (size_t k = 0; k < row_.size(); ++k)
        for (label c = 0; c < lanes; ++c) left[row_[k] * lanes + c] = float(values(k, c));
}

template void coarsestSolver::solve(const List<float>&, List<float>&) const;
template void coarsestSolver::solve(const List<float4>&, List<float4>&) const;

}  // namespace ispf
