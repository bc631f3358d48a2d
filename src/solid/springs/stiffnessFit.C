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
struct alignas(32) paddedTensor
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

// Multipliers y = s + ahead (s - old), by pair
struct multipliers
{
    const scalar* s;
    const scalar* old;
    scalar ahead = 0;

    ISPF_INLINE simd4 at(pairIndex p, pairIndex last) const
    {
        const simd4 now = fourOf(s, p, last);
        return now + ahead * (now - fourOf(old, p, last));
    }
};

// Sets C to the sum over the four lanes, minus a given tensor
ISPF_INLINE void addLanes(const simd4 (&sum)[15], const paddedTensor& minus, paddedTensor& C)
{
    for (int k = 0; k < 15; ++k)
        C.data()[k] = ((sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3])) - minus.data()[k];
}

// C_i = sum over row i of multiplier times link tensor, in units of G, minus a given tensor
ISPF_HOT void sumTensors(const linkTable& links, multipliers y, const paddedTensor& minus,
                         label begin, label end, paddedTensor* C)
{
    for (label i = begin; i < end; ++i)
    {
        const auto [first, last] = rowOf<among::all>(links.pairs, i);
        simd4 sum[15] = {}, q[15];
        for (pairIndex p = first; p < last; p += 4)
        {
            const simd4 factor = y.at(p, last) * fourOf(links.strength.data(), p, last);
            componentsOfFour(links, p, last, q);
            for (int k = 0; k < 15; ++k) sum[k] += factor * q[k];
        }
        addLanes(sum, minus, C[i]);
    }
}

// The tensors of particles, and their rotations to images
struct tensorTable
{
    const referenceNeighbours& pairs;
    const List<quarticRotation>& rotation;
    const paddedTensor* of;

    // Tensor of the partner in pair p, rotated if the partner is an image
    ISPF_INLINE paddedTensor partner(pairIndex p) const
    {
        const paddedTensor& Q = of[pairs.index[p]];
        if (const label m = pairs.image[p]; m != 0)
            return quarticTensor(rotation[m - 1] * Q.tensor());
        return Q;
    }
};

// Rows a, b, c, d of a matrix become its columns
ISPF_INLINE void transpose(simd4& a, simd4& b, simd4& c, simd4& d)
{
    const simd4 ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7),
                cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
}

// Link tensor . (Q + partner) for four pairs.  q: components of the link tensors
ISPF_INLINE simd4 alongFour(const simd4 (&q)[15], const paddedTensor& Q, const paddedTensor& a,
                            const paddedTensor& b, const paddedTensor& c, const paddedTensor& d)
{
    simd4 sum = {};
    for (int m = 0; m < 4; ++m)
    {
        simd4 lane[4] = {a.part[m], b.part[m], c.part[m], d.part[m]};
        transpose(lane[0], lane[1], lane[2], lane[3]);
        for (int k = 0; k < (m < 3 ? 4 : 3); ++k) sum += (Q.part[m][k] + lane[k]) * q[4 * m + k];
    }
    return sum;
}

// strength times link tensor . (Q_i + Q_j) for up to four pairs of row i
ISPF_INLINE simd4 gradientOfFour(const linkTable& links, const tensorTable& Q, label i, pairIndex p,
                                 pairIndex last, const simd4 (&q)[15])
{
    const simd4 strength = fourOf(links.strength.data(), p, last);
    const std::int32_t* j = &links.pairs.index[p];
    if (p + 4 <= links.pairs.mid[i])  // no images
        return strength * alongFour(q, Q.of[i], Q.of[j[0]], Q.of[j[1]], Q.of[j[2]], Q.of[j[3]]);
    paddedTensor partner[4];
    for (pairIndex k = 0; k < std::min<pairIndex>(4, last - p); ++k) partner[k] = Q.partner(p + k);
    return strength * alongFour(q, Q.of[i], partner[0], partner[1], partner[2], partner[3]);
}

// Sets the gradient by pair
ISPF_HOT void gradientRange(const linkTable& links, const tensorTable& Q, label begin, label end,
                            scalar* g)
{
    for (label i = begin; i < end; ++i)
    {
        const auto [first, last] = rowOf<among::all>(links.pairs, i);
        simd4 q[15];
        for (pairIndex p = first; p < last; p += 4)
        {
            componentsOfFour(links, p, last, q);
            const simd4 four = gradientOfFour(links, Q, i, p, last, q);
            for (pairIndex k = p; k < std::min(p + 4, last); ++k) g[k] = four[k - p];
        }
    }
}

// A projected gradient step from y.  Afterwards `next` holds the new multipliers, and C the tensors minus the target for
// the y that follows if there is no restart
struct fitStep
{
    multipliers y;
    scalar length, nextAhead;
    const paddedTensor& target;
    scalar* next;  // may be y.old
    paddedTensor* C;
};

// Returns the sum of (y - next)(next - s): positive if the step leads uphill
ISPF_HOT scalar stepRange(const linkTable& links, const tensorTable& Q, const fitStep& step,
                          label begin, label end)
{
    simd4 uphill = {};
    for (label i = begin; i < end; ++i)
    {
        const auto [first, last] = rowOf<among::all>(links.pairs, i);
        simd4 sum[15] = {}, q[15];
        for (pairIndex p = first; p < last; p += 4)
        {
            componentsOfFour(links, p, last, q);
            const simd4 g = gradientOfFour(links, Q, i, p, last, q);
            const simd4 s = fourOf(step.y.s, p, last), y = step.y.at(p, last);
            simd4 next = y - step.length * (g + stayNear * (y - 1));
            next = next < least ? simd4{} + least : next;
            next = next > most ? simd4{} + most : next;
            const simd4 up = (y - next) * (next - s);
            if (p + 4 <= last)
            {
                __builtin_memcpy(step.next + p, &next, sizeof next);
                uphill += up;
            }
            else
                for (pairIndex k = p; k < last; ++k)
                    step.next[k] = next[k - p], uphill[0] += up[k - p];
            const simd4 factor =
                (next + step.nextAhead * (next - s)) * fourOf(links.strength.data(), p, last);
            for (int k = 0; k < 15; ++k) sum[k] += factor * q[k];
        }
        addLanes(sum, step.target, step.C[i]);
    }
    return (uphill[0] + uphill[1]) + (uphill[2] + uphill[3]);
}

// sum = sum + the weights times the tensors of the partners in row i
ISPF_HOT void addPartners(const tensorTable& C, const scalar* weight, label i, paddedTensor& sum)
{
    paddedTensor total = sum;
    forNeighbours<among::all>(C.pairs, i, [&](pairIndex p, label j) {
        if (C.pairs.image[p] == 0) total.add(weight[p], C.of[j]);
        else total.add(weight[p], C.partner(p));
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
    void tensors(multipliers y, const quarticTensor& minus);
    void localMean();
    tensorTable adjointMean();
    void gradient(List<scalar>& g);
    scalar steepness();

    const structureReference& ref_;
    const referenceNeighbours& pairs_;
    const quarticTensor target_;
    List<scalar>& k_;
    linkTable links_;
    List<scalar> weight_, weightSum_;
    List<quarticRotation> rotation_;
    List<paddedTensor> C_, mean_, adjoint_;  // mean_: over weightSum_
};

fit::fit(const structureReference& ref, const referenceNeighbours& pairs, scalar G, List<scalar>& k)
    : ref_(ref),
      pairs_(pairs),
      target_(isotropicQuartic(ref.nDims)),
      k_(k),
      links_{pairs, List<scalar>(k.size()), List<scalar>(k.size()), List<scalar>(k.size()),
             List<scalar>(k.size())},
      weight_(k.size()),
      weightSum_(ref.n(), 1),
      C_(ref.n()),
      mean_(ref.n()),
      adjoint_(ref.n())
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
    scale();
}

// Multiplies all links by one factor: the best fit of all particles' tensors to the target
void fit::scale()
{
    const List<scalar> ones(k_.size(), 1);
    tensors({ones.data(), ones.data()}, quarticTensor::Zero());
    scalar along = 0, square = 0;
    for (const paddedTensor& C : C_)
        along += C.tensor().dot(target_), square += C.tensor().squaredNorm();
    const scalar factor = along / square;
    for (size_t p = 0; p < k_.size(); ++p) k_[p] *= factor, links_.strength[p] *= factor;
}

void fit::tensors(multipliers y, const quarticTensor& minus)
{
    parallelFor(
        ref_.n(),
        [&](label begin, label end) { sumTensors(links_, y, minus, begin, end, C_.data()); }, 256);
}

void fit::localMean()
{
    const tensorTable C = {pairs_, rotation_, C_.data()};
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                paddedTensor mean = C_[i];
                addPartners(C, weight_.data(), i, mean);
                mean_[i] = paddedTensor();
                mean_[i].add(1 / (weightSum_[i] * weightSum_[i]), mean);
            }
        },
        256);
}

// The adjoint of localMean
tensorTable fit::adjointMean()
{
    const tensorTable mean = {pairs_, rotation_, mean_.data()};
    parallelFor(
        ref_.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                adjoint_[i] = mean_[i];
                addPartners(mean, weight_.data(), i, adjoint_[i]);
            }
        },
        256);
    return {pairs_, rotation_, adjoint_.data()};
}

// Gradient of 1/2 sum |mean|^2 with respect to the multipliers: the adjoint of localMean, then that of tensors
void fit::gradient(List<scalar>& g)
{
    const tensorTable Q = adjointMean();
    parallelFor(
        ref_.n(), [&](label begin, label end) { gradientRange(links_, Q, begin, end, g.data()); },
        256);
}

// Largest eigenvalue of the quadratic form, by power iteration
scalar fit::steepness()
{
    List<scalar> v(k_.size()), g(k_.size());
    const List<std::int64_t> reverse = pairs_.reverse(ref_);
    for (size_t p = 0; p < v.size(); ++p)
        v[p] =
            1 + 0.3 * std::sin(7.3 * scalar(std::min<std::int64_t>(std::int64_t(p), reverse[p])));
    scalar value = 0;
    for (int k = 0; k < 15; ++k)
    {
        tensors({v.data(), v.data()}, quarticTensor::Zero());
        localMean();
        gradient(g);
        value = norm(g) / norm(v);
        for (size_t p = 0; p < v.size(); ++p) v[p] = g[p] / value;
    }
    return value;
}

stiffnessFitReport fit::run()
{
    const scalar length = 1 / (1.05 * steepness() + stayNear);
    const paddedTensor target = target_;
    List<scalar> s(k_.size(), 1), old = s;
    scalar momentum = 1, ahead = 0;
    tensors({s.data(), old.data()}, target_);
    for (int k = 0; k < iterations; ++k)
    {
        localMean();
        const auto after = [](scalar m) { return 0.5 * (1 + std::sqrt(1 + 4 * m * m)); };
        const scalar nextAhead = (momentum - 1) / after(momentum);
        const fitStep step = {
            {s.data(), old.data(), ahead}, length, nextAhead, target, old.data(), C_.data()};
        const tensorTable Q = adjointMean();
        const scalar uphill = parallelSum(ref_.n(), [&](label begin, label end) {
            return stepRange(links_, Q, step, begin, end);
        });
        s.swap(old);
        ahead = nextAhead, momentum = after(momentum);
        if (uphill <= 0) continue;
        ahead = 0, momentum = after(1);
        tensors({s.data(), old.data()}, target_);
    }
    stiffnessFitReport report{s[0], s[0], 0};
    for (size_t p = 0; p < s.size(); ++p)
    {
        k_[p] *= s[p];
        report.least = std::min(report.least, s[p]), report.most = std::max(report.most, s[p]);
    }
    tensors({s.data(), s.data()}, target_);
    localMean();
    for (label i = 0; i < ref_.n(); ++i)
        report.residual += (weightSum_[i] * mean_[i].tensor()).squaredNorm();
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
