// SPDX-License-Identifier: GPL-3.0-or-later
#include "featureSize.H"

#include "execution.H"
#include "surfaceRefinement.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar mostPoints = 2e5;
constexpr scalar lookingBack = -0.7;  // cosine between the normals

// The face opposite to x along `way`; infinite if there is none
featureSize opposite(const surfaceSearch& search, const vector& x, const vector& way, scalar reach,
                     scalar off)
{
    featureSize found;
    const vector n = way.normalized();
    const surfaceHit hit = search.firstHit(x + off * n, x + reach * n);
    // the normal there must look back at x, seen from the same side of the surface
    if (!hit.found) return found;
    const scalar cosine = search.surface().normal(hit.triangle).dot(n);
    if (std::abs(cosine) < -lookingBack) return found;
    found.size = (hit.point - x).norm();
    found.at = 0.5 * (x + hit.point);
    return found;
}

void take(featureSize& best, const featureSize& other)
{
    if (other.size < best.size) best = other;
}

}  // namespace

featureSizes smallestFeatures(const triSurface& surface, scalar spacing, bool flat)
{
    const surfaceSearch search(surface);
    triSurface samples = surface;
    const scalar reach = surface.bounds().diagonal(), off = 1e-9 * reach;
    refine(samples, 1.5 * std::max(spacing, std::sqrt(surface.area() / mostPoints)));
    constexpr label block = 1024;
    const label nBlocks = (samples.size() + block - 1) / block;
    List<featureSizes> perBlock(nBlocks);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                for (label t = i * block; t < std::min(samples.size(), (i + 1) * block); ++t)
                {
                    const vector n = samples.normal(t), x = samples.centre(t);
                    if (n.squaredNorm() == 0 || (flat && std::abs(n[2]) > 0.9)) continue;
                    take(perBlock[i].thickness, opposite(search, x, -n, reach, off));
                    take(perBlock[i].gap, opposite(search, x, n, reach, off));
                }
        },
        1);
    featureSizes smallest;
    for (const featureSizes& f : perBlock)
        take(smallest.thickness, f.thickness), take(smallest.gap, f.gap);
    return smallest;
}

}  // namespace ispf
