// SPDX-License-Identifier: GPL-3.0-or-later
#include "shiftStiffness.H"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// A neighbour at x [dx], and the matrices by which its displacement changes the two sums of (8.30).  A displacement of the
// particle itself changes the sums by the opposite
struct answer
{
    vector x;
    tensor crowding, closing;
};

List<answer> answersOf(const smoothingKernel& kernel, int nDims, scalar dx)
{
    const label reach = label(kernel.support() / dx);
    List<answer> found;
    scalar sum = 0;
    for (label k = nDims == 3 ? -reach : 0; k <= (nDims == 3 ? reach : 0); ++k)
        for (label j = -reach; j <= reach; ++j)
            for (label i = -reach; i <= reach; ++i)
                if (const vector x(i, j, k); x.norm() > 0 && x.norm() * dx < kernel.support())
                    found.push_back({x, tensor::Zero(), tensor::Zero()}), sum += x.norm();
    const scalar mean = sum / scalar(found.size());
    for (answer& a : found)
    {
        constexpr scalar step = 1e-4;  // [dx], of the difference quotient for F' (doc/constants.md)
        const scalar r = a.x.norm();
        const tensor nn = a.x * a.x.transpose() / (r * r);
        scalar rSqr[3], F[3];
        for (int k = 0; k < 3; ++k) rSqr[k] = std::pow((r + (k - 1) * step) * dx, 2);
        kernel.F(rSqr, F, 3);
        const scalar V = std::pow(dx, nDims), slope = r * (F[2] - F[0]) / (2 * step);  // r F'
        a.crowding = mean * mean / (r * r * r) * (3 * nn - tensor::Identity());
        a.closing = V * dx * dx * (F[1] * tensor::Identity() + slope * nn);
    }
    return found;
}

scalar largestEigenvalue(const tensor& m, int nDims)
{
    const Eigen::MatrixXd part = m.topLeftCorner(nDims, nDims);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(part, Eigen::EigenvaluesOnly)
        .eigenvalues()[nDims - 1];
}

}  // namespace

shiftStiffness shiftStiffness::ofLattice(const smoothingKernel& kernel, int nDims, scalar dx)
{
    constexpr int waves = 8;  // per direction, up to the shortest (doc/constants.md)
    const List<answer> all = answersOf(kernel, nDims, dx);
    shiftStiffness most;
    for (int k = 0; k <= (nDims == 3 ? waves : 0); ++k)
        for (int j = 0; j <= waves; ++j)
            for (int i = 0; i <= waves; ++i)
            {
                const vector wave = M_PI / waves * vector(i, j, k);
                tensor crowding = tensor::Zero(), closing = tensor::Zero();
                for (const answer& a : all)
                {
                    const scalar part = 1 - std::cos(wave.dot(a.x));
                    crowding += part * a.crowding, closing += part * a.closing;
                }
                most.crowding = std::max(most.crowding, largestEigenvalue(crowding, nDims));
                most.closing = std::max(most.closing, largestEigenvalue(closing, nDims));
            }
    return most;
}

}  // namespace ispf
