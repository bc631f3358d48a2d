// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumeConstraint.H"
#include "parallel.H"

namespace ispf
{

void volumeConstraint::setup(const List<tensor>& F)
{
    cofactor_.resize(F.size());
    parallelFor(
        label(F.size()),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                cofactor_[i] = F[i].determinant() * F[i].inverse().transpose();
        },
        256);
}

void volumeConstraint::rate(const List<vec4>& u, List<scalar>& dJ) const
{
    gradient_.applyLinear(u, work_);
    dJ.resize(work_.size());
    for (size_t i = 0; i < work_.size(); ++i) dJ[i] = cofactor_[i].cwiseProduct(work_[i]).sum();
}

void volumeConstraint::addStress(const List<vec4>& up, List<tensor>& P) const
{
    for (size_t i = 0; i < cofactor_.size(); ++i) P[i] -= up[i][3] * cofactor_[i];
}

}  // namespace ispf
