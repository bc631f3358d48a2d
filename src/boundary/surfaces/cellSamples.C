// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellSamples.H"

#include <array>
#include <cmath>
#include <set>

namespace ispf
{

int samplesPerCell(int nDims)
{
    return nDims == 3 ? 27 : 9;
}

List<vector> samplesAround(const List<vector>& sites, scalar dx, int nDims)
{
    std::set<std::array<int, 3>> cells;
    for (const vector& x : sites)
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j)
                for (int k = nDims == 3 ? -2 : 0; k <= (nDims == 3 ? 2 : 0); ++k)
                    cells.insert({int(std::floor(x[0] / dx)) + i, int(std::floor(x[1] / dx)) + j,
                                  nDims == 3 ? int(std::floor(x[2] / dx)) + k : 0});
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
