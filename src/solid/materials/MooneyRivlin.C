// SPDX-License-Identifier: GPL-3.0-or-later
// W = c1 (I1 - 3) + c2 (I2 - 3), I2 = (I1^2 - C:C)/2 (M. Mooney 1940, J. Appl. Phys. 11; R. S. Rivlin 1948, Phil. Trans. A
// 241).  Entries: c1, c2 [Pa].  G = 2 (c1 + c2).  Neither may be negative: the solid could lose its stiffness.
#include "isochoricLaw.H"

namespace ispf
{

namespace
{

class MooneyRivlin : public isochoricLaw
{
public:
    explicit MooneyRivlin(const dictionary& dict)
        : c1_(dict.getInRange("c1", 0, 1e15, dims::pressure)),
          c2_(dict.getInRange("c2", 0, 1e15, dims::pressure))
    {
        if (!(c1_ + c2_ > 0)) dict.fail("c1", "One of c1 and c2 must be positive: G = 2 (c1 + c2)");
    }

    scalar shearModulus() const override { return 2 * (c1_ + c2_); }
    word description() const override { return "MooneyRivlin"; }

private:
    scalar at(const tensor& C, label) const override
    {
        const scalar I1 = C.trace(), I2 = 0.5 * (I1 * I1 - C.squaredNorm());
        return c1_ * (I1 - 3) + c2_ * (I2 - 3);
    }
    tensor slope(const tensor& C, label) const override
    {
        return (c1_ + c2_ * C.trace()) * tensor::Identity() - c2_ * C;
    }
    modulusMatrix curvature(const tensor&, label) const override
    {
        const tensor one = tensor::Identity();
        return c2_ * (dyad(one, one) - modulusMatrix::Identity());
    }

    scalar c1_, c2_;
};

}  // namespace

std::unique_ptr<material> newMooneyRivlin(const dictionary& dict, const List<vector>&)
{
    return std::make_unique<MooneyRivlin>(dict);
}

}  // namespace ispf
