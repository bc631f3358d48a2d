// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellSamples.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace ispf
{

int samplesPerCell(int nDims)
{
    return nDims == 3 ? 27 : 9;
}

namespace
{

using cellIndex = std::array<int, 3>;

// Union of two sorted lists, the second shifted along an axis
List<cellIndex> withShifted(const List<cellIndex>& cells, const List<cellIndex>& other, int axis,
                            int by)
{
    List<cellIndex> shifted = other, all;
    for (cellIndex& c : shifted) c[axis] += by;
    all.reserve(cells.size() + shifted.size());
    std::set_union(cells.begin(), cells.end(), shifted.begin(), shifted.end(),
                   std::back_inserter(all));
    return all;
}

}  // namespace

List<vector> samplesAround(const List<vector>& sites, scalar dx, int nDims)
{
    List<cellIndex> cells;
    for (const vector& x : sites)
        cells.push_back({int(std::floor(x[0] / dx)), int(std::floor(x[1] / dx)),
                         nDims == 3 ? int(std::floor(x[2] / dx)) : 0});
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    for (int d = 0; d < nDims; ++d)  // adds two cells on both sides, axis by axis
    {
        for (cellIndex& c : cells) c[d] -= 2;
        const List<cellIndex> two = withShifted(cells, cells, d, 1);
        cells = withShifted(withShifted(two, two, d, 2), cells, d, 4);
    }
    const vector step = nDims == 3
                            ? vector(0.8191725133961645, 0.6710436067037893, 0.5497004779019703)
                            : vector(0.7548776662466927, 0.5698402909980532, 0);
    List<vector> points;
    points.reserve(cells.size() * samplesPerCell(nDims));
    vector inCell(0.5, 0.5, nDims == 3 ? 0.5 : 0);
    for (const cellIndex& c : cells)
        for (int k = 0; k < samplesPerCell(nDims); ++k)
        {
            inCell += step;
            for (int d = 0; d < 3; ++d) inCell[d] -= std::floor(inCell[d]);
            points.push_back(dx * (vector(c[0], c[1], c[2]) + inCell));
        }
    return points;
}

}  // namespace ispf
