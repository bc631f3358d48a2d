// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumeStiffness.H"

namespace ispf
{

tensor volumeStiffness::stress(const tensor& F) const
{
    const scalar J = F.determinant();
    return kappa * (J - 1) * J * F.inverse().transpose();
}

// With T = F^-T: d cof F = J [(T : dF) T - T dF^T T]
modulusMatrix cofactorDerivative(const tensor& F)
{
    const scalar J = F.determinant();
    const tensor T = F.inverse().transpose();
    modulusMatrix C;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            for (int d = 0; d < 3; ++d)
                for (int s = 0; s < 3; ++s)
                    C(r + 3 * c, s + 3 * d) = J * (T(r, c) * T(s, d) - T(r, d) * T(s, c));
    return C;
}

modulusMatrix volumeStiffness::tangent(const tensor& F) const
{
    const tensor cofactor = F.determinant() * F.inverse().transpose();
    const Eigen::Map<const Eigen::Matrix<scalar, 9, 1>> column(cofactor.data());
    return kappa * (column * column.transpose() + (F.determinant() - 1) * cofactorDerivative(F));
}

}  // namespace ispf
