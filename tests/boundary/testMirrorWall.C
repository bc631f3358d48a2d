// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images behind edges that extend into the fluid, and behind curved walls.
#include <doctest/doctest.h>
#include "scene.H"

using namespace scene;

namespace
{

constexpr scalar dx = 1, support = 2.6;

neighbourList listOf(particleCloud& cloud, const boundary& walls)
{
    neighbourList list;
    walls.updateGhosts(cloud);
    list.build(cloud, *smoothingKernel::New("WendlandC2", cloud.nDims, support / 2),
               walls.visible(cloud));
    return list;
}

}  // namespace

TEST_CASE("behind an edge that sticks out every place is filled once for each particle")
{
    // the wall fills x < 0, y < 0
    const auto inFluid = [](const vector& x) { return x[0] > 0 || x[1] > 0; };
    const List<vector> points = lattice(
        dx, {-6, -6, 0}, {6, 6, 0},
        [&](const vector& x) { return inFluid(x) && x.cwiseAbs().maxCoeff() < 6; }, 2);
    folder files;
    triSurface s = sheet({-8, 0, -1}, {8, 0, 0}, {0, 0, 2}, 4);
    s.append(sheet({0, -8, -1}, {0, 0, 2}, {0, 8, 0}, 4));
    files.surface("walls", s);
    particleCloud cloud = fluid(points, dx, 2);
    const boundary walls(files.path,
                         dictionary::fromString("walls { type wall; representation mirror; }"),
                         cloud, support);
    const neighbourList list = listOf(cloud, walls);
    label full = 0, checked = 0;
    for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) full += std::hypot(i, j) < support;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const vector x = cloud.x[i].xyz();
        if (x.cwiseAbs().maxCoeff() > 6 - support) continue;
        ++checked;
        CHECK(list.start[i + 1] - list.start[i] == full - 1);
    }
    CHECK(checked == 27);
}

// A region at the distance d from a ball is stretched in its image by ((R + d)/(R - d))^2 inside, (R - d)/(R + d) outside
TEST_CASE("images of curved walls have the volume of the space they fill")
{
    constexpr scalar R = 6;
    for (const bool inside : {true, false})
    {
        folder files;
        files.surface(
            "wall", parametric(
                        [](scalar s, scalar t) {
                            return vector(R * std::sin(M_PI * t) * std::cos(2 * M_PI * s),
                                          R * std::sin(M_PI * t) * std::sin(2 * M_PI * s),
                                          R * std::cos(M_PI * t));
                        },
                        96, 48, [=](const vector& x) -> vector { return (inside ? 1 : -1) * x; }));
        List<vector> points;
        for (const scalar d : {0.2, 0.7, 1.2, 1.7})
            for (int k = 0; k < 10; ++k)
                points.push_back(
                    (inside ? R - d : R + d) *
                    vector(std::cos(k), std::sin(k), std::sin(3 * k + 0.1)).normalized());
        particleCloud cloud = fluid(points, dx);
        const boundary walls(files.path,
                             dictionary::fromString("wall { type wall; representation mirror; }"),
                             cloud, support);
        walls.updateGhosts(cloud);
        CHECK(cloud.nGhosts() == label(points.size()));
        for (label g = cloud.n(); g < cloud.nAll(); ++g)
        {
            const scalar ratio =
                cloud.x[g].xyz().norm() / cloud.x[cloud.ghostSource(g)].xyz().norm();
            CHECK(cloud.ghostVolume(g) == doctest::Approx(ratio * ratio).epsilon(0.1));
        }
    }
}
