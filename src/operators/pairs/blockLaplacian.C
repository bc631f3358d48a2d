// SPDX-License-Identifier: GPL-3.0-or-later
#include "blockLaplacian.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ispf
{

blockLaplacian::blockLaplacian(const graph& g, const List<scalar>& holds) : g_(g)
{
    findBlocks();
    const label first = g_.within.first, end = g_.cloud.n();
    const tensor free = g_.cloud.freeDirections();
    const int nMatrices = free.isIdentity(1e-9) ? 1 : 3;
    List<Eigen::MatrixXd> A(nMatrices, Eigen::MatrixXd::Zero(n_, n_));
    List<List<label>> members(n_);  // particles of each block
    for (label i = first; i < end; ++i)
        if (block_[i] >= 0) members[block_[i]].push_back(i);
    parallelFor(
        n_,
        [&](label from, label to) {
            List<Eigen::VectorXd> row(nMatrices);
            for (label b = from; b < to; ++b)
            {
                for (Eigen::VectorXd& r : row) r = Eigen::VectorXd::Zero(n_);
                for (const label i : members[b])
                {
                    addPairs(i, free, row);
                    for (Eigen::VectorXd& r : row) r[b] += holds[i];
                }
                for (int d = 0; d < nMatrices; ++d) A[d].row(b) = row[d];
            }
        },
        1);
    for (const Eigen::MatrixXd& ofComponent : A) factors_.emplace_back(ofComponent);
}

// Blocks are cubes with the particles of one body
void blockLaplacian::findBlocks()
{
    constexpr scalar mostBlocks = 300, leastInBlock = 30;  // doc/constants.md
    const particleCloud& cloud = g_.cloud;
    const scalar count = scalar(cloud.n() - g_.within.first);
    const scalar edge =
        cloud.dx * std::pow(std::max(leastInBlock, count / mostBlocks), 1.0 / cloud.nDims);
    block_.assign(cloud.n(), -1);
    std::map<std::array<label, 4>, label> known;
    for (label i = g_.within.first; i < cloud.n(); ++i)
    {
        std::array<label, 4> key = {-1, cloud.stripOf(i), 0, 0};
        if (g_.closed[i])
        {
            key[0] = g_.bodies.of[i];
            for (int d = 0; d < 3; ++d) key[d + 1] = label(std::floor(cloud.x[i][d] / edge));
        }
        else if (!g_.inStrip[i]) continue;
        block_[i] = known.try_emplace(key, label(known.size())).first->second;
    }
    n_ = label(known.size());
}

// Adds the entries of w_ij |psi_i - R psi_j|^2 in the row of i's block, for each pair of i and each component.  R is the turn
// of the image j, 1 for a particle.  free: particleCloud::freeDirections.  A strip has no psi in directions that symmetry planes turn
void blockLaplacian::addPairs(label i, const tensor& free, List<Eigen::VectorXd>& row) const
{
    const particleCloud& cloud = g_.cloud;
    const label own = block_[i];
    forNeighbours(g_.list, g_.within.row(g_.list, i), [&](pairIndex k, label j) {
        const label owner = cloud.ownerOf(j), other = block_[owner];
        // within a block psi is the same: no term
        if ((other == own && j < cloud.n()) || (g_.inStrip[i] && g_.inStrip[owner])) return;
        const scalar w = -g_.list.F[k];
        for (label d = 0; d < label(row.size()); ++d)
        {
            const bool turns = free(d, d) < 0.5;
            if (g_.inStrip[i] && turns) continue;
            row[d][own] += w;
            if (other < 0 || (g_.inStrip[owner] && turns)) continue;
            row[d][other] -= w * (j < cloud.n() ? 1 : cloud.ruleOf(j).R(d, d));
        }
    });
}

void blockLaplacian::solve(const List<float4>& r, const List<float>& weight, List<float4>& z) const
{
    const label first = g_.within.first;
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n_, 3);
    const auto ofPart = [&](label from, label to) {
        Eigen::MatrixXd part = Eigen::MatrixXd::Zero(n_, 3);
        for (label i = first + from; i < first + to; ++i)
            if (const label b = block_[i]; b >= 0)
                for (int d = 0; d < 3; ++d) part(b, d) += weight[i] * r[i][d];
        return part;
    };
    for (const Eigen::MatrixXd& part : parallelParts(g_.cloud.n() - first, ofPart)) sums += part;
    sums /= g_.cloud.dx * g_.cloud.dx;
    if (factors_.size() == 1) sums = factors_[0].solve(sums).eval();
    else
        for (int d = 0; d < 3; ++d) sums.col(d) = factors_[d].solve(sums.col(d)).eval();
    z.resize(n_);
    for (label b = 0; b < n_; ++b)
        z[b] = float4{float(sums(b, 0)), float(sums(b, 1)), float(sums(b, 2)), 0};
}

}  // namespace ispf
