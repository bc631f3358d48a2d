// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidBlock.H"

namespace ispf
{

void solidBlock::setup(const blockMatrix3& K, scalar dt, const List<scalar>& A,
                       const particleCloud& cloud, scalar cellSize)
{
    const label n = K.size();
    elasticSystem system{K, dt, List<scalar>(n), List<char>(n), List<vector>(n)};
    for (label i = 0; i < n; ++i)
    {
        // inertia and viscosity: A_ii without the tangent
        system.added[i] = A[i] - dt * K.diagonal[i].trace() / cloud.nDims;
        system.held[i] = cloud.uFixed[i];
        system.x[i] = cloud.x[i].xyz();
    }
    multigrid_.rebuild(system, cellSize);
}

void solidBlock::solve(const List<scalar>& A, const particleCloud& cloud, List<vec4>& u) const
{
    r_.resize(cloud.nSolid());
    parallelFor(cloud.nSolid(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            r_[i].s = A[i] * u[i].s;
            if (cloud.uFixed[i]) r_[i] = vec4{};
            r_[i][3] = 0;
        }
    });
    multigrid_.apply(r_, z_);
    parallelFor(cloud.nSolid(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (!cloud.uFixed[i]) u[i].s = z_[i].s;
    });
}

}  // namespace ispf
