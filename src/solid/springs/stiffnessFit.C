// SPDX-License-Identifier: GPL-3.0-or-later
#include "stiffnessFit.H"
#include "forPairs.H"
#include "springModuli.H"

#include <algorithm>

namespace ispf
{

namespace
{

constexpr scalar stayNear = 0.3;  // weight of (s - 1)^2 per row entry, two entries per link
constexpr scalar most = 3, least = 1 / most;
constexpr int iterations = 60;  // more than twenty change the moduli of walls by less than 1 %

class fit
{
public:
    fit(const structureReference& ref, const referenceNeighbours& pairs, scalar G, List<scalar>& k);
    stiffnessFitReport run();

private:
    // Sum over row i of multiplier times link tensor, in units of G
    quarticTensor particleTensor(label i, const List<scalar>& s) const
    {
        quarticTensor C = quarticTensor::Zero();
        forNeighbours<among::all>(
            pairs_, i, [&](pairIndex p, label) { C += s[p] * strength_[p] * linkTensor(i, p); });
        return C;
    }
    quarticTensor linkTensor(label i, std::int64_t p) const
    {
        return quartic(pairs_.separation(ref_, i, p).normalized());
    }
    quarticTensor turned(std::int64_t p, const quarticTensor& C) const
    {
        return pairs_.image[p] ? quarticTensor(rotation_[pairs_.image[p] - 1] * C) : C;
    }
    void scale();
    void tensors(const List<scalar>& s, const quarticTensor& minus);
    void localMean();
    void gradient(List<scalar>& g);
    scalar steepness();

    const structureReference& ref_;
    const referenceNeighbours& pairs_;
    const quarticTensor target_;
    List<scalar>& k_;
    List<std::int64_t> reverse_;
    List<scalar> strength_;  // k d0^2/(2 V G)
    List<scalar> weight_, weightSum_;
    List<quarticRotation> rotation_;
    List<quarticTensor> C_, mean_;
    List<scalar> half_;
};

fit::fit(const structureReference& ref, const referenceNeighbours& pairs, scalar G, List<scalar>& k)
    : ref_(ref),
      pairs_(pairs),
      target_(isotropicQuartic(ref.nDims)),
      k_(k),
      reverse_(pairs.reverse(ref)),
      strength_(k.size()),
      weight_(k.size()),
      weightSum_(ref.n(), 1),
      C_(ref.n()),
      mean_(ref.n()),
      half_(k.size())
{
    for (const isometry& image : ref.images) rotation_.push_back(quarticTurn(image.R));
    scalar reach = 0;
    for (label i = 0; i < ref.n(); ++i)
        forNeighbours<among::all>(pairs, i, [&](pairIndex p, label) {
            reach = std::max(reach, pairs.separation(ref, i, p).norm());
        });
    forPairs<among::all>(pairs, 0, ref.n(), [&](label i, pairIndex p, label) {
        const scalar d = pairs.separation(ref, i, p).norm(), q = 1 - d / (1.001 * reach);
        weight_[p] = q * q * (3 - 2 * q);
        weightSum_[i] += weight_[p];
        strength_[p] = k[p] * d * d / (2 * ref.volume() * G);
    });
    scale();
}

// Multiplies all links by one factor: the best fit of all particles' tensors to the target
void fit::scale()
{
    tensors(List<scalar>(k_.size(), 1), quarticTensor::Zero());
    scalar along = 0, square = 0;
    for (const quarticTensor& C : C_) along += C.dot(target_), square += C.squaredNorm();
    const scalar factor = along / square;
    for (size_t p = 0; p < k_.size(); ++p) k_[p] *= factor, strength_[p] *= factor;
}

void fit::tensors(const List<scalar>& s, const quarticTensor& minus)
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i) C_[i] = particleTensor(i, s) - minus;
        },
        256);
}

void fit::localMean()
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                mean_[i] = C_[i];
                forNeighbours<among::all>(pairs_, i, [&](pairIndex p, label j) {
                    mean_[i] += weight_[p] * turned(p, C_[j]);
                });
                mean_[i] /= weightSum_[i];
            }
        },
        256);
}

// Gradient of 1/2 sum |mean|^2 with respect to the multipliers: the adjoint of localMean, then that of tensors
void fit::gradient(List<scalar>& g)
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                quarticTensor Q = mean_[i] / weightSum_[i];
                forNeighbours<among::all>(pairs_, i, [&](pairIndex p, label j) {
                    Q += weight_[p] / weightSum_[j] * turned(p, mean_[j]);
                });
                forNeighbours<among::all>(pairs_, i, [&](pairIndex p, label) {
                    half_[p] = strength_[p] * linkTensor(i, p).dot(Q);
                });
            }
        },
        256);
    for (size_t p = 0; p < g.size(); ++p) g[p] = half_[p] + half_[reverse_[p]];
}

// Largest eigenvalue of the quadratic form, by power iteration
scalar fit::steepness()
{
    List<scalar> v(k_.size()), g(k_.size());
    for (size_t p = 0; p < v.size(); ++p)
        v[p] =
            1 + 0.3 * std::sin(7.3 * scalar(std::min<std::int64_t>(std::int64_t(p), reverse_[p])));
    scalar value = 0;
    for (int k = 0; k < 15; ++k)
    {
        tensors(v, quarticTensor::Zero());
        localMean();
        gradient(g);
        value = norm(g) / norm(v);
        for (size_t p = 0; p < v.size(); ++p) v[p] = g[p] / value;
    }
    return value;
}

stiffnessFitReport fit::run()
{
    const scalar step = 1 / (1.05 * steepness() + stayNear);
    List<scalar> s(k_.size(), 1), y = s, old = s, g(k_.size());
    scalar momentum = 1;
    for (int k = 0; k < iterations; ++k)
    {
        tensors(y, target_);
        localMean();
        gradient(g);
        s.swap(old);
        scalar uphill = 0;
        for (size_t p = 0; p < s.size(); ++p)
        {
            s[p] = std::clamp(y[p] - step * (g[p] + stayNear * (y[p] - 1)), least, most);
            uphill += (y[p] - s[p]) * (s[p] - old[p]);
        }
        if (uphill > 0) momentum = 1;
        const scalar next = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum));
        for (size_t p = 0; p < s.size(); ++p) y[p] = s[p] + (momentum - 1) / next * (s[p] - old[p]);
        momentum = next;
    }
    stiffnessFitReport report{s[0], s[0], 0};
    for (size_t p = 0; p < s.size(); ++p)
    {
        k_[p] *= s[p];
        report.least = std::min(report.least, s[p]), report.most = std::max(report.most, s[p]);
    }
    tensors(s, target_);
    localMean();
    for (const quarticTensor& r : mean_) report.residual += r.squaredNorm();
    report.residual = std::sqrt(report.residual / scalar(mean_.size())) / target_.norm();
    return report;
}

}  // namespace

stiffnessFitReport fitStiffness(const structureReference& ref, const referenceNeighbours& pairs,
                                scalar G, List<scalar>& k)
{
    return fit(ref, pairs, G, k).run();
}

}  // namespace ispf
