// SPDX-License-Identifier: GPL-3.0-or-later
#include "referenceNeighbours.H"
#include "forPairs.H"
#include "messages.H"

#include <Eigen/Eigenvalues>

#include <algorithm>

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

// [dx, or the spacing of a stretched rest] nearer particles are of one piece of solid.  Between lattice layers half a spacing of
// room divides two pieces
constexpr scalar touching = 1.4;
// [1] neighbours span the space if the sum of n n^T over their directions n has no smaller eigenvalue
constexpr scalar spans = 0.1;
// [dx] a chain between two particles goes no farther than this from one of them
constexpr scalar chains = 2.6;

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

vector placeOf(const structureReference& ref, const rowEntry& e)
{
    const vector& x = ref.x0[e.second];
    return e.first ? ref.images[e.first - 1](x) : x;
}

// Spacing of the rest around i: as far as its nearest neighbours span the space.  A rest that is stretched more than `touching`
// one way is compressed another way, where its particles touch
scalar spacingAround(const structureReference& ref, const List<rowEntry>& row, label i)
{
    List<vector> apart;
    for (const rowEntry& e : row) apart.push_back(placeOf(ref, e) - ref.x0[i]);
    std::sort(apart.begin(), apart.end(),
              [](const vector& a, const vector& b) { return a.squaredNorm() < b.squaredNorm(); });
    tensor directions = tensor::Zero();
    if (ref.nDims == 2) directions(2, 2) = scalar(apart.size());
    for (const vector& d : apart)
    {
        directions += d * d.transpose() / d.squaredNorm();
        const Eigen::SelfAdjointEigenSolver<tensor> solver(directions, Eigen::EigenvaluesOnly);
        if (solver.eigenvalues()[0] > spans) return std::max(ref.dx, d.norm());
    }
    return ref.dx;
}

// Which entries of the row of i a chain of touching particles of the row joins to i
List<char> reachedFrom(const structureReference& ref, const List<scalar>& spacing,
                       const List<rowEntry>& row, label i)
{
    struct link
    {
        vector x;
        scalar spacing;
    };
    List<link> all;
    for (const rowEntry& e : row) all.push_back({placeOf(ref, e), spacing[e.second]});
    List<link> front = {{ref.x0[i], spacing[i]}};
    List<char> reached(row.size(), 0);
    while (!front.empty())
    {
        const link a = front.back();
        front.pop_back();
        for (size_t k = 0; k < row.size(); ++k)
        {
            const link& b = all[k];
            if (reached[k] || (b.x - a.x).norm() >= touching * std::max(a.spacing, b.spacing))
                continue;
            reached[k] = 1;
            front.push_back(b);
        }
    }
    return reached;
}

// Leaves out the pairs farther apart than `radius`, and those that no such chain joins, seen from either end: there is no solid
// between them
void trim(const structureReference& ref, scalar radius, List<List<rowEntry>>& rows)
{
    List<scalar> spacing(ref.n());
    List<List<char>> keep(ref.n());
    parallelFor(ref.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) spacing[i] = spacingAround(ref, rows[i], i);
    });
    parallelFor(ref.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) keep[i] = reachedFrom(ref, spacing, rows[i], i);
    });
    const List<std::uint16_t> inverse = ref.inverseImages();
    const auto seenBack = [&](label i, const rowEntry& e) {
        const List<rowEntry>& row = rows[e.second];
        const rowEntry back(e.first ? inverse[e.first - 1] + 1 : 0, i);
        const auto at = std::lower_bound(row.begin(), row.end(), back);
        return at != row.end() && *at == back && keep[e.second][at - row.begin()] > 0;
    };
    List<List<rowEntry>> kept(ref.n());
    parallelFor(ref.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            for (size_t k = 0; k < rows[i].size(); ++k)
            {
                const rowEntry& e = rows[i][k];
                const bool near = (ref.x0[i] - placeOf(ref, e)).norm() <= radius;
                if (near && (keep[i][k] || seenBack(i, e))) kept[i].push_back(e);
            }
    });
    rows = std::move(kept);
}

}  // namespace

referenceNeighbours::referenceNeighbours(const structureReference& ref, scalar radius)
{
    const scalar reach = std::max(radius, chains * ref.dx);
    const candidateGrid grid(ref, reach);
    List<List<rowEntry>> rows(ref.n());
    parallelFor(ref.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) rows[i] = findRow(ref, grid, i, reach);
    });
    trim(ref, radius, rows);
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

std::int64_t referenceNeighbours::placeOf(label i, std::int32_t partner,
                                          std::uint16_t imageOfIt) const
{
    std::int64_t low = start[i], high = start[i + 1];
    const rowEntry wanted(imageOfIt, partner);
    while (low < high)
    {
        const std::int64_t middle = (low + high) / 2;
        if (rowEntry(image[middle], index[middle]) < wanted) low = middle + 1;
        else high = middle;
    }
    return low < start[i + 1] && rowEntry(image[low], index[low]) == wanted ? low : -1;
}

List<std::int64_t> referenceNeighbours::reverse(const structureReference& ref) const
{
    List<std::int64_t> found(index.size());
    const List<std::uint16_t> inverse = ref.inverseImages();
    for (label i = 0; i < n(); ++i)
        forNeighbours<among::all>(*this, i, [&](pairIndex p, label j) {
            found[p] = placeOf(j, i, image[p] ? std::uint16_t(inverse[image[p] - 1] + 1) : 0);
            if (found[p] < 0)
                throw fatalError(
                    "Solid particles " + std::to_string(i) + " and " + std::to_string(j) +
                    " see each other's images from one side only: they are exactly one "
                    "link radius apart. Change the radius by 1e-4");
        });
    return found;
}

}  // namespace ispf
