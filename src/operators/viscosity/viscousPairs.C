// SPDX-License-Identifier: GPL-3.0-or-later
#include "viscousPairs.H"
#include "pairViscosity.H"
#include "rawList.H"

namespace ispf
{

namespace
{

ISPF_HOT void applyRange(const neighbourList& list, const scalar* K, const vec4* phi, label begin,
                         label end, vec4* result)
{
    for (label i = begin; i < end; ++i)
    {
        result[i].s = sumNeighbours<among::all>(
            list, i, simd4{}, [&](pairIndex k, label j) { return K[k] * (phi[j].s - phi[i].s); });
    }
}

}  // namespace

void viscousPairs::setup(const stencil& s)
{
    cloud_ = &s.cloud, list_ = &s.list;
    List<scalar> c = sphc::laplacianScale(s);
    // The support of a strip's particle is truncated, and so is that of its image: c_i = 1
    for (label j = 0; j < s.cloud.nAll(); ++j)
        if (const label i = s.cloud.ownerOf(j); i >= 0 && s.cloud.beyondOpen(i)) c[j] = 1;
    remake(K_, s.list.index.size()), sum_.assign(s.cloud.n(), 0);
    const pairViscosity viscosity(s.cloud);
    forPairs<among::all>(s.list, 0, s.cloud.n(), [&](label i, pairIndex k, label j) {
        const scalar other = c[j] > 0 ? c[j] : c[i];
        K_[k] = 0.5 * (c[i] + other) * s.cloud.friction(i, j) * viscosity.of(i, j) *
                sphc::viscousF(s.cloud, s.list, k);
        sum_[i] += K_[k];
    });
    countPairs(s.list.nPairs(), sizeof(label) + 2 * sizeof(scalar));
}

void viscousPairs::apply(const List<vec4>& phi, List<vec4>& result, label first) const
{
    result.resize(cloud_->n());
    parallelFor(cloud_->n() - first, [&](label begin, label end) {
        applyRange(*list_, K_.data(), phi.data(), first + begin, first + end, result.data());
    });
    countPairs(list_->nPairs() - list_->start[first], sizeof(label) + sizeof(scalar));
}

// Splits the power of each pair, 2 K u_i.(u_i - u_j), into the dissipation K |u_i - u_j|^2 and the exchange
// K (u_i + u_j).(u_i - u_j).  The exchange cancels with the row of j, or of its image.  A wall has no row: its exchange goes
// to `walls`.  The friction of images in curved mirrors is not mutual: `walls` contains the difference
viscousPairs::power viscousPairs::powerOf(const List<vec4>& u) const
{
    const particleCloud& cloud = *cloud_;
    const auto row = [&](label i, power& sum) {
        const simd4 ui = u[i].s;
        const auto dot = [](const simd4& a, const simd4& b) {
            const simd4 ab = a * b;
            return ab[0] + ab[1] + ab[2];
        };
        forNeighbours<among::all>(*list_, i, [&](pairIndex k, label j) {
            const label owner = cloud.ownerOf(j);
            const simd4 uj = u[j].s, e = K_[k] * (ui - uj);
            const scalar all = 2 * dot(e, ui), half = dot(e, ui - uj);
            const bool clamped = owner >= 0 && cloud.uFixed[owner] && !cloud.isFluid(owner);
            if (owner >= 0 && cloud.beyondOpen(owner))
                sum.dissipated += half, sum.faces += all - half;
            else if (owner < 0 || clamped) sum.dissipated += 2 * half, sum.walls += all - 2 * half;
            else if (!cloud.isMedium(j)) sum.dissipated += half, sum.walls += all - half;
            else sum.dissipated += half;
        });
    };
    const List<scalar> sums = blockSums(cloud.n(), 3, [&](label begin, label end, scalar* of) {
        power sum;
        for (label i = begin; i < end; ++i)
            if (cloud.isFree(i)) row(i, sum);
        of[0] = sum.dissipated, of[1] = sum.walls, of[2] = sum.faces;
    });
    return {sums[0], sums[1], sums[2]};
}

}  // namespace ispf
