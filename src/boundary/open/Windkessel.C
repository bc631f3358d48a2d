// SPDX-License-Identifier: GPL-3.0-or-later
// outlet Windkessel: the vessels behind the face are a proximal resistance, a compliance and a distal resistance (N.
// Westerhof, J.-W. Lankhaar and B. E. Westerhof 2009, Med. Biol. Eng. Comput. 47),
//
//     outside { type open; outlet Windkessel; p 0; proximal 1e7; distal 1e8; compliance 1e-8; initialPressure 1e4; }
//
//     p_face = proximal Q + p_C,   compliance dp_C/dt = Q - (p_C - p)/distal                                (4.12)
//
// p [Pa] over time is the pressure behind the distal resistance, p_C that of the compliance, at the start initialPressure.
// Resistances are in [Pa s/m^3], the compliance is in [m^3/Pa]; in two dimensions with m^2 in place of m^3.  The
// three-element model has proximal > 0; proximal 0, the default, gives that of two elements.  In a step Q is that of its end.
#include "outlet.H"

namespace ispf
{

namespace
{

class Windkessel : public outlet
{
public:
    Windkessel(const dictionary& dict, const word& caseFolder, const dimensionSet& flow)
        : p_(Function1::New("p", dict, caseFolder, dims::pressure)),
          proximal_(
              dict.getInRangeOrDefault<scalar>("proximal", 0, 1e30, 0, dims::pressure / flow)),
          distal_(dict.getInRange<scalar>("distal", 1e-30, 1e30, dims::pressure / flow)),
          compliance_(dict.getInRange<scalar>("compliance", 1e-30, 1e30,
                                              flow * dims::time / dims::pressure)),
          stored_(dict.getOrDefault<scalar>("initialPressure", 0, dims::pressure))
    {
    }
    scalar pressure(const step& s, scalar Q) const override { return proximal_ * Q + after(s, Q); }
    scalar slope(const step& s) const override { return proximal_ + rises(s); }
    void accept(const step& s, scalar Q) override { stored_ = after(s, Q); }
    List<scalar> state() const override { return {stored_}; }
    void restore(const List<scalar>& kept) override { stored_ = kept.at(0); }

private:
    // p_C at the end of the step, and its slope dp_C/dQ: (4.12) by the implicit Euler rule, which no step makes unstable
    scalar after(const step& s, scalar Q) const
    {
        const scalar inflow = Q + p_->value(s.end) / distal_;
        return stored_ / (1 + (s.end - s.start) / (distal_ * compliance_)) + rises(s) * inflow;
    }
    scalar rises(const step& s) const
    {
        const scalar dt = s.end - s.start;
        return dt / (compliance_ + dt / distal_);
    }

    std::unique_ptr<Function1> p_;
    scalar proximal_, distal_, compliance_;
    scalar stored_;  // p_C [Pa]
};

}  // namespace

std::unique_ptr<outlet> newWindkessel(const dictionary& dict, const word& caseFolder,
                                      const dimensionSet& flow)
{
    return std::make_unique<Windkessel>(dict, caseFolder, flow);
}

}  // namespace ispf
