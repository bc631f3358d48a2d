// SPDX-License-Identifier: GPL-3.0-or-later
#include "halfSpace.H"

#include "surfaceTopology.H"
#include <algorithm>
#include <cmath>
#include <map>

namespace ispf
{

namespace
{

// Cuts triangles one after another.  An edge is cut once, so that both of its triangles share the node
class cutter
{
public:
    cutter(const triSurface& from, const halfSpace& half, scalar tolerance)
        : from_(from), newNode_(from.nodes.size(), -1)
    {
        to_.patchNames = from.patchNames;
        for (const vector& p : from.nodes)
        {
            const scalar d = half.distance(p);
            distance_.push_back(std::abs(d) <= tolerance ? 0 : d);
        }
    }

    void cut(label t)
    {
        const auto& f = from_.triangles[t];
        if (distance_[f[0]] == 0 && distance_[f[1]] == 0 && distance_[f[2]] == 0) return;
        List<label> polygon;  // the inner part, three or four corners
        for (int k = 0; k < 3; ++k)
        {
            const label a = f[k], b = f[(k + 1) % 3];
            if (distance_[a] <= 0) polygon.push_back(keep(a));
            if (distance_[a] * distance_[b] < 0) polygon.push_back(crossing(a, b));
        }
        for (size_t k = 1; k + 1 < polygon.size(); ++k)
        {
            to_.triangles.push_back({polygon[0], polygon[k], polygon[k + 1]});
            to_.patch.push_back(from_.patch[t]);
        }
    }

    triSurface take() { return std::move(to_); }

private:
    label keep(label n)
    {
        if (newNode_[n] < 0) newNode_[n] = add(from_.nodes[n]);
        return newNode_[n];
    }
    label crossing(label a, label b)
    {
        const auto [low, high] = std::minmax(a, b);
        const auto [at, isNew] = cuts_.emplace(std::make_pair(low, high), 0);
        if (isNew)
        {
            const scalar f = distance_[low] / (distance_[low] - distance_[high]);
            at->second = add(from_.nodes[low] + f * (from_.nodes[high] - from_.nodes[low]));
        }
        return at->second;
    }
    label add(const vector& p)
    {
        to_.nodes.push_back(p);
        return label(to_.nodes.size()) - 1;
    }

    const triSurface& from_;
    triSurface to_;
    List<scalar> distance_;
    List<label> newNode_;
    std::map<std::pair<label, label>, label> cuts_;
};

// Lids over the openings in the plane, as a fan of triangles from one point.  They may overlap with opposite signs: they
// are right for volume() only
triSurface lids(const triSurface& surface, const halfSpace& half, scalar tolerance)
{
    triSurface lid;
    lid.addPatch("lid");
    for (const auto& [a, b] : openHalfEdges(surface))
    {
        const vector &p = surface.nodes[a], &q = surface.nodes[b];
        if (std::abs(half.distance(p)) <= tolerance && std::abs(half.distance(q)) <= tolerance)
            lid.add(half.point, q, p, 0);
    }
    return lid;
}

}  // namespace

triSurface clipped(const triSurface& surface, const halfSpace& half, scalar tolerance)
{
    cutter c(surface, half, tolerance);
    for (label t = 0; t < surface.size(); ++t) c.cut(t);
    return c.take();
}

scalar clippedVolume(const triSurface& surface, const List<halfSpace>& halves)
{
    triSurface part = surface;
    const scalar tolerance = 1e-9 * surface.bounds().diagonal();
    for (const halfSpace& half : halves)
    {
        part = clipped(part, half, tolerance);
        part.append(lids(part, half, 2 * tolerance));
        part.weld(1e-12 * part.bounds().diagonal());
    }
    return part.volume();
}

triSurface withImages(const triSurface& surface, const List<halfSpace>& planes, scalar distance)
{
    triSurface all = surface;
    for (const halfSpace& plane : planes)
    {
        triSurface image = all.subset([&](label t) {
            scalar nearest = -plane.distance(all.corner(t, 0));
            for (int k = 1; k < 3; ++k)
                nearest = std::min(nearest, -plane.distance(all.corner(t, k)));
            return nearest <= distance;
        });
        for (vector& p : image.nodes) p = plane.mirror(p);
        image.flip();  // a reflection reverses the winding
        all.append(image);
    }
    all.weld(1e-9 * all.bounds().diagonal());
    return all;
}

}  // namespace ispf
