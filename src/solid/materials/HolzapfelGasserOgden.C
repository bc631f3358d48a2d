// SPDX-License-Identifier: GPL-3.0-or-later
// Arterial wall of a neo-Hookean ground and families a of fibres,
//
//     W = G/2 (I1 - 3) + k1/(2 k2) sum_a [exp(k2 <E_a>^2) - 1],   E_a = kappa (I1 - 3) + (1 - 3 kappa) (I4_a - 1)
//
// with I4_a = a.C a (G. A. Holzapfel, T. C. Gasser and R. W. Ogden 2000, J. Elast. 61; with dispersion kappa T. C. Gasser,
// R. W. Ogden and G. A. Holzapfel 2006, J. R. Soc. Interface 3).  Fibres act in tension alone: <E> = max(E, 0).  Entries: G and
// k1 [Pa], k2 [1], kappa 0 to 1/3 [1] (0), fibres { .. } (fibres.H).
#include "fibres.H"
#include "isochoricLaw.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

class HolzapfelGasserOgden : public isochoricLaw
{
public:
    HolzapfelGasserOgden(const dictionary& dict, const List<vector>& x0)
        : G_(dict.getInRange("G", 1e-12, 1e15, dims::pressure)),
          k1_(dict.getInRange("k1", 0, 1e15, dims::pressure)),
          k2_(dict.getInRange("k2", 1e-12, 1e6)),
          kappa_(dict.getInRangeOrDefault("kappa", 0, 1.0 / 3, 0)),
          fibres_(dict.subDict("fibres"), x0)
    {
        if (k1_ == 0)
            dict.fail("k1", "Fibres of stiffness 0 have no effect. Give more, or take neoHookean");
        for (label a = 0; kappa_ == 0 && a < fibres_.nFamilies(); ++a)
            if (inPlane(x0) && across(a, label(x0.size())))
                dict.subDict("fibres").fail(
                    "type", "The fibres of family " + std::to_string(a + 1) +
                                " lie across the plane of a two-dimensional case, which does not "
                                "stretch them: they have no effect. Give directions in the plane");
    }

    scalar shearModulus() const override { return G_; }
    word description() const override
    {
        return "HolzapfelGasserOgden with " + std::to_string(fibres_.nFamilies()) +
               " families of fibres";
    }

private:
    // True in two dimensions
    static bool inPlane(const List<vector>& x0)
    {
        return std::all_of(x0.begin(), x0.end(), [](const vector& x) { return x[2] == 0; });
    }
    // True if the fibres of a family lie along z at all n particles
    bool across(label family, label n) const
    {
        for (label k = 0; k < n; ++k)
            if (fibres_.of(family, k).head<2>().norm() > 1e-6) return false;
        return true;
    }

    // E_a and dE_a/dC
    scalar strain(const tensor& C, label family, label k) const
    {
        const vector& a = fibres_.of(family, k);
        return kappa_ * (C.trace() - 3) + (1 - 3 * kappa_) * (a.dot(C * a) - 1);
    }
    tensor direction(label family, label k) const
    {
        const vector& a = fibres_.of(family, k);
        return kappa_ * tensor::Identity() + (1 - 3 * kappa_) * a * a.transpose();
    }

    scalar at(const tensor& C, label k) const override
    {
        scalar W = G_ / 2 * (C.trace() - 3);
        for (label a = 0; a < fibres_.nFamilies(); ++a)
            if (const scalar E = strain(C, a, k); E > 0)
                W += k1_ / (2 * k2_) * std::expm1(k2_ * E * E);
        return W;
    }
    tensor slope(const tensor& C, label k) const override
    {
        tensor S = G_ / 2 * tensor::Identity();
        for (label a = 0; a < fibres_.nFamilies(); ++a)
            if (const scalar E = strain(C, a, k); E > 0)
                S += k1_ * E * std::exp(k2_ * E * E) * direction(a, k);
        return S;
    }
    modulusMatrix curvature(const tensor& C, label k) const override
    {
        modulusMatrix D = modulusMatrix::Zero();
        for (label a = 0; a < fibres_.nFamilies(); ++a)
            if (const scalar E = strain(C, a, k); E > 0)
            {
                const tensor d = direction(a, k);
                D += k1_ * (1 + 2 * k2_ * E * E) * std::exp(k2_ * E * E) * dyad(d, d);
            }
        return D;
    }

    scalar G_, k1_, k2_, kappa_;
    fibreDirections fibres_;
};

}  // namespace

std::unique_ptr<material> newHolzapfelGasserOgden(const dictionary& dict, const List<vector>& x0)
{
    return std::make_unique<HolzapfelGasserOgden>(dict, x0);
}

}  // namespace ispf
