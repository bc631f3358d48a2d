// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampleBodies.H"
#include "forPairs.H"
#include "referenceNeighbours.H"

#include <algorithm>
#include <cmath>
#include <random>

namespace ispf
{

structureReference emptyReference(int nDims, scalar dx)
{
    structureReference ref;
    ref.nDims = nDims, ref.dx = dx, ref.h = 1.3 * dx, ref.support = 2.6 * dx, ref.rho = 1000;
    return ref;
}

structureReference latticeBlock(int nx, int ny, int nz, scalar dx)
{
    structureReference ref = emptyReference(nz > 0 ? 3 : 2, dx);
    for (int k = 0; k < std::max(1, nz); ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                ref.x0.push_back(dx * vector(i + 0.5, j + 0.5, nz > 0 ? k + 0.5 : 0));
    ref.fixed.assign(ref.x0.size(), 0);
    return ref;
}

structureReference triangularBlock(int nx, int ny, scalar dx)
{
    structureReference ref = emptyReference(2, dx);
    const scalar row = std::sqrt(std::sqrt(0.75)) * dx, apart = dx * dx / row;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            ref.x0.push_back({apart * (i + (j % 2 ? 0.75 : 0.25)), row * (j + 0.5), 0});
    ref.fixed.assign(ref.x0.size(), 0);
    return ref;
}

isometry mirrorAt(int axis, scalar position)
{
    isometry m;
    m.R(axis, axis) = -1, m.t[axis] = 2 * position;
    return m;
}

namespace
{

// One sweep of pair repulsion with the weight (1 - r/support)^3
void pushApart(structureReference& ref)
{
    const referenceNeighbours pairs(ref, ref.support);
    List<vector> next = ref.x0;
    forPairs<among::all>(pairs, 0, ref.n(), [&](label i, pairIndex p, label) {
        const vector e = pairs.separation(ref, i, p);
        const scalar q = 1 - e.norm() / ref.support;
        next[i] += 0.25 * q * q * q * e;
    });
    ref.x0 = next;
}

}  // namespace

structureReference disorderedBlock(int nx, int ny, int nz, scalar dx, unsigned seed)
{
    structureReference ref = latticeBlock(nx, ny, nz, dx);
    const vector size = dx * vector(nx, ny, nz);
    const auto keepInside = [&] {
        for (vector& x : ref.x0)
            for (int d = 0; d < ref.nDims; ++d)
                x[d] = std::clamp(x[d], 0.2 * dx, size[d] - 0.2 * dx);
    };
    std::mt19937 generator(seed);  // raw numbers: the same with every standard library
    for (vector& x : ref.x0)
        for (int d = 0; d < ref.nDims; ++d)
            x[d] += 0.35 * dx * (2 * scalar(generator()) / scalar(generator.max()) - 1);
    keepInside();
    for (int d = 0; d < ref.nDims; ++d)
        for (const scalar face : {0.0, size[d]}) ref.images.push_back(mirrorAt(d, face));
    for (int sweep = 0; sweep < 60; ++sweep) pushApart(ref), keepInside();
    ref.images.clear();
    return ref;
}

}  // namespace ispf
