// SPDX-License-Identifier: GPL-3.0-or-later
// A quarter of a solid ring filled with fluid, and its images beyond two symmetry planes
#include "relative.H"
#include "solidSurface.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.1, innerRadius = 1, outerRadius = 1.5;

isometry mirror(const vector& signs)
{
    isometry m;
    m.R = signs.asDiagonal();
    return m;
}

}  // namespace

TEST_CASE(
    "images of the solid move with their image's velocity: a motion that is linear passes as much "
    "with them")
{
    particleCloud cloud;
    cloud.nDims = 2, cloud.dx = dx;
    cloud.zones = {{"wall", phaseType::solid}, {"lumen", phaseType::fluid}};
    const int n = int(outerRadius / dx) + 1;
    for (const bool solids : {true, false})
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                const vector x = dx * vector(i + 0.5, j + 0.5, 0);
                const bool solid = x.norm() > innerRadius;
                if (x.norm() < outerRadius && solid == solids)
                    cloud.append(x, std::uint8_t(!solid), vec4::from(vector(2 * x[0], -x[1], 0)),
                                 cloud.n());
            }
    cloud.vectors["x0"] = cloud.x;
    const auto kernel = smoothingKernel::New("WendlandC2", 2, 1.3 * dx);
    neighbourList list;
    list.build(cloud, *kernel);

    // slopes at the surface are exact for linear fields, with and without images
    const List<tensor> F(cloud.nSolid(), tensor::Identity()),
        dF(cloud.nSolid(), vector(2, -1, 0).asDiagonal());
    const auto flux = [&](const List<isometry>& images) {
        solidSurface surface;
        surface.initialise(cloud, list, F);
        surface.setup(cloud, list, *kernel, F, images);
        return surface.missed(cloud.Up, dF, 0.1, {0, 1});
    };
    const scalar alone = flux({});
    CHECK(std::abs(alone) > 0.1);
    CHECK(flux({mirror({-1, 1, 1}), mirror({1, -1, 1}), mirror({-1, -1, 1})}) ==
          relative(alone, 1e-9));
}
