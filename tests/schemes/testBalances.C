// SPDX-License-Identifier: GPL-3.0-or-later
// Energy, momentum and volume that fluid, solid, walls and open faces exchange add up to rounding, for random velocities
// and pressures on disordered particles (doc/theory, 2.6 to 5.5).  The rows are those of `monolithic`.
#include "balancesWorld.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::balances;

namespace
{

// Each scene in two dimensions and in three, with a disorder of 0.05 and of 0.2 dx
const List<std::unique_ptr<world>>& worlds()
{
    static const List<std::unique_ptr<world>> all = [] {
        List<std::unique_ptr<world>> made;
        for (const scene& s : scenes)
            for (const int nDims : {2, 3})
                for (const unsigned seed : {1, 4})
                    made.push_back(std::make_unique<world>(s, nDims, seed));
        return made;
    }();
    return all;
}

// Share of the sums that may be rounding
constexpr scalar rounding = 1e-12;

scalar dot(const vec4& a, const vec4& b)
{
    return a.xyz().dot(b.xyz());
}

// Checks (3.7) with the solid's load; returns the part from areas that do not add up, over sum V |G p|
scalar checkMomentum(const world& w)
{
    const List<vec4> p = w.randomField(2), g = w.gradient(p);
    const List<vector> rest = w.left().rest;
    vector lacks = vector::Zero(), open = vector::Zero();
    scalar scale = 0;
    for (label i = 0; i < w.cloud().n(); ++i)
    {
        lacks += w.V() * g[i].xyz(), scale += w.V() * g[i].xyz().norm();
        open += 2 * w.V() * p[i][3] * rest[i];
    }
    for (const world::share& s : w.shares(p)) lacks -= s.p * s.S;
    CHECK((w.free() * (lacks + open)).norm() < rounding * scale);
    return open.norm() / scale;
}

}  // namespace

TEST_CASE("what gradient and divergence do in fluid and solid is the work of walls and open faces")
{
    for (const auto& made : worlds())
    {
        const world& w = *made;
        INFO(w.about());
        const List<vec4> f = w.randomField(1), g = w.gradient(f);
        const List<scalar> div = w.divergence(f);
        scalar work = 0, power = 0, scale = 0;
        for (label i = 0; i < w.cloud().n(); ++i)
        {
            work += w.V() * (dot(f[i], g[i]) + f[i][3] * div[i]);
            scale += w.V() * (std::abs(dot(f[i], g[i])) + std::abs(f[i][3] * div[i]));
        }
        for (const world::share& s : w.shares(f)) power += s.p * s.S.dot(s.u);
        CHECK(std::abs(work - power) < rounding * scale);
        if (w.of.floor != symmetry) CHECK(std::abs(power) > 1e-5 * scale);
    }
}

TEST_CASE("fluid, solid, walls and open faces exchange momentum, but for what cells leave open")
{
    scalar most = 0;
    for (const auto& made : worlds())
    {
        const world& w = *made;
        INFO(w.about());
        const scalar open = checkMomentum(w);
        if (!w.isDrained()) most = std::max(most, open);
    }
    MESSAGE("closed boxes with a solid: areas of walls and solid that do not add up leave "
            << most << " of sum V |G p|");
}

TEST_CASE("the same where a solid stands beside a mirror wall")
{
    const scene s = {"block under a lid", {pushed, still}, still, mirror, underTheLid};
    for (const int nDims : {2, 3})
    {
        const world w(s, nDims, 1);
        INFO(w.about());
        checkMomentum(w);
    }
}

TEST_CASE("a pressure for each body of fluid loads the solid by its area vectors alone")
{
    scalar most = 0;  // not proven to be zero
    for (const auto& made : worlds())
    {
        const world& w = *made;
        INFO(w.about());
        List<vec4> p = w.levels(0.7, -2);
        const List<vec4> u = w.randomField(3), loads = w.gradient(p);
        List<scalar> flux(w.cloud().n(), 0);
        if (w.volume) w.surface.addFlux(u, w.solidGradient(u), flux);
        scalar work = 0, swept = 0, sizes = 0;
        for (label i = 0; i < w.cloud().nSolid(); ++i)
            work += w.V() * dot(u[i], loads[i]), sizes += w.V() * std::abs(dot(u[i], loads[i]));
        for (label i = w.cloud().nSolid(); i < w.cloud().n(); ++i)
        {
            swept += w.V() * p[i][3] * flux[i];
            REQUIRE(loads[i].xyz().norm() < rounding / dx);
        }
        CHECK(std::abs(work + swept) <= rounding * sizes);

        const List<vec4> inside = w.randomField(4);  // the solid's own pressure has no resultant
        for (label i = 0; i < w.cloud().nSolid(); ++i) p[i][3] = inside[i][3];
        const List<vec4> g = w.gradient(p);
        vector lacks = -0.7 * w.areaOfSolid(water) + 2 * w.areaOfSolid(oil);
        scalar scale = 0;
        for (label i = 0; i < w.cloud().nSolid(); ++i)
            lacks += w.V() * g[i].xyz(), scale += w.V() * g[i].xyz().norm();
        CHECK((w.free() * lacks).norm() <= rounding * scale);
        if (w.of.zoneOf != inTheMidst) continue;
        scalar area = 0;
        for (label k = 0; k < w.cloud().nSolid(); ++k)
            w.surface.forSides(k, [&](const vector& S, const vector&) { area += S.norm(); });
        most = std::max(most, w.areaOfSolid(water).norm() / area);
    }
    MESSAGE("area vectors of a block in the midst of fluid add up to " << most << " of its area");
}

TEST_CASE("a solid that meets a wall has the same area vectors there as away from it")
{
    for (const scene& s : scenes)
        for (const int nDims : {2, 3})
        {
            const bool plate = s.zoneOf == across;
            if (!plate && s.zoneOf != onTheFloor && s.zoneOf != clampedBelow) continue;
            if (s.floor == symmetry) continue;
            const world w(s, nDims, 0);
            INFO(w.about());
            const particleCloud& cloud = w.cloud();
            const List<vec4>&areas = cloud.vectors.at("surfaceAreaA"), &x0 = cloud.vectors.at("x0");
            label asked = 0;
            for (label i = 0; i < cloud.nSolid(); ++i)
            {
                // the row next to the wall and the next one: both see only the fluid beside them
                if (x0[i][1] > dx || (plate && nDims == 3 && std::abs(x0[i][2] - 4.5 * dx) > dx))
                    continue;
                for (label j = 0; j < cloud.nSolid(); ++j)
                    if ((x0[j].xyz() - x0[i].xyz() - dx * vector::UnitY()).norm() < 0.1 * dx)
                    {
                        CHECK((areas[j].xyz() - areas[i].xyz()).norm() <=
                              1e-2 * areas[j].xyz().norm());
                        asked += areas[j][3] > 0;
                    }
            }
            CHECK(asked >= 2);
            if (!plate) continue;
            const scalar face = w.V() / dx * size[1] * (nDims == 3 ? size[2] : 1);
            CHECK((w.areaOfSolid(water) + face * vector::UnitX()).norm() < 0.01 * face);
        }
}

TEST_CASE("the volume of the fluid is what walls, open faces and the solid's surface let in")
{
    for (const auto& made : worlds())
    {
        const world& w = *made;
        INFO(w.about());
        const List<vec4> u = w.randomField(5);
        const List<scalar> div = w.divergence(u);
        scalar volume = 0, through = 0, scale = 0, entering = 0;
        for (label i = w.cloud().nSolid(); i < w.cloud().n(); ++i)
            volume += w.V() * div[i], scale += w.V() * std::abs(div[i]);
        for (const world::share& s : w.shares(u)) through += s.S.dot(s.u);
        through -= w.solidSweeps(u);
        CHECK(std::abs(volume - through) < rounding * scale);
        for (const scalar part : w.pair().faceFlux()) entering -= w.V() * part;
        if (w.of.ends[0] == inlet)
            CHECK(entering == doctest::Approx(w.cloud().entering.at(1)).epsilon(1e-12));
    }
}

TEST_CASE("energy and volume of the fluid before open faces pass through the faces of its cells")
{
    scalar most = 0, area = 0;
    for (const auto& made : worlds())
    {
        const world& w = *made;
        // where walls hold the fluid beside a face with given pressure, (4.2) has further terms
        if (!w.isDrained() || w.of.others != slips) continue;
        INFO(w.about());
        const particleCloud& cloud = w.cloud();
        const List<vec4> f = w.randomField(6), g = w.gradient(f);
        const List<scalar> div = w.divergence(f);
        scalar work = 0, power = 0, volume = 0, through = -w.solidSweeps(f);
        scalar works = 0, volumes = 0;
        for (label i = 0; i < cloud.n(); ++i)
        {
            if (cloud.beyondOpen(i)) continue;
            work += w.V() * (dot(f[i], g[i]) + f[i][3] * div[i]);
            works += w.V() * (std::abs(dot(f[i], g[i])) + std::abs(f[i][3] * div[i]));
            if (cloud.isFluid(i)) volume += w.V() * div[i], volumes += w.V() * std::abs(div[i]);
        }
        for (const world::share& s : w.shares(f))
            if (!cloud.beyondOpen(s.particle)) power += s.p * s.S.dot(s.u), through += s.S.dot(s.u);
        List<vector> areas(cloud.stripArea);
        w.forCut([&](label i, label j, const vector& a) {
            areas[cloud.stripOf(j)] -= 2 * w.V() * a;
            if (cloud.velocityGiven(j)) return;
            power += w.V() * a.dot(f[i].xyz() * f[j][3] + f[j].xyz() * f[i][3]);
            through += w.V() * a.dot(f[i].xyz() + f[j].xyz());
        });
        const scalar beyond = w.throughStrips(f);
        CHECK(std::abs(work - power - beyond) < rounding * works);
        CHECK(std::abs(volume - through) < rounding * volumes);
        most = std::max(most, std::abs(beyond) / works);
        for (size_t k = 1; k < areas.size() && !w.volume; ++k)
            area = std::max(area, std::abs(areas[k][0] / cloud.stripArea[k][0]));
    }
    MESSAGE("before open faces (3.12) leaves " << most << " of the work, " << area
                                               << " of a face's area is missing without a solid");
    CHECK(most < 1e-5);
    CHECK(area < 1e-3);
}

TEST_CASE("viscosity exchanges momentum with walls alone and takes energy from any flow")
{
    for (const auto& made : worlds())
    {
        const world& w = *made;
        INFO(w.about());
        const particleCloud& cloud = w.cloud();
        const viscousPairs& viscous = w.rows.viscous();
        List<vec4> u = w.randomField(7), half;  // lap u = -2 of it
        viscous.apply(u, half);
        scalar loss = 0;
        for (label i = 0; i < cloud.n(); ++i) loss += 2 * dot(u[i], half[i]);
        CHECK(loss > 0);

        cloud.fillGhosts(u, false);
        viscous.apply(u, half);
        vector lacks = vector::Zero();
        scalar scale = 0, power = 0, powers = 0;
        for (label i = 0; i < cloud.n(); ++i)
        {
            const scalar own = -2 * dot(u[i], half[i]);
            if (cloud.isFree(i)) power += own, powers += std::abs(own);
            lacks -= 2 * half[i].xyz(), scale += 2 * half[i].xyz().norm();
            for (std::int64_t k = w.list().wall[i]; k < w.list().start[i + 1]; ++k)
                lacks -= 2 * viscous.K()[k] * (u[i].xyz() - u[w.list().index[k]].xyz());
        }
        CHECK((w.free() * lacks).norm() < rounding * scale);
        const viscousPairs::power parts = viscous.powerOf(u);
        CHECK(parts.dissipated < 0);
        CHECK(std::abs(parts.dissipated + parts.walls + parts.faces - power) < rounding * powers);
    }
}
