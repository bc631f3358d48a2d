// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes of two-dimensional cases are areas: the volume that a tracked surface encloses and that a wall sweeps, for
// slices of any height
#include "caseOnDisk.H"
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

}  // namespace

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
