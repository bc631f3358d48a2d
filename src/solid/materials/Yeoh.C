// SPDX-License-Identifier: GPL-3.0-or-later
// Yeoh's law of filled rubber, W = c1 i + c2 i^2 + c3 i^3 with i = tr C - 3 (O. H. Yeoh 1993, Rubber Chem. Technol. 66).
// Entries: c1, c2, c3 [Pa]; c2 and c3 are zero by default.  G = 2 c1.  dW/di must be positive for every i > 0: else
// the solid would give way under a growing load.
#include "isochoricLaw.H"

namespace ispf
{

namespace
{

class Yeoh : public isochoricLaw
{
public:
    explicit Yeoh(const dictionary& dict)
        : c1_(dict.getInRange("c1", 1e-12, 1e15, dims::pressure)),
          c2_(dict.getInRangeOrDefault("c2", -1e15, 1e15, 0, dims::pressure)),
          c3_(dict.getInRangeOrDefault("c3", 0, 1e15, 0, dims::pressure))
    {
        // the least c1 + 2 c2 i + 3 c3 i^2 is at i = -c2/(3 c3)
        if (c2_ < 0 && !(c2_ * c2_ < 3 * c1_ * c3_))
            dict.fail("c2",
                      "With this c2 the stress would fall where the stretch grows: c2 must be 0 at "
                      "least, or c2^2 below 3 c1 c3");
    }

    scalar shearModulus() const override { return 2 * c1_; }
    word description() const override { return "Yeoh"; }

private:
    scalar at(const tensor& C, label) const override
    {
        const scalar i = C.trace() - 3;
        return i * (c1_ + i * (c2_ + i * c3_));
    }
    tensor slope(const tensor& C, label) const override
    {
        const scalar i = C.trace() - 3;
        return (c1_ + i * (2 * c2_ + 3 * c3_ * i)) * tensor::Identity();
    }
    modulusMatrix curvature(const tensor& C, label) const override
    {
        const tensor one = tensor::Identity();
        return (2 * c2_ + 6 * c3_ * (C.trace() - 3)) * dyad(one, one);
    }

    scalar c1_, c2_, c3_;
};

}  // namespace

std::unique_ptr<material> newYeoh(const dictionary& dict, const List<vector>&)
{
    return std::make_unique<Yeoh>(dict);
}

}  // namespace ispf
