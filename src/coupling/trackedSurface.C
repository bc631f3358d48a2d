// SPDX-License-Identifier: GPL-3.0-or-later
#include "trackedSurface.H"

#include "surfaceTopology.H"

#include <cmath>

namespace ispf
{

trackedSurface::trackedSurface(const word& name, const fsiCase& c) : name_(name)
{
    if (c.cloud.nSolid() == 0)
        throw fatalError("Surface " + name + " is to follow a solid, but the case has none");
    rest_ = readSTL(c.time.constantFile("triSurface/" + name + ".stl"));
    rest_.weld(1e-3 * c.cloud.dx);
    factor_ = c.walls->symmetryFactor();
    attach(c);
    findApex(*c.walls);
    now_ = rest_;
    update(c.cloud.x);
}

void trackedSurface::attach(const fsiCase& c)
{
    const List<vec4>& x0 = c.cloud.vectors.at("x0");
    const scalar reach = 2.6 * c.cloud.dx;
    const label nv = label(rest_.nodes.size());
    List<List<std::pair<label, scalar>>> found(nv);
    parallelFor(
        nv,
        [&](label begin, label end) {
            for (label v = begin; v < end; ++v)
            {
                // w_j = W_j (1, r)^T M^-1 (1, 0), M = sum W (1, r)(1, r)^T: linear reproduction
                Eigen::Matrix4d M = 1e-9 * Eigen::Matrix4d::Identity();
                List<std::pair<label, Eigen::Vector4d>> near;
                for (label j = 0; j < c.cloud.nSolid(); ++j)
                {
                    const vector r = (x0[j].xyz() - rest_.nodes[v]) / reach;
                    if (r.squaredNorm() >= 1) continue;
                    const Eigen::Vector4d P(1, r[0], r[1], r[2]);
                    const scalar W = std::pow(1 - r.norm(), 2);
                    M += W * P * P.transpose();
                    near.push_back({j, W * P});
                }
                if (near.size() < 4)
                    throw fatalError("Surface " + name_ + ": vertex (" + str(rest_.nodes[v][0]) +
                                     " " + str(rest_.nodes[v][1]) + " " + str(rest_.nodes[v][2]) +
                                     ") has no solid particles near it to follow");
                const Eigen::Vector4d a = M.ldlt().solve(Eigen::Vector4d(1, 0, 0, 0));
                scalar sum = 0;
                for (const auto& [j, WP] : near)
                    found[v].push_back({j, a.dot(WP)}), sum += a.dot(WP);
                for (auto& [j, w] : found[v]) w /= sum;
            }
        },
        16);
    start_.push_back(0);
    for (const auto& list : found)
    {
        for (const auto& [j, w] : list) source_.push_back(j), weight_.push_back(w);
        start_.push_back(label(source_.size()));
    }
}

// A point in every symmetry plane and in the mean of the rim: planes through it add no volume
void trackedSurface::findApex(const boundary& walls)
{
    apex_ = vector::Zero();
    label n = 0;
    for (const auto& [a, b] : openHalfEdges(rest_))
    {
        const vector middle = 0.5 * (rest_.nodes[a] + rest_.nodes[b]);
        bool onPlane = false;
        for (const auto& [point, normal] : walls.symmetryPlanes())
            onPlane = onPlane || std::abs((middle - point).dot(normal)) <
                                     1e-4 * (rest_.nodes[a] - rest_.nodes[b]).norm();
        if (!onPlane) apex_ += middle, ++n;
    }
    if (n > 0) apex_ /= n;
    for (int sweep = 0; sweep < 20; ++sweep)  // onto all planes; orthogonal ones need one
        for (const auto& [point, normal] : walls.symmetryPlanes())
            apex_ -= (apex_ - point).dot(normal) * normal;
}

void trackedSurface::update(const List<vec4>& x)
{
    parallelFor(label(now_.nodes.size()), [&](label begin, label end) {
        for (label v = begin; v < end; ++v)
        {
            simd4 sum = {};
            for (label k = start_[v]; k < start_[v + 1]; ++k) sum += weight_[k] * x[source_[k]].s;
            now_.nodes[v] = vector(sum[0], sum[1], sum[2]);
        }
    });
}

scalar trackedSurface::volumeOf(const triSurface& s) const
{
    scalar volume = 0;
    for (label t = 0; t < s.size(); ++t)
        volume += (s.corner(t, 0) - apex_).dot(s.areaVector(t)) / 3;
    return std::abs(volume) * factor_;
}

}  // namespace ispf
