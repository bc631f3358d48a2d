// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceCover.H"
#include "imagedPoints.H"
#include "execution.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Reach of the kernel [dx]: layers of feet are no lattice, and a narrower kernel would see them one by one
constexpr scalar reachByDx = 4;
// |sum S.n w t| over reach C, above which a point is near an end or edge: packed walls have 0.003, at most 0.012; half a
// reach from an edge it is 0.018
constexpr scalar offCentre = 0.015;
constexpr scalar largest = 1.25;

// Wendland's C2, without its norm; q = |t|/reach
scalar weight(scalar q)
{
    return q < 1 ? std::pow(1 - q, 4) * (1 + 4 * q) : 0;
}

// Sum of the weights about a point of a lattice with spacing dx
scalar latticeCover(int nDims)
{
    constexpr int m = int(reachByDx);
    scalar sum = 0;
    for (int i = -m; i <= m; ++i)
        for (int k = nDims == 3 ? -m : 0; k <= (nDims == 3 ? m : 0); ++k)
            sum += weight(std::hypot(i, k) / reachByDx);
    return sum;
}

}  // namespace

List<scalar> coverFactors(const List<vector>& x, const List<vector>& S, int nDims, scalar dx,
                          const List<isometry>& images)
{
    const label n = label(x.size());
    const scalar reach = reachByDx * dx, full = latticeCover(nDims) * std::pow(dx, nDims - 1);
    const imagedPoints feet(x, reach, images);
    const auto areaOf = [&](label k) -> vector {
        const vector& A = S[feet.source[k]];
        return feet.image[k] == 0 ? A : images[feet.image[k] - 1].R * A;
    };
    // Calls visit(source, projected area times weight, t) for all vectors that the tangent plane at point i sees
    const auto around = [&](label i, auto&& visit) {
        const vector normal = S[i].normalized();
        feet.grid.within(x[i], reach, [&](label k, scalar) {
            const vector d = feet.grid[k] - x[i], t = d - d.dot(normal) * normal;
            const scalar area = areaOf(k).dot(normal);
            if (area > 0) visit(feet.source[k], area * weight(t.norm() / reach), t);
        });
    };

    List<scalar> factor(n, 0);  // 0: not known
    parallelFor(
        n,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                scalar cover = 0;
                vector first = vector::Zero();
                around(i, [&](label, scalar w, const vector& t) { cover += w, first += w * t; });
                if (first.norm() < offCentre * reach * cover)
                    factor[i] = std::clamp(full / cover, 1 / largest, largest);
            }
        },
        64);
    const List<scalar> known = factor;
    for (label i = 0; i < n; ++i)
    {
        if (known[i] > 0) continue;
        scalar sum = 0, mean = 0;
        const auto take = [&](label j, scalar w) {
            if (known[j] > 0) sum += w, mean += w * known[j];
        };
        around(i, [&](label j, scalar w, const vector&) { take(j, w); });
        // a narrow face, such as the end of a flag: takes the factors around the corner
        if (sum == 0)
            feet.grid.within(x[i], reach,
                             [&](label k, scalar r) { take(feet.source[k], weight(r / reach)); });
        factor[i] = sum > 0 ? mean / sum : 1;
    }
    return factor;
}

}  // namespace ispf
