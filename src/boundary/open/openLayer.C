// SPDX-License-Identifier: GPL-3.0-or-later
#include "openLayer.H"
#include "cellSamples.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

openLayer::cellIndex openLayer::indexOf(const vector& x) const
{
    cellIndex c = {0, 0, 0};
    for (int d = 0; d < nDims_; ++d) c[d] = int(std::floor(x[d] / dx_));
    return c;
}

// Part of cell c that is in the layer; smooth at both ends, so that layers of particles do not count all at once
scalar openLayer::share(const cell& c, const vector& x, vector& foot) const
{
    const scalar beyond = c.depth + (x - c.centre).dot(c.normal);
    foot = x - beyond * c.normal;
    return std::clamp(std::min(-beyond / dx_, depth + beyond / dx_) / 2, 0.0, 1.0);
}

openLayer::openLayer(const patchSurface& surface, const List<vector>& sites,
                     const particleCloud& cloud, const place& allowed)
    : dx_(cloud.dx), nDims_(cloud.nDims)
{
    List<vector> columns;
    footSequence ofSites(surface);
    for (const vector& x : sites)
    {
        const surfaceFoot f = ofSites.find(x);
        for (scalar s = -f.depth; s < depth * dx_; s += dx_)
            columns.push_back(f.foot - s * f.normal);
    }
    const List<vector> points = samplesAround(columns, dx_, nDims_);
    const int perCell = samplesPerCell(nDims_);
    List<char> taken(points.size(), 0);
    List<surfaceFoot> feet(points.size() / perCell);
    const auto centreOf = [&](label k) {
        const cellIndex i = indexOf(points[k * perCell]);
        return vector(dx_ * vector(i[0] + 0.5, i[1] + 0.5, nDims_ == 3 ? i[2] + 0.5 : 0));
    };
    parallelFor(
        label(feet.size()),
        [&](label begin, label end) {
            footSequence near(surface);
            for (label k = begin; k < end; ++k)
            {
                feet[k] = near.find(centreOf(k));
                const scalar beyond = feet[k].depth / dx_;
                if (!feet[k].found || feet[k].aside > 0 || beyond < -depth - 1 || beyond > 1)
                {
                    feet[k].found = false;
                    continue;
                }
                for (label m = k * perCell; m < (k + 1) * perCell; ++m)
                    taken[m] = allowed(points[m], 0);
            }
        },
        64);

    pointGrid bins(dx_);
    for (label k = 0; k < label(feet.size()); ++k)
    {
        const surfaceFoot& f = feet[k];
        if (!f.found) continue;
        label bin = bins.nearestIndex(f.foot, 0.75 * dx_);
        if (bin < 0) bin = bins.size(), bins.add(f.foot), full_.emplace_back();
        const cell& c =
            cells_[indexOf(points[k * perCell])] = {centreOf(k), f.foot, f.normal, f.depth, bin};
        vector foot;
        for (label m = k * perCell; m < (k + 1) * perCell; ++m)
            if (const scalar s = share(c, points[m], foot); taken[m] && s > 0)
                full_[bin].add(foot, s / perCell);
    }
}

openLayer::deficit openLayer::missing(const particleCloud& cloud, scalar radius) const
{
    struct part
    {
        label bin;
        scalar share = 0;
        vector foot;
    };
    List<part> parts(cloud.n());
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const vector x = cloud.x[i].xyz();
            const auto found = cells_.find(indexOf(x));
            if (found == cells_.end()) continue;
            parts[i].bin = found->second.bin;
            parts[i].share = share(found->second, x, parts[i].foot);
        }
    });
    List<bin> present(full_.size());
    for (const part& p : parts)
        if (p.share > 0) present[p.bin].add(p.foot, p.share);
    deficit d(radius);
    for (const bin& b : full_)
        if (b.volume > 0) d.add(b.foot / b.volume, b.volume);
    for (const bin& b : present)
        if (b.volume > 0) d.add(b.foot / b.volume, -b.volume);
    return d;
}

}  // namespace ispf
