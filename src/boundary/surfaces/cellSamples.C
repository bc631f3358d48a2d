// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellSamples.H"

#include <algorithm>
#include <array>
#include <cmath>

namespace ispf
{

int samplesPerCell(int nDims)
{
    return nDims == 3 ? 27 : 9;
}

List<vector> samplesAround(const List<vector>& sites, scalar dx, int nDims)
{
    List<std::array<int, 3>> cells;
    for (const vector& x : sites)
        cells.push_back({int(std::floor(x[0] / dx)), int(std::floor(x[1] / dx)),
                         nDims == 3 ? int(std::floor(x[2] / dx)) : 0});
    for (int d = nDims; d-- > 0;)  // adds two cells on both sides, axis by axis
    {
        List<std::array<int, 3>> wider;
        for (std::array<int, 3> c : cells)
        {
            c[d] -= 2;
            for (int k = 0; k < 5; ++k, ++c[d]) wider.push_back(c);
        }
        std::sort(wider.begin(), wider.end());
        wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
        cells = std::move(wider);
    }
    const vector step = nDims == 3
                            ? vector(0.8191725133961645, 0.6710436067037893, 0.5497004779019703)
                            : vector(0.7548776662466927, 0.5698402909980532, 0);
    List<vector> points;
    vector inCell(0.5, 0.5, nDims == 3 ? 0.5 : 0);
    for (const auto& c : cells)
        for (int k = 0; k < samplesPerCell(nDims); ++k)
        {
            inCell += step;
            for (int d = 0; d < 3; ++d) inCell[d] -= std::floor(inCell[d]);
            points.push_back(dx * (vector(c[0], c[1], c[2]) + inCell));
        }
    return points;
}

}  // namespace ispf
