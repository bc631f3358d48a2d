// SPDX-License-Identifier: GPL-3.0-or-later
#include "vesselWall.H"

#include "featureSize.H"
#include "halfSpace.H"
#include "offsetSurface.H"
#include "surfaceCapping.H"
#include "surfaceTopology.H"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

constexpr scalar offPlane = 0.05;  // [dx] that an opening's nodes may be
constexpr scalar leastSlope =
    0.25;  // cosine between an opening's normal and the vessel's direction

class wallMaker
{
public:
    wallMaker(const triSurface& lumen, const std::function<bool(const word&)>& isOpening,
              const vesselWallSettings& settings)
        : lumen_(lumen), set_(settings), next_(edgeNeighbours(lumen)), opening_(lumen.size(), -1)
    {
        findOpenings(isOpening);
        for (vesselOpening& o : openings_) measure(o);
    }

    vesselWall run()
    {
        triSurface wall = walled();
        wall.flip();
        const triSurface body = prolonged([&](const vesselOpening& o) { return lengthBeyond(o); });
        checkGap(body);
        triSurface outer = offsetSurface(surfaceSearch(body), set_.thickness,
                                         0.5 * std::min(set_.spacing, set_.thickness), set_.flat);
        for (const vesselOpening& o : openings_) cutOff(outer, o);
        if (set_.flat) wall = upright(wall, outer);
        else wall.append(outer);
        wall.weld(1e-6 * set_.dx);
        if (!openHalfEdges(wall).empty()) capEnds(wall, {}, offPlane * set_.dx, set_.dx);
        wall.patchNames = {""};
        wall.patch.assign(wall.patch.size(), 0);
        return {std::move(wall), std::move(openings_)};
    }

    // The lumen with its ends moved along the vessel; the patches of openings keep their names
    triSurface prolonged(const std::function<scalar(const vesselOpening&)>& length) const
    {
        triSurface all = walled();
        all.patchNames = {""};
        all.patch.assign(all.patch.size(), 0);
        for (const vesselOpening& o : openings_)
        {
            const vector shift = length(o) * o.along;
            const label lid = all.addPatch(o.patch);
            for (const label t : o.facets)
                all.add(lumen_.corner(t, 0) + shift, lumen_.corner(t, 1) + shift,
                        lumen_.corner(t, 2) + shift, lid);
            forRim(o, [&](label a, label b, label) {
                const vector &p = lumen_.nodes[a], &q = lumen_.nodes[b];
                all.add(q, p, p + shift, 0), all.add(q, p + shift, q + shift, 0);
            });
        }
        all.weld(1e-9 * set_.dx);
        return all;
    }

    const List<vesselOpening>& openings() const { return openings_; }

private:
    bool isPrismEnd(label t) const { return set_.flat && std::abs(lumen_.normal(t)[2]) > 0.9; }
    bool isWall(label t) const { return opening_[t] < 0 && !isPrismEnd(t); }
    triSurface walled() const
    {
        return lumen_.subset([&](label t) { return isWall(t); });
    }

    // Each connected part of the patches is an opening
    void findOpenings(const std::function<bool(const word&)>& isOpening)
    {
        List<char> asked(lumen_.size());
        for (label t = 0; t < lumen_.size(); ++t)
            asked[t] = isOpening(lumen_.patchNames[lumen_.patch[t]]) && !isPrismEnd(t);
        for (label seed = 0; seed < lumen_.size(); ++seed)
        {
            if (!asked[seed] || opening_[seed] >= 0) continue;
            vesselOpening o;
            o.patch = lumen_.patchNames[lumen_.patch[seed]];
            const label own = opening_[seed] = label(openings_.size());
            o.facets = {seed};
            for (size_t k = 0; k < o.facets.size(); ++k)
                for (const auto& [t, same] : next_[o.facets[k]])
                    if (asked[t] && opening_[t] < 0) opening_[t] = own, o.facets.push_back(t);
            openings_.push_back(std::move(o));
        }
    }

    void measure(vesselOpening& o) const
    {
        scalar area = 0;
        for (const label t : o.facets)
        {
            const vector a = lumen_.areaVector(t);
            o.normal += a, o.centre += a.norm() * lumen_.centre(t), area += a.norm();
        }
        o.centre /= area;
        o.normal.normalize();
        scalar off = 0;
        for (const label t : o.facets)
            for (int k = 0; k < 3; ++k)
                off = std::max(off, std::abs((lumen_.corner(t, k) - o.centre).dot(o.normal)));
        if (off > offPlane * set_.dx)
            throw fatalError(name(o) + " is not plane: it leaves its plane by up to " +
                             str(off, 3) + " m = " + str(off / set_.dx, 3) +
                             " dx. Cut the vessel there by a plane");
        o.along = direction(o);
        if (o.along.dot(o.normal) < leastSlope)
            throw fatalError(
                name(o) +
                " does not end the vessel: the lumen's wall around it does not lead to it. Draw a "
                "piece of vessel that leads to the opening, at least as long as the wall is thick");
    }

    word name(const vesselOpening& o) const
    {
        return "The opening " + o.patch + " at " + place(o.centre, 1e-6 * set_.dx) + " m";
    }

    // Along the wall: least squares of its component along the normals of the wall's facets at the opening
    vector direction(const vesselOpening& o) const
    {
        tensor sum = tensor::Zero();
        forRim(o, [&](label a, label b, label t) {
            const vector n = lumen_.normal(t);
            sum += (lumen_.nodes[b] - lumen_.nodes[a]).norm() * n * n.transpose();
        });
        if (set_.flat) sum(2, 2) = sum.trace();
        const vector way =
            Eigen::SelfAdjointEigenSolver<tensor>(sum).eigenvectors().col(0).normalized();
        return way.dot(o.normal) < 0 ? vector(-way) : way;
    }

    // Calls f(a, b, t) for each half-edge of a wall's facet t at the opening
    template <class F>
    void forRim(const vesselOpening& o, F&& f) const
    {
        for (const label t : o.facets)
            for (const auto& [other, same] : next_[t])
                if (isWall(other))
                    for (int k = 0; k < 3; ++k)
                        if (const label a = lumen_.triangles[other][k],
                            b = lumen_.triangles[other][(k + 1) % 3];
                            has(t, a) && has(t, b))
                            f(a, b, other);
    }
    bool has(label t, label node) const
    {
        const auto& f = lumen_.triangles[t];
        return std::find(f.begin(), f.end(), node) != f.end();
    }

    // Where the walls of two sides meet no outer surface lies at the thickness from both
    void checkGap(const triSurface& prolonged) const
    {
        const featureSize gap =
            smallestFeatures(prolonged.patchSurface(""), set_.dx, set_.flat).gap;
        if (gap.size < 2 * set_.thickness)
            throw fatalError("A wall of " + str(set_.thickness, 3) + " m is too thick: at " +
                             place(gap.at, 1e-6 * set_.dx) +
                             " m the lumen turns back, or another part of it is near, " +
                             str(gap.size, 3) +
                             " m away, and the walls of both sides would meet. Make the wall "
                             "thinner than " +
                             str(0.5 * gap.size, 3) + " m, or draw it");
    }

    scalar lengthBeyond(const vesselOpening& o) const
    {
        return set_.thickness * (1 + 1 / o.along.dot(o.normal)) + 2 * set_.spacing;
    }

    // Removes the part of the outer surface beyond the opening's plane that surrounds the prolonged end
    void cutOff(triSurface& outer, const vesselOpening& o) const
    {
        const scalar tolerance = 1e-6 * set_.dx, length = lengthBeyond(o);
        const halfSpace inside{o.centre, o.normal}, beyond{o.centre, -o.normal};
        triSurface rest = clipped(outer, beyond, tolerance);
        const List<label> part = connectedComponents(rest);
        const vector tip = o.centre + (length + set_.thickness) * o.along;
        const auto distance = [&](label t) { return (level(rest.centre(t)) - level(tip)).norm(); };
        label nearest = 0;
        for (label t = 1; t < rest.size(); ++t)
            if (distance(t) < distance(nearest)) nearest = t;
        const label end = part.empty() ? 0 : part[nearest];
        scalar radius = 0;
        for (const label t : o.facets)
            for (int k = 0; k < 3; ++k)
                radius = std::max(radius, level(lumen_.corner(t, k) - o.centre).norm());
        const scalar reach = radius + length + 2 * set_.thickness;
        for (label t = 0; t < rest.size(); ++t)
            if (part[t] == end && level(rest.centre(t) - o.centre).norm() > reach)
                throw fatalError(name(o) + " has another part of the wall beyond its plane, at " +
                                 place(rest.centre(t), 1e-6 * set_.dx) +
                                 " m: the wall cannot end there. Make the vessel longer there, or "
                                 "the wall thinner");
        outer = clipped(outer, inside, tolerance);
        outer.append(rest.subset([&](label t) { return part[t] != end; }));
        outer.weld(tolerance);
    }
    vector level(vector x) const
    {
        if (set_.flat) x[2] = 0;
        return x;
    }

    // In two dimensions: the sides as upright quads, and others in the planes of the openings that join their ends
    triSurface upright(const triSurface& inner, const triSurface& outer) const
    {
        const scalar tolerance = 1e-6 * set_.dx;
        const boundBox box = lumen_.bounds();
        triSurface all;
        all.addPatch("inner"), all.addPatch("outer");
        const auto raised = [&](vector x, bool top) {
            x[2] = top ? box.max[2] : box.min[2];
            return x;
        };
        for (const triSurface* s : {&inner, &outer})
            for (label t = 0; t < s->size(); ++t)
                for (int k = 0; k < 3; ++k)
                {
                    const vector &a = s->corner(t, k), &b = s->corner(t, (k + 1) % 3);
                    if (std::max(a[2], b[2]) > box.min[2] + tolerance) continue;
                    all.add(raised(a, false), raised(b, false), raised(b, true), s == &outer);
                    all.add(raised(a, false), raised(b, true), raised(a, true), s == &outer);
                }
        all.weld(tolerance);
        List<label> side(all.nodes.size());
        for (label t = 0; t < all.size(); ++t)
            for (const label n : all.triangles[t]) side[n] = all.patch[t];
        List<std::array<label, 2>> ends[2];
        for (const auto& edge : openHalfEdges(all))
            if (level(all.nodes[edge[0]] - all.nodes[edge[1]]).norm() < tolerance)
                ends[side[edge[0]]].push_back(edge);
        for (const auto& end : ends[0]) join(all, end, ends[1]);
        return all;
    }

    void join(triSurface& all, const std::array<label, 2>& end,
              const List<std::array<label, 2>>& others) const
    {
        const auto [a, b] = end;
        std::array<label, 2> best = {-1, -1};
        scalar least = std::numeric_limits<scalar>::max();
        for (const auto& other : others)  // those that run the other way
            if (const scalar way = (all.nodes[other[1]] - all.nodes[a]).norm();
                way < least && all.nodes[other[1]][2] == all.nodes[a][2])
                least = way, best = other;
        if (best[0] < 0) return;
        all.triangles.push_back({b, a, best[1]}), all.triangles.push_back({b, best[1], best[0]});
        all.patch.resize(all.triangles.size(), 0);
    }

    const triSurface& lumen_;
    const vesselWallSettings& set_;
    List<List<std::pair<label, bool>>> next_;  // neighbours of each facet
    List<label> opening_;                      // of each facet, or -1
    List<vesselOpening> openings_;
};

}  // namespace

vesselWall makeVesselWall(const triSurface& lumen,
                          const std::function<bool(const word&)>& isOpening,
                          const vesselWallSettings& settings)
{
    wallMaker maker(lumen, isOpening, settings);
    if (settings.beyond == 0) return maker.run();
    const triSurface longer = maker.prolonged(
        [&](const vesselOpening& o) { return settings.beyond / o.along.dot(o.normal); });
    return {wallMaker(longer, isOpening, settings).run().surface, maker.openings()};
}

}  // namespace ispf
