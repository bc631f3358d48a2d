// SPDX-License-Identifier: GPL-3.0-or-later
#include "smoothingKernel.H"
#include "execution.H"

#include <cmath>

namespace ispf
{

namespace
{

// Each shape has: w(q), f(q) = w'(q)/q, support in h, and the normalisation in 2D and 3D (times h^-nDims)

ISPF_INLINE scalar positive(scalar a)
{
    return a > 0 ? a : 0;
}

struct cubic
{
    static constexpr scalar support = 2;
    static constexpr scalar norm[2] = {10 / (7 * M_PI), 1 / M_PI};
    static ISPF_INLINE scalar w(scalar q)
    {
        const scalar a = positive(2 - q), b = positive(1 - q);
        return 0.25 * a * a * a - b * b * b;
    }
    static ISPF_INLINE scalar f(scalar q)
    {
        const scalar a = positive(2 - q);
        return q < 1 ? -3 + 2.25 * q : -0.75 * a * a / q;
    }
};

struct quintic
{
    static constexpr scalar support = 3;
    static constexpr scalar norm[2] = {7 / (478 * M_PI), 1 / (120 * M_PI)};
    static ISPF_INLINE scalar power4(scalar a) { return a * a * a * a; }
    static ISPF_INLINE scalar w(scalar q)
    {
        const scalar a = positive(3 - q), b = positive(2 - q), c = positive(1 - q);
        return power4(a) * a - 6 * power4(b) * b + 15 * power4(c) * c;
    }
    static ISPF_INLINE scalar f(scalar q)
    {
        const scalar a = positive(3 - q), b = positive(2 - q), c = positive(1 - q);
        // below q = 1 the quotient is written as a polynomial: no cancellation as q -> 0
        return q < 1 ? -120 + q * q * (120 - 50 * q)
                     : -5 * (power4(a) - 6 * power4(b) + 15 * power4(c)) / q;
    }
};

struct wendlandC2
{
    static constexpr scalar support = 2;
    static constexpr scalar norm[2] = {7 / (4 * M_PI), 21 / (16 * M_PI)};
    static ISPF_INLINE scalar w(scalar q)
    {
        const scalar t = positive(1 - 0.5 * q);
        return t * t * t * t * (1 + 2 * q);
    }
    static ISPF_INLINE scalar f(scalar q)
    {
        const scalar t = positive(1 - 0.5 * q);
        return -5 * t * t * t;
    }
};

struct wendlandC4
{
    static constexpr scalar support = 2;
    static constexpr scalar norm[2] = {9 / (4 * M_PI), 495 / (256 * M_PI)};
    static ISPF_INLINE scalar w(scalar q)
    {
        const scalar t = positive(1 - 0.5 * q);
        return t * t * t * t * t * t * (35 * q * q / 12 + 3 * q + 1);
    }
    static ISPF_INLINE scalar f(scalar q)
    {
        const scalar t = positive(1 - 0.5 * q);
        return -t * t * t * t * t * (35 * q + 14) / 3;
    }
};

template <class Shape>
class kernelOf : public smoothingKernel
{
public:
    kernelOf(const word& name, int nDims, scalar h)
        : smoothingKernel(name, nDims, h, Shape::support),
          scaleW_(Shape::norm[nDims - 2] / std::pow(h, nDims)),
          scaleF_(scaleW_ / (h * h))
    {
    }
    scalar W(scalar r) const override { return scaleW_ * Shape::w(r / h_); }
    void W(const scalar* rSqr, scalar* W, label n) const override
    {
        const scalar perH = 1 / h_, scale = scaleW_;
        for (label k = 0; k < n; ++k) W[k] = scale * Shape::w(std::sqrt(rSqr[k]) * perH);
    }
    void F(const scalar* rSqr, scalar* F, label n) const override
    {
        const scalar perH = 1 / h_, scale = scaleF_;
        for (label k = 0; k < n; ++k) F[k] = scale * Shape::f(std::sqrt(rSqr[k]) * perH);
    }

private:
    scalar scaleW_, scaleF_;
};

}  // namespace

List<word> smoothingKernel::valid()
{
    return {"cubic", "quintic", "WendlandC2", "WendlandC4"};
}

std::unique_ptr<smoothingKernel> smoothingKernel::New(const word& name, int nDims, scalar h)
{
    if (name == "cubic") return std::make_unique<kernelOf<cubic>>(name, nDims, h);
    if (name == "quintic") return std::make_unique<kernelOf<quintic>>(name, nDims, h);
    if (name == "WendlandC2") return std::make_unique<kernelOf<wendlandC2>>(name, nDims, h);
    if (name == "WendlandC4") return std::make_unique<kernelOf<wendlandC4>>(name, nDims, h);
    throw fatalError("Unknown kernel '" + name + "'. " + validWords("kernel", valid()));
}

scalar smoothingKernel::latticeSum(scalar dx) const
{
    return latticeSum(dx, [&](scalar r) { return W(r); });
}

scalar smoothingKernel::latticeSum(scalar dx, const std::function<scalar(scalar)>& value) const
{
    const int m = int(support() / dx) + 1;
    scalar sum = 0;
    for (int i = -m; i <= m; ++i)
        for (int j = -m; j <= m; ++j)
            for (int k = nDims_ == 3 ? -m : 0; k <= (nDims_ == 3 ? m : 0); ++k)
                sum += value(dx * std::sqrt(scalar(i * i + j * j + k * k)));
    return sum * std::pow(dx, nDims_);
}

}  // namespace ispf
