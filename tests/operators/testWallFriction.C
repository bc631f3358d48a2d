// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallFriction.H"
#include "sphc.H"
#include "smoothingKernel.H"

#include <doctest/doctest.h>
#include <cmath>
#include <random>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.1;

enum class wallOf
{
    rigid,
    rigidWithoutFeet,  // as if the surface were not known
    images
};

// Fluid in no order before a wall that follows the velocity u = x, in which every shear and stretch is.  radius: of the
// circle that the wall is round the fluid, 0 for the plane y = 0
struct wallScene
{
    particleCloud cloud;
    neighbourList list;
    kernelCorrection B;
    scalar radius;

    wallScene(scalar circle, wallOf kind) : radius(circle)
    {
        cloud.nDims = 2, cloud.dx = dx;
        cloud.zones = {{"fluid", phaseType::fluid, false}};
        std::mt19937 random(5);
        std::uniform_real_distribution<scalar> shift(-0.15 * dx, 0.15 * dx);
        for (int row = 0; row < 6; ++row)
            for (int column = 0; column < columns; ++column)
            {
                const scalar x = column * dx + shift(random), y = (row + 0.5) * dx + shift(random);
                cloud.append(at(x, y), 0, vec4{}, cloud.nextId());
            }
        if (kind == wallOf::images) addImages();
        for (int row = 0; row < 3 && kind != wallOf::images; ++row)
            for (int column = 0; column < columns; ++column)
            {
                const vector x = at(column * dx, -(row + 0.5) * dx), foot = at(column * dx, 0);
                if (kind == wallOf::rigid) cloud.addRigid(x, foot, foot);
                else cloud.addRigid(x, foot);
            }
        list.build(cloud, *smoothingKernel::New("WendlandC2", 2, 1.3 * dx));
        B.build(cloud, list);
    }

    // Largest |n.laplacian u| dx of the row next to the wall, away from a plane's ends
    scalar force() const
    {
        List<vec4> u(cloud.n());
        for (label i = 0; i < cloud.n(); ++i) u[i] = vec4::from(cloud.x[i].xyz());
        cloud.fillGhosts(u, false);
        const List<vec4> lap = sphc::laplacian({cloud, list, B}, u, List<scalar>(cloud.nAll(), 1));
        scalar worst = 0;
        for (label i = 0; i < columns; ++i)
        {
            if (radius == 0 && (i % columns < 4 || i % columns >= columns - 4)) continue;
            vector n = cloud.hasRigid() ? vector(vector::Zero()) : away(i);
            for (auto k = list.mid[i]; k < list.start[i + 1]; ++k)
                if (const label j = list.index[k]; cloud.phase[j] == phaseType::rigid)
                    n -= list.F[k] * cloud.ghostDepth(j).xyz();
            worst = std::max(worst, std::abs(n.normalized().dot(lap[i].xyz())) * dx);
        }
        return worst;
    }

    // Largest |laplacian u| dx^2 where a wall at rest goes as fast as the fluid, u everywhere, away from a plane's ends
    scalar forceAlong(const vector& u, bool atWalls = true) const
    {
        const stencil here{cloud, list, B};
        const List<scalar> c = sphc::laplacianScale(here);
        List<vec4> all(cloud.n(), vec4::from(u));
        cloud.fillGhosts(all, true);
        const List<vec4> lap = sphc::laplacian(here, all, c),
                         walls = sphc::laplacianAtWalls(here, sphc::alongWalls(here, all), c);
        scalar worst = 0;
        for (label i = 0; i < cloud.n(); ++i)
            if (i % columns >= 4 && i % columns < columns - 4 && i / columns < 3)
                worst = std::max(worst, (lap[i].xyz() + scalar(atWalls) * walls[i].xyz()).norm());
        return worst * dx * dx;
    }

private:
    static constexpr int columns = 50;

    vector away(label i) const
    {
        return radius == 0 ? vector(0, 1, 0) : vector(-cloud.x[i].xyz().normalized());
    }

    // u = x of what is mirrored becomes 2 foot - x
    void addImages()
    {
        Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
        M.topLeftCorner<3, 3>() *= -1;
        for (label i = 0; i < cloud.n(); ++i)
        {
            const vector x = cloud.x[i].xyz(), n = away(i);
            const scalar d = radius == 0 ? x[1] : radius - x.norm();
            const scalar volume = radius == 0 ? 1 : (radius + d) / (radius - d);
            const vector foot = x - d * n;
            const label rule = cloud.addRule(M, tensor::Identity() - 2 * n * n.transpose());
            cloud.addMirror({i, rule, volume}, x - 2 * d * n, vec4::from(2 * foot), {0, 0, 0});
        }
    }

    // x along the wall, y into the fluid
    vector at(scalar x, scalar y) const
    {
        if (radius == 0) return {x, y, 0};
        const scalar angle = 2 * M_PI * x / (columns * dx);
        return (radius - y) * vector(std::cos(angle), std::sin(angle), 0);
    }
};

}  // namespace

TEST_CASE(
    "viscosity leaves linear flow along a wall without a force, whatever the order of the "
    "particles")
{
    for (const wallOf kind : {wallOf::rigid, wallOf::images})
        for (const scalar radius : {0.0, 0.8})
        {
            CAPTURE(radius);
            CAPTURE(int(kind));
            wallScene s(radius, kind);
            CHECK(s.force() > 0.1);
            makeShearExact(s.cloud, s.list);
            CHECK(s.force() < 1e-11);
            s.cloud.clearGhosts();
            CHECK(s.cloud.nAll() == s.cloud.n());
        }
}

TEST_CASE(
    "a wall whose surface is not known is left as it is, and one that is not there costs nothing")
{
    wallScene s(0, wallOf::rigidWithoutFeet);
    makeShearExact(s.cloud, s.list);
    for (label i = 0; i < s.cloud.n(); ++i)
        for (auto k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
            CHECK(s.cloud.wallFactor(i, s.list.index[k]) == 2);
}

TEST_CASE("fluid beside a wall that goes with it feels nothing; only along the wall can it go")
{
    for (const wallOf kind : {wallOf::rigid, wallOf::images})
    {
        CAPTURE(int(kind));
        wallScene s(0, kind);
        makeShearExact(s.cloud, s.list);
        CHECK(s.forceAlong({1, 0, 0.5}) < 1e-12);
        CHECK(s.forceAlong({0, 1, 0}) > 0.5);
        CHECK(s.forceAlong({0, 1, 0}) ==
              doctest::Approx(s.forceAlong({0, 1, 0}, false)).epsilon(1e-12));
    }
    wallScene unknown(0, wallOf::rigidWithoutFeet);
    CHECK(unknown.forceAlong({1, 0, 0}) == unknown.forceAlong({1, 0, 0}, false));
}

TEST_CASE("walls that meet in a corner lead nothing along them there")
{
    particleCloud cloud;
    cloud.nDims = 2, cloud.dx = dx;
    cloud.zones = {{"fluid", phaseType::fluid, false}};
    const auto at = [](int column, int row) -> vector {
        return {(column + 0.5) * dx, (row + 0.5) * dx, 0};
    };
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 12; ++column)
            cloud.append(at(column, row), 0, vec4{}, cloud.nextId());
    CHECK(!sphc::anySticks(cloud));
    for (int k = 0; k < 12; ++k)
        for (int layer = -3; layer < 0; ++layer)
        {
            cloud.addRigid(at(k, layer), {0, 0, 0}, {at(k, 0)[0], 0, 0});
            if (k < 8) cloud.addRigid(at(layer, k), {0, 0, 0}, {0, at(0, k)[1], 0});
        }
    CHECK(sphc::anySticks(cloud));
    neighbourList list;
    kernelCorrection B;
    list.build(cloud, *smoothingKernel::New("WendlandC2", 2, 1.3 * dx)), B.build(cloud, list);
    const List<vec4> along =
        sphc::alongWalls({cloud, list, B}, List<vec4>(cloud.n(), vec4::from({1, 2, 0})));
    const auto of = [&](int column, int row) { return vector(along[row * 12 + column].xyz()); };
    CHECK(of(0, 0).norm() < 1e-12);
    CHECK((of(6, 0) - vector(1, 0, 0)).norm() < 1e-12);
    CHECK((of(0, 5) - vector(0, 2, 0)).norm() < 1e-12);
    CHECK(of(6, 4).norm() == 0);
}

TEST_CASE("the number of a row is held within a half and two")
{
    wallScene s(0, wallOf::rigid);
    const wallScene plain(0, wallOf::rigid);
    makeShearExact(s.cloud, s.list);
    scalar least = 1, most = 1;
    for (label i = 0; i < s.cloud.n(); ++i)
        for (auto k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
        {
            const label j = s.list.index[k];
            if (s.cloud.phase[j] != phaseType::rigid) continue;
            const scalar scale = s.cloud.wallFactor(i, j) / plain.cloud.wallFactor(i, j);
            least = std::min(least, scale), most = std::max(most, scale);
        }
    CHECK(least >= 0.5 * (1 - 1e-12));
    CHECK(most <= 2 * (1 + 1e-12));
    CHECK(least < 0.9);
    CHECK(most > 1.1);
}
