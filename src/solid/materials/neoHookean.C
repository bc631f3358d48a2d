// SPDX-License-Identifier: GPL-3.0-or-later
// Incompressible neo-Hookean solid, W = G/2 (I - 3) with the first invariant I of J^(-1/3) F (Treloar 1943, Trans. Faraday
// Soc. 39).  Entries: E = 3 G [Pa], or G [Pa].
#include "firstInvariantLaw.H"

namespace ispf
{

namespace
{

class neoHookean : public firstInvariantLaw
{
public:
    explicit neoHookean(scalar G) : G_(G) {}

    word description() const override { return "neoHookean"; }

private:
    values at(scalar i) const override { return {G_ / 2 * i, G_ / 2, 0}; }

    scalar G_;
};

}  // namespace

std::unique_ptr<material> newNeoHookean(const dictionary& dict)
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
