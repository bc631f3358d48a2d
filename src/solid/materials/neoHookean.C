// SPDX-License-Identifier: GPL-3.0-or-later
// Incompressible neo-Hookean solid, W = G/2 (I - 3) with I = tr C (Treloar 1943, Trans. Faraday Soc. 39).  Entries: E = 3 G
// [Pa], or G [Pa].
#include "isochoricLaw.H"

namespace ispf
{

namespace
{

class neoHookean : public isochoricLaw
{
public:
    explicit neoHookean(scalar G) : G_(G) {}

    scalar shearModulus() const override { return G_; }
    word description() const override { return "neoHookean"; }

private:
    scalar at(const tensor& C, label) const override { return G_ / 2 * (C.trace() - 3); }
    tensor slope(const tensor&, label) const override { return G_ / 2 * tensor::Identity(); }
    modulusMatrix curvature(const tensor&, label) const override { return modulusMatrix::Zero(); }

    scalar G_;
};

}  // namespace

std::unique_ptr<material> newNeoHookean(const dictionary& dict, const List<vector>&)
{
    if (dict.found("E") == dict.found("G"))
        throw fatalError(
            "The material neoHookean needs exactly one of E (Young's modulus, Pa) and G (shear "
            "modulus, Pa)",
            dict.where());
    return std::make_unique<neoHookean>(
        dict.found("G") ? dict.getInRange("G", 1e-12, 1e15, dims::pressure)
                        : dict.getInRange("E", 1e-12, 1e15, dims::pressure) / 3);
}

}  // namespace ispf
