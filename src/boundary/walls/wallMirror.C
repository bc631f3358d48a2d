// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMirror.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Least cosine between normals of one part; below it is a corner: 41 degrees
constexpr scalar parallel = 0.75;
// Bounds of the volume factor.  Larger factors occur only near the centre of curvature, where particles are few.  It must
// not be zero: viscosity divides by it
constexpr scalar leastStretch = 1e-3, mostStretch = 2;

// Part of each triangle: connected through edges that are not sharp
List<label> smoothParts(const triSurface& s, bool twoSided)
{
    std::map<std::pair<label, label>, List<label>> users;
    for (label t = 0; t < s.size(); ++t)
        for (int k = 0; k < 3; ++k)
            users[std::minmax(s.triangles[t][k], s.triangles[t][(k + 1) % 3])].push_back(t);
    List<label> part(s.size(), -1);
    label nParts = 0;
    for (label seed = 0; seed < s.size(); ++seed)
    {
        if (part[seed] >= 0) continue;
        List<label> front = {seed};
        part[seed] = nParts;
        while (!front.empty())
        {
            const label t = front.back();
            front.pop_back();
            for (int k = 0; k < 3; ++k)
                for (const label u :
                     users[std::minmax(s.triangles[t][k], s.triangles[t][(k + 1) % 3])])
                {
                    const scalar cosine = s.normal(t).dot(s.normal(u));
                    if (part[u] >= 0 || (twoSided ? std::abs(cosine) : cosine) < parallel) continue;
                    part[u] = nParts, front.push_back(u);
                }
        }
        ++nParts;
    }
    return part;
}

// Volume factor of the image of a region at the distance d before a wall: the product of (1 + kappa d)/(1 - kappa d) over
// the principal curvatures, positive where the wall bends around the fluid.  kappa across t comes from the surface at the
// distance a before the wall.  Its curvature kappa/(1 - kappa a) is 2 s/(a^2 - s^2), with s the approach to the wall on the
// way a t: exact for balls.  Three directions 120 degrees apart give the mean curvature H and half the difference D
scalar imageVolume(const patchSurface& surface, const surfaceFoot& f, int nDims, scalar a)
{
    const vector y = f.foot - a * f.normal;
    const auto curvature = [&](const vector& t) {
        const surfaceFoot beside = surface.find(y + a * t);
        if (!beside.found) return 0.0;
        const scalar s = beside.depth + a;
        return 2 * s / std::max(a * a - s * s + 2 * a * s, 1e-9 * a * a);
    };
    const auto stretch = [&](scalar kappa) {
        const scalar kd = -kappa * f.depth;
        return kd < 1 ? std::clamp((1 + kd) / (1 - kd), leastStretch, mostStretch) : mostStretch;
    };
    if (nDims == 2)
    {
        const vector t(-f.normal[1], f.normal[0], 0);
        return stretch(0.5 * (curvature(t) + curvature(-t)));
    }
    const vector t = f.normal.unitOrthogonal(), across = std::sqrt(0.75) * f.normal.cross(t);
    const vector kappa(curvature(t), curvature(across - 0.5 * t), curvature(-across - 0.5 * t));
    const scalar H = kappa.mean(), D = std::sqrt(2.0 / 3 * (kappa.array() - H).square().sum());
    return stretch(H + D) * stretch(H - D);
}

// Shortest way to several planes at once, and the projector onto the directions it can have
struct wayToPlanes
{
    tensor P = tensor::Zero();
    vector s = vector::Zero();

    void add(const vector& normal, scalar distance)
    {
        vector e = normal - P * normal;
        const scalar length = e.norm();
        e /= length;
        s += (distance - normal.dot(s)) / length * e;
        P += e * e.transpose();
    }
};

}  // namespace

void wallMirror::find(const wallSet& walls, scalar support)
{
    support_ = support;
    for (size_t b = 0; b < walls.bodies().size(); ++b)
    {
        const wallSet::body& body = walls.bodies()[b];
        const auto mirrors = [&](label patch) {
            const wallRepresentation r = walls.walls()[body.walls[patch]].representation;
            return r == wallRepresentation::mirror;
        };
        const bool rigid = body.twoSided && !mirrors(0);
        const triSurface* mesh = body.surface->mesh();
        if (!mesh)
        {
            if (mirrors(0)) parts_.push_back({b, nullptr, false});
            continue;
        }
        const triSurface made =
            mesh->subset([&](label t) { return mirrors(mesh->patch[t]) || body.twoSided; });
        if (made.empty()) continue;
        const List<label> number = smoothParts(made, body.twoSided);
        for (label p = 0; p <= *std::max_element(number.begin(), number.end()); ++p)
            parts_.push_back(
                {b,
                 patchSurface::triangles(made.subset([&](label t) { return number[t] == p; }),
                                         imageGroup(), support, body.twoSided),
                 rigid});
    }
}

List<wallMirror::foot> wallMirror::feet(const particleCloud& cloud, const wallSet& walls,
                                        label i) const
{
    List<foot> found;
    for (label p = 0; p < label(parts_.size()); ++p)
    {
        const wallSet::body& body = walls.bodies()[parts_[p].body];
        const patchSurface& surface = parts_[p].own ? *parts_[p].own : *body.surface;
        const bodyFrame& frame = walls.frame(body);
        const vector x = frame.toBody(cloud.x[i].xyz());
        if (surface.surelyFar(x)) continue;
        const surfaceFoot f = surface.find(x);
        const bool beside = f.aside > 0 && !cloud.beyondOpen(i);
        if (!f.found || f.depth >= 0 || f.depth < -support_) continue;
        // past the rim of a sheet a particle sees fluid, or the image of the fluid beside it, never both; past the edge of a
        // thick wall it sees the fluid
        if (beside && !(body.twoSided && f.aside < support_)) continue;
        const wall& w = walls.walls()[body.walls[f.patch]];
        // a deeper image is seen only at the edge of the support
        const bool bent = surface.mesh() && -f.depth < 0.75 * support_;
        const scalar volume = bent ? imageVolume(surface, f, cloud.nDims, cloud.dx) : 1;
        const vector at = frame.toSpace(f.foot);
        found.push_back(
            {p, frame.turn(f.normal), w.velocity.at(at), -f.depth, volume, beside, w.slip});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const foot& a, const foot& b) { return a.distance < b.distance; });
    if (found.size() > 3) found.resize(3);  // more walls do not meet in a corner
    return found;
}

class wallMirror::imageAdder
{
public:
    imageAdder(const wallMirror& mirror, particleCloud& cloud, List<vector>& facing)
        : mirror_(mirror), cloud_(cloud), facing_(facing)
    {
    }

    void add(label i, const List<foot>& feet)
    {
        for (unsigned group = 1; group < 1u << feet.size(); ++group)
        {
            List<foot> members;
            for (size_t k = 0; k < feet.size(); ++k)
                if (group >> k & 1) members.push_back(feet[k]);
            if (cornered(members)) addImage(i, members);
        }
    }

private:
    static bool cornered(const List<foot>& members)
    {
        for (const foot& a : members)
            for (const foot& b : members)
                if (&a < &b &&
                    (a.beside || b.beside || std::abs(a.normal.dot(b.normal)) > parallel))
                    return false;
        return true;
    }

    void addImage(label i, const List<foot>& members)
    {
        wayToPlanes way;
        vector direction = vector::Zero(), velocity = vector::Zero();
        bool rigid = true;
        scalar volume = 1;
        for (const foot& f : members)
        {
            volume *= f.volume;
            way.add(f.normal, f.distance);
            direction += f.normal, velocity += f.wallVelocity / scalar(members.size());
            rigid = rigid && mirror_.parts_[f.part].rigid;
        }
        if (way.s.norm() > mirror_.support_) return;
        const vector at = cloud_.x[i].xyz() + 2 * way.s;
        if (rigid) cloud_.addRigid(at, velocity, at);
        else
        {
            const tensor A = velocityMap(members);
            const label rule = ruleFor(members, way.P, A);
            cloud_.addMirror({i, rule, volume}, at, vec4::from(velocity - A * velocity));
        }
        facing_.push_back(cloud_.beyondOpen(i) ? vector(vector::Zero()) : direction.normalized());
    }

    // Each wall reverses the velocity relative to its own; a wall with slip reverses the normal part only
    tensor velocityMap(const List<foot>& members) const
    {
        wayToPlanes slip;
        scalar sign = 1;
        for (const foot& f : members)
            if (f.slip) slip.add(f.normal, 0);
            else sign = -sign;
        return sign * (tensor::Identity() - 2 * slip.P);
    }

    // All particles of a flat part share one rule
    label ruleFor(const List<foot>& members, const tensor& P, const tensor& A)
    {
        List<label> parts;
        for (const foot& f : members) parts.push_back(f.part);
        const auto close = [](const tensor& a, const tensor& b) {
            return (a - b).cwiseAbs().maxCoeff() < 1e-9;
        };
        known& last = last_[parts];
        if (last.rule >= 0 && close(last.P, P) && close(last.A, A)) return last.rule;
        Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
        M.topLeftCorner<3, 3>() = A;
        last = {P, A, cloud_.addRule(M, tensor::Identity() - 2 * P)};
        return last.rule;
    }

    const wallMirror& mirror_;
    particleCloud& cloud_;
    List<vector>& facing_;
    struct known
    {
        tensor P, A;
        label rule = -1;
    };
    std::map<List<label>, known> last_;
};

void wallMirror::addImages(particleCloud& cloud, const wallSet& walls, List<vector>& facing) const
{
    if (parts_.empty()) return;
    List<List<foot>> found(cloud.n());
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) found[i] = feet(cloud, walls, i);
    });
    imageAdder adder(*this, cloud, facing);
    for (label i = 0; i < cloud.n(); ++i) adder.add(i, found[i]);
}

}  // namespace ispf
