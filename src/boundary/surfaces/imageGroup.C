// SPDX-License-Identifier: GPL-3.0-or-later
#include "imageGroup.H"
#include "halfSpace.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

structureImage identity()
{
    return {tensor::Identity(), vector::Zero()};
}

structureImage after(const structureImage& second, const structureImage& first)
{
    return {second.R * first.R, second.R * first.t + second.t};
}

bool same(const structureImage& a, const structureImage& b, scalar length)
{
    return (a.R - b.R).cwiseAbs().maxCoeff() < 1e-9 &&
           (a.t - b.t).cwiseAbs().maxCoeff() < 1e-9 * length;
}

bool contains(const List<structureImage>& list, const structureImage& map, scalar length)
{
    for (const structureImage& m : list)
        if (same(m, map, length)) return true;
    return false;
}

std::array<vector, 8> corners(const boundBox& box)
{
    std::array<vector, 8> c;
    for (int k = 0; k < 8; ++k)
        for (int d = 0; d < 3; ++d) c[k][d] = k >> d & 1 ? box.max[d] : box.min[d];
    return c;
}

}  // namespace

void imageGroup::addSymmetryPlane(const word& patch, const vector& point, const vector& normal)
{
    const vector n = normal.normalized();
    const structureImage mirror = {tensor::Identity() - 2 * n * n.transpose(),
                                   2 * n.dot(point) * n};
    sides_.push_back({patch, point, n, mirror, mirror, false});
}

void imageGroup::addCyclic(const word& patch, const vector& point, const vector& separation,
                           std::shared_ptr<Function1> drop)
{
    if (drop) drops_.push_back({separation, std::move(drop), 0});
    const vector n = separation.normalized();
    const structureImage up = {tensor::Identity(), separation};
    const structureImage down = {tensor::Identity(), -separation};
    sides_.push_back({patch, point, -n, down, up, true});
    sides_.push_back({patch, point + separation, n, up, down, true});
}

void imageGroup::setTime(scalar t)
{
    for (pressureDrop& d : drops_) d.now = d.function->value(t);
}

// The separations of pairs are at right angles to all other sides, so map.t tells how often each pair is passed
scalar imageGroup::pressureOffset(const structureImage& map) const
{
    scalar offset = 0;
    for (const pressureDrop& d : drops_)
        offset -= std::round(map.t.dot(d.separation) / d.separation.squaredNorm()) * d.now;
    return offset;
}

vector imageGroup::pressureSlope() const
{
    vector slope = vector::Zero();
    for (const pressureDrop& d : drops_) slope -= d.now / d.separation.squaredNorm() * d.separation;
    return slope;
}

List<std::pair<vector, vector>> imageGroup::symmetryPlanes() const
{
    List<std::pair<vector, vector>> planes;
    for (const side& s : sides_)
        if (!s.cyclic) planes.push_back({s.point, s.normal});
    return planes;
}

List<std::pair<vector, vector>> imageGroup::planes() const
{
    List<std::pair<vector, vector>> planes;
    for (const side& s : sides_) planes.push_back({s.point, s.normal});
    return planes;
}

triSurface imageGroup::clipped(triSurface surface, scalar tolerance) const
{
    for (const side& s : sides_) surface = ispf::clipped(surface, {s.point, s.normal}, tolerance);
    return surface;
}

scalar imageGroup::beyond(const vector& x) const
{
    scalar most = -std::numeric_limits<scalar>::infinity();
    for (const side& s : sides_) most = std::max(most, (x - s.point).dot(s.normal));
    return most;
}

imageGroup::wayHome imageGroup::wayBack(const vector& x) const
{
    for (const side& s : sides_)
        if ((x - s.point).dot(s.normal) > 0) return {&s.back, &s.patch, !s.cyclic};
    return {};
}

// Chambers must be images of one another: reflections at an edge generate a finite set
// if the angle between the planes is 180 degrees over a whole number (Coxeter 1934)
void imageGroup::checkAngles() const
{
    for (const side& a : sides_)
        for (const side& b : sides_)
        {
            if (&a >= &b || a.patch == b.patch) continue;
            const scalar angle = std::acos(std::clamp(-a.normal.dot(b.normal), -1.0, 1.0));
            const bool parallel = angle < 1e-6 || M_PI - angle < 1e-6;
            const scalar parts = parallel ? 0 : M_PI / angle;
            const bool orthogonal = std::abs(angle - 0.5 * M_PI) < 1e-6;
            const bool fits = a.cyclic || b.cyclic ? orthogonal
                              : parallel           ? angle < 1e-6
                                                   : std::abs(parts - std::round(parts)) < 1e-6;
            if (fits) continue;
            throw fatalError(
                "Patches " + a.patch + " and " + b.patch + " meet at " + str(angle * 180 / M_PI) +
                " degrees, so that their images overlap. Symmetry planes must meet at 180 degrees "
                "over a whole number and face each other when parallel; cyclic pairs must be at "
                "right angles to each other and to symmetry planes");
        }
}

void imageGroup::checkInside(const particleCloud& cloud) const
{
    const auto rest = cloud.vectors.find("x0");
    for (const side& s : sides_)
        for (label i = 0; i < cloud.n(); ++i)
        {
            scalar out = (cloud.x[i].xyz() - s.point).dot(s.normal);
            // a solid that moves across a cyclic plane began within the planes
            if (s.cyclic && i < cloud.nSolid() && rest != cloud.vectors.end())
                out = std::min(out, (rest->second[i].xyz() - s.point).dot(s.normal));
            if (out < 0.5 * cloud.dx) continue;
            throw fatalError("Particle " + std::to_string(cloud.id[i]) + " lies " +
                             str(out / cloud.dx) + " dx beyond patch " + s.patch +
                             ". Give the plane a normal that points out of the particles, and a "
                             "cyclic pair the point on its first plane");
        }
    // the two sides of a pair are adjacent in sides_; from the last particles to the first images there is one spacing
    for (size_t k = 0; k + 1 < sides_.size(); ++k)
    {
        const side &a = sides_[k], &b = sides_[k + 1];
        if (!a.cyclic || a.patch != b.patch) continue;
        scalar gap[2] = {-std::numeric_limits<scalar>::infinity(), 0};
        gap[1] = gap[0];
        for (label i = 0; i < cloud.n(); ++i)
            for (int s = 0; s < 2; ++s)
            {
                const side& at = s ? b : a;
                gap[s] = std::max(gap[s], (cloud.x[i].xyz() - at.point).dot(at.normal));
            }
        if (-gap[0] - gap[1] < 2 * cloud.dx) continue;
        throw fatalError(
            "The particles end " + str(-gap[0] / cloud.dx) +
            " dx before the one side of "
            "cyclic patch " +
            a.patch + " and " + str(-gap[1] / cloud.dx) +
            " dx before the other, where half a spacing each is right: what leaves one side "
            "would enter a gap. Set point and separation to where the particles end");
    }
}

// Box of the particles, extended to the planes that they may reach
boundBox imageGroup::regionOf(const particleCloud& cloud) const
{
    boundBox box;
    for (label i = 0; i < cloud.n(); ++i)
        if (beyond(cloud.x[i].xyz()) < 0.5 * cloud.dx) box.add(cloud.x[i].xyz());
    const boundBox inner = box;
    for (const side& s : sides_)
        for (const vector& c : corners(inner)) box.add(c - (c - s.point).dot(s.normal) * s.normal);
    return box;
}

bool imageGroup::comesNear(const structureImage& map, const boundBox& region) const
{
    for (const side& s : sides_)
    {
        scalar nearest = std::numeric_limits<scalar>::infinity();
        for (const vector& c : corners(region))
            nearest = std::min(nearest, (map(c) - s.point).dot(s.normal));
        if (nearest > support_) return false;
    }
    return true;
}

// Finds all images breadth-first: multiplies each known map g by the map s of each plane
void imageGroup::grow(const boundBox& region)
{
    const scalar length = region.diagonal() + support_;
    List<structureImage> all = {identity()};
    for (size_t k = 0; k < all.size(); ++k)
        for (const side& s : sides_)
        {
            const structureImage next = after(all[k], s.out);
            if (contains(all, next, length) || !comesNear(next, region)) continue;
            all.push_back(next);
            if (all.size() > 1000)
                throw fatalError(
                    "More than 1000 images of the particles lie within the kernel "
                    "support " +
                    str(support_) +
                    " m: the region between the "
                    "symmetry planes and cyclic pairs is too thin. Widen it");
        }
    for (size_t k = 0; k < all.size(); ++k)  // links expect the inverse of every map in the list
    {
        const structureImage inverse = {all[k].R.transpose(), -(all[k].R.transpose() * all[k].t)};
        if (!contains(all, inverse, length)) all.push_back(inverse);
    }
    maps_.assign(all.begin() + 1, all.end());
}

// Number of copies of the modelled part in the whole; only planes without a parallel partner count
void imageGroup::setFactor()
{
    List<structureImage> turns = {identity()};
    const auto alone = [&](const side& a) {
        for (const side& b : sides_)
            if (&a != &b && a.normal.dot(b.normal) < -1 + 1e-9) return false;
        return !a.cyclic;
    };
    for (size_t k = 0; k < turns.size(); ++k)
        for (const side& s : sides_)
        {
            const structureImage next = {turns[k].R * s.out.R, vector::Zero()};
            if (alone(s) && !contains(turns, next, 1)) turns.push_back(next);
        }
    factor_ = scalar(turns.size());
}

void imageGroup::close(const particleCloud& cloud, scalar support)
{
    support_ = support, tiny_ = 1e-6 * cloud.dx;
    if (sides_.empty()) return;
    checkAngles();
    checkInside(cloud);
    grow(regionOf(cloud));
    setFactor();
}

namespace
{

Eigen::Matrix4d turn(const tensor& R)
{
    Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
    M.topLeftCorner<3, 3>() = R;
    return M;
}

vec4 turned(const tensor& R, const vec4& b)
{
    return vec4::from(R * b.xyz(), b[3]);
}

// Makes the images of one map: of owned particles, of mirror images (their rules are multiplied) and of
// rigid particles
struct imageMaker
{
    particleCloud& cloud;
    const structureImage& map;
    scalar p;  // pressure offset of the map
    label ownRule;
    std::map<label, label> productRule;

    imageMaker(particleCloud& c, const structureImage& m, scalar offset)
        : cloud(c), map(m), p(offset), ownRule(c.addRule(turn(m.R), m.R))
    {
    }

    void add(label e, const vector& at)
    {
        if (e < cloud.n()) return cloud.addImage(e, ownRule, at, vec4::from(vector(0, 0, 0), p));
        vec4 b = turned(map.R, cloud.ghostOffset(e));
        if (cloud.ghostSource(e) < 0)
        {
            const vec4& depth = cloud.ghostDepth(e);
            return cloud.addRigid(at, b.xyz(), at + depth[3] * (map.R * depth.xyz()));
        }
        const label rule = cloud.ruleIndex(e);
        if (!productRule.count(rule))
        {
            const ghostRule inner = cloud.ruleOf(e);
            productRule[rule] = cloud.addRule(turn(map.R) * inner.M, map.R * inner.R);
        }
        b[3] += p;
        cloud.addMirror({cloud.ghostSource(e), productRule[rule], cloud.ghostVolume(e)}, at, b);
    }
};

}  // namespace

// Solids are moved over a cyclic plane as whole bodies: the largest distance that they reach beyond a plane is added to the
// support
scalar imageGroup::reach(const particleCloud& cloud) const
{
    scalar most = 0;
    for (label i = 0; i < cloud.nSolid(); ++i)
        for (const side& s : sides_)
            if (s.cyclic) most = std::max(most, (cloud.x[i].xyz() - s.point).dot(s.normal));
    return support_ + most;
}

vector imageGroup::wayOverCyclic(const vector& x) const
{
    vector way = vector::Zero();
    for (size_t k = 0; k < 8 * sides_.size(); ++k)
    {
        const side& s = sides_[k % sides_.size()];
        if (s.cyclic && (x + way - s.point).dot(s.normal) > 0) way += s.back.t;
    }
    return way;
}

void imageGroup::addImages(particleCloud& cloud, List<vector>& facing) const
{
    if (maps_.empty()) return;
    const scalar reach = this->reach(cloud);
    List<imageMaker> makers;
    for (const structureImage& map : maps_) makers.emplace_back(cloud, map, pressureOffset(map));
    const label n = cloud.nAll();
    List<vector> taken;
    for (label e = 0; e < n; ++e)
    {
        const vector x = cloud.x[e].xyz();
        if (beyond(x) < -reach) continue;
        taken.assign(1, x);  // a particle on a plane is its own image
        for (imageMaker& maker : makers)
        {
            const vector at = maker.map(x);
            if (beyond(at) >= reach) continue;
            bool free = true;
            for (const vector& other : taken) free = free && (at - other).norm() > tiny_;
            if (!free) continue;
            taken.push_back(at);
            maker.add(e, at);
            facing.push_back(e < cloud.n() ? vector(vector::Zero())
                                           : vector(maker.map.R * facing[e - cloud.n()]));
        }
    }
}

}  // namespace ispf
