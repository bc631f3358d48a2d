// SPDX-License-Identifier: GPL-3.0-or-later
#include "referenceGradient.H"
#include "forPairs.H"
#include "messages.H"
#include "pointGrid.H"

#include <numeric>

namespace ispf
{

namespace
{

// [dx] a particle at a sharp tip follows one no farther away than this
constexpr scalar followReach = 8;

// Sum of w (x_j - x_i)(X_j - X_i)^T over the pairs of row i without images
ISPF_HOT void addOwn(const referenceNeighbours& pairs, const scalar* weight, const vec4* x,
                     const vec4* X, label i, tensor& S)
{
    simd4 c0 = {}, c1 = {}, c2 = {};
    const simd4 xi = x[i].s, Xi = X[i].s;
    forNeighbours<among::same>(pairs, i, [&](pairIndex k, label j) {
        const simd4 R = X[j].s - Xi, d = weight[k] * (x[j].s - xi);
        c0 += d * R[0], c1 += d * R[1], c2 += d * R[2];
    });
    for (int a = 0; a < 3; ++a) S(a, 0) += c0[a], S(a, 1) += c1[a], S(a, 2) += c2[a];
}

// Sum of w (A_i + A_j)(X_j - X_i) over the pairs of row i without images; A is stored by columns, three each
ISPF_HOT void ownForce(const referenceNeighbours& pairs, const scalar* weight, const vec4* X,
                       const vec4* A, label i, simd4& f)
{
    simd4 sum = {}, arm = {};
    const simd4 Xi = X[i].s;
    forNeighbours<among::same>(pairs, i, [&](pairIndex k, label j) {
        const simd4 r = weight[k] * (X[j].s - Xi);
        arm += r, sum += A[3 * j].s * r[0] + A[3 * j + 1].s * r[1] + A[3 * j + 2].s * r[2];
    });
    f = sum + A[3 * i].s * arm[0] + A[3 * i + 1].s * arm[1] + A[3 * i + 2].s * arm[2];
}

// The same sum over images; A_j turns with them
vector imageForce(const referenceNeighbours& pairs, const structureReference& ref,
                  const scalar* weight, const List<tensor>& A, label i)
{
    vector f = vector::Zero();
    forNeighbours<among::others>(pairs, i, [&](pairIndex k, label j) {
        const tensor& R = ref.images[pairs.image[k] - 1].R;
        const vector r = -weight[k] * pairs.separation(ref, i, k);
        f += A[i] * r + R * (A[j] * (R.transpose() * r));
    });
    return f;
}

}  // namespace

referenceGradient::referenceGradient(const structureReference& ref)
    : ref_(ref),
      pairs_(ref, ref.support),
      X_(ref.n()),
      weight_(size_t(pairs_.nPairs())),
      B_(ref.n()),
      leader_(ref.n())
{
    std::iota(leader_.begin(), leader_.end(), 0);
    for (label i = 0; i < ref.n(); ++i) X_[i] = vec4::from(ref.x0[i]);
    const scalar dx2 = ref.dx * ref.dx;
    parallelFor(
        ref.n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                tensor moment = tensor::Zero();
                forNeighbours<among::all>(pairs_, i, [&](pairIndex k, label) {
                    const vector r = pairs_.separation(ref, i, k);
                    const scalar w = std::max(1e-6, 1 - r.norm() / ref.support);
                    weight_[k] = w * w * w;
                    moment += weight_[k] * r * r.transpose();
                });
                if (ref.nDims == 2) moment(2, 2) = 0.5 * moment.trace();
                const scalar mean = moment.trace() / 3;
                const bool spans =
                    moment.determinant() > 1e-4 * mean * mean * mean && mean >= 1e-9 * dx2;
                if (spans) B_[i] = moment.inverse();
                else B_[i].setZero(), leader_[i] = -1;
            }
        },
        64);
    findLeaders();
}

void referenceGradient::findLeaders()
{
    for (label i = 0; i < ref_.n(); ++i)
        if (leader_[i] < 0) followers_.push_back(i);
    if (followers_.empty()) return;
    const scalar reach = followReach * ref_.dx;
    pointGrid spanning(reach);
    List<label> source;
    for (label i = 0; i < ref_.n(); ++i)
        if (leader_[i] == i) spanning.add(ref_.x0[i]), source.push_back(i);
    const auto zoneOf = [&](label i) { return ref_.zone.empty() ? 0 : ref_.zone[i]; };
    for (const label i : followers_)
    {
        const vector& X = ref_.x0[i];
        scalar least = reach;
        spanning.within(X, reach, [&](label k, scalar r) {
            if (r < least && zoneOf(source[k]) == zoneOf(i)) least = r, leader_[i] = source[k];
        });
        if (leader_[i] < 0)
            throw fatalError(
                "Solid particle " + std::to_string(i) + " at (" + str(X[0]) + " " + str(X[1]) +
                " " + str(X[2]) + ") has " + std::to_string(pairs_.count(i)) +
                " solid neighbours, all in one " + (ref_.nDims == 3 ? "plane" : "line") +
                ", and no particle within " + str(followReach) +
                " dx whose neighbours are not: the wall is less than two layers thick there. "
                "Use a smaller dx");
    }
}

void referenceGradient::evaluateRange(const List<vec4>& x, scalar shift, label begin, label end,
                                      tensor* F) const
{
    for (label i = begin; i < end; ++i)
    {
        tensor S = tensor::Zero();
        addOwn(pairs_, weight_.data(), x.data(), X_.data(), i, S);
        forNeighbours<among::others>(pairs_, i, [&](pairIndex k, label j) {
            const isometry& image = ref_.images[pairs_.image[k] - 1];
            const vector xj = image.R * x[j].xyz() + shift * image.t;
            S -= weight_[k] * (xj - x[i].xyz()) * pairs_.separation(ref_, i, k).transpose();
        });
        F[i] = S * B_[i];
        if (ref_.nDims == 2) F[i](2, 2) = shift;
    }
}

void referenceGradient::evaluate(const List<vec4>& x, scalar shift, List<tensor>& F) const
{
    F.resize(ref_.n());
    parallelFor(
        ref_.n(), [&](label begin, label end) { evaluateRange(x, shift, begin, end, F.data()); },
        256);
    for (const label i : followers_) F[i] = F[leader_[i]];
}

void referenceGradient::apply(const List<vec4>& x, List<tensor>& F) const
{
    evaluate(x, 1, F);
}

void referenceGradient::applyLinear(const List<vec4>& u, List<tensor>& dF) const
{
    evaluate(u, 0, dF);
}

void referenceGradient::forces(const List<tensor>& P, List<vec4>& f) const
{
    const label n = ref_.n();
    List<tensor> A(n);
    List<vec4> columns(3 * n);
    forEach(0, n, [&](label i) { A[i] = ref_.volume() * P[i] * B_[i]; });
    for (const label i : followers_) A[leader_[i]] += ref_.volume() * P[i] * B_[leader_[i]];
    forEach(0, n, [&](label i) {
        for (int b = 0; b < 3; ++b) columns[3 * i + b] = vec4::from(A[i].col(b));
    });
    f.resize(std::max<size_t>(f.size(), size_t(n)));
    parallelFor(
        n,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                simd4 own;
                ownForce(pairs_, weight_.data(), X_.data(), columns.data(), i, own);
                f[i].s = own + vec4::from(imageForce(pairs_, ref_, weight_.data(), A, i)).s;
            }
        },
        256);
}

}  // namespace ispf
