// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallVisibility.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

// True if a wall that faces the other way lies within `support` behind triangle t, tested at points no
// further apart than half a support
bool isThin(const surfaceSearch& search, label t, scalar support)
{
    const triSurface& s = search.surface();
    const vector n = s.normal(t), a = s.corner(t, 0);
    const vector e1 = s.corner(t, 1) - a, e2 = s.corner(t, 2) - a;
    const scalar longest = std::max({e1.norm(), e2.norm(), (e1 - e2).norm()});
    const int m = std::clamp(int(std::ceil(2 * longest / support)), 1, 20);
    for (int i = 0; i <= m; ++i)
        for (int j = 0; i + j <= m; ++j)
        {
            // moved inwards a little, so that neighbours across an edge are not hit
            const scalar p = 0.02 + 0.94 * i / m, q = 0.02 + 0.94 * j / m;
            const vector from = a + p * e1 + q * e2 + 1e-6 * support * n;
            const surfaceHit hit = search.firstHit(from, from + support * n);
            if (hit.found && s.normal(hit.triangle).dot(n) < -0.05) return true;
        }
    return false;
}

// The nearest wall point of every fluid particle and image near a thin part; positions in the frame of the part
struct wallView
{
    struct place
    {
        vector foot, normal;
    };
    const particleCloud& cloud;
    const patchSurface& surface;
    bodyFrame frame;  // copied: walls move on while pairs are still tested
    scalar margin;
    List<label> slot;  // -1: far
    List<place> places;

    wallView(const particleCloud& c, const patchSurface& s, const bodyFrame& at, scalar m,
             const List<vector>& facing)
        : cloud(c), surface(s), frame(at), margin(m), slot(c.nAll(), -1)
    {
        List<label> near;
        for (label i = 0; i < c.nAll(); ++i)
            if (c.phase[i] == phaseType::fluid && !s.surelyFar(at.toBody(c.x[i].xyz())) &&
                (i < c.n() || facing[i - c.n()].isZero(0)))
                slot[i] = label(near.size()), near.push_back(i);
        places.resize(near.size());
        parallelFor(
            label(near.size()),
            [&](label begin, label end) {
                for (label k = begin; k < end; ++k)
                {
                    const surfaceFoot f = s.find(frame.toBody(c.x[near[k]].xyz()));
                    places[k] = {f.foot, f.normal};
                    if (!f.found) slot[near[k]] = -1;
                }
            },
            256);
    }

    bool behind(label of, const vector& x) const
    {
        const place& p = places[of];
        return (x - p.foot).dot(p.normal) > -margin;
    }

    bool parts(label i, label j) const
    {
        const label a = slot[i], b = slot[j];
        if (a < 0 || b < 0) return false;
        const vector xi = frame.toBody(cloud.x[i].xyz()), xj = frame.toBody(cloud.x[j].xyz());
        return behind(a, xj) && behind(b, xi) && surface.crosses(xi, xj);
    }
};

// The mirror images, for the test of their pairs
struct imageView
{
    const particleCloud& cloud;
    const wallSet& walls;
    const List<vector>& facing;
    static constexpr scalar aligned = 0.5;  // corners of three walls: 1/sqrt(3)

    bool sees(label i, label g) const
    {
        const vector& direction = facing[g - cloud.n()];
        if (direction.isZero(0) || cloud.beyondOpen(i)) return true;
        const vector a = cloud.x[i].xyz(), b = cloud.x[g].xyz();
        scalar nearest = std::numeric_limits<scalar>::max();
        bool same = false;
        for (const wallSet::body& body : walls.bodies())
        {
            const bodyFrame& frame = walls.frame(body);
            const surfaceFoot f = body.surface->firstCrossing(frame.toBody(a), frame.toBody(b));
            if (!f.found) continue;
            const scalar way = (frame.toSpace(f.foot) - a).squaredNorm();
            if (way < nearest) nearest = way, same = frame.turn(f.normal).dot(direction) > aligned;
        }
        return same;
    }
};

}  // namespace

void wallVisibility::find(const wallSet& walls, scalar support)
{
    margin_ = 0.1 * support;
    for (size_t b = 0; b < walls.bodies().size(); ++b)
    {
        const wallSet::body& body = walls.bodies()[b];
        const triSurface* mesh = body.surface->mesh();
        if (!mesh) continue;
        const surfaceSearch search(*mesh);
        List<char> thin(mesh->size(), 0);
        parallelFor(
            mesh->size(),
            [&](label begin, label end) {
                for (label t = begin; t < end; ++t)
                    thin[t] = body.twoSided || isThin(search, t, support);
            },
            64);
        triSurface part = mesh->subset([&](label t) { return thin[t] != 0; });
        if (part.empty()) continue;
        parts_.push_back(
            {b, patchSurface::triangles(std::move(part), imageGroup(), support, body.twoSided)});
    }
}

neighbourList::visibility wallVisibility::test(const particleCloud& cloud, const wallSet& walls,
                                               const List<vector>& facing) const
{
    const bool images = std::any_of(facing.begin(), facing.end(),
                                    [](const vector& direction) { return !direction.isZero(0); });
    if (parts_.empty() && !images) return nullptr;
    const auto views = std::make_shared<List<wallView>>();
    for (const thinPart& p : parts_)
        views->emplace_back(cloud, *p.surface, walls.frame(walls.bodies()[p.body]), margin_,
                            facing);
    const imageView seen{cloud, walls, facing};
    return [views, seen](label i, label j) {
        if (j >= seen.cloud.n() && !seen.sees(i, j)) return false;
        for (const wallView& view : *views)
            if (view.parts(i, j)) return false;
        return true;
    };
}

}  // namespace ispf
