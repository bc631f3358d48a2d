// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.H"

#include "surfaceTopology.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

word shapeOf(const dictionary& dict)
{
    return dict.choose("shape", {"box", "sphere", "ellipsoid", "cylinder", "annulus"});
}

// A smaller or larger radius, in dx, comes from a wrong unit
constexpr scalar smallest = 0.1;
// So does a larger coordinate, in dx
constexpr scalar farthest = 1e7;
constexpr scalar largest(int nDims)
{
    return nDims == 3 ? 2e3 : 1e4;
}

scalar radiusOf(const dictionary& dict, const word& key, scalar dx, int nDims)
{
    return dict.getInRange(key, smallest * dx, largest(nDims) * dx, dims::length);
}

vector semiAxesOf(const dictionary& dict, scalar dx, int nDims)
{
    const vector axes = dict.get<vector>("semiAxes", dims::length);
    for (int d = 0; d < nDims; ++d)
        if (!(axes[d] >= smallest * dx && axes[d] <= largest(nDims) * dx))
            dict.fail("semiAxes", "Each of the semiAxes must lie between " + str(smallest * dx) +
                                      " and " + str(largest(nDims) * dx));
    return axes;
}

// Inner and outer radius
std::pair<scalar, scalar> ringOf(const dictionary& dict, scalar dx, int nDims)
{
    const scalar inner = radiusOf(dict, "innerRadius", dx, nDims),
                 outer = radiusOf(dict, "outerRadius", dx, nDims);
    if (!(inner < outer))
        dict.fail("innerRadius", "The innerRadius " + str(inner) +
                                     " must be smaller than the outerRadius " + str(outer));
    return {inner, outer};
}

// A point within the range that numbers resolve in comparison with dx
vector placeOf(const dictionary& dict, const word& key, scalar dx, int nDims)
{
    const vector x = dict.get<vector>(key, dims::length);
    for (int d = 0; d < nDims; ++d)
        if (!(std::abs(x[d]) <= farthest * dx))
            dict.fail(key, "The coordinate " + str(x[d]) + " m of " + key + " is " +
                               str(x[d] / dx, 3) + " dx from the origin, more than " +
                               str(farthest) + " dx. Are dx and the unit right?");
    return x;
}

// Lower and upper corner
std::pair<vector, vector> cornersOf(const dictionary& dict, scalar dx, int nDims)
{
    const vector low = placeOf(dict, "min", dx, nDims), high = placeOf(dict, "max", dx, nDims);
    for (int d = 0; d < nDims; ++d)
        if (!(low[d] < high[d]))
            dict.fail("max", "Every coordinate of max must be greater than that of min");
    return {low, high};
}

// The ends of an axis
std::pair<vector, vector> endsOf(const dictionary& dict, scalar dx)
{
    const vector p1 = placeOf(dict, "point1", dx, 3), p2 = placeOf(dict, "point2", dx, 3);
    if (!((p2 - p1).norm() > 0)) dict.fail("point2", "point1 and point2 are the same point");
    return {p1, p2};
}

// Number of segments of a circle with a sag below 1e-3 dx; a multiple of 4 keeps symmetry planes
label segments(scalar radius, scalar dx)
{
    const scalar angle = std::acos(std::max(0.0, 1 - 1e-3 * dx / radius));
    return 4 * std::max<label>(4, label(std::ceil(M_PI / (4 * angle))));
}

void quad(triSurface& s, const vector& a, const vector& b, const vector& c, const vector& d)
{
    s.add(a, b, c, 0), s.add(a, c, d, 0);
}

triSurface box(const vector& lo, const vector& hi)
{
    triSurface s;
    s.addPatch("");
    const auto p = [&](int i, int j, int k) {
        return vector(i ? hi[0] : lo[0], j ? hi[1] : lo[1], k ? hi[2] : lo[2]);
    };
    quad(s, p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0));
    quad(s, p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
    quad(s, p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
    quad(s, p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0));
    quad(s, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
    quad(s, p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
    return s;
}

struct frame  // of a body of revolution
{
    vector origin, axis, u, v;

    frame(const vector& from, const vector& along) : origin(from), axis(along.normalized())
    {
        int least;
        axis.cwiseAbs().minCoeff(&least);
        u = vector::Unit(least) - axis[least] * axis;
        u.normalize();
        v = axis.cross(u);
    }
    vector at(scalar r, scalar z, scalar angle) const
    {
        return origin + z * axis + r * (std::cos(angle) * u + std::sin(angle) * v);
    }
};

// Turns a closed outline of (radius, height) about the axis
triSurface revolved(const frame& f, const List<std::pair<scalar, scalar>>& outline, label n)
{
    triSurface s;
    s.addPatch("");
    for (label k = 0; k < n; ++k)
    {
        const scalar a = 2 * M_PI * k / n, b = 2 * M_PI * (k + 1) / n;
        for (size_t e = 0; e < outline.size(); ++e)
        {
            const auto [r0, z0] = outline[e];
            const auto [r1, z1] = outline[(e + 1) % outline.size()];
            if (r0 == 0 && r1 == 0) continue;
            const vector p = f.at(r0, z0, a), q = f.at(r0, z0, b);
            const vector c = f.at(r1, z1, b), d = f.at(r1, z1, a);
            if (r0 > 0) s.add(p, q, c, 0);
            if (r1 > 0) s.add(p, c, d, 0);
        }
    }
    return s;
}

triSurface ellipsoid(const vector& centre, const vector& semi, scalar dx)
{
    const label n = segments(semi.maxCoeff(), dx), rings = n / 2;
    List<std::pair<scalar, scalar>> outline;
    for (label k = 0; k <= rings; ++k)
    {
        const scalar angle = M_PI * k / rings;
        outline.push_back({k == 0 || k == rings ? 0 : std::sin(angle), -std::cos(angle)});
    }
    triSurface s = revolved(frame(vector::Zero(), vector::UnitZ()), outline, n);
    for (vector& p : s.nodes) p = centre + vector(semi.cwiseProduct(p));
    return s;
}

triSurface tube(const vector& p1, const vector& p2, scalar inner, scalar outer, scalar dx)
{
    const scalar length = (p2 - p1).norm();
    const List<std::pair<scalar, scalar>> outline = {
        {inner, 0}, {outer, 0}, {outer, length}, {inner, length}};
    return revolved(frame(p1, p2 - p1), outline, segments(outer, dx));
}

// The ellipse, disc or ring with semi-axes `outer` as a prism
triSurface prism(const vector& centre, const vector& outer, scalar inner, scalar dx)
{
    const scalar h = prismHalfHeight * dx, big = std::max(outer[0], outer[1]);
    const scalar hole = inner / big;
    triSurface s = revolved(frame(vector(0, 0, -h), vector::UnitZ()),
                            {{hole, 0}, {1, 0}, {1, 2 * h}, {hole, 2 * h}}, segments(big, dx));
    for (vector& p : s.nodes)
        p = vector(centre[0] + outer[0] * p[0], centre[1] + outer[1] * p[1], p[2]);
    return s;
}

triSurface flatShape(const dictionary& dict, scalar dx)
{
    const word shape = shapeOf(dict);
    const scalar h = prismHalfHeight * dx;
    if (shape == "box")
    {
        auto [lo, hi] = cornersOf(dict, dx, 2);
        lo[2] = -h, hi[2] = h;
        return box(lo, hi);
    }
    if (shape == "ellipsoid")
        return prism(placeOf(dict, "centre", dx, 2), semiAxesOf(dict, dx, 2), 0, dx);
    if (shape == "sphere")
        return prism(placeOf(dict, "centre", dx, 2),
                     vector::Constant(radiusOf(dict, "radius", dx, 2)), 0, dx);
    const vector centre = placeOf(dict, "point1", dx, 2);
    dict.getOrDefault<vector>("point2", centre, dims::length);
    if (shape == "cylinder")
        return prism(centre, vector::Constant(radiusOf(dict, "radius", dx, 2)), 0, dx);
    const auto [inner, outer] = ringOf(dict, dx, 2);
    return prism(centre, vector::Constant(outer), inner, dx);
}

triSurface fullShape(const dictionary& dict, scalar dx)
{
    const word shape = shapeOf(dict);
    if (shape == "box")
    {
        const auto [low, high] = cornersOf(dict, dx, 3);
        return box(low, high);
    }
    if (shape == "sphere")
        return ellipsoid(placeOf(dict, "centre", dx, 3),
                         vector::Constant(radiusOf(dict, "radius", dx, 3)), dx);
    if (shape == "ellipsoid")
        return ellipsoid(placeOf(dict, "centre", dx, 3), semiAxesOf(dict, dx, 3), dx);
    const auto [p1, p2] = endsOf(dict, dx);
    if (shape == "cylinder") return tube(p1, p2, 0, radiusOf(dict, "radius", dx, 3), dx);
    const auto [inner, outer] = ringOf(dict, dx, 3);
    return tube(p1, p2, inner, outer, dx);
}

}  // namespace

triSurface makeShape(const dictionary& dict, scalar dx, int nDims)
{
    triSurface s = nDims == 2 ? flatShape(dict, dx) : fullShape(dict, dx);
    s.weld(1e-9 * dx);
    orientOutward(s);
    return s;
}

scalar shapeVolume(const dictionary& dict)
{
    const word shape = shapeOf(dict);
    const auto scalarOf = [&](const char* key) { return dict.get<scalar>(key, dims::length); };
    if (shape == "box")
        return (dict.get<vector>("max", dims::length) - dict.get<vector>("min", dims::length))
            .prod();
    if (shape == "sphere") return 4 * M_PI / 3 * std::pow(scalarOf("radius"), 3);
    if (shape == "ellipsoid")
        return 4 * M_PI / 3 * dict.get<vector>("semiAxes", dims::length).prod();
    const scalar length =
        (dict.get<vector>("point2", dims::length) - dict.get<vector>("point1", dims::length))
            .norm();
    if (shape == "cylinder") return M_PI * std::pow(scalarOf("radius"), 2) * length;
    const scalar outer = scalarOf("outerRadius"), inner = scalarOf("innerRadius");
    return M_PI * (outer * outer - inner * inner) * length;
}

}  // namespace ispf
