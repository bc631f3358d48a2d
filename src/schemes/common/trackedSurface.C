// SPDX-License-Identifier: GPL-3.0-or-later
#include "trackedSurface.H"

#include "disjointSets.H"
#include "fileNames.H"
#include "followWeights.H"
#include "surfaceRefinement.H"
#include "surfaceTopology.H"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

namespace ispf
{

namespace
{

// Longest edge [dx]: a mesh as coarse as the flat CAD faces would cut off the bulges of the solid
constexpr scalar longestEdge = 1.5;
// Reach of the particles that a vertex follows; farthest particle that a vertex on a sharp edge follows [dx]
constexpr scalar followed = 3, farthest = 12;

using plane = std::pair<vector, vector>;  // point, outward unit normal
using halfEdges = List<std::array<label, 2>>;

bool isOn(const plane& p, const vector& x, scalar tolerance)
{
    return std::abs((x - p.first).dot(p.second)) < tolerance;
}

void project(vector& x, const plane& p)
{
    x -= (x - p.first).dot(p.second) * p.second;
}

// Mean point of edges, weighted with their lengths
vector meanOf(const triSurface& s, const halfEdges& edges)
{
    vector mean = vector::Zero();
    scalar length = 0;
    for (const auto& [a, b] : edges)
    {
        const scalar part = (s.nodes[b] - s.nodes[a]).norm();
        mean += 0.5 * part * (s.nodes[a] + s.nodes[b]), length += part;
    }
    return length > 0 ? vector(mean / length) : mean;
}

// True if the chain of edges has an end on the plane
bool endsOn(const plane& p, const triSurface& s, const halfEdges& edges)
{
    std::map<label, int> balance;  // of a node: edges that leave it less edges that reach it
    for (const auto& [a, b] : edges) ++balance[a], --balance[b];
    return std::any_of(edges.begin(), edges.end(), [&](const std::array<label, 2>& e) {
        const scalar near = 1e-3 * (s.nodes[e[1]] - s.nodes[e[0]]).norm();
        return (balance[e[0]] != 0 && isOn(p, s.nodes[e[0]], near)) ||
               (balance[e[1]] != 0 && isOn(p, s.nodes[e[1]], near));
    });
}

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
    : name_(name), where_(where)
{
    if (c.cloud.nSolid() == 0)
        throw fatalError("Surface " + name + " is to follow a solid, but the case has none", where);
    rest_ = readSurface(name, c, where);
    rest_.weld(1e-3 * c.cloud.dx);
    refine(rest_, longestEdge * c.cloud.dx);
    factor_ = c.walls->symmetryFactor();
    if (const boundBox box = rest_.bounds(); c.cloud.nDims == 2) height_ = box.max[2] - box.min[2];
    attach(c, where);
    findRims(*c.walls);
    findOrigin(*c.walls);
    // normals point into the fluid, as generateParticles writes them, unless the volume at rest is negative
    scalar area = 0;
    for (label t = 0; t < rest_.size(); ++t) area += rest_.areaVector(t).norm();
    if (volumeBelow(rest_) < -1e-3 * area * c.cloud.dx) sign_ = 1;
    now_ = rest_;
    update(c.cloud.x);
}

// An edge too sharp to hold particles, as the root of a leaflet, moves with the nearest particle: its vertices have few
// particles or none near them
void trackedSurface::attach(const fsiCase& c, const fileLocation& where)
{
    const List<vec4>& x0 = c.cloud.vectors.at("x0");
    const scalar reach = followed * c.cloud.dx;
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
                    near[v] = {nearestSolid(solids, x, farthest * c.cloud.dx, where)};
                List<vector> r;
                for (const label j : near[v]) r.push_back((solids[j] - x) / reach);
                weights[v] = r.size() == 1 ? List<scalar>{1} : followWeights(r);
            }
        },
        16);
    start_.push_back(0);
    scalar way = 0;
    for (label v = 0; v < nv; ++v)
    {
        if (near[v].size() == 1)
        {
            sharp_.emplace_back(v, rest_.nodes[v] - solids[near[v][0]]);
            way = std::max(way, sharp_.back().second.norm());
        }
        source_.insert(source_.end(), near[v].begin(), near[v].end());
        weight_.insert(weight_.end(), weights[v].begin(), weights[v].end());
        start_.push_back(label(source_.size()));
    }
    if (!sharp_.empty())
        info() << "Surface " << name_ << ": " << sharp_.size()
               << " vertices on sharp edges follow the nearest solid particle, up to "
               << str(way / c.cloud.dx, 3) << " dx away" << std::endl;
}

label trackedSurface::nearestSolid(const pointGrid& solids, const vector& x, scalar radius,
                                   const fileLocation& where) const
{
    const label j = solids.nearestIndex(x, radius);
    if (j < 0)
        throw fatalError("Surface " + name_ + ": the vertex (" + str(x[0]) + " " + str(x[1]) + " " +
                             str(x[2]) + ") is more than " + str(radius, 3) +
                             " m = " + str(farthest) +
                             " dx away from every solid particle, so it has none to follow. Is "
                             "the surface one of this case? generateParticles makes it anew",
                         where);
    return j;
}

List<trackedSurface::halfEdge> trackedSurface::rimEdges(const boundary& walls) const
{
    List<halfEdge> edges;
    for (const auto& [a, b] : openHalfEdges(rest_))
    {
        // in two dimensions the rim consists of the ends alone, without the edges of the slice
        const vector edge = rest_.nodes[b] - rest_.nodes[a];
        if (height_ > 0 && std::abs(edge[2]) < 1e-3 * height_) continue;
        const vector middle = rest_.nodes[a] + 0.5 * edge;
        bool onPlane = false;
        for (const plane& p : walls.symmetryPlanes())
            onPlane = onPlane || isOn(p, middle, 1e-4 * edge.norm());
        if (!onPlane) edges.push_back({a, b});
    }
    return edges;
}

// Edges with a common node belong to one rim.  In two dimensions the cap of an opening leads from end to end, or from the only
// end to a symmetry plane: all ends are one rim
void trackedSurface::findRims(const boundary& walls)
{
    const List<plane> planes = walls.symmetryPlanes();
    const List<halfEdge> edges = rimEdges(walls);
    List<label> sets(rest_.nodes.size());
    std::iota(sets.begin(), sets.end(), 0);
    for (const auto& [a, b] : edges) join(sets, a, height_ > 0 ? edges[0][0] : b);
    std::map<label, rim> found;
    for (const halfEdge& e : edges) found[representative(sets, e[0])].edges.push_back(e);
    for (auto& [set, r] : found)
    {
        r.apex = meanOf(rest_, r.edges);
        for (const plane& p : planes)
            if (height_ > 0 ? edges.size() == 1 : endsOn(p, rest_, r.edges)) project(r.apex, p);
        rims_.push_back(std::move(r));
    }
    if (height_ > 0 && edges.size() > (planes.empty() ? 2 : 1))
        notClosed_ = "its lines have " + std::to_string(edges.size()) + " free ends" +
                     (planes.empty() ? "" : " beside the symmetry planes") +
                     ", and it is not known which of them an opening joins";
}

void trackedSurface::findOrigin(const boundary& walls)
{
    origin_ = vector::Zero();
    for (const rim& r : rims_) origin_ += r.apex / scalar(rims_.size());
    // onto all planes; for orthogonal planes one sweep is enough
    const List<plane> planes = walls.symmetryPlanes();
    for (int sweep = 0; sweep < 20; ++sweep)
        for (const plane& p : planes) project(origin_, p);
    if (height_ > 0) along_(2, 2) = 0;
    for (const plane& p : planes)
        for (const plane& q : planes)
        {
            const vector n = along_ * p.second;
            if ((p.second + q.second).norm() < 1e-9 && n.norm() > 1e-6)
                along_ -= n * n.transpose() / n.squaredNorm();
        }
    if (along_.trace() < 0.5) notClosed_ = "symmetry planes face each other in all directions";
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
    for (const auto& [v, offset] : sharp_)
        for (int d = 0; d < (height_ > 0 ? 2 : 3); ++d) now_.nodes[v][d] += offset[d];
}

scalar trackedSurface::volume(const triSurface& s) const
{
    if (!notClosed_.empty())
        throw fatalError("The volume inside " + name_ + " is not known: " + notClosed_ +
                             ". Take a surface that symmetry planes and one opening close, or "
                             "measure the flow with patchFlux.",
                         where_);
    return volumeBelow(s);
}

// A ribbon closes the way of a rim since rest: a rim that moves along with a wall leaves no gap
scalar trackedSurface::volumeBelow(const triSurface& s) const
{
    scalar volume = 0;
    const auto add = [&](const vector& a, const vector& b, const vector& c) {
        volume += 0.5 * (along_ * (a - origin_)).dot((b - a).cross(c - a));
    };
    for (label t = 0; t < s.size(); ++t) add(s.corner(t, 0), s.corner(t, 1), s.corner(t, 2));
    for (const rim& r : rims_)
        for (const auto& [a, b] : r.edges)
        {
            add(s.nodes[b], s.nodes[a], rest_.nodes[a]);
            add(s.nodes[b], rest_.nodes[a], rest_.nodes[b]);
            add(r.apex, rest_.nodes[b], rest_.nodes[a]);
        }
    const scalar directions = std::max<scalar>(1, std::round(along_.trace()));
    return sign_ * volume * factor_ / (directions * (height_ > 0 ? height_ : 1));
}

}  // namespace ispf
