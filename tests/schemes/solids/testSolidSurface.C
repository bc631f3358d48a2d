// SPDX-License-Identifier: GPL-3.0-or-later
// The unit load of the fluid in and around a ring and a sphere: its flux for the incompressible velocity
// x/r^nDims is 2 pi and 4 pi for every radius
#include "relative.H"
#include "solidSurface.H"

#include <cmath>
#include <doctest/doctest.h>
#include <functional>

using namespace ispf;

namespace
{

constexpr scalar innerRadius = 1, outerRadius = 1.5;

struct shell
{
    particleCloud cloud;
    std::unique_ptr<smoothingKernel> kernel;
    neighbourList list;

    shell(int nDims, scalar dx, const std::function<void(shell&)>& fill)
        : kernel(smoothingKernel::New("WendlandC2", nDims, 1.3 * dx))
    {
        cloud.nDims = nDims, cloud.dx = dx;
        cloud.zones = {
            {"wall", phaseType::solid}, {"in", phaseType::fluid}, {"out", phaseType::fluid}};
        fill(*this);
        cloud.vectors["x0"] = cloud.x;
        list.build(cloud, *kernel);
    }

    void add(const vector& x, int zone) { cloud.append(x, std::uint8_t(zone), vec4{}, cloud.n()); }

    void lattice()
    {
        const int nDims = cloud.nDims;
        const scalar dx = cloud.dx;
        const label n = label((outerRadius + kernel->support()) / dx) + 1;
        for (const bool solids : {true, false})
            for (label k = nDims == 3 ? -n : 0; k < (nDims == 3 ? n : 1); ++k)
                for (label j = -n; j < n; ++j)
                    for (label i = -n; i < n; ++i)
                    {
                        const vector x = dx * vector(i + 0.5, j + 0.5, nDims == 3 ? k + 0.5 : 0);
                        const scalar r = x.norm();
                        const int zone = r < innerRadius ? 1 : r < outerRadius ? 0 : 2;
                        if ((zone == 0) == solids) add(x, zone);
                    }
    }

    // Layers as packing makes them: along the surface of radius 1, half a spacing before and behind it, with smaller
    // distances between layers further off; within a layer the spacing is larger in the same measure
    void layers(int fluidZone)
    {
        constexpr scalar closer = 0.94;
        constexpr label nLayers = 6;
        for (const bool solids : {true, false})
            for (label k = 0; k < nLayers; ++k)
            {
                const bool outside = (fluidZone == 2) != solids;
                const scalar d = (0.5 + closer * k) * cloud.dx;
                layer(innerRadius + (outside ? d : -d), closer * cloud.dx, solids ? 0 : fluidZone);
            }
    }
    void layer(scalar r, scalar thickness, int zone)
    {
        if (cloud.nDims == 2)
        {
            const label n = label(std::lround(2 * M_PI * r * thickness / cloud.volume()));
            for (label i = 0; i < n; ++i)
            {
                const scalar angle = 2 * M_PI * (i + 0.5 * (zone == 0)) / n;
                add(r * vector(std::cos(angle), std::sin(angle), 0), zone);
            }
            return;
        }
        // the golden spiral is even to a few per cent
        const label n = label(std::lround(4 * M_PI * r * r * thickness / cloud.volume()));
        for (label i = 0; i < n; ++i)
        {
            const scalar z = 1 - (2 * i + 1.0) / n, angle = M_PI * (3 - std::sqrt(5.0)) * i;
            const scalar rho = std::sqrt(1 - z * z);
            add(r * vector(rho * std::cos(angle), rho * std::sin(angle), z), zone);
        }
    }

    // Flux of a unit pressure in the zone, over that through a sphere of any radius
    scalar flux(int zone)
    {
        const List<tensor> F(cloud.nSolid(), tensor::Identity());
        solidSurface surface;
        surface.initialise(cloud, list, F);
        surface.setup(cloud, list, *kernel, F);
        List<vec4> unit(cloud.n()), Q;
        List<tensor> P;
        for (label i = 0; i < cloud.n(); ++i) unit[i][3] = cloud.zone[i] == zone;
        surface.loads(unit, Q, P);
        scalar sum = 0;
        for (label i = 0; i < cloud.nSolid(); ++i)
        {
            const vector x = cloud.x[i].xyz();
            const scalar r = x.norm(), d = cloud.nDims;
            tensor slope = (tensor::Identity() - d / (r * r) * x * x.transpose()) / std::pow(r, d);
            if (d == 2) slope(2, 2) = 0;
            sum += Q[i].xyz().dot(x) / std::pow(r, d) +
                   cloud.volume() * (P[i].array() * slope.array()).sum();
        }
        return sum / (cloud.nDims == 3 ? 4 * M_PI : 2 * M_PI);
    }
};

}  // namespace

TEST_CASE("what passes through the area vectors of curved surfaces, from inside and outside")
{
    // half a kernel about a curved surface holds more or less: without coverFactors the error is 2 to 5 %
    for (const int nDims : {2, 3})
        for (const scalar dx : {0.1, 0.0666})
        {
            shell s(nDims, dx, [](shell& all) { all.lattice(); });
            CHECK(s.flux(1) == relative(-1, 0.006));
            CHECK(s.flux(2) == relative(1, 0.006));
        }
}

TEST_CASE("the same where layers along the surface hold fewer particles than a lattice")
{
    // without coverFactors 5 to 8 % are missing; linear extrapolation over a radius of 10 spacings leaves 1.2 %
    for (const int nDims : {2, 3})
        for (const scalar dx : {0.1, 0.0666})
            for (const int zone : {1, 2})
            {
                shell s(nDims, dx, [&](shell& all) { all.layers(zone); });
                CHECK(s.flux(zone) == relative(zone == 1 ? -1 : 1, 0.013));
            }
}
