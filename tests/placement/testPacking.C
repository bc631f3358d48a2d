// SPDX-License-Identifier: GPL-3.0-or-later
// A packing must keep volumes, kernel sums (also across the faces between zones) and distances
#include "bodies.H"

#include "packingReport.H"
#include "relative.H"
#include "smoothingKernel.H"
#include "wallLayers.H"
#include <map>

using namespace ispf;

namespace
{

struct sums
{
    scalar least = 1e9, most = 0;
    label n = 0;
};

// Kernel sums over all particles by brute force; leaves out particles that see the free end of a solid
sums kernelSums(const packedScene& scene, scalar freeEndsWithin = 0)
{
    const auto kernel = smoothingKernel::New("WendlandC2", 3, scene.support / 2);
    const scalar dx = scene.geometry.dx();
    List<vector> all = scene.placed.x;
    all.insert(all.end(), scene.placed.rigid.begin(), scene.placed.rigid.end());
    for (const halfSpace& plane : scene.geometry.symmetryPlanes())
        for (size_t i = 0, n = all.size(); i < n; ++i) all.push_back(plane.mirror(all[i]));
    const boundBox box = scene.geometry.bounds();
    sums found;
    for (const vector& x : scene.placed.x)
    {
        if (std::min(x[2] - box.min[2], box.max[2] - x[2]) < freeEndsWithin) continue;
        scalar sum = 0;
        for (const vector& y : all)
            if ((x - y).squaredNorm() < scene.support * scene.support)
                sum += dx * dx * dx * kernel->W((x - y).norm()) / kernel->latticeSum(dx);
        found.least = std::min(found.least, sum), found.most = std::max(found.most, sum), ++found.n;
    }
    return found;
}

scalar closest(const packedScene& scene)
{
    scalar least = 1e9;
    for (const zoneQuality& q : packingQuality(scene.geometry, scene.placed, scene.support))
        least = std::min(least, q.minDistance);
    return least;
}

// Number of particles per layer of the solid, zone 0; layers by the radius from the axis or centre, from the inner face on
List<label> particlesPerLayer(const packedScene& scene, scalar inner, scalar thickness, label n,
                              int nDims)
{
    List<label> count(n, 0);
    const boundBox box = scene.geometry.bounds();
    for (size_t i = 0; i < scene.placed.x.size(); ++i)
    {
        const scalar z = scene.placed.x[i][2];
        const bool freeEnd = nDims == 2 && std::min(z - box.min[2], box.max[2] - z) < scene.support;
        if (scene.placed.zone[i] != 0 || freeEnd) continue;
        const scalar depth = (scene.placed.x[i].head(nDims).norm() - inner) / thickness * scalar(n);
        REQUIRE(depth > 0);
        REQUIRE(depth < n);
        CHECK(std::abs(depth - std::floor(depth) - 0.5) < 0.25);  // near the middle of its layer
        ++count[label(depth)];
    }
    return count;
}

void checkVolumes(const packedScene& scene, const List<scalar>& exact, scalar within)
{
    for (size_t z = 0; z < exact.size(); ++z)
    {
        CAPTURE(scene.geometry.zones()[z].name);
        CHECK(scene.geometry.volume(label(z)) == relative(exact[z], 1e-3));  // facets
        CHECK(scene.volumeOf(label(z)) == relative(exact[z], within));
    }
}

List<scalar> shellVolumes(scalar inner, scalar thickness, scalar dx)
{
    const auto octant = [](scalar r) { return M_PI / 6 * r * r * r; };
    const scalar outer = inner + thickness, end = outer + 5 * dx;
    return {octant(outer) - octant(inner), octant(inner), octant(end) - octant(outer)};
}

List<scalar> tubeVolumes(scalar inner, scalar thickness, scalar length, scalar dx)
{
    const auto quarter = [&](scalar r) { return M_PI / 4 * r * r * length; };
    const scalar outer = inner + thickness, end = outer + 5 * dx;
    return {quarter(outer) - quarter(inner), quarter(inner), quarter(end) - quarter(outer)};
}

constexpr scalar thickness = 2e-3;

const packedScene& fittedShell(scalar dx)  // made once: takes seconds
{
    static std::map<scalar, packedScene> made;
    const auto at = made.find(dx);
    if (at != made.end()) return at->second;
    return made.emplace(dx, sphericalShell(6e-3, thickness, dx, true)).first->second;
}

}  // namespace

TEST_CASE("a shell between two fluids: volumes, sums across its faces, as many layers as fit")
{
    for (const auto& [dx, layers] : {std::pair(0.67e-3, 3), std::pair(0.5e-3, 4)})
    {
        CAPTURE(dx);
        const packedScene& s = fittedShell(dx);
        checkVolumes(s, shellVolumes(6e-3, thickness, dx), 0.005);
        const sums k = kernelSums(s);
        CHECK(k.n == label(s.placed.x.size()));
        CHECK(k.least > 0.98);
        CHECK(k.most < 1.02);
        CHECK(closest(s) > 0.75);
        const List<label> count = particlesPerLayer(s, 6e-3, thickness, layers, 3);
        const scalar width = thickness / layers;
        for (int k = 0; k < layers; ++k)
            CHECK(dx * dx * dx * count[k] ==
                  relative(shellVolumes(6e-3 + k * width, width, dx)[0], 0.1));
    }
}

TEST_CASE("a tube between two fluids: volumes, sums, layers")
{
    const scalar dx = 0.5e-3, length = 8e-3;
    const packedScene s = tubeQuarter(5e-3, thickness, length, dx, true);
    checkVolumes(s, tubeVolumes(5e-3, thickness, length, dx), 0.005);
    const sums k = kernelSums(s, s.support);  // the tube's ends are free
    CHECK(k.n > label(s.placed.x.size()) / 2);
    CHECK(k.least > 0.98);
    CHECK(k.most < 1.02);
    CHECK(closest(s) > 0.75);
    particlesPerLayer(s, 5e-3, thickness, 4, 2);
}

TEST_CASE("lattice: volumes of curved bodies; what lies along the axes stays a lattice")
{
    const scalar dx = 0.5e-3;
    for (const scalar inner : {5e-3, 6.3e-3, 15e-3})
    {
        CAPTURE(inner);
        checkVolumes(sphericalShell(inner, thickness, dx, false),
                     shellVolumes(inner, thickness, dx), 0.005);
        checkVolumes(tubeQuarter(inner, thickness, 8e-3, dx, false),
                     tubeVolumes(inner, thickness, 8e-3, dx), 0.005);
    }
    // the second height is 0.3 dx more than a whole number of layers
    for (const scalar height : {6e-3, 6.15e-3})
    {
        const packedScene box(
            {{"water"}}, {body{0, unnamed(testShapes::box({0, 0, 0}, {4e-3, 5e-3, height})), 0}},
            {}, dx, false);
        CHECK(box.placed.x.size() == 8 * 10 * 12);
        CHECK(closest(box) == relative(1));
        const sums k = kernelSums(box);
        CHECK(k.least == relative(1));
        CHECK(k.most == relative(1));
    }
}

TEST_CASE("a box filled body-fitted is even as well")
{
    const scalar dx = 0.5e-3;
    const packedScene box({{"water"}},
                          {body{0, unnamed(testShapes::box({0, 0, 0}, {4e-3, 5e-3, 6e-3})), 0}}, {},
                          dx, true);
    CHECK(box.placed.x.size() == 8 * 10 * 12);
    const sums k = kernelSums(box);
    CHECK(k.least > 0.98);
    CHECK(k.most < 1.02);
}

TEST_CASE("openings flush in a curved wall are packed as evenly as the rest")
{
    for (const scalar halfAngle : {0.24, 0.7})
    {
        const packedScene scene = ballWithOpenings(0.01, halfAngle < 0.5 ? 11 : 2, halfAngle, 1e-3);
        const zoneQuality q = packingQuality(scene.geometry, scene.placed, scene.support)[0];
        CHECK(q.nTooClose == 0);
        CHECK(q.minDistance > 0.7);
        CHECK(q.least > 1 - 0.02);
        CHECK(q.most < 1 + 0.02);
        CHECK(std::abs(q.mean - 1) < 3e-3);
    }
}

TEST_CASE("layers are counted from particles alone")
{
    const auto range = [](const List<vector>& x, int nDims) {
        sums found;
        for (const scalar n : layersBelow(x, label(x.size()), 1, nDims))
            if (n > 0) found.least = std::min(found.least, n), found.most = std::max(found.most, n);
        return found;
    };
    for (int k = 1; k <= 5; ++k)
    {
        List<vector> plate, strip;
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < k; ++j) strip.emplace_back(i, j, 0);
        for (int i = 0; i < 16; ++i)
            for (const vector& x : strip) plate.emplace_back(x[0], i, x[1]);
        CHECK(range(plate, 3).least == relative(k, 1e-3));
        CHECK(range(strip, 2).least == relative(k, 1e-3));
    }
    for (const auto& [dx, layers] : {std::pair(0.67e-3, 3), std::pair(0.5e-3, 4)})
    {
        const packedScene& s = fittedShell(dx);
        const zoneQuality q = packingQuality(s.geometry, s.placed, s.support)[0];
        CHECK(std::lround(q.layers) == layers);
    }
}

TEST_CASE("bodies set into others: covered parts of large faces belong to no zone twice")
{
    const scalar dx = 0.5e-3, length = 8e-3;
    const auto cylinder = [&](label zone, scalar r) {
        return body{zone, revolved({{0, 0}, {r, 0}, {r, length}, {0, length}}), 0};
    };
    const List<halfSpace> quarter = {{vector::Zero(), -vector::UnitX()},
                                     {vector::Zero(), -vector::UnitY()}};
    const packedScene tubes({{"tube", phaseType::solid}, {"inside"}, {"around"}},
                            {cylinder(2, 9.5e-3), cylinder(0, 7e-3), cylinder(1, 5e-3)}, quarter,
                            dx, false);
    checkVolumes(tubes, tubeVolumes(5e-3, thickness, length, dx), 0.005);

    // pillars on the floor of a tank, in its middle and in its corner, as high as the tank and lower
    for (const vector& foot : {vector(3e-3, 3e-3, 0), vector(0, 0, 0)})
        for (const scalar height : {8e-3, 4e-3})
        {
            CAPTURE(height);
            const vector top = foot + vector(4e-3, 4e-3, height);
            const packedScene tank(
                {{"pillar", phaseType::solid}, {"water"}},
                {body{1, unnamed(testShapes::box({0, 0, 0}, {1e-2, 1e-2, 8e-3})), 0},
                 body{0, unnamed(testShapes::box(foot, top)), 0}},
                {}, dx, false);
            const scalar pillar = 16e-6 * height;
            checkVolumes(tank, {pillar, 8e-7 - pillar}, 1e-9);
        }
}

TEST_CASE(
    "a sleeve around part of a cylinder, turned in other steps: the rest of the cylinder is wall")
{
    const scalar dx = 1e-3, R = 4e-3, length = 2e-2;
    for (const auto& [from, to, n] : {std::tuple(5e-3, 1.5e-2, 200), std::tuple(8e-3, 1.2e-2, 200),
                                      std::tuple(0.0, 1e-2, 1000)})
    {
        CAPTURE(n);
        const packedScene s(
            {{"inside"}, {"sleeve", phaseType::solid}},
            {body{0, revolved({{0, 0}, {R, 0}, {R, length}, {0, length}}, 144), 0},
             body{1, revolved({{R, from}, {2 * R, from}, {2 * R, to}, {R, to}}, n), 0}},
            {}, dx, false);
        const scalar bare = 2 * M_PI * R * (length - (to - from)) + 2 * M_PI * R * R;
        CHECK(s.geometry.patchSurface(0).area() / bare == doctest::Approx(1).epsilon(3e-3));
        const scalar all = 2 * M_PI * R * (length + R);
        CHECK(s.geometry.boundary(0).area() / all == doctest::Approx(1).epsilon(3e-3));
    }
}

TEST_CASE("zones whose common face is meshed twice leave no gap between them")
{
    // two half cylinders with 60 and 64 segments: slivers along the common face
    const scalar dx = 0.5e-3, length = 4e-3;
    const packedScene s(
        {{"inside"}, {"around"}},
        {body{0, revolved({{0, 0}, {6e-3, 0}, {6e-3, length}, {0, length}}, 60), 0},
         body{1, revolved({{6e-3, 0}, {9e-3, 0}, {9e-3, length}, {6e-3, length}}, 64), 0}},
        {}, dx, false);
    label inGap = 0;
    for (scalar angle = 0.0005; angle < 2 * M_PI; angle += 0.01)
        for (scalar r = 5.97e-3; r < 6e-3; r += 1e-6)
            inGap += s.geometry.zoneAt(vector(r * std::cos(angle), r * std::sin(angle), 2e-3)) < 0;
    CHECK(inGap == 0);
}
