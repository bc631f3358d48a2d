// SPDX-License-Identifier: GPL-3.0-or-later
#include "patchSurface.H"

#include "surfaceTopology.H"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ispf
{

namespace
{

// The surface with its images beyond symmetry planes and cyclic pairs, joined along their edges
triSurface continued(triSurface s, const imageGroup& group, scalar reach)
{
    const triSurface own = s;
    for (const structureImage& map : group.maps())
    {
        const bool reflects = map.R.determinant() < 0;
        for (label t = 0; t < own.size(); ++t)
        {
            vector c[3];
            for (int k = 0; k < 3; ++k) c[k] = map(own.corner(t, k));
            const scalar nearest =
                std::min({group.beyond(c[0]), group.beyond(c[1]), group.beyond(c[2])});
            if (nearest > 2 * reach) continue;
            if (reflects) std::swap(c[1], c[2]);
            s.add(c[0], c[1], c[2], own.patch[t]);
        }
    }
    s.weld(1e-4 * reach);
    return s;
}

// A coarse raster around the surface: most particles are far from it, and one look-up shows that
struct raster
{
    vector low;
    scalar cell = 1;
    int n[3] = {0, 0, 0};
    List<char> near;

    void build(const surfaceSearch& search, scalar reach)
    {
        boundBox box = search.surface().bounds();
        const vector extent = box.max - box.min + vector::Constant(2 * reach);
        const scalar volume = extent.prod();
        cell = std::max(0.5 * reach, std::cbrt(volume / 2e6));
        low = box.min - vector::Constant(reach);
        for (int d = 0; d < 3; ++d) n[d] = int(extent[d] / cell) + 1;
        near.resize(size_t(n[0]) * n[1] * n[2]);
        const scalar radius = reach + std::sqrt(0.75) * cell;
        parallelFor(
            n[2],
            [&](label begin, label end) {
                for (label z = begin; z < end; ++z)
                    for (int y = 0; y < n[1]; ++y)
                        for (int x = 0; x < n[0]; ++x)
                            near[(size_t(z) * n[1] + y) * n[0] + x] = search.within(
                                low + cell * vector(x + 0.5, y + 0.5, z + 0.5), radius);
            },
            1);
    }

    bool far(const vector& x) const
    {
        size_t index = 0;
        for (int d = 2; d >= 0; --d)
        {
            const scalar q = (x[d] - low[d]) / cell;
            if (!(q >= 0 && q < n[d])) return true;
            index = index * n[d] + size_t(q);
        }
        return !near[index];
    }
};

class triangulatedSurface : public patchSurface
{
public:
    triangulatedSurface(triSurface surface, const imageGroup& group, scalar reach, bool twoSided)
        : reach_(reach), twoSided_(twoSided)
    {
        surface = group.clipped(std::move(surface));
        if (surface.empty())
            throw fatalError("The surface of patch " + join(surface.patchNames, " and ") +
                             " lies beyond the symmetry planes and cyclic sides, where there is no "
                             "fluid. See their points and normals in constant/boundary");
        area_.assign(surface.patchNames.size(), vector::Zero());
        for (label t = 0; t < surface.size(); ++t) area_[surface.patch[t]] += surface.areaVector(t);
        surface.weld(1e-4 * reach);
        search_ = surfaceSearch(continued(std::move(surface), group, reach));
        raster_.build(search_, reach);
        triSurface rim;  // edges as triangles without area
        for (const auto& [a, b] : openHalfEdges(search_.surface()))
        {
            const vector& end = search_.surface().nodes[b];
            rim.add(search_.surface().nodes[a], end, end, 0);
        }
        rim_ = surfaceSearch(std::move(rim));
    }

    surfaceFoot find(const vector& x, scalar known) const override
    {
        surfaceFoot f;
        if (raster_.far(x)) return f;
        const surfacePoint p = search_.nearest(x, std::min(known, reach_));
        if (!p.found) return f;
        if (twoSided_) return onSheet(x, p);
        f.found = true, f.patch = search_.patch(p), f.foot = p.point, f.normal = p.normal;
        f.nearest = p.point;
        if (p.rim)
        {
            f.depth = (x - p.point).dot(p.normal);
            f.foot = x - f.depth * p.normal;
            f.aside = (f.foot - p.point).norm();
            return f;
        }
        f.depth = p.signedDistance(x);
        if (p.distance > 1e-6 * reach_) f.normal = (x - p.point) / f.depth;
        return f;
    }

    bool crosses(const vector& a, const vector& b) const override { return search_.crosses(a, b); }

    surfaceFoot firstCrossing(const vector& a, const vector& b) const override
    {
        surfaceFoot f;
        const surfaceHit hit = search_.firstHit(a, b);
        if (!hit.found) return f;
        f.found = true, f.foot = hit.point, f.patch = search_.surface().patch[hit.triangle];
        f.normal = search_.surface().normal(hit.triangle);
        if (twoSided_ && f.normal.dot(b - a) < 0) f.normal = -f.normal;
        return f;
    }

    vector areaVector(label patch) const override
    {
        return twoSided_ ? vector(vector::Zero()) : area_[patch];
    }
    const triSurface* mesh() const override { return &search_.surface(); }
    bool rimWithin(const vector& x, scalar radius) const override { return rim_.within(x, radius); }
    bool surelyFar(const vector& x) const override { return raster_.far(x); }

private:
    // Foot on a two-sided sheet: the normal points away from x
    surfaceFoot onSheet(const vector& x, const surfacePoint& p) const
    {
        surfaceFoot f;
        f.found = true, f.patch = search_.patch(p), f.normal = p.normal, f.nearest = p.point;
        if (!p.rim && p.distance > 1e-6 * reach_) f.normal = (p.point - x) / p.distance;
        if ((x - p.point).dot(f.normal) > 0) f.normal = -f.normal;
        f.depth = (x - p.point).dot(f.normal);
        f.foot = x - f.depth * f.normal;
        if (p.rim) f.aside = (f.foot - p.point).norm();
        return f;
    }

    scalar reach_;
    surfaceSearch search_, rim_;
    raster raster_;
    bool twoSided_;
    List<vector> area_;
};

}  // namespace

std::unique_ptr<patchSurface> patchSurface::triangles(triSurface surface, const imageGroup& group,
                                                      scalar reach, bool twoSided)
{
    return std::make_unique<triangulatedSurface>(std::move(surface), group, reach, twoSided);
}

surfaceFoot footSequence::find(const vector& x)
{
    constexpr scalar rounding = 1e-9;
    scalar least = std::numeric_limits<scalar>::max();
    for (label k = 0; k < std::min(found_, length); ++k)
        least = std::min(least, (x - last_[k]).squaredNorm());
    const surfaceFoot f =
        found_ > 0 ? surface_.find(x, (1 + rounding) * std::sqrt(least)) : surface_.find(x);
    if (f.found) last_[found_++ % length] = f.nearest;
    return f;
}

vector nonZero(const dictionary& dict, const word& key, const dimensionSet& wanted)
{
    const vector v = dict.get<vector>(key, wanted);
    if (!(v.norm() > 0)) dict.fail(key, key + " must not be zero");
    return v;
}

word patchFile(const word& caseFolder, const word& patch)
{
    return caseFolder + "/constant/triSurface/" + patch + ".stl";
}

triSurface readPatch(const word& caseFolder, const word& patch, const dictionary& dict)
{
    const word path = patchFile(caseFolder, patch);
    if (!std::filesystem::exists(path))
        throw fatalError("Patch " + patch + " needs its surface " + path +
                             ". Write it with generateParticles, or describe the patch by "
                             "'surface plane; point ...; normal ...;'",
                         dict.where("type"));
    triSurface s = readSTL(path);
    const scalar size = s.bounds().diagonal();
    if (s.empty() || !(s.area() > 1e-9 * size * size))
        throw fatalError("The surface " + path + " of patch " + patch + " has " +
                             (s.empty() ? "no triangles" : "triangles without an area") +
                             ". Write it anew with generateParticles",
                         dict.where("type"));
    s.patchNames = {patch};
    std::fill(s.patch.begin(), s.patch.end(), 0);
    return s;
}

}  // namespace ispf
