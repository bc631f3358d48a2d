// SPDX-License-Identifier: GPL-3.0-or-later
#include "referenceNeighbours.H"
#include "disjointSets.H"
#include "forPairs.H"
#include "messages.H"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace ispf
{

namespace
{

struct candidate
{
    vector x;
    std::int32_t index;
    std::uint16_t image;
};

// [dx] nearer particles are of one body.  Between lattice layers half a spacing of room divides two bodies
constexpr scalar touching = 1.4;

// Every particle, and every image within `radius` of the particles' bounding box
struct candidateGrid
{
    vector low;
    scalar cell = 0;
    std::array<label, 3> size = {};
    List<label> start;
    List<candidate> point;

    candidateGrid(const structureReference& ref, scalar radius)
    {
        vector high = low = ref.x0[0];
        for (const vector& x : ref.x0) low = low.cwiseMin(x), high = high.cwiseMax(x);
        low.array() -= radius, high.array() += radius;
        // hollow bodies have empty cells: at most about a hundred per particle are made
        cell = std::max(radius, std::cbrt((high - low).prod() / (100.0 * ref.n())));
        for (int d = 0; d < 3; ++d) size[d] = label((high[d] - low[d]) / cell) + 1;

        List<candidate> all;
        for (label i = 0; i < ref.n(); ++i) all.push_back({ref.x0[i], i, 0});
        for (size_t m = 0; m < ref.images.size(); ++m)
            for (label i = 0; i < ref.n(); ++i)
            {
                const vector x = ref.images[m](ref.x0[i]);
                if ((x.array() >= low.array()).all() && (x.array() <= high.array()).all())
                    all.push_back({x, i, std::uint16_t(m + 1)});
            }
        sortByCell(all);
    }

    std::array<label, 3> cellOf(const vector& x) const
    {
        std::array<label, 3> c;
        for (int d = 0; d < 3; ++d)
            c[d] = std::clamp<label>(label((x[d] - low[d]) / cell), 0, size[d] - 1);
        return c;
    }
    label key(const std::array<label, 3>& c) const
    {
        return (c[2] * size[1] + c[1]) * size[0] + c[0];
    }

    void sortByCell(const List<candidate>& all)
    {
        start.assign(size_t(size[0]) * size[1] * size[2] + 1, 0);
        for (const candidate& c : all) ++start[key(cellOf(c.x)) + 1];
        for (size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
        List<label> next(start.begin(), start.end() - 1);
        point.resize(all.size());
        for (const candidate& c : all) point[next[key(cellOf(c.x))]++] = c;
    }

    template <class Visit>
    void visitAround(const vector& x, Visit&& visit) const
    {
        const std::array<label, 3> c = cellOf(x);
        for (label k = std::max(0, c[2] - 1); k <= std::min(size[2] - 1, c[2] + 1); ++k)
            for (label j = std::max(0, c[1] - 1); j <= std::min(size[1] - 1, c[1] + 1); ++j)
            {
                const label line = (k * size[1] + j) * size[0];
                const label to = start[line + std::min(size[0] - 1, c[0] + 1) + 1];
                for (label p = start[line + std::max(0, c[0] - 1)]; p < to; ++p) visit(point[p]);
            }
    }
};

// image, index: sorts own neighbours before images
using rowEntry = std::pair<std::uint16_t, std::int32_t>;

List<rowEntry> findRow(const structureReference& ref, const candidateGrid& grid, label i,
                       scalar radius)
{
    List<rowEntry> row;
    grid.visitAround(ref.x0[i], [&](const candidate& c) {
        if (c.index == i && c.image == 0) return;
        const scalar d = (ref.x0[i] - c.x).norm();
        if (d > radius) return;
        if (d < 1e-3 * ref.dx)
            throw fatalError("Solid particles " + std::to_string(i) + " and " +
                             (c.image ? "the image of " : "") + std::to_string(c.index) +
                             " coincide at (" + str(c.x[0]) + " " + str(c.x[1]) + " " +
                             str(c.x[2]) +
                             "): no particle may be doubled or lie on a symmetry plane");
        row.push_back({c.image, c.index});
    });
    std::sort(row.begin(), row.end());
    return row;
}

// Number of the map that is a after b, -1: it is not in the list.  0 is the map that moves nothing
label composed(const structureReference& ref, label a, label b)
{
    const isometry none, &A = a ? ref.images[a - 1] : none, &B = b ? ref.images[b - 1] : none;
    const tensor R = A.R * B.R;
    const vector t = A.R * B.t + A.t;
    for (label m = 0; m <= label(ref.images.size()); ++m)
    {
        const isometry& M = m ? ref.images[m - 1] : none;
        if ((M.R - R).norm() < 1e-6 && (M.t - t).norm() < 1e-6 * ref.dx) return m;
    }
    return -1;
}

// Leaves out the pairs of two bodies, or of a body and an image, that no chain of touching particles joins: there is no solid
// between them
void divideBodies(const structureReference& ref, List<List<rowEntry>>& rows)
{
    const auto touch = [&](label i, const rowEntry& e) {
        const vector& x = ref.x0[e.second];
        return (ref.x0[i] - (e.first ? ref.images[e.first - 1](x) : x)).norm() < touching * ref.dx;
    };
    List<label> body(ref.n());
    std::iota(body.begin(), body.end(), 0);
    for (label i = 0; i < ref.n(); ++i)
        for (const rowEntry& e : rows[i])
            if (e.first == 0 && touch(i, e)) join(body, i, label(e.second));
    // Numbers the bodies: each particle leads to a lower one of its body, the first to itself
    label nBodies = 0;
    for (label i = 0; i < ref.n(); ++i) body[i] = body[i] == i ? nBodies++ : body[body[i]];

    std::set<std::tuple<label, label, label>> links;
    for (label i = 0; i < ref.n(); ++i)
        for (const rowEntry& e : rows[i])
            if (e.first && touch(i, e)) links.insert({body[i], body[e.second], e.first});
    const label nMaps = label(ref.images.size()) + 1;
    List<label> sets(nBodies * nMaps);  // of body b in image m: m nBodies + b
    std::iota(sets.begin(), sets.end(), 0);
    for (const auto& [b, other, image] : links)
        for (label m = 0; m < nMaps; ++m)
            if (const label to = composed(ref, m, image); to >= 0)
                join(sets, m * nBodies + b, to * nBodies + other);
    for (label s = 0; s < label(sets.size()); ++s) sets[s] = representative(sets, s);
    for (label i = 0; i < ref.n(); ++i)
        rows[i].erase(std::remove_if(rows[i].begin(), rows[i].end(),
                                     [&](const rowEntry& e) {
                                         return sets[body[i]] !=
                                                sets[e.first * nBodies + body[e.second]];
                                     }),
                      rows[i].end());
}

}  // namespace

referenceNeighbours::referenceNeighbours(const structureReference& ref, scalar radius)
{
    const candidateGrid grid(ref, radius);
    List<List<rowEntry>> rows(ref.n());
    parallelFor(ref.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) rows[i] = findRow(ref, grid, i, radius);
    });
    divideBodies(ref, rows);
    start.push_back(0);
    for (const List<rowEntry>& row : rows)
    {
        for (const rowEntry& e : row) image.push_back(e.first), index.push_back(e.second);
        const auto own = std::partition_point(row.begin(), row.end(),
                                              [](const rowEntry& e) { return e.first == 0; });
        mid.push_back(start.back() + (own - row.begin()));
        start.push_back(std::int64_t(index.size()));
    }
}

List<std::int64_t> referenceNeighbours::reverse(const structureReference& ref) const
{
    List<std::int64_t> found(index.size());
    const List<std::uint16_t> inverse = ref.inverseImages();
    for (label i = 0; i < n(); ++i)
        forNeighbours<among::all>(*this, i, [&](pairIndex p, label j) {
            const rowEntry wanted(image[p] ? inverse[image[p] - 1] + 1 : 0, i);
            std::int64_t low = start[j], high = start[j + 1];
            while (low < high)
            {
                const std::int64_t middle = (low + high) / 2;
                if (rowEntry(image[middle], index[middle]) < wanted) low = middle + 1;
                else high = middle;
            }
            if (low == start[j + 1] || rowEntry(image[low], index[low]) != wanted)
                throw fatalError(
                    "Solid particles " + std::to_string(i) + " and " + std::to_string(j) +
                    " see each other's images from one side only: they are exactly one "
                    "link radius apart. Change the radius by 1e-4");
            found[p] = low;
        });
    return found;
}

}  // namespace ispf
