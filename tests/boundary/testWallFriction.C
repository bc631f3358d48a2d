// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallFriction.H"
#include "smoothingKernel.H"
#include "viscousPairs.H"

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

// Disordered fluid before a wall that moves with the velocity u = x, which contains every shear and stretch.  radius: of the
// circular wall around the fluid, 0 for the plane y = 0
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

    // Largest |n.laplacian u| dx of the row next to the wall, away from the ends of a plane.  Here all pairs have equal
    // weight.  Viscosity weights them by the laplacianScale of both particles, which is not exact
    scalar force() const
    {
        const List<vec4> u = likeTheWall();
        List<vec4> lap(cloud.n());
        for (label i = 0; i < cloud.n(); ++i)
            for (auto k = list.start[i]; k < list.start[i + 1]; ++k)
                lap[i].s += 2 * cloud.friction(i, list.index[k]) * sphc::viscousF(cloud, list, k) *
                            (u[i].s - u[list.index[k]].s);
        return worstOf(lap);
    }

    // The same for the pairs of viscosity
    scalar forceOfPairs() const
    {
        viscousPairs viscous;
        viscous.setup({cloud, list, B});
        List<vec4> lap;
        viscous.apply(likeTheWall(), lap);
        for (vec4& a : lap) a.s *= -2;
        return worstOf(lap);
    }

private:
    static constexpr int columns = 50;

    List<vec4> likeTheWall() const
    {
        List<vec4> u(cloud.n());
        for (label i = 0; i < cloud.n(); ++i) u[i] = vec4::from(cloud.x[i].xyz());
        cloud.fillGhosts(u, false);
        return u;
    }

    scalar worstOf(const List<vec4>& lap) const
    {
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

    vector away(label i) const
    {
        return radius == 0 ? vector(0, 1, 0) : vector(-cloud.x[i].xyz().normalized());
    }

    // the image of u = x is 2 foot - x
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
            cloud.addMirror({i, rule, volume}, x - 2 * d * n, vec4::from(2 * foot));
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
            const scalar before = s.force(), beforeOfPairs = s.forceOfPairs();
            CHECK(before > 0.1);
            makeShearExact(s.cloud, s.list);
            CHECK(s.force() < 1e-11);
            CHECK(s.forceOfPairs() < 0.2 * beforeOfPairs);
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
            CHECK(s.cloud.friction(i, s.list.index[k]) == 2);
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
            const scalar scale = s.cloud.friction(i, j) / plain.cloud.friction(i, j);
            least = std::min(least, scale), most = std::max(most, scale);
        }
    CHECK(least >= 0.5 * (1 - 1e-12));
    CHECK(most <= 2 * (1 + 1e-12));
    CHECK(least < 0.9);
    CHECK(most > 1.1);
}
