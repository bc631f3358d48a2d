// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallShares.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// A lattice of dx before a wall in x = 0: solid below y = level, fluid above
struct corner
{
    static constexpr int across = 12;
    scalar dx;
    particleCloud cloud;
    std::unique_ptr<smoothingKernel> kernel;
    neighbourList list;

    corner(int nDims, scalar spacing, scalar level)
        : dx(spacing), kernel(smoothingKernel::New("WendlandC2", nDims, 1.3 * spacing))
    {
        cloud.nDims = nDims, cloud.dx = dx;
        cloud.zones = {{"solid", phaseType::solid, false}, {"fluid", phaseType::fluid, false}};
        const int deep = nDims == 3 ? 7 : 1;
        for (const int zone : {0, 1})
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < across; ++j)
                    for (int k = 0; k < deep; ++k)
                        if ((j >= across / 2) == (zone == 1))
                            cloud.append({dx * (i + 0.5), level + dx * (j - across / 2 + 0.5),
                                          nDims == 3 ? dx * (k - 3) : 0},
                                         std::uint8_t(zone), vec4{}, cloud.nextId());
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < across; ++j)
                for (int k = 0; k < deep; ++k)
                    cloud.addRigid({-dx * (i + 0.5), level + dx * (j - across / 2 + 0.5),
                                    nDims == 3 ? dx * (k - 3) : 0},
                                   vector::Zero());
        list.build(cloud, *kernel);
    }

    // Share of the fluid in a wall element at the height y
    scalar ofFluid(scalar y, bool withSolid = false)
    {
        const scalar area = cloud.nDims == 3 ? dx * dx : dx;
        cloud.surface = {{{0, y, 0}, {-area, 0, 0}, vector::Zero(), true}};
        wallShares shares;
        shares.build(cloud, list, *kernel, withSolid);
        scalar sum = 0;
        for (const wallShares::share& s : shares.shares) sum += s.weight;
        return sum;
    }
};

}  // namespace

TEST_CASE("a wall's element belongs to the fluid as far as no solid stands before it")
{
    for (const int nDims : {2, 3})
        for (const scalar dx : {1.0, 2e-4})
        {
            CAPTURE(nDims);
            CAPTURE(dx);
            for (int k = -30; k <= 30; ++k)
            {
                CAPTURE(k);
                const scalar level =
                    0.05 * k * dx;  // the solid's surface; the element reaches from -dx/2 to dx/2
                corner c(nDims, dx, level);
                CHECK(c.ofFluid(0) ==
                      doctest::Approx(std::clamp(0.5 - 0.05 * k, 0.0, 1.0)).epsilon(1e-9));
                CHECK(c.ofFluid(0, true) == doctest::Approx(1).epsilon(1e-9));
            }
        }
}
