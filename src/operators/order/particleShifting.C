// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleShifting.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Way of the fastest particle in a step [dx] from which on the second term of (8.30) is taken in full (doc/constants.md)
constexpr scalar inFull = 0.1;
// A fluid particle between two or three solid ones needs a few
constexpr int mostSweeps = 10;

// sum_j (r_mean/r_ij)^2 n_ij = r_mean^2 sum_j x_ij / r_ij^3, over all neighbours of i
ISPF_INLINE vector crowding(const particleCloud& cloud, const neighbourList& list, label i)
{
    simd4 sum = {};
    scalar rSum = 0;
    forNeighbours<among::all>(list, i, [&](pairIndex, label j) {
        const simd4 d = cloud.x[i].s - cloud.x[j].s;
        const scalar r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], r = std::sqrt(r2);
        sum += d / (r2 * r);
        rSum += r;
    });
    const scalar n = scalar(rowOf<among::all>(list, i).size());
    return rSum * rSum / (n * n) * vector(sum[0], sum[1], sum[2]);
}

// V sum_j grad W_ij, over all neighbours of i
ISPF_INLINE vector slopeOfSum(const particleCloud& cloud, const neighbourList& list, label i)
{
    const simd4 sum = sumNeighbours<among::all>(list, i, simd4{}, [&](pairIndex k, label j) {
        return list.F[k] * (cloud.x[i].s - cloud.x[j].s);
    });
    return {sum[0], sum[1], sum[2]};
}

// Makes dr lead i away from solid particles nearer than `reach`, by what it lacks or by `most`: their layer has no room for it.
// The sweeps end once dr leads away from each by half of that.  dr is zero if several leave it no way
void keepOff(const particleCloud& cloud, const neighbourList& list, label i, scalar reach,
             scalar most, vector& dr)
{
    bool changed = true;
    for (int sweep = 0; changed; ++sweep)
    {
        if (sweep == mostSweeps)
        {
            dr.setZero();
            return;
        }
        changed = false;
        forNeighbours<among::others>(list, i, [&](pairIndex, label j) {
            const label owner = cloud.ownerOf(j);
            if (owner < 0 || cloud.isFluid(owner)) return;
            const vector d = cloud.x[i].xyz() - cloud.x[j].xyz();
            const scalar r = d.norm(), along = dr.dot(d) / r, wanted = std::min(reach - r, most);
            if (!(wanted > 0) || r == 0 || along > 0.5 * wanted) return;
            dr += (wanted - along) / r * d;
            changed = true;
        });
    }
}

}  // namespace

particleShifting::particleShifting(const dictionary& dict, const word& frame,
                                   const shiftStiffness& stiffness)
    : stiffness_(stiffness)
{
    if (dict.chooseOrDefault("type", {"Xu", "none"}, "Xu") == "none") return;
    constant_ = dict.getInRangeOrDefault("constant", 0, 1, 0.2);
    closing_ = dict.getInRangeOrDefault("closing", 0, 2, 0.7);
    maxShift_ = dict.getInRangeOrDefault("maxShift", 0, 0.2, 0.05);
    closest_ = dict.getInRangeOrDefault("closest", 0, 0.9, 0.4);
    againstMean_ = dict.chooseOrDefault("frame", {"still", "mean"}, frame) == "mean";
}

scalar particleShifting::speed(const particleCloud& cloud) const
{
    if (!againstMean_) return cloud.maxSpeed();
    const label n = cloud.n();
    vector mean;
    for (int d = 0; d < 3; ++d)
        mean[d] = parallelSum(n,
                              [&](label begin, label end) {
                                  scalar sum = 0;
                                  for (label i = begin; i < end; ++i) sum += cloud.Up[i][d];
                                  return sum;
                              }) /
                  n;
    return std::sqrt(maxOf(n, [&](label begin, label end) {
        scalar most = 0;
        for (label i = begin; i < end; ++i)
            most = std::max(most, (cloud.Up[i].xyz() - mean).squaredNorm());
        return most;
    }));
}

word particleShifting::describe() const
{
    if (!on()) return "none";
    return "Xu, constant " + str(constant_) + ", closing " + str(closing_) + ", at most " +
           str(maxShift_) + " dx, pairs kept " + str(closest_) + " dx apart" +
           (againstMean_ ? ", by the speed against the mean" : "");
}

namespace
{

// dr.grad u, shortened so that u_i plus it stays within the range of the neighbours' velocities in its direction
vector limitedChange(const particleCloud& cloud, const neighbourList& list, const tensor& B,
                     label i, const vector& dr)
{
    const simd4 ui = cloud.Up[i].s;
    simd4 gx = {}, gy = {}, gz = {};
    forNeighbours<among::same>(list, i, [&](pairIndex k, label j) {
        const simd4 g = list.F[k] * (cloud.x[i].s - cloud.x[j].s), e = cloud.Up[j].s - ui;
        gx += e * g[0], gy += e * g[1], gz += e * g[2];
    });
    const vector w = B.transpose() * dr;
    const simd4 change = w[0] * gx + w[1] * gy + w[2] * gz;
    const vector v(change[0], change[1], change[2]);
    const scalar size = v.norm();
    if (size == 0) return v;
    const vector along = v / size;
    scalar high = 0;
    const auto differs = [&](label j) { return along.dot(cloud.Up[j].xyz() - cloud.Up[i].xyz()); };
    forNeighbours<among::same>(list, i,
                               [&](pairIndex, label j) { high = std::max(high, differs(j)); });
    // an image is as far beyond the wall as its owner is before the wall
    forNeighbours<among::walls>(list, i, [&](pairIndex, label j) {
        high = std::max(high, (cloud.ownerOf(j) >= 0 ? 0.5 : 1) * differs(j));
    });
    return std::min(size, high) * along;
}

// Shortens the vectors v so that their sum is zero along directions that symmetry planes do not turn.  Each v is multiplied
// by 1 - p, p = m.v/|v| within [0, 1]; Newton finds m (the equation is linear between changes of sign of m.v)
void balance(const particleCloud& cloud, List<vector>& v)
{
    const tensor free = cloud.freeDirections();
    vector m = vector::Zero();
    const auto part = [&](const vector& a, scalar size) {
        return std::clamp(m.dot(a) / size, scalar(0), scalar(1));
    };
    for (int iteration = 0; iteration < 30; ++iteration)
    {
        vector sum = vector::Zero();
        tensor slope = tensor::Zero();
        scalar lengths = 0;
        for (const vector& a : v)
        {
            const scalar size = a.norm();
            if (size == 0) continue;
            const scalar p = part(a, size);
            sum += (1 - p) * a, lengths += size;
            if (p > 0 || iteration == 0)
                slope += (iteration == 0 ? 0.5 : 1) / size * a * a.transpose();
        }
        sum = free * sum;
        if (!(sum.norm() > 1e-15 * lengths)) break;
        slope = free * slope * free + lengths * (tensor::Identity() - free) +
                1e-12 * lengths * tensor::Identity();
        m += slope.ldlt().solve(sum);
    }
    for (vector& a : v)
        if (const scalar size = a.norm(); size > 0) a *= 1 - part(a, size);
}

}  // namespace

scalar particleShifting::shift(particleCloud& cloud, const neighbourList& list,
                               const kernelCorrection& correction, scalar dt, scalar allowance,
                               const std::function<void(label, vector&)>& confine) const
{
    const scalar way = speed(cloud) * dt, dx = cloud.dx, most = maxShift_ * dx;
    if (!on() || !(way > 0)) return 0;
    scalar alpha = constant_ * way,
           beta = closing_ * dx * dx * std::min(way / (inFull * dx), scalar(1));
    const scalar gain = alpha / dx * stiffness_.crowding + beta / (dx * dx) * stiffness_.closing;
    // (8.37): a gain above 2 enlarges the stiffest wave
    if (constexpr scalar most = 2; gain > most) alpha *= most / gain, beta *= most / gain;
    cloud.fillGhosts(cloud.Up, false);
    const label first = cloud.nSolid(), nFluid = cloud.n() - first;
    List<vector> shifts(nFluid, vector::Zero()), v(nFluid, vector::Zero());
    parallelFor(nFluid, [&](label begin, label end) {
        for (label k = begin; k < end; ++k)
        {
            const label i = first + k;
            if (rowOf<among::all>(list, i).size() == 0) continue;
            vector dr = alpha * crowding(cloud, list, i) - beta * slopeOfSum(cloud, list, i);
            if (first > 0) keepOff(cloud, list, i, closestToSolid() * dx, std::min(way, most), dr);
            if (const scalar size = dr.norm(); size > most) dr *= most / size;
            if (confine) confine(i, dr);
            shifts[k] = dr, v[k] = limitedChange(cloud, list, correction.same[i], i, dr);
        }
    });
    if (cloud.surface.empty()) balance(cloud, v);
    // t is the largest number, at most 1, with b t^2 + a t <= allowance
    scalar a = 0, b = 0;
    for (label k = 0; k < nFluid; ++k)
        a += cloud.Up[first + k].xyz().dot(v[k]), b += 0.5 * v[k].squaredNorm();
    allowance = std::max(allowance, scalar(0));
    const scalar root = std::sqrt(a * a + 4 * b * allowance);
    const scalar t = a + b <= allowance ? 1
                     : a > 0            ? 2 * allowance / (a + root)
                                        : (root - a) / (2 * b);
    for (label k = 0; k < nFluid; ++k)
    {
        cloud.x[first + k].s += vec4::from(shifts[k]).s;
        cloud.Up[first + k].s += t * vec4::from(v[k]).s;
    }
    return a * t + b * t * t;
}

}  // namespace ispf
