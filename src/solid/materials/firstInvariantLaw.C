// SPDX-License-Identifier: GPL-3.0-or-later
#include "firstInvariantLaw.H"

#include <cmath>

namespace ispf
{

namespace
{

// i and A of (5.15), with the parts of which they are made
struct invariant
{
    scalar share;  // J^(-2/3)
    scalar I;
    tensor T;  // F^-T
    tensor A;

    explicit invariant(const tensor& F) : I(F.squaredNorm()), T(F.inverse().transpose())
    {
        const scalar root = std::cbrt(F.determinant());
        share = 1 / (root * root);
        A = 2 * share * (F - I / 3 * T);
    }
    scalar i() const { return share * I - 3; }
};

using column = Eigen::Matrix<scalar, 9, 1>;

column columnOf(const tensor& t)
{
    return Eigen::Map<const column>(t.data());
}

}  // namespace

scalar firstInvariantLaw::energy(const tensor& F) const
{
    return at(invariant(F).i()).w;
}

tensor firstInvariantLaw::stress(const tensor& F) const
{
    const invariant v(F);
    return at(v.i()).slope * v.A;
}

modulusMatrix firstInvariantLaw::tangent(const tensor& F) const
{
    const invariant v(F);
    const values law = at(v.i());
    const column f = columnOf(F), t = columnOf(v.T), a = columnOf(v.A);
    modulusMatrix bracket = modulusMatrix::Identity();
    bracket -= 2.0 / 3 * (f * t.transpose() + t * f.transpose());
    bracket += 2 * v.I / 9 * t * t.transpose();
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            for (int d = 0; d < 3; ++d)
                for (int s = 0; s < 3; ++s)
                    bracket(r + 3 * c, s + 3 * d) += v.I / 3 * v.T(r, d) * v.T(s, c);
    return law.curvature * a * a.transpose() + 2 * law.slope * v.share * bracket;
}

}  // namespace ispf
