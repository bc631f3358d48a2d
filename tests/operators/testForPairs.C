// SPDX-License-Identifier: GPL-3.0-or-later
#include "forPairs.H"
#include "neighbourList.H"

#include <doctest/doctest.h>
#include <random>
#include <set>

using namespace ispf;

namespace
{

// Random solids and fluid.  Part of the fluid is beyond a face that gives its velocity.  Every third particle has an image
// in a symmetry plane, an image in a wall and a rigid particle
struct strewn
{
    particleCloud cloud;
    neighbourList list;
    scalar reach;

    strewn()
    {
        cloud.nDims = 2, cloud.dx = 0.05;
        cloud.zones = {{"ring", phaseType::solid, false}, {"water", phaseType::fluid, false}};
        std::mt19937 random(5);
        std::uniform_real_distribution<scalar> u(-0.5, 0.5);
        const auto point = [&] { return vector(u(random), u(random), 0); };
        for (label i = 0; i < 400; ++i) cloud.append(point(), i < 150 ? 0 : 1, vec4{}, i);
        for (label i = 300; i < 400; ++i) cloud.uFixed[i] = 1;
        const label rule = cloud.addRule(Eigen::Matrix4d::Identity(), tensor::Identity());
        for (label i = 0; i < cloud.n(); i += 3)
        {
            cloud.addImage(i, rule, point(), vec4{});
            if (cloud.isFluid(i)) cloud.addMirror({i, rule}, point(), vec4{});
            cloud.addRigid(point(), {0, 0, 0});
        }
        const auto kernel = smoothingKernel::New("WendlandC2", 2, 1.3 * cloud.dx);
        list.build(cloud, *kernel), reach = kernel->support();
    }

    bool isWall(label j) const
    {
        return cloud.phase[j] == phaseType::rigid || cloud.phase[j] == phaseType::mirror;
    }
    bool given(label j) const { return cloud.velocityGiven(cloud.ownerOf(j)); }
    // True if the pair lies across an open face or beyond it
    bool isCut(label i, label j) const
    {
        return cloud.phase[i] == cloud.phase[j] && (given(i) || given(j));
    }
};

// Checks the rows of the filter against all particles within reach
template <among which, class Expected>
void checkFilter(const strewn& s, const Expected& expected)
{
    std::int64_t nPairs = 0;
    List<std::set<label>> found(s.cloud.n()), wanted(s.cloud.n());
    for (label i = 0; i < s.cloud.n(); ++i)
    {
        for (label j = 0; j < s.cloud.nAll(); ++j)
            if (j != i && (s.cloud.x[i].xyz() - s.cloud.x[j].xyz()).norm() < s.reach &&
                expected(i, j))
                wanted[i].insert(j);
        pairIndex last = -1;
        forNeighbours<which>(s.list, i, [&](pairIndex k, label j) {
            CHECK(k > last);
            CHECK(j == s.list.index[k]);
            found[i].insert(j), last = k;
        });
        nPairs += rowOf<which>(s.list, i).size();
        CHECK(rowOf<which>(s.list, i).size() == pairIndex(found[i].size()));
        CHECK(found[i] == wanted[i]);
    }
    CHECK(nPairs > 100);
    CHECK((which == among::all) == (nPairs == s.list.nPairs()));

    List<std::set<label>> together(s.cloud.n());
    forPairs<which>(s.list, 0, s.cloud.n(),
                    [&](label i, pairIndex, label j) { together[i].insert(j); });
    CHECK(together == wanted);
}

}  // namespace

TEST_CASE("each filter visits the neighbours that it names, in the order of the list")
{
    const strewn s;
    const auto same = [&](label i, label j) { return s.cloud.phase[i] == s.cloud.phase[j]; };
    checkFilter<among::all>(s, [&](label, label) { return true; });
    checkFilter<among::same>(s, same);
    checkFilter<among::others>(s, [&](label i, label j) { return !same(i, j); });
    checkFilter<among::media>(s, [&](label, label j) { return !s.isWall(j); });
    checkFilter<among::walls>(s, [&](label, label j) { return s.isWall(j); });
    checkFilter<among::cut>(s, [&](label i, label j) { return s.isCut(i, j); });
    checkFilter<among::connected>(s,
                                  [&](label i, label j) { return !s.isWall(j) && !s.isCut(i, j); });
}

TEST_CASE("even and odd terms are summed from left to right, and a search ends where it finds")
{
    struct
    {
        List<std::int64_t> start = {0, 0, 4};
        List<label> index = {5, 6, 7, 8};
    } const rows;
    const List<scalar> part = {1, 1e16, -1e16, 0.25};
    const auto term = [&](pairIndex k, label) { return part[k]; };
    CHECK(sumNeighbours<among::all>(rows, 0, 3.0, term) == 3);
    CHECK(sumNeighbours<among::all>(rows, 1, 1.0, term) == (1.0 + 1 - 1e16) + (1e16 + 0.25));
    CHECK(sumNeighbours(rows, {1, 3}, 0.5, term) == (0.5 + 1e16) - 1e16);
    CHECK(sumNeighbours(rows, {0, 3}, 0.5, term) == (0.5 + 1 + 1e16) - 1e16);

    List<label> visited;
    const auto isSix = [&](pairIndex, label j) {
        visited.push_back(j);
        return j == 6;
    };
    CHECK(anyNeighbour<among::all>(rows, 1, isSix));
    CHECK(visited == List<label>{5, 6});
    CHECK(!anyNeighbour<among::all>(rows, 0, isSix));
    CHECK(!anyNeighbour(rows, {2, 4}, isSix));
    CHECK(visited == List<label>{5, 6, 7, 8});
}

TEST_CASE("pairs of some rows are visited, and of no others")
{
    const strewn s;
    List<label> count(s.cloud.n(), 0);
    forPairs<among::all>(s.list, 100, 250, [&](label i, pairIndex, label) { ++count[i]; });
    for (label i = 0; i < s.cloud.n(); ++i)
        CHECK(count[i] == (i < 100 || i >= 250 ? 0 : rowOf<among::all>(s.list, i).size()));
}
