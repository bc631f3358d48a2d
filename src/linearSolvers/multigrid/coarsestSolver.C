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

void coarsestSolver::solve(const List<float>& b, List<float>& x) const
{
    if (row_.empty()) return;
    Eigen::VectorXd values(row_.size());
    for (size_t k = 0; k < row_.size(); ++k) values[k] = b[row_[k]];
    values = factors_.solve(values);
    for (size_t k = 0; k < row_.size(); ++k) x[row_[k]] = float(values[k]);
}

}  // namespace ispf
