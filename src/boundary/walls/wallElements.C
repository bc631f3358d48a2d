// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid particles and surface elements of walls near particles
#include "wallSet.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ispf
{

namespace
{

// Search cells within one cell of an owned particle
class occupancy
{
public:
    occupancy(const particleCloud& cloud, scalar cell) : cell_(cell)
    {
        low_ = cloud.x[0].xyz();
        vector high = low_;
        for (label i = 0; i < cloud.n(); ++i)
            low_ = low_.cwiseMin(cloud.x[i].xyz()), high = high.cwiseMax(cloud.x[i].xyz());
        low_.array() -= cell;
        for (int d = 0; d < 3; ++d) n_[d] = std::int64_t((high[d] - low_[d]) / cell) + 2;
        near_.assign(size_t(n_[0] * n_[1] * n_[2]), 0);
        for (label i = 0; i < cloud.n(); ++i) near_[size_t(index(cloud.x[i].xyz()))] = 1;
        spread(1), spread(n_[0]), spread(n_[0] * n_[1]);
    }

    bool near(const vector& x) const
    {
        for (int d = 0; d < 3; ++d)
            if (!(x[d] >= low_[d] && x[d] < low_[d] + scalar(n_[d]) * cell_)) return false;
        return near_[size_t(index(x))];
    }

private:
    std::int64_t index(const vector& x) const
    {
        const auto c = [&](int d) { return std::int64_t((x[d] - low_[d]) / cell_); };
        return (c(2) * n_[1] + c(1)) * n_[0] + c(0);
    }
    void spread(std::int64_t stride)  // the outermost cells are empty: no wrap-around
    {
        const List<char> old = near_;
        const size_t step = size_t(stride), size = old.size();
        for (size_t k = 0; k < size; ++k)
            near_[k] = old[k] | (k >= step && old[k - step]) | (k + step < size && old[k + step]);
    }

    scalar cell_;
    vector low_;
    std::int64_t n_[3];
    List<char> near_;
};

// Share of a triangle with d < 0, for d linear between its corners; 1/2 for a triangle in d = 0
scalar shareBelowZero(std::array<scalar, 3> d, scalar rounding)
{
    std::sort(d.begin(), d.end());
    if (d[2] - d[0] < rounding && std::abs(d[0]) < rounding) return 0.5;
    if (d[2] <= 0) return 1;
    if (d[0] >= 0) return 0;
    if (d[1] > 0) return d[0] * d[0] / ((d[0] - d[1]) * (d[0] - d[2]));
    return 1 - d[2] * d[2] / ((d[2] - d[0]) * (d[2] - d[1]));
}

}  // namespace

void wallSet::addRigid(particleCloud& cloud) const
{
    if (empty() || cloud.n() == 0) return;
    const occupancy cells(cloud, support_);
    for (const wall& w : walls_)
        for (size_t k = 0; k < w.rigid.size(); ++k)
            if (const vector at = w.frame.toSpace(w.rigid[k]); cells.near(at))
            {
                const vector foot = w.frame.toSpace(w.footOf(k)),
                             whose = w.motion.rotates() ? foot : at;
                cloud.addRigid(at, w.velocity.at(whose), foot);
            }
}

// Halves a triangle at its longest edge until all are shorter than dx; leaves out parts further than reach from the region
template <class Visit>
void wallSet::split(const std::array<vector, 3>& t, const boundBox& region, scalar reach,
                    const Visit& visit) const
{
    int longest = 0;
    scalar length = 0;
    for (int k = 0; k < 3; ++k)
        if (const scalar l = (t[k] - t[(k + 1) % 3]).norm(); l > length) longest = k, length = l;
    const scalar off = std::sqrt(region.distSqr((t[0] + t[1] + t[2]) / 3));
    if (!(off < reach + length)) return;
    if (length <= dx_) return visit(t);
    const vector &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3],
                 middle = 0.5 * (a + b);
    split({a, middle, c}, region, reach, visit), split({middle, b, c}, region, reach, visit);
}

// Makes elements from the facets near particles, no longer than dx.  Facets in one cell of dx with the same direction become
// one element: its area vector is the sum, its centre the mean.  Facets beyond symmetry planes and cyclic sides are images
void wallSet::makeElements(const particleCloud& cloud)
{
    elements_.clear();
    std::map<std::array<label, 7>, size_t> known;  // wall, cell, direction -> element
    List<scalar> weight;
    const auto add = [&](size_t body, label w, const vector& x, const vector& S) {
        std::array<label, 7> key = {w};
        for (int d = 0; d < 3; ++d)
        {
            key[1 + d] = label(std::floor(x[d] / dx_));
            key[4 + d] = label(std::lround(2 * S[d] / S.norm()));
        }
        const auto [at, isNew] = known.try_emplace(key, elements_.size());
        if (isNew)
            elements_.push_back({body, w, vector::Zero(), vector::Zero(), 0}), weight.push_back(0);
        element& e = elements_[at->second];
        scalar& sum = weight[at->second];
        e.x = (sum * e.x + S.norm() * x) / (sum + S.norm());
        e.S += S, sum += S.norm();
        return at->second;
    };
    boundBox region;
    for (label i = 0; i < cloud.n(); ++i) region.add(cloud.x[i].xyz());
    const scalar reach = region.diagonal() + 10 * support_;
    for (size_t b = 0; b < bodies_.size(); ++b)
    {
        const body& own = bodies_[b];
        if (!own.surface->mesh()) continue;
        const triSurface s = group_->clipped(*own.surface->mesh(), 1e-6 * dx_);
        const scalar depth = perDepth(*own.surface);
        const auto facet = [&](label w, const vector& p, const vector& q, const vector& r) {
            vector x = (p + q + r) / 3, S = 0.5 * depth * (q - p).cross(r - p);
            if (nDims_ == 2) x[2] = S[2] = 0;
            if (S.isZero(0)) return;
            for (const int side : {1, -1})
            {
                if (side < 0 && !own.twoSided) continue;
                const size_t at = add(b, w, x, side * S);
                if (bodies_.size() > 1) elements_[at].facets.push_back({p, q, r});
            }
        };
        for (label t = 0; t < s.size(); ++t)
            split({s.corner(t, 0), s.corner(t, 1), s.corner(t, 2)}, region, reach,
                  [&](const std::array<vector, 3>& f) {
                      facet(own.walls[s.patch[t]], f[0], f[1], f[2]);
                  });
    }
    for (element& e : elements_)
        for (const auto& f : e.facets)
            for (const vector& corner : f) e.reach = std::max(e.reach, (corner - e.x).norm());
}

void wallSet::cover(const particleCloud& cloud)
{
    lattice_.cover(cloud, walls_);
    coverPlanes(cloud);
}

// The region depends on the present places of particles, not on earlier ones: a restart finds the same elements
void wallSet::coverPlanes(const particleCloud& cloud)
{
    if (cloud.n() == 0 ||
        std::none_of(walls_.begin(), walls_.end(), [](const wall& w) { return w.plane; }))
        return;
    boundBox box;
    for (label i = 0; i < cloud.n(); ++i) box.add(cloud.x[i].xyz());
    const scalar step = 8 * dx_;
    boundBox region;
    region.add(step * ((box.min.array() - support_) / step).floor().matrix());
    region.add(step * ((box.max.array() + support_) / step).ceil().matrix());
    if (!planesCovered_.empty() && planesCovered_.min == region.min &&
        planesCovered_.max == region.max)
        return;
    planesCovered_ = region, planeElements_.clear();
    for (size_t b = 0; b < bodies_.size(); ++b)
        for (const label w : bodies_[b].walls)
            if (walls_[w].plane)
                for (const planeLattice::element& e : lattice_.elements(walls_[w], walls_, region))
                    planeElements_.push_back({b, w, e.x, e.area * walls_[w].normal,
                                              nDims_ == 3 ? std::sqrt(e.area) : e.area});
}

// Share of an element's facets that lies before the surface of another body
scalar wallSet::shareBefore(const element& e, const body& other) const
{
    const auto depth = [&](const vector& v) {
        const surfaceFoot f =
            other.surface->find(frame(other).toBody(frame(bodies_[e.body]).toSpace(v)));
        return f.found && f.aside < e.reach ? f.depth : -e.reach;
    };
    scalar before = 0, all = 0;
    for (const auto& [a, b, c] : e.facets)
    {
        const scalar area = (b - a).cross(c - a).norm();
        before += area * shareBelowZero({depth(a), depth(b), depth(c)}, 1e-6 * dx_), all += area;
    }
    return before / all;
}

// Share of an element, at present at x, that lies in the fluid and not behind the surface of another body
scalar wallSet::uncovered(const element& e, const vector& x) const
{
    scalar share = 1;
    for (size_t b = 0; b < bodies_.size(); ++b)
    {
        if (b == e.body || bodies_[b].twoSided) continue;
        const vector y = frame(bodies_[b]).toBody(x);
        if (bodies_[b].surface->surelyFar(y)) continue;
        const surfaceFoot f = bodies_[b].surface->find(y);
        if (!f.found || f.aside >= e.reach) continue;
        if (std::abs(f.depth) >= e.reach) share = f.depth < 0 ? share : 0;
        else if (e.facets.empty())  // a square of a plane, with the width `reach`
            share = std::min(share, std::clamp(0.5 - f.depth / e.reach, 0.0, 1.0));
        else share = std::min(share, shareBefore(e, bodies_[b]));
    }
    return share;
}

void wallSet::addSurface(particleCloud& cloud) const
{
    if (empty() || cloud.n() == 0) return;
    const occupancy cells(cloud, support_);
    for (const List<element>* all : {&elements_, &planeElements_})
        for (const element& e : *all)
        {
            const wall& w = walls_[e.wall];
            const vector x = w.frame.toSpace(e.x);
            if (!cells.near(x)) continue;
            const scalar share = uncovered(e, x);
            if (share == 0) continue;
            const vector S = 0.5 * share * (w.frame.turn(e.S) + w.after.turn(e.S));
            cloud.surface.push_back({x, S, w.velocity.at(x), !w.slip});
        }
}

}  // namespace ispf
