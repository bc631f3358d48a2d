// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidFields.H"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace ispf
{

vector stretchesOf(const tensor& F)
{
    const Eigen::SelfAdjointEigenSolver<tensor> e(F.transpose() * F, Eigen::EigenvaluesOnly);
    return e.eigenvalues().cwiseMax(0).cwiseSqrt().reverse();
}

scalar vonMisesOf(const tensor& sigma)
{
    const tensor s = sigma - sigma.trace() / 3 * tensor::Identity();
    return std::sqrt(1.5 * s.squaredNorm());
}

solidFields& solidFields::now()
{
    if (time_ == case_.time.value()) return *this;
    if (!recovery_ || !recovery_->isCurrent()) recovery_ = std::make_unique<solidRecovery>(case_);
    time_ = case_.time.value();
    recovery_->evaluate(F_, sigma_);
    return *this;
}

}  // namespace ispf
