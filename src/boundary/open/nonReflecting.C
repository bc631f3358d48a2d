// SPDX-License-Identifier: GPL-3.0-or-later
// outlet nonReflecting: behind the face a long vessel of the face's section carries waves away, with speed waveSpeed [m/s]:
//
//     outside { type open; outlet nonReflecting; p 0; waveSpeed 5; }
//
//     p_face = p + (rho waveSpeed/A) Q                                                                      (4.14)
//
// p [Pa] over time is the pressure there without waves.  A is the area of the face and of its mirror images together.
// A wave p_w(t) that is to enter through the face adds 2 p_w(t) to p: the other half is what it needs to set fluid in motion.
#include "outlet.H"

namespace ispf
{

namespace
{

class nonReflecting : public outlet
{
public:
    nonReflecting(const dictionary& dict, const word& caseFolder)
        : p_(Function1::New("p", dict, caseFolder, dims::pressure)),
          c_(dict.getInRange<scalar>("waveSpeed", 1e-30, 1e30, dims::velocity))
    {
    }
    scalar pressure(const step& s, scalar Q) const override
    {
        return p_->value(s.end) + slope(s) * Q;
    }
    scalar slope(const step& s) const override { return s.inertia * c_; }

private:
    std::unique_ptr<Function1> p_;
    scalar c_;
};

}  // namespace

std::unique_ptr<outlet> newNonReflecting(const dictionary& dict, const word& caseFolder,
                                         const dimensionSet&)
{
    return std::make_unique<nonReflecting>(dict, caseFolder);
}

}  // namespace ispf
