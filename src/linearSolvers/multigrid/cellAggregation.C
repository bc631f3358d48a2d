// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellAggregation.H"

#include "disjointSets.H"
#include "elasticLevel.H"
#include "multigridLevel.H"
#include <algorithm>
#include <array>

namespace ispf
{

namespace
{

// Rows sorted by cell.  A very large box is folded: several cells then share a bucket.  Only
// connected rows become one aggregate, so far cells stay apart.
struct buckets
{
    List<label> start;  // [nBuckets + 1]
    List<label> row;    // rows by bucket
    List<label> place;  // [rows] position in row
};

buckets sortByCell(const List<float4>& point, float cellSize)
{
    const label n = label(point.size());
    const float inverse = 1 / cellSize;
    std::array<std::int64_t, 3> size = {1, 1, 1};
    for (const float4& p : point)
        for (int d = 0; d < 3; ++d)
            size[d] = std::max<std::int64_t>(size[d], std::int64_t(p[d] * inverse) + 1);
    while (size[0] * size[1] * size[2] > 8 * std::int64_t(n) + 4096)
    {
        std::int64_t& largest = *std::max_element(size.begin(), size.end());
        largest = (largest + 1) / 2;
    }
    List<label> bucket(n);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            std::int64_t c[3];
            for (int d = 0; d < 3; ++d) c[d] = std::int64_t(point[i][d] * inverse) % size[d];
            bucket[i] = label((c[2] * size[1] + c[1]) * size[0] + c[0]);
        }
    });

    buckets sorted;
    sorted.start.assign(size[0] * size[1] * size[2] + 1, 0);
    for (const label b : bucket) ++sorted.start[b + 1];
    for (size_t b = 1; b < sorted.start.size(); ++b) sorted.start[b] += sorted.start[b - 1];
    sorted.row.resize(n), sorted.place.resize(n);
    List<label> next(sorted.start.begin(), sorted.start.end() - 1);
    for (label i = 0; i < n; ++i)
    {
        sorted.place[i] = next[bucket[i]]++;
        sorted.row[sorted.place[i]] = i;
    }
    return sorted;
}

// Joins the connected rows at the places [begin, end); the root of a set is its first place
template <class Level>
void joinBucket(const Level& level, const buckets& sorted, label begin, label end,
                List<label>& parent)
{
    label nSets = end - begin;
    for (label p = begin; p < end && nSets > 1; ++p)
    {
        const label i = sorted.row[p];
        level.forCoupled(i, [&](label j) {
            const label q = sorted.place[j];
            if (q >= begin && q < end && level.mayJoin(i, j)) nSets -= join(parent, p, q);
        });
    }
}

}  // namespace

template <class Level>
cellAggregates aggregateByCell(const Level& level, float cellSize)
{
    const label n = level.size();
    const buckets sorted = sortByCell(level.point, cellSize);
    const label nBuckets = label(sorted.start.size()) - 1;
    List<label> parent(n), nSets(nBuckets + 1, 0);
    parallelFor(nBuckets, [&](label first, label last) {
        for (label c = first; c < last; ++c)
        {
            const label begin = sorted.start[c], end = sorted.start[c + 1];
            for (label p = begin; p < end; ++p) parent[p] = p;
            joinBucket(level, sorted, begin, end, parent);
            for (label p = begin; p < end; ++p)
                nSets[c + 1] += parent[p] == p && level.hasCouplings(sorted.row[p]);
        }
    });
    for (label c = 0; c < nBuckets; ++c) nSets[c + 1] += nSets[c];

    cellAggregates result;
    result.n = nSets[nBuckets];
    result.of.assign(n, -1);
    result.start.assign(result.n + 1, 0);
    for (label c = 0, next = 0; c < nBuckets; ++c)
        for (label p = sorted.start[c]; p < sorted.start[c + 1]; ++p)
        {
            const label i = sorted.row[p];
            if (parent[p] != p) result.of[i] = result.of[sorted.row[representative(parent, p)]];
            else if (level.hasCouplings(i)) result.of[i] = next++;
            if (result.of[i] >= 0) ++result.start[result.of[i] + 1];
        }
    for (label a = 0; a < result.n; ++a) result.start[a + 1] += result.start[a];
    result.member.resize(result.start[result.n]);
    List<label> next(result.start.begin(), result.start.end() - 1);
    for (const label i : sorted.row)
        if (result.of[i] >= 0) result.member[next[result.of[i]]++] = i;
    return result;
}

template cellAggregates aggregateByCell(const multigridLevel&, float);
template cellAggregates aggregateByCell(const elasticLevel<3>&, float);
template cellAggregates aggregateByCell(const elasticLevel<6>&, float);

}  // namespace ispf
