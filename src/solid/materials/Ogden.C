// SPDX-License-Identifier: GPL-3.0-or-later
// W = sum_p (mu_p/alpha_p) (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) with the principal stretches l of J^(-1/3) F (R. W.
// Ogden 1972, Proc. R. Soc. A 326).  Entries: mu [Pa] and alpha [1], lists of the same length.  G = sum mu_p alpha_p/2.
// mu_p alpha_p must be positive in each term (Hill's condition).
#include "isochoricLaw.H"

#include <cmath>

namespace ispf
{

namespace
{

// Eigenvalues of C nearer than this share count as equal: their divided difference is then the derivative at their mean
constexpr scalar equal = 1e-5;

class Ogden : public isochoricLaw
{
public:
    explicit Ogden(const dictionary& dict)
        : mu_(dict.get<List<scalar>>("mu", dims::pressure)), alpha_(dict.get<List<scalar>>("alpha"))
    {
        if (mu_.empty() || mu_.size() != alpha_.size())
            dict.fail("alpha", "mu has " + std::to_string(mu_.size()) + " numbers and alpha " +
                                   std::to_string(alpha_.size()) +
                                   ": each term of the law needs one of both");
        for (size_t p = 0; p < mu_.size(); ++p)
            if (!(mu_[p] * alpha_[p] > 0))
                dict.fail("mu", "Term " + std::to_string(p + 1) +
                                    " has mu alpha <= 0: it would soften the solid without limit");
    }

    scalar shearModulus() const override
    {
        scalar sum = 0;
        for (size_t p = 0; p < mu_.size(); ++p) sum += 0.5 * mu_[p] * alpha_[p];
        return sum;
    }
    word description() const override
    {
        return "Ogden with " + std::to_string(mu_.size()) + " terms";
    }

private:
    // W is the sum of w(c) over the eigenvalues c = l^2 of C
    struct values
    {
        scalar w = 0, first = 0, second = 0;
    };
    values of(scalar c) const
    {
        values v;
        for (size_t p = 0; p < mu_.size(); ++p)
        {
            const scalar a = 0.5 * alpha_[p], power = std::pow(c, a);
            v.w += mu_[p] / alpha_[p] * (power - 1);
            v.first += 0.5 * mu_[p] * power / c;
            v.second += 0.5 * mu_[p] * (a - 1) * power / (c * c);
        }
        return v;
    }
    using eigenvalues = Eigen::SelfAdjointEigenSolver<tensor>;

    scalar at(const tensor& C, label) const override
    {
        const eigenvalues e(C, Eigen::EigenvaluesOnly);
        return of(e.eigenvalues()[0]).w + of(e.eigenvalues()[1]).w + of(e.eigenvalues()[2]).w;
    }
    tensor slope(const tensor& C, label) const override
    {
        const eigenvalues e(C);
        tensor S = tensor::Zero();
        for (int a = 0; a < 3; ++a)
            S += of(e.eigenvalues()[a]).first * e.eigenvectors().col(a) *
                 e.eigenvectors().col(a).transpose();
        return S;
    }
    modulusMatrix curvature(const tensor& C, label) const override
    {
        const eigenvalues e(C);
        modulusMatrix D = modulusMatrix::Zero();
        for (int a = 0; a < 3; ++a)
            for (int b = a; b < 3; ++b)
            {
                const vector n = e.eigenvectors().col(a), m = e.eigenvectors().col(b);
                const tensor turn = n * m.transpose() + m * n.transpose();
                const scalar share = a == b ? 0.25 : 0.5;  // n m^T counts twice in `turn` for a = b
                D +=
                    share * slopeBetween(e.eigenvalues()[a], e.eigenvalues()[b]) * dyad(turn, turn);
            }
        return D;
    }
    scalar slopeBetween(scalar c, scalar d) const
    {
        if (std::abs(c - d) < equal * (c + d)) return of(0.5 * (c + d)).second;
        return (of(c).first - of(d).first) / (c - d);
    }

    List<scalar> mu_, alpha_;
};

}  // namespace

std::unique_ptr<material> newOgden(const dictionary& dict, const List<vector>&)
{
    return std::make_unique<Ogden>(dict);
}

}  // namespace ispf
