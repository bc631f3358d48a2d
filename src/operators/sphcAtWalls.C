// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphc.H"

#include <Eigen/Eigenvalues>

namespace ispf
{

namespace
{

// n n^T of the wall that ghost j stands for, zero where it is not known; images in several walls at once are left out
tensor acrossWall(const particleCloud& cloud, label j)
{
    if (cloud.ghostSource(j) >= 0)
        return cloud.sticks(j) ? tensor(0.5 * (tensor::Identity() - cloud.ruleOf(j).R))
                               : tensor::Zero();
    const vec4& depth = cloud.ghostDepth(j);
    return depth[3] > 0 ? tensor(depth.xyz() * depth.xyz().transpose()) : tensor::Zero();
}

// What of u, its mean over the fluid in reach, lies along all walls in reach: a direction counts whole if a tenth of the walls
// is across it, not at all from a quarter on.  In corners nothing does: p has no slope there that dx resolves
vector alongWallsAt(const stencil& s, label i, const List<vec4>& all)
{
    const auto weight = [&](std::int64_t k) {
        return -s.list.F[k] * (s.cloud.x[i].xyz() - s.cloud.x[s.list.index[k]].xyz()).squaredNorm();
    };
    tensor across = tensor::Zero();
    for (std::int64_t k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
        if (const label j = s.list.index[k]; j >= s.cloud.n())
            across += weight(k) * acrossWall(s.cloud, j);
    if (!(across.trace() > 0)) return vector::Zero();
    vector u = vector::Zero();
    scalar sum = 0;
    for (std::int64_t k = s.list.start[i]; k < s.list.mid[i]; ++k)
        u += weight(k) * all[s.list.index[k]].xyz(), sum += weight(k);
    if (!(sum > 0)) return vector::Zero();
    u /= sum;
    const Eigen::SelfAdjointEigenSolver<tensor> part(across / across.trace());
    const vector counts = ((0.25 - part.eigenvalues().array()) / 0.15).cwiseMax(0).cwiseMin(1);
    return part.eigenvectors() * counts.cwiseProduct(part.eigenvectors().transpose() * u);
}

// By how much the wall's going faster changes the velocity of neighbour j as i sees it
vector atWall(const particleCloud& cloud, const List<vec4>& u, label i, label j)
{
    if (const label source = cloud.ghostSource(j); source >= 0)
    {
        const ghostRule& rule = cloud.ruleOf(j);
        return (rule.R - rule.M.topLeftCorner<3, 3>()) * u[source].xyz();
    }
    if (!(cloud.ghostDepth(j)[3] > 0)) return vector::Zero();
    return u[i].xyz() - acrossWall(cloud, j) * u[i].xyz();
}

}  // namespace

bool sphc::anySticks(const particleCloud& cloud)
{
    for (label g = cloud.n(); g < cloud.nAll(); ++g)
        if (cloud.ghostSource(g) < 0 || cloud.sticks(g)) return true;
    return false;
}

List<vec4> sphc::alongWalls(const stencil& s, List<vec4> u)
{
    List<vec4> result(s.cloud.n());
    s.cloud.fillGradientGhosts(u);
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) result[i].setXyz(alongWallsAt(s, i, u));
    });
    return result;
}

List<vec4> sphc::laplacianAtWalls(const stencil& s, const List<vec4>& u, const List<scalar>& c)
{
    const particleCloud& cloud = s.cloud;
    List<vec4> result(cloud.n());
    if (u.empty()) return result;
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            for (std::int64_t k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
            {
                const label j = s.list.index[k];
                if (j < cloud.n()) continue;
                const scalar both = c[i] + (cloud.ghostSource(j) < 0 ? c[i] : c[j]);
                result[i].s -= cloud.friction(i, j) * viscousF(cloud, s.list, k) * both *
                               vec4::from(atWall(cloud, u, i, j)).s;
            }
    });
    return result;
}

}  // namespace ispf
