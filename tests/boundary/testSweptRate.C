// SPDX-License-Identifier: GPL-3.0-or-later
// The zone that a moving wall pushes on, and the rate: a piston before two zones, a sheet between them,
// planes, and walls that are drawn back
#include <doctest/doctest.h>
#include "relative.H"
#include "scene.H"

using namespace scene;

namespace
{

constexpr scalar dx = 1, side = 10;

// A cube of fluid in zones 0 and 1, which meet at x = 5 or y = 4 (axis); rates of the step [0, 1]
struct rates
{
    folder files;
    particleCloud cloud;
    std::unique_ptr<boundary> walls;

    rates(int axis, const word& patches, const triSurface& surface = {}) : cloud(box(axis))
    {
        if (!surface.empty()) files.surface("piston", surface);
        walls = std::make_unique<boundary>(files.path, dictionary::fromString(patches), cloud, 2.6);
    }
    List<scalar> at(scalar t0, scalar t1) const
    {
        walls->setStep(t0, t1);
        return walls->swept(cloud).net;
    }

private:
    static particleCloud box(int axis)
    {
        particleCloud cloud =
            fluid(lattice(dx, {0, 0, 0}, {side, side, side},
                          [](const vector& x) { return x.minCoeff() > 0 && x.maxCoeff() < side; }),
                  dx);
        cloud.zones.push_back({"other", phaseType::fluid, false});
        for (label i = 0; i < cloud.n(); ++i)
            cloud.zone[i] = cloud.x[i][axis] > (axis == 0 ? 5 : 4);
        return cloud;
    }
};

const word moving = "motion { direction (1 0 0); displacement polynomial ((0.1 1)); } }";

}  // namespace

TEST_CASE("a piston pushes on the zones before it, each with its part of the face")
{
    const triSurface face =
        sheet({0, 0, 0}, {0, 0, side}, {0, side, 0});  // normal -x, two triangles
    const rates r(1, "piston { type wall; representation mirror; " + moving, face);
    const List<scalar> rate = r.at(0, 0.5);
    CHECK(rate[0] + rate[1] == relative(0.1 * side * side, 1e-6));
    CHECK(rate[0] == relative(0.1 * 4 * side, 0.1));  // the border cuts triangles
}

TEST_CASE("a sheet takes from the zone behind what it gives the one before")
{
    const rates r(0, "piston { type wall; twoSided yes; representation mirror; " + moving,
                  sheet({5, 0, 0}, {0, 0, side}, {0, side, 0}, 10));
    const List<scalar> rate = r.at(0, 0.5);
    CHECK(rate[1] == relative(0.1 * side * side, 1e-6));
    CHECK(rate[0] == relative(-0.1 * side * side, 1e-6));
}

TEST_CASE("a plane between planes, one that nothing bounds, and one that slides in itself")
{
    const word plane = "piston { type wall; surface plane; point (0 0 0); normal (-1 0 0); ";
    const auto wall = [](const word& name, const word& point, const word& normal) {
        return name + " { type wall; surface plane; point " + point + "; normal " + normal + "; } ";
    };
    const word around = wall("a", "(0 0 0)", "(0 -1 0)") + wall("b", "(0 10 0)", "(0 1 0)") +
                        wall("c", "(0 0 0)", "(0 0 -1)") + wall("d", "(0 0 10)", "(0 0 1)");
    const rates closed(0, around + plane + moving);
    CHECK(closed.at(0, 0.5)[0] == relative(0.1 * side * side, 1e-9));
    CHECK(closed.at(0, 0.5)[1] == 0);
    CHECK(std::isnan(rates(0, plane + moving).at(0, 0.5)[0]));
    const rates sliding(0, around + plane + "velocity (0 1 0); }");
    CHECK(sliding.at(0, 0.5)[0] == 0);
}

TEST_CASE("a piston in a round bore: its surface elements push as much as it sweeps")
{
    constexpr scalar R = 4.3;
    const auto round = [](scalar r, scalar t, scalar z) {
        return vector(r * std::cos(2 * M_PI * t), r * std::sin(2 * M_PI * t), z);
    };
    folder files;
    files.surface("piston", parametric([&](scalar s, scalar t) { return round(R * s, t, 0); }, 5,
                                       48, [](const vector&) { return vector(0, 0, -1); }));
    files.surface("bore", parametric([&](scalar s, scalar t) { return round(R, t, 12 * s - 2); }, 8,
                                     48, [](const vector& x) { return vector(x[0], x[1], 0); }));
    particleCloud cloud = fluid(
        lattice(
            dx, {-5, -5, 0}, {5, 5, 8},
            [](const vector& x) { return x.head<2>().norm() < R - 0.3 && x[2] > 0.3 && x[2] < 8; }),
        dx);
    boundary walls(files.path,
                   dictionary::fromString(
                       "piston { type wall; representation mirror; motion { direction (0 0 1); "
                       "displacement polynomial ((0.1 1)); } } "
                       "bore { type wall; representation mirror; }"),
                   cloud, 2.6);
    walls.setStep(0, 0.5);
    walls.updateGhosts(cloud);
    scalar pushes = 0;
    for (const surfaceElement& e : cloud.surface) pushes -= e.S.dot(e.u);
    // elements at the rim extend to the bore and not beyond it
    CHECK(pushes == relative(walls.swept(cloud).net[0], 1e-6));
    CHECK(pushes == relative(0.1 * M_PI * R * R, 0.005));
}
