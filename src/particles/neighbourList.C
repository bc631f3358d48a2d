// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbourList.H"
#include "forPairs.H"
#include "rawList.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// All points sorted by row-major search cell, in single precision relative to the lowest corner.  The
// candidates of a particle are nine contiguous runs.
struct searchGrid
{
    vector low;
    std::int64_t nx = 1, ny = 1, nz = 1;
    scalar cell = 0;
    List<label> start, point;
    List<float> x, y, z;

    int cellOf(scalar value, int d) const { return int((value - low[d]) / cell); }

    void build(const List<vec4>& p, scalar size)
    {
        cell = size;
        vector high = low = p[0].xyz();
        for (const vec4& q : p) low = low.cwiseMin(q.xyz()), high = high.cwiseMax(q.xyz());
        const scalar cells = ((high - low) / cell).array().max(1).prod();
        if (!(cells < 1e9))
            throw fatalError("The particles spread over " + str(cells) +
                             " search cells: some have flown away. The run is unstable");
        nx = cellOf(high[0], 0) + 1, ny = cellOf(high[1], 1) + 1, nz = cellOf(high[2], 2) + 1;
        const label n = label(p.size());
        start.assign(size_t(nx * ny * nz + 1), 0);
        List<label> key(n);
        for (label i = 0; i < n; ++i)
        {
            key[i] =
                label((cellOf(p[i][2], 2) * ny + cellOf(p[i][1], 1)) * nx + cellOf(p[i][0], 0));
            ++start[key[i] + 1];
        }
        for (size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
        point.resize(n), x.resize(n), y.resize(n), z.resize(n);
        List<label> next(start.begin(), start.end() - 1);
        for (label i = 0; i < n; ++i)
        {
            const label k = next[key[i]]++;
            point[k] = i;
            x[k] = float(p[i][0] - low[0]), y[k] = float(p[i][1] - low[1]);
            z[k] = float(p[i][2] - low[2]);
        }
    }
};

// Appends to hit the indices k in [from, to) of points closer than sqrt(limit) to q
ISPF_HOT label closeOnes(const searchGrid& g, const float* q, label from, label to, float limit,
                         label* hit)
{
    const float *x = g.x.data(), *y = g.y.data(), *z = g.z.data();
    label n = 0;
    float d2[64];
    for (label b = from; b < to; b += 64)
    {
        const label m = std::min<label>(64, to - b);
        for (label k = 0; k < m; ++k)
        {
            const float dx = x[b + k] - q[0], dy = y[b + k] - q[1], dz = z[b + k] - q[2];
            d2[k] = dx * dx + dy * dy + dz * dz;
        }
        for (label k = 0; k < m; ++k) hit[n] = b + k, n += d2[k] < limit;
    }
    return n;
}

struct rowBuilder
{
    const particleCloud& cloud;
    const searchGrid& grid;
    const neighbourList::visibility& visible;
    scalar reach;

    List<label> hit;
    List<label> found[4];     // cut off, same phase, other phase, walls
    const List<char>& given;  // 1 for fluid with a given velocity

    rowBuilder(const particleCloud& c, const searchGrid& g, const neighbourList::visibility& v,
               scalar support, const List<char>& isGiven)
        : cloud(c), grid(g), visible(v), reach(support), given(isGiven)
    {
    }

    void clear()
    {
        for (int g = 0; g < 4; ++g) found[g].clear();
    }

    void row(label i)
    {
        const vec4& xi = cloud.x[i];
        const float q[3] = {float(xi[0] - grid.low[0]), float(xi[1] - grid.low[1]),
                            float(xi[2] - grid.low[2])};
        const float limit = float(reach * reach) * 1.0001f;
        const int cx = grid.cellOf(xi[0], 0), cy = grid.cellOf(xi[1], 1),
                  cz = grid.cellOf(xi[2], 2);
        const int x0 = std::max(0, cx - 1), x1 = int(std::min<std::int64_t>(grid.nx - 1, cx + 1));
        for (int z = std::max(0, cz - 1); z <= std::min<std::int64_t>(grid.nz - 1, cz + 1); ++z)
            for (int y = std::max(0, cy - 1); y <= std::min<std::int64_t>(grid.ny - 1, cy + 1); ++y)
            {
                const std::int64_t line = (z * grid.ny + y) * grid.nx;
                const label from = grid.start[line + x0], to = grid.start[line + x1 + 1];
                hit.resize(std::max<size_t>(hit.size(), size_t(to - from) + 64));
                const label nHit = closeOnes(grid, q, from, to, limit, hit.data());
                for (label k = 0; k < nHit; ++k) candidate(i, grid.point[hit[k]]);
            }
    }

    void candidate(label i, label j)
    {
        if (j == i) return;
        const scalar square = magSqr(cloud.x[i].s - cloud.x[j].s);
        if (square >= reach * reach || (visible && !visible(i, j))) return;
        if (square == 0)
            throw fatalError("Particle " + std::to_string(cloud.id[i]) + " and " +
                             (j < cloud.n() ? "particle " + std::to_string(cloud.id[j])
                                            : word("a boundary particle")) +
                             " coincide at (" + str(cloud.x[i][0]) + " " + str(cloud.x[i][1]) +
                             " " + str(cloud.x[i][2]) + ")");
        const int g = cloud.phase[j] != cloud.phase[i] ? (cloud.isMedium(j) ? 2 : 3)
                      : given[i] || given[j]           ? 0
                                                       : 1;
        found[g].push_back(j);
    }

    void append(neighbourList& part)
    {
        const auto add = [&](const List<label>& j) {
            part.index.insert(part.index.end(), j.begin(), j.end());
        };
        add(found[0]);
        part.own.push_back(part.nPairs());
        add(found[1]);
        part.mid.push_back(part.nPairs());
        add(found[2]);
        part.wall.push_back(part.nPairs());
        add(found[3]);
        part.start.push_back(part.nPairs());
    }
};

}  // namespace

void neighbourList::build(const particleCloud& cloud, const smoothingKernel& kernel,
                          const visibility& visible, const List<char>& wanted)
{
    const label n = cloud.n();
    start.assign(n + 1, 0), own.assign(n, 0), mid.assign(n, 0), wall.assign(n, 0), index.clear(),
        F.clear();
    if (n == 0) return;
    searchGrid grid;
    grid.build(cloud.x, kernel.support());
    List<char> given(cloud.nAll(), 0);
    for (label j = 0; j < cloud.nAll(); ++j)
        if (const label owner = cloud.ownerOf(j); owner >= 0) given[j] = cloud.velocityGiven(owner);

    constexpr label blockRows = 512;
    const label nBlocks = (n + blockRows - 1) / blockRows;
    List<neighbourList> part(nBlocks);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            rowBuilder rows(cloud, grid, visible, kernel.support(), given);
            for (label b = begin; b < end; ++b)
                for (label i = b * blockRows; i < std::min(n, (b + 1) * blockRows); ++i)
                {
                    rows.clear();
                    if (wanted.empty() || wanted[i]) rows.row(i);
                    rows.append(part[b]);
                }
        },
        1);

    List<std::int64_t> offset(nBlocks + 1, 0);
    for (label b = 0; b < nBlocks; ++b) offset[b + 1] = offset[b] + part[b].nPairs();
    remake(index, offset[nBlocks]);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label b = begin; b < end; ++b)
            {
                const neighbourList p = std::move(part[b]);
                std::copy(p.index.begin(), p.index.end(), index.begin() + offset[b]);
                for (size_t r = 0; r < p.mid.size(); ++r)
                {
                    own[b * blockRows + r] = offset[b] + p.own[r];
                    mid[b * blockRows + r] = offset[b] + p.mid[r];
                    wall[b * blockRows + r] = offset[b] + p.wall[r];
                    start[b * blockRows + r + 1] = offset[b] + p.start[r];
                }
            }
        },
        1);
    weigh(cloud, kernel);
}

// Sets F of all pairs
void neighbourList::weigh(const particleCloud& cloud, const smoothingKernel& kernel)
{
    remake(F, index.size());
    parallelFor(cloud.n(), [&](label begin, label end) {
        List<scalar> r2;
        for (label i = begin; i < end; ++i)
        {
            const pairIndex first = start[i];
            const label nPairs = label(start[i + 1] - first);
            r2.resize(nPairs);
            forNeighbours<among::all>(*this, i, [&](pairIndex k, label j) {
                r2[k - first] = magSqr(cloud.x[i].s - cloud.x[j].s);
            });
            kernel.F(r2.data(), F.data() + first, nPairs);
            forNeighbours<among::all>(*this, i, [&](pairIndex k, label j) {
                F[k] *= cloud.volume() * (j < cloud.n() ? 1 : cloud.ghostVolume(j));
            });
        }
    });
    countPairs(nPairs(), sizeof(label) + 2 * sizeof(scalar));
}

}  // namespace ispf
