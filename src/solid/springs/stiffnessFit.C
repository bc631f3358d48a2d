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

// A quarticTensor with one more component, a zero: four lanes of four
struct paddedTensor
{
    simd4 part[4] = {};

    paddedTensor() = default;
    paddedTensor(const quarticTensor& q) { std::copy(q.data(), q.data() + q.size(), data()); }
    scalar* data() { return reinterpret_cast<scalar*>(part); }
    const scalar* data() const { return reinterpret_cast<const scalar*>(part); }
    auto tensor() const { return Eigen::Map<const quarticTensor>(data()); }
    ISPF_INLINE void add(scalar factor, const paddedTensor& other)
    {
        for (int k = 0; k < 4; ++k) part[k] += factor * other.part[k];
    }
};

// Unit vectors along the links, and strength = k d0^2/(2 V G), by pair
struct linkTable
{
    const referenceNeighbours& pairs;
    List<scalar> x, y, z, strength;
};

// Four values from p on, or fewer if `last` comes first; zeros fill the rest
ISPF_INLINE simd4 fourOf(const scalar* values, pairIndex p, pairIndex last)
{
    simd4 four = {};
    if (p + 4 <= last) __builtin_memcpy(&four, values + p, sizeof four);
    else
        for (pairIndex k = p; k < last; ++k) four[k - p] = values[k];
    return four;
}

ISPF_INLINE void componentsOfFour(const linkTable& links, pairIndex p, pairIndex last,
                                  simd4 (&q)[15])
{
    quarticComponents(fourOf(links.x.data(), p, last), fourOf(links.y.data(), p, last),
                      fourOf(links.z.data(), p, last), q);
}

// C_i = sum over row i of multiplier times link tensor, in units of G, minus a given tensor
ISPF_HOT void sumTensors(const linkTable& links, const scalar* s, const paddedTensor& minus,
                         label begin, label end, paddedTensor* C)
{
    for (label i = begin; i < end; ++i)
    {
        const auto [first, last] = rowOf<among::all>(links.pairs, i);
        simd4 sum[15] = {}, q[15];
        for (pairIndex p = first; p < last; p += 4)
        {
            const simd4 factor = fourOf(s, p, last) * fourOf(links.strength.data(), p, last);
            componentsOfFour(links, p, last, q);
            for (int k = 0; k < 15; ++k) sum[k] += factor * q[k];
        }
        for (int k = 0; k < 15; ++k)
            C[i].data()[k] = ((sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3])) - minus.data()[k];
    }
}

// Sets the strength times link tensor . Q for each pair of row i
ISPF_HOT void alongLinks(const linkTable& links, label i, const paddedTensor& Q, scalar* result)
{
    const auto [first, last] = rowOf<among::all>(links.pairs, i);
    simd4 q[15];
    for (pairIndex p = first; p < last; p += 4)
    {
        componentsOfFour(links, p, last, q);
        simd4 sum = {};
        for (int k = 0; k < 15; ++k) sum += Q.data()[k] * q[k];
        sum *= fourOf(links.strength.data(), p, last);
        for (pairIndex k = p; k < std::min(p + 4, last); ++k) result[k] = sum[k - p];
    }
}

// Adds the factors times the tensors of the partners in row i.  The tensor of an image is rotated like the image
ISPF_HOT void addPartners(const referenceNeighbours& pairs, const List<quarticRotation>& rotation,
                          const scalar* factor, const paddedTensor* of, label i, paddedTensor& sum)
{
    paddedTensor total = sum;
    forNeighbours<among::all>(pairs, i, [&](pairIndex p, label j) {
        if (const label m = pairs.image[p]; m == 0) total.add(factor[p], of[j]);
        else total.add(factor[p], quarticTensor(rotation[m - 1] * of[j].tensor()));
    });
    sum = total;
}

class fit
{
public:
    fit(const structureReference& ref, const referenceNeighbours& pairs, scalar G, List<scalar>& k);
    stiffnessFitReport run();

private:
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
    linkTable links_;
    List<scalar> weight_, weightSum_,
        share_;  // share: weight of the pair over the sum of the partner
    List<quarticRotation> rotation_;
    List<paddedTensor> C_, mean_;
    List<scalar> half_;
};

fit::fit(const structureReference& ref, const referenceNeighbours& pairs, scalar G, List<scalar>& k)
    : ref_(ref),
      pairs_(pairs),
      target_(isotropicQuartic(ref.nDims)),
      k_(k),
      reverse_(pairs.reverse(ref)),
      links_{pairs, List<scalar>(k.size()), List<scalar>(k.size()), List<scalar>(k.size()),
             List<scalar>(k.size())},
      weight_(k.size()),
      weightSum_(ref.n(), 1),
      share_(k.size()),
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
        const vector apart = pairs.separation(ref, i, p), n = apart.normalized();
        const scalar d = apart.norm(), q = 1 - d / (1.001 * reach);
        links_.x[p] = n[0], links_.y[p] = n[1], links_.z[p] = n[2];
        weight_[p] = q * q * (3 - 2 * q);
        weightSum_[i] += weight_[p];
        links_.strength[p] = k[p] * d * d / (2 * ref.volume() * G);
    });
    forPairs<among::all>(pairs, 0, ref.n(), [&](label, pairIndex p, label j) {
        share_[p] = weight_[p] / weightSum_[j];
    });
    scale();
}

// Multiplies all links by one factor: the best fit of all particles' tensors to the target
void fit::scale()
{
    tensors(List<scalar>(k_.size(), 1), quarticTensor::Zero());
    scalar along = 0, square = 0;
    for (const paddedTensor& C : C_)
        along += C.tensor().dot(target_), square += C.tensor().squaredNorm();
    const scalar factor = along / square;
    for (size_t p = 0; p < k_.size(); ++p) k_[p] *= factor, links_.strength[p] *= factor;
}

void fit::tensors(const List<scalar>& s, const quarticTensor& minus)
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) { sumTensors(links_, s.data(), minus, begin, end, C_.data()); },
        256);
}

void fit::localMean()
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                paddedTensor mean = C_[i];
                addPartners(pairs_, rotation_, weight_.data(), C_.data(), i, mean);
                mean_[i] = paddedTensor();
                mean_[i].add(1 / weightSum_[i], mean);
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
                paddedTensor Q;
                Q.add(1 / weightSum_[i], mean_[i]);
                addPartners(pairs_, rotation_, share_.data(), mean_.data(), i, Q);
                alongLinks(links_, i, Q, half_.data());
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
    for (const paddedTensor& r : mean_) report.residual += r.tensor().squaredNorm();
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
