// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of the solid at rest: all within reach, but those that have no solid between them
#include "referenceNeighbours.H"
#include "sampleBodies.H"
#include "structureChecks.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, reach = 2.6 * dx * (1 + 1e-6);

// Pairs that are at most `reach` apart
std::int64_t allWithin(const structureReference& ref)
{
    std::int64_t n = 0;
    for (const vector& a : ref.x0)
        for (const vector& b : ref.x0) n += (a - b).norm() <= reach && (a - b).norm() > 0;
    return n;
}

// A plane lattice, 20 by 12, without the columns from `from` to before `to` above the third row
structureReference withSlit(int from, int to)
{
    structureReference ref = emptyReference(2, dx);
    for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 20; ++i)
            if (j < 3 || i < from || i >= to) ref.x0.push_back(dx * vector(i, j, 0));
    ref.fixed.assign(ref.x0.size(), 0);
    return ref;
}

}  // namespace

TEST_CASE("a rest that is stretched by a half one way has all pairs within reach")
{
    structureReference ref = withSlit(0, 0);
    const scalar turn = 0.3;
    const tensor R = Eigen::AngleAxisd(turn, vector::UnitZ()).toRotationMatrix();
    for (size_t i = 0; i < ref.x0.size(); ++i)
    {
        vector& x = ref.x0[i];
        const scalar noise = 0.1 * dx * std::sin(12.9898 * scalar(i));
        x = R * vector(1.5 * x[0] + noise, (x[1] - noise) / 1.5, 0);
    }
    CHECK(referenceNeighbours(ref, reach).nPairs() == allWithin(ref));
}

TEST_CASE("across a slit of one spacing only particles near its end are neighbours")
{
    const structureReference ref = withSlit(10, 11);
    const referenceNeighbours pairs(ref, reach);
    label across = 0;
    scalar highest = 0;
    for (label i = 0; i < ref.n(); ++i)
        for (std::int64_t p = pairs.start[i]; p < pairs.mid[i]; ++p)
        {
            const vector &a = ref.x0[i], &b = ref.x0[pairs.index[p]];
            if (!(a[0] < 9.5 * dx && b[0] > 10.5 * dx) || std::min(a[1], b[1]) < 2.5 * dx) continue;
            ++across;
            highest = std::max({highest, a[1] / dx, b[1] / dx});
        }
    CHECK(pairs.nPairs() < allWithin(ref));
    CHECK(across > 0);
    CHECK(highest < 5.5);
    // the slit takes nothing from the pairs of one side
    const structureReference whole = withSlit(10, 20);
    CHECK(referenceNeighbours(whole, reach).nPairs() == allWithin(whole));
}
