// SPDX-License-Identifier: GPL-3.0-or-later
#include "densityFeedback.H"

#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

constexpr label fewest = 100;   // particles whose mean tells anything
constexpr scalar longest = 30;  // [dx] of a zone that has the whole rate

scalar sqr(scalar a)
{
    return a * a;
}

// Sum of laplacian W over the neighbours on the lattice, over the sum of (grad W)^2 V.  With F = W'/r
// laplacian W = nDims F + 2 r^2 dF/d(r^2)
scalar disorderExcess(const smoothingKernel& kernel, int nDims, scalar dx)
{
    const auto F = [&](scalar rSqr) {
        scalar value;
        kernel.F(&rSqr, &value, 1);
        return value;
    };
    constexpr scalar part = 1e-4;
    const auto laplacian = [&](scalar r) {
        const scalar slope = (F(r * r * (1 + part)) - F(r * r * (1 - part))) / part;
        return r > 0 ? nDims * F(r * r) + slope : 0;
    };
    const auto squaredGradient = [&](scalar r) { return sqr(F(r * r) * r); };
    return kernel.latticeSum(dx, laplacian) / kernel.latticeSum(dx, squaredGradient) /
           std::pow(dx, nDims);
}

// Work space of a thread
struct row
{
    List<scalar> rSqr, W;
};

scalar kernelSum(const particleCloud& cloud, const neighbourList& list,
                 const smoothingKernel& kernel, label i, row& r)
{
    const std::int64_t first = list.start[i];
    const label n = label(list.start[i + 1] - first);
    r.rSqr.resize(n + 1), r.W.resize(n + 1);
    for (label k = 0; k < n; ++k)
    {
        const simd4 d = cloud.x[i].s - cloud.x[list.index[first + k]].s;
        r.rSqr[k] = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    }
    r.rSqr[n] = 0;
    kernel.W(r.rSqr.data(), r.W.data(), n + 1);
    scalar sum = 0;
    for (const scalar W : r.W) sum += W;
    return cloud.volume() * sum;
}

// Kernel sums s of those particles of which isOf(i) is true
struct density
{
    label n = 0;
    scalar mean = 0, variance = 0;

    template <class IsOf>
    density(const particleCloud& cloud, const neighbourList& list, const smoothingKernel& kernel,
            IsOf&& isOf)
    {
        const label first = cloud.nSolid(), nFluid = cloud.n() - first;
        List<scalar> s(nFluid, 0);
        parallelFor(nFluid, [&](label begin, label end) {
            row r;
            for (label k = begin; k < end; ++k)
                if (isOf(first + k)) s[k] = kernelSum(cloud, list, kernel, first + k, r);
        });
        for (const scalar v : s) mean += v, n += v > 0;
        mean /= n;
        scalar deviation = 0;
        for (const scalar v : s)
            if (v > 0) deviation += std::abs(v - mean) / n;
        variance = 0.5 * M_PI * sqr(deviation);  // as if normal: outliers shall not rule
    }
};

// Largest side of the box around those particles of which isOf(i) is true
template <class IsOf>
scalar extent(const particleCloud& cloud, IsOf&& isOf)
{
    vector low = vector::Constant(std::numeric_limits<scalar>::max()), high = -low;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (isOf(i)) low = low.cwiseMin(cloud.x[i].xyz()), high = high.cwiseMax(cloud.x[i].xyz());
    return (high - low).maxCoeff();
}

}  // namespace

densityFeedback::densityFeedback(const dictionary& solution, const smoothingKernel& kernel,
                                 const particleCloud& cloud)
    : kernel_(kernel),
      cloud_(cloud),
      constant_(solution.getInRangeOrDefault("densityFeedback", 0, 1, cloud.wallsApart ? 0 : 1)),
      latticeSum_(kernel.latticeSum(cloud.dx)),
      k_(disorderExcess(kernel, cloud.nDims, cloud.dx))
{
    if (const auto known = cloud.history.find(startDensity); known != cloud.history.end())
        start_ = known->second;
    start_.resize(cloud.zones.size(), 0);
}

void densityFeedback::addTo(List<scalar>& q, const neighbourList& list, const List<char>& drained,
                            const std::function<bool(label)>& isCut)
{
    added_ = 0;
    const scalar speed = constant_ * cloud_.maxSpeed();
    const auto isOf = [&](label i, label z) {
        return drained[i] && cloud_.zone[i] == z && q[i] == 0;
    };
    for (label z = 0; z < label(cloud_.zones.size()); ++z)
    {
        if (cloud_.zones[z].phase != phaseType::fluid || (speed == 0 && start_[z] > 0)) continue;
        const auto counts = [&](label i) {
            return isOf(i, z) && !cloud_.beyondOpen(i) && !isCut(i);
        };
        const density s(cloud_, list, kernel_, counts);
        if (s.n < fewest) continue;
        const scalar d = (s.mean - k_ * s.variance) / latticeSum_;
        if (start_[z] == 0) start_[z] = d;
        const scalar length = std::max(cloud_.dx, extent(cloud_, counts) / longest);
        const scalar source = speed / length * (d - 0.5 * (1 + start_[z]));
        for (label i = cloud_.nSolid(); i < cloud_.n(); ++i)
            if (isOf(i, z) && !cloud_.beyondOpen(i))
                q[i] = source, added_ += source * cloud_.volume();
    }
}

void densityFeedback::book(particleCloud& cloud, scalar dt) const
{
    if (constant_ == 0) return;
    List<scalar>& booked = cloud.history[fluidFeedback];
    booked.resize(1, 0);
    booked[0] += added_ * dt;
    cloud.history[startDensity] = start_;
}

}  // namespace ispf
