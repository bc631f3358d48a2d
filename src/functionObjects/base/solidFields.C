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
    const particleCloud& cloud = case_.cloud;
    time_ = case_.time.value();
    case_.structure->fromRest(cloud.x, F_);
    case_.structure->stress(cloud.x, sigma_);
    case_.structure->addViscousStress(cloud.x, cloud.Up, sigma_);
    forEach(0, cloud.nSolid(), [&](label i) {
        sigma_[i] = sigma_[i] / F_[i].determinant() - cloud.Up[i][3] * tensor::Identity();
    });
    return *this;
}

}  // namespace ispf
