// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of the operators of the discrete energy balance, for random fields and disordered particles
#include "boxWorld.H"
#include "particleShifting.H"
#include "viscousPairs.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace boxWorld;

TEST_CASE(
    "what gradient and divergence do together is the work of the walls, and volume is what walls "
    "sweep")
{
    for (const unsigned seed : {1, 2, 4})
        for (const world& w : worlds(seed))
        {
            INFO(w.name, ", ", seed);
            const particleCloud& cloud = w.cloud;
            REQUIRE((w.periodic || !w.pair.walls().shares.empty()));
            List<vec4> f = randomField(cloud, seed);
            const List<vec4> g = w.gradient(f);
            const List<scalar> div = w.divergence(f);
            scalar work = 0, power = 0, scale = 0, volume = 0, swept = 0, sizes = 0;
            for (label i = 0; i < cloud.n(); ++i)
            {
                work += cloud.volume() * (f[i].xyz().dot(g[i].xyz()) + f[i][3] * div[i]);
                scale += cloud.volume() * std::abs(f[i][3] * div[i]);
                volume += cloud.volume() * div[i], sizes += cloud.volume() * std::abs(div[i]);
            }
            w.forShares(f, [&](const surfaceElement& e, scalar part, scalar p) {
                power += part * p * e.S.dot(e.u);
            });
            for (const surfaceElement& e : cloud.surface) swept += e.S.dot(e.u);
            CHECK(std::abs(work - power) < 1e-13 * scale);
            CHECK(std::abs(volume - swept) < 1e-13 * sizes);
            if (!w.periodic) CHECK(std::abs(power) > 1e-5 * scale);
            const bool divided = w.name.starts_with("divided");
            for (label i = 0; i < cloud.n(); ++i)  // a level for each body
                f[i][3] = divided && cloud.x[i][0] > 0.5 ? -2 : 0.7;
            cloud.fillGradientGhosts(f);
            for (const vec4& a : w.gradient(f)) REQUIRE(a.xyz().norm() < 1e-13 / cloud.dx);
        }
}

TEST_CASE(
    "closed cells: a uniform flow has no divergence, and the fluid's momentum is what walls give")
{
    vector U(0.6, -0.9, 0);
    const auto along = [&](surfaceElement& e) { e.u = U, e.sticks = !(e.S[0] > 0); };
    for (const unsigned seed : {1, 3})
        for (const world& w : worlds(seed, along))
        {
            if (w.name.starts_with("symmetry")) continue;  // U goes across
            INFO(w.name, ", ", seed);
            const particleCloud& cloud = w.cloud;
            const label n = cloud.n();
            List<vec4> u(n, vec4::from(U));
            cloud.fillGradientGhosts(u);
            const List<scalar> div = w.divergence(u);
            const List<vec4> p = randomField(cloud, 5);
            // for each body of fluid separately
            const bool divided = w.name.starts_with("divided");
            const auto body = [&](const vector& x) { return divided && x[0] > 0.5; };
            vector lacks[2] = {vector::Zero(), vector::Zero()};
            scalar size = 0, tight = 0;
            List<scalar> open;
            const List<vec4> gp = w.gradient(p);
            for (label i = 0; i < n; ++i)
            {
                CHECK(std::abs(div[i]) < 1e-11);  // what closure leaves is taken out
                open.push_back(w.open([&](auto k) { return w.pair.face(k); }, i).norm());
                lacks[body(cloud.x[i].xyz())] += cloud.volume() * gp[i].xyz();
                size += cloud.volume() * gp[i].xyz().norm();
                tight = std::max(
                    tight, cloud.dx * w.open([&](auto k) { return w.tight.of(k); }, i).norm());
            }
            w.forShares(p, [&](const surfaceElement& e, scalar part, scalar at) {
                lacks[body(e.x)] -= part * at * e.S;
            });
            const scalar defect = w.pair.closure().defect / cloud.dx;
            CHECK(defect * cloud.dx <= 1e-4);
            CHECK(rms(open) < 1.01 * defect);
            CHECK(tight < 1e-6);
            for (const vector& l : lacks) CHECK(l.norm() < 1e-13 * size);
        }
}

TEST_CASE("the stabiliser is symmetric, takes energy, and leaves linear pressures alone")
{
    for (const unsigned seed : {2, 4})
        for (const world& w : worlds(seed))
        {
            INFO(w.name, ", ", seed);
            const List<vec4> gp = w.withGradient(randomField(w.cloud, 1)),
                             gq = w.withGradient(randomField(w.cloud, 2));
            const List<scalar> Sp = w.stabiliser(gp), Sq = w.stabiliser(gq);
            scalar pSp = 0, qSp = 0, pSq = 0;
            for (label i = 0; i < w.cloud.n(); ++i)
                pSp += gp[i][3] * Sp[i], qSp += gq[i][3] * Sp[i], pSq += gp[i][3] * Sq[i];
            CHECK(pSp > 0);
            CHECK(std::abs(qSp - pSq) < 1e-13 * pSp);
            const auto product = [&](const List<vec4>& a, const List<vec4>& b) {
                return w.sumPairs([&](label i, std::int64_t k) {
                    return adjointPair::stabiliserWeight * w.weight(k) * w.jump(a, i, k) * w.jump(b, i, k);
                });
            };
            CHECK(pSp == doctest::Approx(product(gp, gp)).epsilon(1e-12));
            CHECK(std::abs(qSp - product(gq, gp)) < 1e-13 * pSp);
            // linear p, far from cyclic sides and symmetry planes, where it has a kink
            if (!w.closed || w.name.starts_with("cyclic") || w.name.starts_with("symmetry") ||
                w.name.starts_with("divided"))  // three or four particles wide
                continue;
            List<vec4> p(w.cloud.n());
            for (label i = 0; i < w.cloud.n(); ++i)
                p[i][3] = w.cloud.x[i].xyz().dot(vector(2, -1, w.cloud.nDims == 3));
            const List<vec4> g = w.withGradient(p);
            const scalar energy = product(g, g), compact = w.sumPairs([&](label i, std::int64_t k) {
                return w.weight(k) * std::pow(g[i][3] - g[w.list.index[k]][3], 2);
            });
            MESSAGE(w.name << ", disorder " << 0.05 * seed
                           << ": of a linear p over a compact Laplacian's " << energy / compact);
            CHECK(energy < 0.01 * compact);
        }
}

TEST_CASE("the stiffness of a row bounds its gradient of p by the differences of p about it, (6.13)")
{
    scalar largest = 0, least = 1e30;
    for (const unsigned seed : {1, 4})
        for (const world& w : worlds(seed))
        {
            INFO(w.name, ", ", seed);
            const List<scalar> s = w.pair.stiffness();
            for (const unsigned of : {1, 2, 3})
            {
                const List<vec4> g = w.withGradient(randomField(w.cloud, of));
                List<scalar> about(w.cloud.n(), 0);
                w.sumPairs([&](label i, std::int64_t k) {
                    about[i] += w.weight(k) * std::pow(g[i][3] - g[w.list.index[k]][3], 2);
                    return 0.0;
                });
                for (label i = 0; i < w.cloud.n(); ++i)
                {
                    const scalar share = g[i].xyz().squaredNorm() / (2 * s[i] * about[i]);
                    REQUIRE(share < 1);
                    largest = std::max(largest, share), least = std::min(least, 1 / s[i]);
                }
            }
        }
    MESSAGE("largest share of the bound " << largest << ", largest stiffness " << 1 / least);
    CHECK(largest > 0.3);
    CHECK(least < 0.7);
}

TEST_CASE("gradient and divergence of smooth fields")
{
    scalar eG[2], eD[2];
    for (const int fine : {0, 1})
    {
        const auto box = std::make_shared<periodicBox>(2, fine ? 24 : 12, 0.1, "WendlandC2", 1.3);
        world w = world::of("", nullptr, box, *box);
        w.setup();
        const scalar k = 2 * M_PI;
        const List<vec4> f = box->field([&](const vector& x) {
            return vec4{{std::sin(k * x[0]), std::sin(k * (x[0] + x[1])), 0,
                         std::sin(k * x[0]) * std::cos(k * x[1])}};
        });
        const List<vec4> g = w.gradient(f);
        List<scalar> d = w.divergence(f), e(w.cloud.n());
        for (label i = 0; i < w.cloud.n(); ++i)
        {
            const scalar x = k * w.cloud.x[i][0], y = k * w.cloud.x[i][1];
            d[i] -= k * (std::cos(x) + std::cos(x + y));
            e[i] =
                (g[i].xyz() - k * vector(std::cos(x) * std::cos(y), -std::sin(x) * std::sin(y), 0))
                    .norm();
        }
        eG[fine] = rms(e) / k, eD[fine] = rms(d) / k;
    }
    MESSAGE("root mean squares over the wave number, n = 12, 24: gradient "
            << eG[0] << ", " << eG[1] << "; divergence " << eD[0] << ", " << eD[1]);
    CHECK(eG[0] < 0.15);
    CHECK(eG[1] < 0.5 * eG[0]);
    CHECK(eD[1] < 0.6 * eD[0]);
}

TEST_CASE("viscosity takes energy from any flow between walls at rest, as much as its dissipation")
{
    for (const unsigned seed : {1, 4})
        for (const world& w : worlds(seed))
        {
            INFO(w.name, ", ", seed);
            viscousPairs viscous;
            viscous.setup({w.cloud, w.list, w.B});
            const List<vec4> u = randomField(w.cloud, seed);
            List<vec4> half;  // lap u = -2 of it
            viscous.apply(u, half);
            scalar loss = 0;
            for (label i = 0; i < w.cloud.n(); ++i) loss += 2 * u[i].xyz().dot(half[i].xyz());
            CHECK(loss > 0);
            CHECK(-viscous.powerOf(u).dissipated == doctest::Approx(loss).epsilon(1e-12));
        }
}

TEST_CASE("shifting makes no new extremum, gains no more energy than it may, and keeps momentum")
{
    const particleShifting shifting(dictionary::fromString("maxShift 0.2; closest 0;"));
    label withNone = 0;
    for (const unsigned seed : {1, 2, 3, 4})
        for (world& w : worlds(seed))
        {
            for (const scalar allowance : {1e30, 1e-3, 0.0})
            {
                // t is 0/0 there
                INFO(w.name, ", ", seed, ", ", allowance);
                particleCloud& cloud = w.cloud;
                cloud.Up = randomField(cloud, seed, {0.5, 0, 0});
                cloud.fillGhosts(cloud.Up, false);
                const List<vec4> before = cloud.Up, x = cloud.x;
                const scalar gain =
                    shifting.shift(cloud, w.list, w.B, 0.5 * cloud.dx, allowance, nullptr);
                vector momentum = vector::Zero();
                scalar energy = 0, changes = 0, moved = 0, beyond = 0;
                for (label i = 0; i < cloud.n(); ++i)
                {
                    const vector u = before[i].xyz(), now = cloud.Up[i].xyz(), d = now - u;
                    // the velocity changes in a direction only as far as a neighbour's velocity in this direction
                    const vector along = d.norm() > 0 ? vector(d.normalized()) : d;
                    scalar high = 0;
                    for (std::int64_t k = w.list.start[i]; k < w.list.start[i + 1]; ++k)
                        high = std::max(high, along.dot(before[w.list.index[k]].xyz() - u));
                    // the direction of a small change is that of its rounding error
                    const scalar rounding = d.norm() > 0 ? 1e-16 / d.norm() : 0;
                    beyond = std::max(beyond, d.norm() - high - rounding);
                    momentum += d, changes += d.norm(), energy += d.dot(u) + 0.5 * d.squaredNorm();
                    moved = std::max(moved, (cloud.x[i].xyz() - x[i].xyz()).norm());
                }
                CHECK(beyond < 1e-13);
                CHECK(std::abs(gain - energy) < 1e-13 * (1 + changes));
                CHECK(gain <= allowance + 1e-13 * changes);
                CHECK(moved > 0.1 * cloud.dx);
                CHECK(moved < 0.2001 * cloud.dx);
                if (allowance == 0) ++withNone;
                if (w.periodic) CHECK(momentum.norm() < 1e-13 * (1 + changes));
                cloud.x = x;
            }
        }
    CHECK(withNone > 10);
}
