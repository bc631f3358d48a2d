// SPDX-License-Identifier: GPL-3.0-or-later
#include "closedBodies.H"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ispf
{

namespace
{

constexpr scalar borderShare = 0.2;  // share of a particle's neighbours

// True if most neighbours of fluid particle i are in its own zone.  A stray that has passed a wall gives false
bool amongItsOwn(const particleCloud& cloud, const neighbourList& list, label i)
{
    label own = 0;
    forNeighbours<among::same>(
        list, i, [&](pairIndex, label j) { own += cloud.zone[cloud.ownerOf(j)] == cloud.zone[i]; });
    return 2 * own > rowOf<among::same>(list, i).size();
}

struct zoneCount
{
    label particles = 0;
    bool open = false;
};

List<zoneCount> countZones(const particleCloud& cloud, const neighbourList& list)
{
    List<zoneCount> count(cloud.zones.size());
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        zoneCount& c = count[cloud.zone[i]];
        ++c.particles;
        c.open = c.open || (cloud.pFixed[i] && amongItsOwn(cloud, list, i));
    }
    return count;
}

// Over fluid particles [begin, end): [a * zones + b] is 1 if a particle of zone a at the border to zone b has neighbours in
// both.  A particle that has strayed through a wall has few or no neighbours in its own zone
List<char> bordersOf(const particleCloud& cloud, const neighbourList& list, label begin, label end)
{
    const label nz = label(cloud.zones.size());
    List<char> borders(nz * nz, 0);
    List<label> seen(nz);
    for (label i = begin; i < end; ++i)
    {
        std::fill(seen.begin(), seen.end(), 0);
        forNeighbours<among::same>(
            list, i, [&](pairIndex, label j) { ++seen[cloud.zone[cloud.ownerOf(j)]]; });
        const scalar all = scalar(rowOf<among::same>(list, i).size());
        for (label z = 0; z < nz; ++z)
            if (seen[z] > borderShare * all && seen[z] < (1 - borderShare) * all)
                borders[cloud.zone[i] * nz + z] = 1;
    }
    return borders;
}

// Per zone: the lowest zone of its body
List<label> joinZones(const particleCloud& cloud, const neighbourList& list)
{
    const label nz = label(cloud.zones.size());
    List<label> root(nz);
    std::iota(root.begin(), root.end(), 0);
    const auto isFluid = [](const zoneInfo& z) { return z.phase == phaseType::fluid; };
    if (std::count_if(cloud.zones.begin(), cloud.zones.end(), isFluid) < 2) return root;

    constexpr label block = 4096;
    const label first = cloud.nSolid(), nBlocks = (cloud.n() - first + block - 1) / block;
    List<List<char>> borders(nBlocks);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label b = begin; b < end; ++b)
                borders[b] = bordersOf(cloud, list, first + b * block,
                                       std::min(cloud.n(), first + (b + 1) * block));
        },
        1);
    for (label a = 0; a < nz; ++a)
        for (label b = 0; b < nz; ++b)
        {
            const auto joined = [&](const List<char>& s) { return s[a * nz + b]; };
            if (root[a] == root[b] || std::none_of(borders.begin(), borders.end(), joined))
                continue;
            const auto [low, high] = std::minmax(root[a], root[b]);
            std::replace(root.begin(), root.end(), label(high), label(low));
        }
    return root;
}

}  // namespace

List<label> closedBodies(const particleCloud& cloud, const neighbourList& list)
{
    const label nz = label(cloud.zones.size());
    const List<zoneCount> count = countZones(cloud, list);
    const auto isClosed = [](const zoneCount& c) { return c.particles > 0 && !c.open; };
    if (std::none_of(count.begin(), count.end(), isClosed)) return List<label>(nz, -1);
    List<label> root = joinZones(cloud, list);
    List<char> drained(nz, 0);
    for (label z = 0; z < nz; ++z) drained[root[z]] |= count[z].open;
    for (label z = 0; z < nz; ++z)
        if (count[z].particles == 0 || drained[root[z]]) root[z] = -1;
    return root;
}

List<char> drainedFluid(const particleCloud& cloud, const neighbourList& list,
                        const List<label>& bodyOf)
{
    List<char> drained(cloud.n(), 0);
    List<label> next;
    const auto reach = [&](label i) {
        if (!drained[i] && bodyOf[cloud.zone[i]] < 0) drained[i] = 1, next.push_back(i);
    };
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (cloud.pFixed[i]) reach(i);
    while (!next.empty())
    {
        const label i = next.back();
        next.pop_back();
        forNeighbours<among::same>(list, i, [&](pairIndex, label j) { reach(cloud.ownerOf(j)); });
    }
    return drained;
}

void refusePush(const fsiCase& c, const sweptRates& pushed, const List<label>& zones)
{
    // shares: facets of moving surfaces may differ from step to step; the flux through an open face is known
    constexpr scalar ofWalls = 0.05, ofFaces = 1e-3;
    scalar net = 0, admissible = 0;
    for (const label z : zones)
    {
        net += pushed.net[z];
        admissible += ofWalls * (pushed.gross[z] - pushed.faces[z]) + ofFaces * pushed.faces[z];
    }
    if (!(std::abs(net) > admissible)) return;
    throw fatalError(
        "walls and open faces push " + str(net) + (c.cloud.nDims == 2 ? " m^2/s" : " m^3/s") +
        " into zone " + c.cloud.zones[zones.front()].name +
        ", which has no other way out: an incompressible fluid cannot give way. Add an "
        "open patch that gives the pressure or an elastic wall, or balance what is given");
}

}  // namespace ispf
