// SPDX-License-Identifier: GPL-3.0-or-later
#include "trackedSurface.H"

#include "fileNames.H"
#include "followWeights.H"
#include "pointGrid.H"
#include "surfaceRefinement.H"
#include "surfaceTopology.H"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ispf
{

namespace
{

// Longest edge [dx]: a mesh as coarse as the flat CAD faces would cut off the bulges of the solid
constexpr scalar longestEdge = 1.5;

}  // namespace

triSurface readSurface(const word& name, const fsiCase& c, const fileLocation& where)
{
    const word folder = c.time.constantFile("triSurface");
    if (isFile(folder + "/" + name + ".stl")) return readSTL(folder + "/" + name + ".stl");
    List<word> valid;
    std::error_code ignored;
    for (const auto& item : std::filesystem::directory_iterator(folder, ignored))
        if (item.path().extension() == ".stl") valid.push_back(item.path().stem().string());
    throw fatalError("There is no surface " + folder + "/" + name + ".stl." +
                         didYouMean(name, valid) + "\n" + validWords("surface", valid),
                     where);
}

trackedSurface::trackedSurface(const word& name, const fsiCase& c, const fileLocation& where)
    : name_(name)
{
    if (c.cloud.nSolid() == 0)
        throw fatalError("Surface " + name + " is to follow a solid, but the case has none", where);
    rest_ = readSurface(name, c, where);
    rest_.weld(1e-3 * c.cloud.dx);
    refine(rest_, longestEdge * c.cloud.dx);
    factor_ = c.walls->symmetryFactor();
    if (const boundBox box = rest_.bounds(); c.cloud.nDims == 2) height_ = box.max[2] - box.min[2];
    attach(c, where);
    findRim(*c.walls);
    findApex(*c.walls);
    // normals point into the fluid, as generateParticles writes them, unless the volume at rest is negative
    scalar area = 0;
    for (label t = 0; t < rest_.size(); ++t) area += rest_.areaVector(t).norm();
    if (restVolume() < -1e-3 * area * c.cloud.dx) sign_ = 1;
    now_ = rest_;
    update(c.cloud.x);
}

void trackedSurface::attach(const fsiCase& c, const fileLocation& where)
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
                                         ") has no solid particles near it to follow",
                                     where);
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

void trackedSurface::findRim(const boundary& walls)
{
    for (const auto& [a, b] : openHalfEdges(rest_))
    {
        // in two dimensions the rim consists of the ends alone, without the edges of the slice
        const vector edge = rest_.nodes[b] - rest_.nodes[a];
        if (height_ > 0 && std::abs(edge[2]) < 1e-3 * height_) continue;
        const vector middle = rest_.nodes[a] + 0.5 * edge;
        bool onPlane = false;
        for (const auto& [point, normal] : walls.symmetryPlanes())
            onPlane = onPlane || std::abs((middle - point).dot(normal)) < 1e-4 * edge.norm();
        if (!onPlane) rim_.push_back({a, b});
    }
}

// The mean point of the rim, projected to every symmetry plane: then these planes add no volume
void trackedSurface::findApex(const boundary& walls)
{
    apex_ = vector::Zero();
    scalar length = 0;
    for (const auto& [a, b] : rim_)
    {
        const scalar part = (rest_.nodes[b] - rest_.nodes[a]).norm();
        apex_ += 0.5 * part * (rest_.nodes[a] + rest_.nodes[b]), length += part;
    }
    if (length > 0) apex_ /= length;
    // onto all planes; for orthogonal planes one sweep is enough
    for (int sweep = 0; sweep < 20; ++sweep)
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

// A ribbon closes the way of the rim since rest: a rim that moves along with a wall leaves no gap
scalar trackedSurface::volumeBelow(const triSurface& s) const
{
    scalar volume = 0;
    const auto add = [&](const vector& a, const vector& b, const vector& c) {
        volume += 0.5 * (a - apex_).dot((b - a).cross(c - a));
    };
    for (label t = 0; t < s.size(); ++t) add(s.corner(t, 0), s.corner(t, 1), s.corner(t, 2));
    for (const auto& [a, b] : rim_)
    {
        add(s.nodes[b], s.nodes[a], rest_.nodes[a]);
        add(s.nodes[b], rest_.nodes[a], rest_.nodes[b]);
    }
    return sign_ * volume * factor_ / (height_ > 0 ? 2 * height_ : 3);
}

}  // namespace ispf
