// SPDX-License-Identifier: GPL-3.0-or-later
#include "planeLattice.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar aligned = 1e-6;

bool parallel(const vector& a, const vector& b)
{
    return a.cross(b).norm() < aligned;
}
bool orthogonal(const vector& a, const vector& b)
{
    return std::abs(a.dot(b)) < aligned;
}

bool still(const wall& w)
{
    return w.plane && !w.motion.moves();
}
bool carries(const wall& w)
{
    return w.representation == wallRepresentation::particles;
}

}  // namespace

void planeLattice::set(const imageGroup& group, const particleCloud& cloud, scalar support)
{
    group_ = &group, nDims_ = cloud.nDims, dx_ = cloud.dx, support_ = support;
}

// Ends of the region along e, and the lattice coordinates inside and behind its ends
planeLattice::axis planeLattice::axisOf(const vector& e, const List<wall>& walls) const
{
    axis a;
    a.e = e, a.low = 1e300, a.high = -1e300, a.lowBound = a.highBound = false;
    for (int k = 0; k < 8; ++k)
    {
        const vector corner(k & 1 ? covered_.max[0] : covered_.min[0],
                            k & 2 ? covered_.max[1] : covered_.min[1],
                            k & 4 ? covered_.max[2] : covered_.min[2]);
        a.low = std::min(a.low, corner.dot(e)), a.high = std::max(a.high, corner.dot(e));
    }
    const auto bound = [&](const vector& point, const vector& normal, label wall) {
        if (!parallel(normal, e)) return;
        const scalar at = point.dot(e);
        if (normal.dot(e) < 0) a.low = at, a.lowBound = true, a.lowWall = wall;
        if (normal.dot(e) > 0) a.high = at, a.highBound = true, a.highWall = wall;
    };
    for (const auto& [point, normal] : group_->planes()) bound(point, normal, -1);
    for (const auto& [point, normal] : ends_) bound(point, normal, -1);
    for (const wall& w : walls)
        if (still(w)) bound(w.point, w.normal, carries(w) ? label(&w - walls.data()) : -1);

    const label n = std::max<label>(1, label(std::lround((a.high - a.low) / dx_)));
    const bool both = a.lowBound && a.highBound;
    // free ends depend on the particles; a restart must find the same points, to the last digit
    const auto at = [&](label k) -> scalar {
        if (both) return a.low + (k + 0.5) * (a.high - a.low) / n;
        if (a.highBound) return a.high - (n - k - 0.5) * dx_;
        if (a.lowBound) return a.low + (k + 0.5) * dx_;
        return (std::floor(a.low / dx_) + k + 0.5) * dx_;
    };
    for (label k = 0; k < n; ++k) a.inside.push_back(at(k));
    for (scalar d = 0.5 * dx_; d < support_; d += dx_)
    {
        if (a.lowWall >= 0) a.below.push_back(a.low - d);
        if (a.highWall >= 0) a.above.push_back(a.high + d);
    }
    return a;
}

// Axes along the normal, and along planes at right angles to it if there are any
planeLattice::frame planeLattice::frameOf(const vector& normal, const List<wall>& walls) const
{
    vector e[3] = {normal, vector::Zero(), vector::UnitZ()};
    if (nDims_ == 2) e[1] = e[2].cross(normal);
    else
    {
        List<vector> candidates;
        for (const wall& w : walls)
            if (still(w)) candidates.push_back(w.normal);
        for (const auto& [point, n] : group_->planes()) candidates.push_back(n);
        for (int d = 0; d < 3; ++d) candidates.push_back(vector::Unit(d));
        for (const vector& c : candidates)
            if (orthogonal(c, normal) && e[1].norm() == 0) e[1] = c;
        if (e[1].norm() == 0) e[1] = normal.unitOrthogonal();
        e[2] = normal.cross(e[1]);
    }
    frame f;
    for (int d = 0; d < 3; ++d) f.a[d] = axisOf(e[d], walls);
    if (nDims_ == 2) f.a[2].inside = {0}, f.a[2].below.clear(), f.a[2].above.clear();
    return f;
}

List<planeLattice::frame> planeLattice::frames(const List<wall>& walls) const
{
    List<frame> all;
    for (const wall& w : walls)
    {
        if (!still(w) || !carries(w)) continue;
        bool known = false;
        for (const frame& f : all)
            for (const axis& a : f.a) known = known || parallel(a.e, w.normal);
        if (!known) all.push_back(frameOf(w.normal, walls));
    }
    return all;
}

bool planeLattice::wanted(const vector& x) const
{
    return group_->beyond(x) <= 0;
}

void planeLattice::addStill(const List<frame>& all, size_t f, List<wall>& walls) const
{
    // per axis: coordinate, depth behind a plane (0 inside), wall of that plane
    struct node
    {
        scalar at, depth;
        label wall;
    };
    List<node> nodes[3];
    for (int d = 0; d < 3; ++d)
    {
        const axis& a = all[f].a[d];
        for (const scalar c : a.inside) nodes[d].push_back({c, 0, -1});
        for (const scalar c : a.below) nodes[d].push_back({c, a.low - c, a.lowWall});
        for (const scalar c : a.above) nodes[d].push_back({c, c - a.high, a.highWall});
    }
    const auto ownedEarlier = [&](const vector& x) {
        for (size_t g = 0; g < f; ++g)
            for (const axis& a : all[g].a)
                if ((a.lowWall >= 0 && x.dot(a.e) < a.low) ||
                    (a.highWall >= 0 && x.dot(a.e) > a.high))
                    return true;
        return false;
    };
    for (const node& p : nodes[0])
        for (const node& q : nodes[1])
            for (const node& r : nodes[2])
            {
                const node* owner = &p;
                for (const node* other : {&q, &r})
                    if (other->depth > owner->depth * (1 + aligned)) owner = other;
                if (owner->wall < 0) continue;
                const vector x = p.at * all[f].a[0].e + q.at * all[f].a[1].e + r.at * all[f].a[2].e;
                if (wanted(x) && !ownedEarlier(x)) walls[owner->wall].rigid.push_back(x);
            }
}

void planeLattice::addMoving(const frame& f, wall& w) const
{
    for (scalar d = 0.5 * dx_; d < support_; d += dx_)
        for (const scalar q : f.a[1].inside)
            for (const scalar r : f.a[2].inside)
            {
                const vector x =
                    (w.point.dot(w.normal) + d) * w.normal + q * f.a[1].e + r * f.a[2].e;
                if (wanted(x)) w.rigid.push_back(x);
            }
}

void planeLattice::cover(const particleCloud& cloud, List<wall>& walls)
{
    const auto made = [](const wall& w) { return w.plane && carries(w); };
    if (std::none_of(walls.begin(), walls.end(), made) || cloud.n() == 0) return;
    boundBox box;
    for (label i = 0; i < cloud.n(); ++i) box.add(cloud.x[i].xyz());
    const vector margin = vector::Constant(support_);
    if (!covered_.empty() && (box.min - margin - covered_.min).minCoeff() >= 0 &&
        (covered_.max - box.max - margin).minCoeff() >= 0)
        return;
    covered_ = boundBox();
    covered_.add(box.min - 4 * margin), covered_.add(box.max + 4 * margin);
    for (wall& w : walls)
        if (made(w)) w.rigid.clear();
    const List<frame> all = frames(walls);
    for (size_t f = 0; f < all.size(); ++f) addStill(all, f, walls);
    for (wall& w : walls)
        if (made(w) && w.motion.moves()) addMoving(frameOf(w.normal, walls), w);
}

triSurface planeLattice::rectangle(const vector& point, const vector& normal,
                                   const List<wall>& walls, const boundBox& region) const
{
    planeLattice here = *this;
    here.covered_ = region;
    const frame f = here.frameOf(normal, walls);
    const scalar half = 0.5 * dx_;
    const auto at = [&](bool q, bool r) -> vector {
        const scalar along = q ? f.a[1].high : f.a[1].low;
        const scalar across = nDims_ == 2 ? (r ? half : -half) : r ? f.a[2].high : f.a[2].low;
        return point.dot(normal) * normal + along * f.a[1].e + across * f.a[2].e;
    };
    triSurface s;
    s.patchNames = {"plane"};
    s.add(at(0, 0), at(1, 0), at(1, 1), 0), s.add(at(0, 0), at(1, 1), at(0, 1), 0);
    return s;
}

List<planeLattice::element> planeLattice::elements(const wall& w, const List<wall>& walls,
                                                   const boundBox& region) const
{
    planeLattice here = *this;
    here.covered_ = region;
    const frame f = here.frameOf(w.normal, walls);
    const auto width = [&](const axis& a) {
        return a.lowBound && a.highBound ? (a.high - a.low) / scalar(a.inside.size()) : dx_;
    };
    const scalar area = width(f.a[1]) * (nDims_ == 3 ? width(f.a[2]) : 1);
    List<element> all;
    for (const scalar q : f.a[1].inside)
        for (const scalar r : f.a[2].inside)
        {
            const vector x = w.point.dot(w.normal) * w.normal + q * f.a[1].e + r * f.a[2].e;
            if (wanted(x)) all.push_back({x, area});
        }
    return all;
}

scalar planeLattice::area(const wall& w, const List<wall>& walls) const
{
    const frame f = frameOf(w.normal, walls);
    scalar area = 1;
    for (int d = 1; d < nDims_; ++d)
        area *= f.a[d].lowBound && f.a[d].highBound ? f.a[d].high - f.a[d].low : 0;
    return area;
}

triSurface planeLattice::rectangle(const vector& point, const vector& normal,
                                   const List<wall>& walls, const planes& ends) const
{
    planeLattice here = *this;
    here.ends_ = ends;
    const frame f = here.frameOf(normal, walls);
    for (int d = 1; d < nDims_; ++d)
        if (!f.a[d].lowBound || !f.a[d].highBound) return {};
    return here.rectangle(point, normal, walls, covered_);
}

}  // namespace ispf
