// SPDX-License-Identifier: GPL-3.0-or-later
#include "homogeneousMotion.H"

#include <cmath>

namespace ispf
{

namespace
{

tensor stretched(const tensor& frame, const vector& factors)
{
    return frame * factors.asDiagonal() * frame.transpose();
}

}  // namespace

List<word> homogeneousMotions(int nDims)
{
    if (nDims == 2) return {"uniaxial", "shear"};
    return {"uniaxial", "equibiaxial", "shear"};
}

tensor frameAlong(const vector& direction)
{
    const vector a = direction.normalized();
    const bool upright = std::abs(a[2]) > 1 - 1e-9;
    const vector near = upright ? vector::UnitX() : vector::UnitZ();
    const vector c = (near - near.dot(a) * a).normalized();
    tensor frame;
    frame << a, c.cross(a), c;
    return frame;
}

homogeneousMotion motionOf(const word& name, const tensor& frame, int nDims, scalar lambda)
{
    if (name == "shear")
    {
        const scalar gamma = lambda - 1 / lambda;
        const tensor slide = frame.col(0) * frame.col(1).transpose();
        return {tensor::Identity() + gamma * slide, slide, gamma};
    }
    const auto power = [&](scalar exponent) { return std::pow(lambda, exponent); };
    if (name == "equibiaxial")
        return {stretched(frame, {lambda, lambda, power(-2)}),
                stretched(frame, vector(0.5, 0.5, -1) / lambda), lambda - power(-5)};
    if (nDims == 2)
        return {stretched(frame, {lambda, 1 / lambda, 1}),
                stretched(frame, vector(1, -1, 0) / lambda), lambda - power(-3)};
    return {stretched(frame, {lambda, power(-0.5), power(-0.5)}),
            stretched(frame, vector(1, -0.5, -0.5) / lambda), lambda - power(-2)};
}

scalar nominalStress(const structureModel& model, const homogeneousMotion& motion,
                     const List<char>& inside)
{
    List<vec4> x;
    for (const vector& X : model.reference().x0) x.push_back(vec4::from(motion.F * X));
    List<tensor> tau;
    model.stress(x, tau);
    scalar sum = 0;
    label n = 0;
    for (size_t i = 0; i < inside.size(); ++i)
        if (inside[i]) sum += tau[i].cwiseProduct(motion.rate).sum(), ++n;
    if (n == 0) throw fatalError("No particle of the structure lies in the measured part");
    return sum / n;
}

}  // namespace ispf
