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

// The smallest size that is not exceeded within the radius around it, on the same side.  Single places towards a sharp
// edge, or on a flaw of the mesh, may be as thin as rounding
featureSize sustained(const List<featureSize>& sizes, const surfaceSearch& samples, scalar radius)
{
    constexpr scalar sameSide = 0.7;  // cosine
    const triSurface& s = samples.surface();
    List<label> order;
    for (label t = 0; t < s.size(); ++t)
        if (std::isfinite(sizes[t].size)) order.push_back(t);
    std::sort(order.begin(), order.end(), [&](label a, label b) {
        return std::make_pair(sizes[a].size, a) < std::make_pair(sizes[b].size, b);
    });
    featureSize best;
    for (const label t : order)
    {
        if (sizes[t].size >= best.size) break;
        featureSize here = sizes[t];
        boundBox around;
        around.add(vector(s.centre(t) - vector::Constant(radius)));
        around.add(vector(s.centre(t) + vector::Constant(radius)));
        for (const label u : samples.inBox(around))
            if (std::isfinite(sizes[u].size) && s.normal(u).dot(s.normal(t)) > sameSide &&
                (s.centre(u) - s.centre(t)).norm() <= radius)
                here.size = std::max(here.size, sizes[u].size);
        take(best, here);
    }
    return best;
}

}  // namespace

featureSizes smallestFeatures(const triSurface& surface, scalar spacing, bool flat)
{
    const surfaceSearch search(surface);
    triSurface samples = surface;
    const scalar reach = surface.bounds().diagonal(), off = 1e-9 * reach;
    refine(samples, 1.5 * std::max(spacing, std::sqrt(surface.area() / mostPoints)));
    List<featureSize> thickness(samples.size()), gap(samples.size());
    parallelFor(samples.size(), [&](label begin, label end) {
        for (label t = begin; t < end; ++t)
        {
            const vector n = samples.normal(t), x = samples.centre(t);
            if (n.squaredNorm() == 0 || (flat && std::abs(n[2]) > 0.9)) continue;
            thickness[t] = opposite(search, x, -n, reach, off);
            gap[t] = opposite(search, x, n, reach, off);
        }
    });
    const surfaceSearch places(std::move(samples));
    return {sustained(thickness, places, 0.5 * spacing), sustained(gap, places, 0.5 * spacing)};
}

}  // namespace ispf
