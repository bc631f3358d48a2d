// SPDX-License-Identifier: GPL-3.0-or-later
#include "isochoricLaw.H"

#include <cmath>

namespace ispf
{

namespace
{

// J^(-1/3) F and its Cauchy-Green tensor
struct shape
{
    scalar share;  // J^(-1/3)
    tensor F, C;   // of the shape alone
    tensor T;      // F^-T of the whole deformation

    explicit shape(const tensor& whole)
        : share(1 / std::cbrt(whole.determinant())),
          F(share * whole),
          C(F.transpose() * F),
          T(whole.inverse().transpose())
    {
    }
};

scalar product(const tensor& a, const tensor& b)
{
    return a.cwiseProduct(b).sum();
}

}  // namespace

scalar isochoricLaw::energy(const tensor& F, label k) const
{
    return at(shape(F).C, k);
}

// (5.15)
tensor isochoricLaw::stress(const tensor& F, label k) const
{
    const shape s(F);
    const tensor Q = 2 * s.F * slope(s.C, k);
    return s.share * (Q - product(Q, F) / 3 * s.T);
}

// (5.16), column by column
modulusMatrix isochoricLaw::tangent(const tensor& F, label k) const
{
    const shape s(F);
    const tensor S = slope(s.C, k), Q = 2 * s.F * S;
    const modulusMatrix D = curvature(s.C, k);
    const scalar QF = product(Q, F);
    const tensor bracket = Q - QF / 3 * s.T;
    modulusMatrix tangent;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
        {
            const scalar volume = s.T(r, c);  // F^-T : dF
            tensor dShape = -volume / 3 * s.F;
            dShape(r, c) += s.share;
            const tensor dC = dShape.transpose() * s.F + s.F.transpose() * dShape;
            const tensorColumn dS = D * columnOf(dC);
            const tensor dQ = 2 * (dShape * S + s.F * Eigen::Map<const tensor>(dS.data()));
            const tensor dT = -s.T.col(c) * s.T.row(r);
            const tensor dP =
                -volume / 3 * bracket + dQ - (product(dQ, F) + Q(r, c)) / 3 * s.T - QF / 3 * dT;
            tangent.col(r + 3 * c) = s.share * columnOf(dP);
        }
    return 0.5 * (tangent + tangent.transpose());  // rounding alone makes it unsymmetric
}

}  // namespace ispf
