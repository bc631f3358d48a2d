// SPDX-License-Identifier: GPL-3.0-or-later
#include "closedBodies.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

struct vessels
{
    particleCloud cloud;
    neighbourList list;

    explicit vessels(const List<word>& zones)
    {
        cloud.nDims = 2, cloud.dx = 1;
        for (const word& z : zones) cloud.zones.push_back({z, phaseType::fluid, false});
    }
    // adds 10 x 10 particles from x = left on; those beyond y = 10 - open lie beyond an open face
    void add(scalar left, std::uint8_t zone, int open = 0, int width = 10)
    {
        for (int j = 0; j < 10; ++j)
            for (int i = 0; i < width; ++i)
            {
                cloud.append({left + i, scalar(j), 0}, zone, vec4{}, cloud.nextId());
                cloud.pFixed.back() = j >= 10 - open;
            }
    }
    void close()
    {
        list.build(cloud, *smoothingKernel::New("WendlandC2", 2, 1.3));
        bodyOf = closedBodies(cloud, list);
        drained = drainedFluid(cloud, list, bodyOf);
    }
    label nDrained() const { return label(std::count(drained.begin(), drained.end(), 1)); }

    List<label> bodyOf;
    List<char> drained;
};

}  // namespace

TEST_CASE("bodies of fluid: an open face drains what is joined to it")
{
    vessels v({"a", "b", "c"});
    v.add(0, 0, 2), v.add(10, 1), v.add(30, 2);
    v.close();
    CHECK(v.bodyOf == List<label>{-1, -1, 2});
    CHECK(v.nDrained() == 200);
    CHECK(!v.drained.back());
}

TEST_CASE("bodies of fluid: of two vessels in one zone the closed one is not drained")
{
    vessels v({"water"});
    v.add(0, 0, 2), v.add(30, 0);
    v.close();
    CHECK(v.bodyOf == List<label>{-1});
    CHECK(v.nDrained() == 100);
    CHECK(v.drained.front());
}

TEST_CASE("bodies of fluid: a narrow outlet drains, a stray beyond another zone's face does not")
{
    vessels narrow({"water"});
    narrow.add(0, 0, 0, 100), narrow.add(110, 0, 2, 2);  // four of a thousand
    narrow.close();
    CHECK(narrow.bodyOf == List<label>{-1});
    vessels stray({"bath", "chamber"});
    stray.add(0, 0, 2), stray.add(30, 1);
    stray.cloud.append({4.5, 8.5, 0}, 1, vec4{}, stray.cloud.nextId());
    stray.cloud.pFixed.back() = 1;
    stray.close();
    CHECK(stray.bodyOf == List<label>{-1, 1});
    CHECK(stray.nDrained() == 100);
}
