// SPDX-License-Identifier: GPL-3.0-or-later
#include "triSurface.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace ispf
{

boundBox::boundBox()
    : min(vector::Constant(std::numeric_limits<scalar>::max())),
      max(vector::Constant(-std::numeric_limits<scalar>::max()))
{
}

void boundBox::add(const vector& p)
{
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
}

void boundBox::add(const boundBox& box)
{
    min = min.cwiseMin(box.min);
    max = max.cwiseMax(box.max);
}

vector triSurface::areaVector(label t) const
{
    return 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
}

vector triSurface::normal(label t) const
{
    const vector a = areaVector(t);
    const scalar length = a.norm();
    return length > 0 ? vector(a / length) : vector(vector::Zero());
}

label triSurface::patchIndex(const word& name) const
{
    const auto at = std::find(patchNames.begin(), patchNames.end(), name);
    if (at == patchNames.end())
        throw fatalError("The surface has no patch " + name + ". " +
                         validWords("name", patchNames));
    return label(at - patchNames.begin());
}

label triSurface::addPatch(const word& name)
{
    const auto at = std::find(patchNames.begin(), patchNames.end(), name);
    const label index = label(at - patchNames.begin());
    if (at == patchNames.end()) patchNames.push_back(name);
    return index;
}

void triSurface::add(const vector& a, const vector& b, const vector& c, label patchI)
{
    const label n = label(nodes.size());
    nodes.insert(nodes.end(), {a, b, c});
    triangles.push_back({n, n + 1, n + 2});
    patch.push_back(patchI);
}

void triSurface::append(const triSurface& other)
{
    List<label> newPatch;
    for (const word& name : other.patchNames) newPatch.push_back(addPatch(name));
    const label n = label(nodes.size());
    nodes.insert(nodes.end(), other.nodes.begin(), other.nodes.end());
    for (label t = 0; t < other.size(); ++t)
    {
        const triangle& f = other.triangles[t];
        triangles.push_back({f[0] + n, f[1] + n, f[2] + n});
        patch.push_back(newPatch[other.patch[t]]);
    }
}

void triSurface::scale(scalar factor)
{
    for (vector& p : nodes) p *= factor;
}

void triSurface::flip()
{
    for (triangle& f : triangles) std::swap(f[1], f[2]);
}

namespace
{

// Nodes by cells as wide as the tolerance: a partner lies in the same or a neighbouring cell
class nodeGrid
{
public:
    nodeGrid(const vector& origin, scalar width) : origin_(origin), width_(width) {}

    label find(const vector& p, const List<vector>& nodes) const
    {
        const auto c = cell(p);
        for (std::int64_t k = c[2] - 1; k <= c[2] + 1; ++k)
            for (std::int64_t j = c[1] - 1; j <= c[1] + 1; ++j)
                for (std::int64_t i = c[0] - 1; i <= c[0] + 1; ++i)
                {
                    const auto bucket = cells_.find(key({i, j, k}));
                    if (bucket == cells_.end()) continue;
                    for (const label n : bucket->second)
                        if ((nodes[n] - p).norm() <= width_) return n;
                }
        return -1;
    }
    void insert(const vector& p, label n) { cells_[key(cell(p))].push_back(n); }

private:
    using triple = std::array<std::int64_t, 3>;
    triple cell(const vector& p) const
    {
        triple c;
        for (int k = 0; k < 3; ++k) c[k] = std::int64_t(std::floor((p[k] - origin_[k]) / width_));
        return c;
    }
    static std::uint64_t key(const triple& c)
    {
        return std::uint64_t(c[0]) * 73856093u ^ std::uint64_t(c[1]) * 19349663u * 65537u ^
               std::uint64_t(c[2]) * 83492791u * 4294967291u;
    }

    vector origin_;
    scalar width_;
    std::unordered_map<std::uint64_t, List<label>> cells_;
};

}  // namespace

// Per node: the first node with the same coordinates
static List<label> firstEqual(const List<vector>& nodes)
{
    List<label> order(nodes.size()), first(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    const auto before = [&](label a, label b) {
        return std::lexicographical_compare(nodes[a].begin(), nodes[a].end(), nodes[b].begin(),
                                            nodes[b].end());
    };
    std::stable_sort(order.begin(), order.end(), before);
    for (size_t k = 0; k < order.size(); ++k)
        first[order[k]] =
            k > 0 && nodes[order[k]] == nodes[order[k - 1]] ? first[order[k - 1]] : order[k];
    return first;
}

// Per node: the first kept node within the tolerance
static List<label> firstNear(const List<vector>& nodes, const boundBox& box, scalar tolerance)
{
    // wide enough that cells can be numbered
    nodeGrid grid(box.min, std::max(tolerance, 1e-12 * box.diagonal()));
    List<label> first(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n)
    {
        const label near = grid.find(nodes[n], nodes);
        first[n] = near < 0 ? label(n) : near;
        if (near < 0) grid.insert(nodes[n], label(n));
    }
    return first;
}

void triSurface::weld(scalar tolerance)
{
    keepUsed();
    const List<label> first =
        tolerance > 0 ? firstNear(nodes, bounds(), tolerance) : firstEqual(nodes);
    label kept = 0;
    for (label t = 0; t < size(); ++t)
    {
        triangle f = triangles[t];
        for (label& n : f) n = first[n];
        if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
        triangles[kept] = f, patch[kept] = patch[t], ++kept;
    }
    triangles.resize(kept), patch.resize(kept);
    keepUsed();
}

void triSurface::keepUsed()
{
    List<label> newNode(nodes.size(), -1);
    for (const triangle& f : triangles)
        for (const label n : f) newNode[n] = 0;
    label used = 0;
    for (size_t n = 0; n < nodes.size(); ++n)
        if (newNode[n] == 0) nodes[used] = nodes[n], newNode[n] = used++;
    nodes.resize(used);
    for (triangle& f : triangles)
        for (label& n : f) n = newNode[n];
}

triSurface triSurface::subset(const std::function<bool(label)>& keep) const
{
    triSurface part = *this;
    label kept = 0;
    for (label t = 0; t < size(); ++t)
        if (keep(t)) part.triangles[kept] = triangles[t], part.patch[kept] = patch[t], ++kept;
    part.triangles.resize(kept), part.patch.resize(kept);
    part.keepUsed();
    return part;
}

triSurface triSurface::patchSurface(const word& name) const
{
    const label wanted = patchIndex(name);
    triSurface part = subset([&](label t) { return patch[t] == wanted; });
    part.patchNames = {name};
    std::fill(part.patch.begin(), part.patch.end(), 0);
    return part;
}

scalar triSurface::area() const
{
    scalar sum = 0;
    for (label t = 0; t < size(); ++t) sum += areaVector(t).norm();
    return sum;
}

scalar triSurface::volume() const
{
    // divergence theorem; a reference point in the middle of the surface keeps rounding errors small
    const vector o = empty() ? vector(vector::Zero()) : bounds().centre();
    scalar sum = 0;
    for (label t = 0; t < size(); ++t) sum += areaVector(t).dot(corner(t, 0) - o) / 3;
    return sum;
}

boundBox triSurface::bounds() const
{
    boundBox box;
    for (const vector& p : nodes) box.add(p);
    return box;
}

}  // namespace ispf
