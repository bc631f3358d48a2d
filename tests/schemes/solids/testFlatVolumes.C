// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes of two-dimensional cases are areas: the volume that a tracked surface encloses and that a wall sweeps, for
// slices of any height
#include "caseOnDisk.H"
#include "core/errorOf.H"
#include "relative.H"
#include "trackedSurface.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.01, length = 0.2, height = 0.013;

// The parabola from (0, y) to (length, y), one dx deep
void writeStrip(const word& path, const word& name, scalar y)
{
    triSurface s;
    const label patch = s.addPatch(name);
    constexpr int n = 80;
    for (int k = 0; k < n; ++k)
    {
        const auto at = [&](int q, scalar z) {
            const scalar x = q * length / n;
            return vector(x, y - x * (length - x), z * height);
        };
        s.add(at(k, -0.5), at(k + 1, -0.5), at(k + 1, 0.5), patch);
        s.add(at(k, -0.5), at(k + 1, 0.5), at(k, 0.5), patch);
    }
    std::filesystem::create_directories(path + "/constant/triSurface");
    writeSTL(s, path + "/constant/triSurface/" + name + ".stl");
}

// The lower side of a leaflet whose root is an edge of 27 degrees: a straight line from the origin along x, dx deep
void writeRoot(const word& path, scalar from)
{
    triSurface s;
    const label patch = s.addPatch("leaflet_to_blood");
    const vector a(from, 0, -0.5 * dx), b(length, 0, -0.5 * dx), up(0, 0, dx);
    s.add(a, b, b + up, patch), s.add(a, b + up, a + up, patch);
    std::filesystem::create_directories(path + "/constant/triSurface");
    writeSTL(s, path + "/constant/triSurface/leaflet_to_blood.stl");
}

}  // namespace

TEST_CASE("the sharp root of a leaflet follows the nearest solid particle")
{
    caseOnDisk files("sharpRoot");
    files.fill(20, 3, dx);
    particleTable& leaflet = files.particles();
    leaflet.attributes["zones"] = "leaflet";
    leaflet.attributes["phases"] = "solid";
    // the particles that the leaflet has room for: two within 3 dx of the root
    List<label> inside;
    for (label i = 0; i < label(leaflet.x.size()); ++i)
        if (leaflet.x[i][1] < 0.5 * leaflet.x[i][0]) inside.push_back(i);
    const auto keep = [&](auto& list) {
        auto kept = list;
        kept.clear();
        for (const label i : inside) kept.push_back(list[i]);
        list = kept;
    };
    keep(leaflet.x), keep(leaflet.vectors["U"]), keep(leaflet.scalars["p"]);
    keep(leaflet.integers["id"]), keep(leaflet.integers["zone"]);
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel springNetwork; E 1e3; links radius; radius 2.6;");
    writeRoot(files.path(), 0);
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    trackedSurface surface("leaflet_to_blood", c);
    CHECK(
        log.contains("leaflet_to_blood: 3 vertices on sharp edges follow the nearest solid "
                     "particle, up to 1.66 dx away"));
    const triSurface rest = surface.now();
    for (label v = 0; v < label(rest.nodes.size()); ++v)
        CHECK((rest.nodes[v] - surface.rest().nodes[v]).norm() < 1e-12);
    const vector shift(0.3 * dx, -0.7 * dx, 0);
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        c.cloud.x[i][0] += shift[0], c.cloud.x[i][1] += shift[1];
    }
    surface.update(c.cloud.x);
    for (label v = 0; v < label(rest.nodes.size()); ++v)
        CHECK((surface.now().nodes[v] - rest.nodes[v] - shift).norm() < 1e-12);

    writeRoot(files.path(), -0.12);  // 13.5 dx from the first particle
    CHECK_ERROR(trackedSurface("leaflet_to_blood", c),
                "(-0.12 0 -0.005) is more than 0.12 m = 12 dx away from every solid particle", 0);
}

TEST_CASE("area under a bent wall, and what a piston sweeps")
{
    caseOnDisk files("flatVolumes");
    files.fill(20, 3, dx);
    files.particles().attributes["zones"] = "wall";
    files.particles().attributes["phases"] = "solid";
    files.boundary =
        "piston { type wall; representation mirror; motion { direction (0 1 0); displacement "
        "polynomial ((0.03 1)); } }";
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel springNetwork; E 1e3; links radius; radius 2.6;");
    writeStrip(files.path(), "wall_to_chamber", 0);
    writeStrip(files.path(), "piston", -0.1);
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    trackedSurface surface("wall_to_chamber", c);
    // the 80 segments cut off 1/80^2 of the parabola
    const scalar area = std::pow(length, 3) / 6 * (1 - 1 / 6400.0);
    CHECK(surface.restVolume() == relative(area, 1e-6));  // STL has single precision
    for (label i = 0; i < c.cloud.n(); ++i) c.cloud.x[i][0] *= 1.1, c.cloud.x[i][1] *= 1.2;
    surface.update(c.cloud.x);
    CHECK(surface.enclosedVolume() == relative(1.32 * area, 1e-6));
    for (label i = 0; i < c.cloud.n(); ++i)
        c.cloud.x[i] = c.cloud.vectors.at("x0")[i], c.cloud.x[i][1] -= 0.2 * dx;
    surface.update(c.cloud.x);  // its rim has moved as well
    CHECK(surface.enclosedVolume() - surface.restVolume() == relative(0.2 * dx * length, 1e-6));

    c.walls->setStep(0, 0.5);
    c.walls->exchange(c.cloud, 0.5);
    CHECK(c.walls->balance()[0].swept == relative(0.5 * 0.03 * length, 1e-6));
}
