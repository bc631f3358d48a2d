// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbourList.H"

#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <set>

using namespace ispf;

namespace
{

// Random solids, fluid, images and rigid particles
particleCloud strewn(int nDims, label nSolid, label nFluid)
{
    particleCloud cloud;
    cloud.nDims = nDims, cloud.dx = nDims == 3 ? 0.1 : 0.05;
    cloud.zones = {{"wall", phaseType::solid, false}, {"fluid", phaseType::fluid, false}};
    std::mt19937 random(5);
    std::uniform_real_distribution<scalar> u(-0.5, 0.5);
    const auto point = [&] { return vector(u(random), u(random), nDims == 3 ? u(random) : 0); };
    for (label i = 0; i < nSolid + nFluid; ++i)
        cloud.append(point(), i < nSolid ? 0 : 1, vec4{}, 100 + i);
    const label rule = cloud.addRule(Eigen::Matrix4d::Identity(), tensor::Identity());
    for (label i = 0; i < 40; ++i)
        cloud.addImage((7 * i) % cloud.n(), rule, point() + vector(0.8, 0, 0), vec4{});
    for (label i = 0; i < 40; ++i) cloud.addRigid(point() - vector(0.8, 0, 0), {0, 0, 0});
    return cloud;
}

scalar distanceSqr(const particleCloud& cloud, label i, label j)
{
    return (cloud.x[i].xyz() - cloud.x[j].xyz()).squaredNorm();
}

}  // namespace

TEST_CASE("the neighbour list finds what brute force finds")
{
    for (const int nDims : {2, 3})
    {
        const particleCloud cloud = strewn(nDims, 150, 650);
        const auto kernel = smoothingKernel::New("WendlandC2", nDims, 1.3 * cloud.dx);
        neighbourList list;
        list.build(cloud, *kernel);
        const scalar reach = kernel->support();
        for (label i = 0; i < cloud.n(); ++i)
        {
            std::set<label> expected, found;
            for (label j = 0; j < cloud.nAll(); ++j)
                if (j != i && distanceSqr(cloud, i, j) < reach * reach) expected.insert(j);
            for (auto k = list.start[i]; k < list.start[i + 1]; ++k)
            {
                const label j = list.index[k];
                found.insert(j);
                CHECK((k < list.mid[i]) == (cloud.phase[j] == cloud.phase[i]));
                const scalar r2 = distanceSqr(cloud, i, j);
                scalar F;
                kernel->F(&r2, &F, 1);
                CHECK(list.F[k] == doctest::Approx(cloud.volume() * F).epsilon(1e-12));
            }
            CHECK(found == expected);
            CHECK(label(found.size()) == list.start[i + 1] - list.start[i]);
        }
    }
}

TEST_CASE("pairs that do not see each other are left out")
{
    const particleCloud cloud = strewn(2, 0, 500);
    const auto kernel = smoothingKernel::New("cubic", 2, 1.3 * cloud.dx);
    const auto side = [&](label i) { return cloud.x[i][1] > 0; };
    neighbourList all, seen;
    all.build(cloud, *kernel);
    seen.build(cloud, *kernel, [&](label i, label j) { return side(i) == side(j); });
    std::int64_t acrossPairs = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        for (auto k = all.start[i]; k < all.start[i + 1]; ++k)
            acrossPairs += side(i) != side(all.index[k]);
        for (auto k = seen.start[i]; k < seen.start[i + 1]; ++k)
            CHECK(side(i) == side(seen.index[k]));
    }
    CHECK(acrossPairs > 0);
    CHECK(seen.nPairs() == all.nPairs() - acrossPairs);
}

TEST_CASE("the list is the same with one thread and with two")
{
    const int before = nThreads();
    const particleCloud cloud = strewn(3, 3000, 9000);
    const auto kernel = smoothingKernel::New("quintic", 3, cloud.dx);
    neighbourList list[2];
    for (const int t : {0, 1})
    {
        setThreads(t + 1);
        list[t].build(cloud, *kernel);
    }
    setThreads(before);
    CHECK(list[0].start == list[1].start);
    CHECK(list[0].mid == list[1].mid);
    CHECK(list[0].index == list[1].index);
    CHECK(list[0].F == list[1].F);
}

TEST_CASE("coinciding particles and flown ones are refused with their number and place")
{
    particleCloud cloud = strewn(2, 0, 20);
    const auto kernel = smoothingKernel::New("cubic", 2, cloud.dx);
    neighbourList list;
    cloud.x[3] = cloud.x[4];
    CHECK_THROWS_WITH_AS(list.build(cloud, *kernel), doctest::Contains("particle 104"), fatalError);
    cloud.x[3][0] = 1e9;
    CHECK_THROWS_WITH_AS(list.build(cloud, *kernel), doctest::Contains("unstable"), fatalError);
}
