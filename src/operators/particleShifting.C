// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleShifting.H"
#include "pairSums.H"

#include <cmath>

namespace ispf
{

namespace
{

struct change
{
    vec4 x, Up;
};

// sum_j (r_mean/r_ij)^2 n_ij = r_mean^2 sum_j x_ij / r_ij^3, all neighbours of i
ISPF_INLINE vector crowding(const particleCloud& cloud, const neighbourList& list, label i)
{
    simd4 sum = {};
    scalar rSum = 0;
    for (std::int64_t k = list.start[i]; k < list.start[i + 1]; ++k)
    {
        const simd4 d = cloud.x[i].s - cloud.x[list.index[k]].s;
        const scalar r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], r = std::sqrt(r2);
        sum += d / (r2 * r);
        rSum += r;
    }
    const scalar n = scalar(list.start[i + 1] - list.start[i]);
    return rSum * rSum / (n * n) * vector(sum[0], sum[1], sum[2]);
}

struct shiftRows
{
    const particleCloud& cloud;
    const neighbourList& list;
    const kernelCorrection& correction;
    const std::function<bool(label)>& leaveAlone;
    scalar alpha, most;

    // Without a one-sided gradient the fields could not follow
    bool moves(label i) const
    {
        return list.start[i] != list.start[i + 1] && !correction.same[i].isZero(0) &&
               !(leaveAlone && leaveAlone(i));
    }
};

ISPF_HOT void evaluate(const shiftRows& s, label begin, label end, change* result)
{
    for (label i = begin; i < end; ++i, ++result)
    {
        *result = change{};
        if (!s.moves(i)) continue;
        vector dr = s.alpha * crowding(s.cloud, s.list, i);
        const scalar size = dr.norm();
        if (size > s.most) dr *= s.most / size;
        pairSums sums;
        sums.add(s.list, s.cloud.x.data(), s.cloud.Up.data(), i, s.list.start[i], s.list.mid[i]);
        const vector w = s.correction.same[i].transpose() * dr;
        result->x = vec4::from(dr);
        result->Up.s = w[0] * sums.gx + w[1] * sums.gy + w[2] * sums.gz;
    }
}

}  // namespace

particleShifting::particleShifting(const dictionary& dict, const word& frame)
{
    if (dict.chooseOrDefault("type", {"Xu", "none"}, "Xu") == "none") return;
    constant_ = dict.getInRangeOrDefault("constant", 0, 1, 0.1);
    maxShift_ = dict.getInRangeOrDefault("maxShift", 0, 0.2, 0.05);
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
    return "Xu, constant " + str(constant_) + ", at most " + str(maxShift_) + " dx" +
           (againstMean_ ? ", by the speed against the mean" : "");
}

void particleShifting::shift(particleCloud& cloud, const neighbourList& list,
                             const kernelCorrection& correction, scalar dt,
                             const std::function<bool(label)>& leaveAlone) const
{
    const shiftRows rows{
        cloud, list, correction, leaveAlone, constant_ * speed(cloud) * dt, maxShift_ * cloud.dx};
    if (!(rows.alpha > 0)) return;
    cloud.fillGhosts(cloud.Up, false);

    const label first = cloud.nSolid(), nFluid = cloud.n() - first;
    List<change> changes(nFluid);
    parallelFor(nFluid, [&](label begin, label end) {
        evaluate(rows, first + begin, first + end, &changes[begin]);
    });
    parallelFor(nFluid, [&](label begin, label end) {
        for (label k = begin; k < end; ++k)
        {
            cloud.x[first + k].s += changes[k].x.s;
            cloud.Up[first + k].s += changes[k].Up.s;
        }
    });
}

}  // namespace ispf
