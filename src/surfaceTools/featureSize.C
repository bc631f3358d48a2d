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

// The smallest thickness or gap: sizes at the centres of the samples, along their normals times `side`.  It must not be
// exceeded at the radius around, on the same side: single places towards a sharp edge, or on a flaw of the mesh, may be
// as thin as rounding
class smallest
{
public:
    smallest(const surfaceSearch& search, const triSurface& samples, scalar side, bool flat)
        : search_(search),
          samples_(samples),
          side_(side),
          reach_(search.surface().bounds().diagonal()),
          flat_(flat)
    {
    }

    featureSize find(scalar radius) const
    {
        List<scalar> sizes(samples_.size(), std::numeric_limits<scalar>::infinity());
        parallelFor(samples_.size(), [&](label begin, label end) {
            for (label t = begin; t < end; ++t)
                if (const vector n = samples_.normal(t);
                    n.squaredNorm() > 0 && !(flat_ && std::abs(n[2]) > 0.9))
                    sizes[t] = at(samples_.centre(t), n).size;
        });
        List<label> order;
        for (label t = 0; t < samples_.size(); ++t)
            if (std::isfinite(sizes[t])) order.push_back(t);
        std::sort(order.begin(), order.end(), [&](label a, label b) {
            return std::make_pair(sizes[a], a) < std::make_pair(sizes[b], b);
        });
        featureSize best;
        for (const label t : order)
        {
            if (sizes[t] >= best.size) break;
            take(best, around(samples_.centre(t), samples_.normal(t), radius));
        }
        return best;
    }

private:
    featureSize at(const vector& x, const vector& n) const
    {
        return opposite(search_, x, side_ * n, reach_, 1e-9 * reach_);
    }

    // The place at x with the largest of the sizes at the radius in four directions, in two if flat
    featureSize around(const vector& x, const vector& n, scalar radius) const
    {
        constexpr scalar sameSide = 0.7;  // cosine
        featureSize here = at(x, n);
        const vector a = flat_ ? vector(n.cross(vector::UnitZ())) : n.unitOrthogonal();
        const vector b = flat_ ? a : vector(n.cross(a));
        for (const vector& way : {a, vector(-a), b, vector(-b)})
        {
            const surfacePoint q = search_.nearest(x + radius * way.normalized(), radius);
            if (!q.found) continue;
            const vector m = search_.surface().normal(q.triangle);
            const scalar size = at(q.point, m).size;
            if (m.dot(n) > sameSide && std::isfinite(size)) here.size = std::max(here.size, size);
        }
        return here;
    }

    const surfaceSearch& search_;
    const triSurface& samples_;
    scalar side_, reach_;
    bool flat_;
};

}  // namespace

featureSizes smallestFeatures(const triSurface& surface, scalar spacing, bool flat)
{
    const surfaceSearch search(surface);
    triSurface samples = surface;
    refine(samples, 1.5 * std::max(spacing, std::sqrt(surface.area() / mostPoints)));
    const scalar radius = 0.5 * spacing;
    return {smallest(search, samples, -1, flat).find(radius),
            smallest(search, samples, 1, flat).find(radius)};
}

}  // namespace ispf
