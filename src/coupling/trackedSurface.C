// SPDX-License-Identifier: GPL-3.0-or-later
#include "trackedSurface.H"

#include "followWeights.H"
#include "pointGrid.H"
#include "surfaceTopology.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

trackedSurface::trackedSurface(const word& name, const fsiCase& c) : name_(name)
{
    if (c.cloud.nSolid() == 0)
        throw fatalError("Surface " + name + " is to follow a solid, but the case has none");
    rest_ = readSTL(c.time.constantFile("triSurface/" + name + ".stl"));
    rest_.weld(1e-3 * c.cloud.dx);
    factor_ = c.walls->symmetryFactor();
    if (const boundBox box = rest_.bounds(); c.cloud.nDims == 2) height_ = box.max[2] - box.min[2];
    attach(c);
    findApex(*c.walls);
    // normals point into the fluid, as generateParticles writes them, unless the volume at rest says else
    scalar area = 0;
    for (label t = 0; t < rest_.size(); ++t) area += rest_.areaVector(t).norm();
    if (restVolume() < -1e-3 * area * c.cloud.dx) sign_ = 1;
    now_ = rest_;
    update(c.cloud.x);
}

void trackedSurface::attach(const fsiCase& c)
{
    const List<vec4>& x0 = c.cloud.vectors.at("x0");
    const scalar reach = 3 * c.cloud.dx;
    pointGrid solids(reach);
    for (label j = 0; j < c.cloud.nSolid(); ++j) solids.add(x0[j].xyz());
    const label nv = label(rest_.nodes.size());
    List<List<label>> near(nv);
    List<List<scalar>> weights(nv);
    parallelFor(
        nv,
        [&](label begin, label end) {
            for (label v = begin; v < end; ++v)
            {
                const vector& x = rest_.nodes[v];
                solids.within(x, reach, [&](label j, scalar) { near[v].push_back(j); });
                std::sort(near[v].begin(), near[v].end());
                if (near[v].size() < 4)
                    throw fatalError("Surface " + name_ + ": vertex (" + str(x[0]) + " " +
                                     str(x[1]) + " " + str(x[2]) +
                                     ") has no solid particles near it to follow");
                List<vector> r;
                for (const label j : near[v]) r.push_back((solids[j] - x) / reach);
                weights[v] = followWeights(r);
            }
        },
        16);
    start_.push_back(0);
    for (label v = 0; v < nv; ++v)
    {
        source_.insert(source_.end(), near[v].begin(), near[v].end());
        weight_.insert(weight_.end(), weights[v].begin(), weights[v].end());
        start_.push_back(label(source_.size()));
    }
}

// A point in every symmetry plane and in the mean of the rim: planes through it add no volume
void trackedSurface::findApex(const boundary& walls)
{
    apex_ = vector::Zero();
    label n = 0;
    for (const auto& [a, b] : openHalfEdges(rest_))
    {
        // in two dimensions the rim is the ends alone, not the edges of the slice
        if (height_ > 0 && std::abs(rest_.nodes[a][2] - rest_.nodes[b][2]) < 0.5 * height_)
            continue;
        const vector middle = 0.5 * (rest_.nodes[a] + rest_.nodes[b]);
        bool onPlane = false;
        for (const auto& [point, normal] : walls.symmetryPlanes())
            onPlane = onPlane || std::abs((middle - point).dot(normal)) <
                                     1e-4 * (rest_.nodes[a] - rest_.nodes[b]).norm();
        if (!onPlane) apex_ += middle, ++n;
    }
    if (n > 0) apex_ /= n;
    for (int sweep = 0; sweep < 20; ++sweep)  // onto all planes; orthogonal ones need one
        for (const auto& [point, normal] : walls.symmetryPlanes())
            apex_ -= (apex_ - point).dot(normal) * normal;
}

void trackedSurface::update(const List<vec4>& x)
{
    parallelFor(label(now_.nodes.size()), [&](label begin, label end) {
        for (label v = begin; v < end; ++v)
        {
            simd4 sum = {};
            for (label k = start_[v]; k < start_[v + 1]; ++k) sum += weight_[k] * x[source_[k]].s;
            now_.nodes[v] = vector(sum[0], sum[1], height_ > 0 ? rest_.nodes[v][2] : sum[2]);
        }
    });
}

scalar trackedSurface::volumeOf(const triSurface& s) const
{
    scalar volume = 0;
    for (label t = 0; t < s.size(); ++t) volume += (s.corner(t, 0) - apex_).dot(s.areaVector(t));
    return sign_ * volume * factor_ / (height_ > 0 ? 2 * height_ : 3);
}

}  // namespace ispf
