// SPDX-License-Identifier: GPL-3.0-or-later
// outlet resistance: the vessels behind the face resist the flow:
//
//     outside { type open; outlet resistance; p 0; resistance 1e8; }      // p + resistance Q
//
// p [Pa] over time is the pressure behind the resistance; resistance [Pa s/m^3; Pa s/m^2 in two dimensions].
#include "outlet.H"

namespace ispf
{

namespace
{

class resistance : public outlet
{
public:
    resistance(const dictionary& dict, const word& caseFolder, const dimensionSet& flow)
        : p_(Function1::New("p", dict, caseFolder, dims::pressure)),
          R_(dict.getInRange<scalar>("resistance", 0, 1e30, dims::pressure / flow))
    {
    }
    scalar pressure(const step& s, scalar Q) const override { return p_->value(s.end) + R_ * Q; }
    scalar slope(const step&) const override { return R_; }

private:
    std::unique_ptr<Function1> p_;
    scalar R_;
};

}  // namespace

std::unique_ptr<outlet> newResistance(const dictionary& dict, const word& caseFolder,
                                      const dimensionSet& flow)
{
    return std::make_unique<resistance>(dict, caseFolder, flow);
}

}  // namespace ispf
