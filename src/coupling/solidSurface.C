// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidSurface.H"

#include <cmath>

namespace ispf
{

namespace
{

// Fluid zone of a neighbour, -1 for a rigid one
int fluidZone(const particleCloud& cloud, label j)
{
    if (cloud.phase[j] == phaseType::rigid) return -1;
    return cloud.zone[j < cloud.n() ? j : cloud.ghostSource(j)];
}

vector kernelGradient(const particleCloud& cloud, const neighbourList& list, label i,
                      std::int64_t k)
{
    return list.F[k] * (cloud.x[i].xyz() - cloud.x[list.index[k]].xyz());
}

constexpr const char* sideField = "surfaceSides";  // {M0, a + 256 b}; a, b zone numbers plus one
int sideA(scalar code)
{
    return int(code) % 256 - 1;
}
int sideB(scalar code)
{
    return int(code) / 256 - 1;
}

}  // namespace

void solidSurface::initialise(particleCloud& cloud, const neighbourList& list,
                              const List<tensor>& F) const
{
    if (cloud.vectors.count(sideField)) return;
    List<vec4>& sides = cloud.vectors[sideField];
    sides.assign(cloud.n(), vec4{});
    List<vector> sum(cloud.zones.size());
    for (label i = 0; i < cloud.nSolid(); ++i)
    {
        for (vector& s : sum) s.setZero();
        for (std::int64_t k = list.mid[i]; k < list.start[i + 1]; ++k)
            if (const int z = fluidZone(cloud, list.index[k]); z >= 0)
                sum[z] += kernelGradient(cloud, list, i, k);
        // the two fluid zones that weigh most; below 0.001/dx a zone is out of sight
        int a = -1, b = -1;
        for (int z = 0; z < int(sum.size()); ++z)
        {
            if (sum[z].norm() < 1e-3 / cloud.dx) continue;
            if (a < 0 || sum[z].norm() > sum[a].norm()) b = a, a = z;
            else if (b < 0 || sum[z].norm() > sum[b].norm()) b = z;
        }
        const vector M =
            (a < 0 ? vector::Zero() : sum[a]) - (b < 0 ? vector(vector::Zero()) : sum[b]);
        sides[i] = vec4::from(F[i].transpose() * M / F[i].determinant(), (a + 1) + 256 * (b + 1));
    }
}

void solidSurface::loads(const particleCloud& cloud, const neighbourList& list,
                         const smoothingKernel& kernel, const List<tensor>& F)
{
    const List<vec4>& sides = cloud.vectors.at(sideField);
    const label nSolid = cloud.nSolid();
    start.assign(nSolid + 1, 0);
    for (label i = 0; i < nSolid; ++i) start[i + 1] = start[i] + list.start[i + 1] - list.mid[i];
    c.assign(start[nSolid], vec4{});
    List<char> twoSided(nSolid, 0);
    parallelFor(
        nSolid,
        [&](label begin, label end) {
            List<scalar> w;
            for (label i = begin; i < end; ++i)
            {
                const label m = label(start[i + 1] - start[i]);
                w.assign(m, 0);
                vector N = vector::Zero();
                List<scalar> weight(cloud.zones.size(), 0);
                for (std::int64_t k = list.start[i]; k < list.start[i + 1]; ++k)
                {
                    const label j = list.index[k];
                    const int z = k < list.mid[i] ? -1 : fluidZone(cloud, j);
                    if (z < 0) N -= kernelGradient(cloud, list, i, k);
                    else
                        weight[z] += w[k - list.mid[i]] =
                            kernel.W((cloud.x[i].xyz() - cloud.x[j].xyz()).norm());
                }
                int a = sideA(sides[i][3]), b = sideB(sides[i][3]);
                vector load[2] = {N, vector::Zero()};
                if (a >= 0 && b >= 0)
                {
                    const vector M =
                        F[i].determinant() * F[i].inverse().transpose() * sides[i].xyz();
                    load[0] = 0.5 * (N + M), load[1] = 0.5 * (N - M);
                    twoSided[i] = 1;
                }
                else if (a < 0)  // saw no fluid at first: all to the zone it sees most of now
                    for (int z = 0; z < int(weight.size()); ++z)
                        if (weight[z] > 0 && (a < 0 || weight[z] > weight[a])) a = z;
                for (label q = 0; q < m; ++q)
                {
                    const int z = fluidZone(cloud, list.index[list.mid[i] + q]);
                    if (z >= 0 && (z == a || z == b))
                        c[start[i] + q] = vec4::from(2 * w[q] / weight[z] * load[z == a ? 0 : 1]);
                }
            }
        },
        256);
    nTwoSided = 0;
    for (const char t : twoSided) nTwoSided += t;
}

}  // namespace ispf
