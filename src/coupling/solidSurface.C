// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidSurface.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr const char* areaField[2] = {"surfaceAreaA", "surfaceAreaB"};  // {S0, zone + 1}
constexpr const char* wayField[2] = {"surfaceWayA", "surfaceWayB"};     // {e0, -}

// Fluid zone of a neighbour, -1 for a rigid one
int fluidZone(const particleCloud& cloud, label j)
{
    if (cloud.phase[j] == phaseType::rigid) return -1;
    return cloud.zone[j < cloud.n() ? j : cloud.ghostSource(j)];
}

// Depth below a plane from the fraction of the kernel beyond it,
//
//     int_d^H W 2 pi r (r - d) dr in 3D,   int_d^H W 2 r acos(d/r) dr in 2D
class depthTable
{
public:
    depthTable(const smoothingKernel& kernel, int nDims) : H_(kernel.support())
    {
        constexpr int nPoints = 200;
        for (int k = 0; k <= nDepths; ++k)
        {
            const scalar d = H_ * k / nDepths, dr = (H_ - d) / nPoints;
            scalar sum = 0;
            for (int q = 0; q < nPoints; ++q)
            {
                const scalar r = d + (q + 0.5) * dr;
                const scalar cap = nDims == 3 ? 2 * M_PI * r * (r - d) : 2 * r * std::acos(d / r);
                sum += kernel.W(r) * cap * dr;
            }
            beyond_[k] = sum;
        }
    }
    scalar depth(scalar fraction) const
    {
        if (fraction >= beyond_[0]) return 0;
        int k = 1;
        while (k < nDepths && beyond_[k] > fraction) ++k;
        const scalar part = (beyond_[k - 1] - fraction) / (beyond_[k - 1] - beyond_[k]);
        return H_ * (k - 1 + std::min(part, scalar(1))) / nDepths;
    }

private:
    static constexpr int nDepths = 64;
    scalar H_;
    scalar beyond_[nDepths + 1];
};

}  // namespace

void solidSurface::initialise(particleCloud& cloud, const neighbourList& list,
                              const smoothingKernel& kernel, const List<tensor>& F) const
{
    if (cloud.vectors.count(areaField[0])) return;
    for (const int s : {0, 1})
        for (const char* name : {areaField[s], wayField[s]})
            cloud.vectors[name].assign(cloud.n(), vec4{});
    const depthTable table(kernel, cloud.nDims);
    const scalar V = cloud.volume(), least = 2e-3 * V / cloud.dx;
    List<vector> area(cloud.zones.size());
    List<scalar> fraction(cloud.zones.size());
    for (label i = 0; i < cloud.nSolid(); ++i)
    {
        for (vector& a : area) a.setZero();
        std::fill(fraction.begin(), fraction.end(), 0);
        for (std::int64_t k = list.mid[i]; k < list.start[i + 1]; ++k)
        {
            const label j = list.index[k];
            const int z = fluidZone(cloud, j);
            if (z < 0) continue;
            const vector xij = cloud.x[i].xyz() - cloud.x[j].xyz();
            area[z] += 2 * V * list.F[k] * xij;
            fraction[z] += V * kernel.W(xij.norm());
        }
        // the two zones that weigh most; below `least` a zone is out of sight
        for (const int s : {0, 1})
        {
            const auto most = std::max_element(
                area.begin(), area.end(),
                [](const vector& a, const vector& b) { return a.norm() < b.norm(); });
            if (most->norm() < least) break;
            const label z = label(most - area.begin());
            const vector e = table.depth(fraction[z]) * most->normalized();
            cloud.vectors[areaField[s]][i] =
                vec4::from(F[i].transpose() * *most / F[i].determinant(), scalar(z + 1));
            cloud.vectors[wayField[s]][i] = vec4::from(F[i].inverse() * e);
            most->setZero();
        }
    }
}

void solidSurface::setup(const particleCloud& cloud, const neighbourList& list,
                         const smoothingKernel& kernel, const List<tensor>& cofactor)
{
    cloud_ = &cloud, list_ = &list;
    const label nSolid = cloud.nSolid();
    start_.assign(nSolid + 1, 0);
    for (label i = 0; i < nSolid; ++i) start_[i + 1] = start_[i] + list.start[i + 1] - list.mid[i];
    for (const int s : {0, 1}) part_[s].resize(nSolid), weight_[s].assign(start_[nSolid], 0);
    parallelFor(
        nSolid,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i) setupParticle(i, kernel, cofactor[i]);
        },
        256);
}

void solidSurface::setupParticle(label i, const smoothingKernel& kernel, const tensor& cofactor)
{
    const particleCloud& cloud = *cloud_;
    for (const int s : {0, 1})
    {
        const vec4& S0 = cloud.vectors.at(areaField[s])[i];
        sided& part = part_[s][i];
        part = {int(S0[3]) - 1, cofactor * S0.xyz(), cloud.vectors.at(wayField[s])[i].xyz()};
        if (part.side < 0) continue;
        scalar sum = 0;
        const label m = label(start_[i + 1] - start_[i]);
        scalar* w = weight_[s].data() + start_[i];
        for (label q = 0; q < m; ++q)
        {
            const label j = list_->index[list_->mid[i] + q];
            if (fluidZone(cloud, j) != part.side) continue;
            w[q] = kernel.W((cloud.x[i].xyz() - cloud.x[j].xyz()).norm());
            sum += w[q];
        }
        for (label q = 0; q < m && sum > 0; ++q) w[q] /= sum;
    }
}

void solidSurface::loads(const List<vec4>& up, List<vec4>& Q, List<tensor>& P) const
{
    const label nSolid = cloud_->nSolid();
    const scalar perVolume = 1 / cloud_->volume();
    Q.resize(nSolid), P.resize(nSolid);
    parallelFor(
        nSolid,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                Q[i] = vec4{}, P[i].setZero();
                for (const int s : {0, 1})
                {
                    const sided& part = part_[s][i];
                    if (part.side < 0) continue;
                    scalar p = 0;
                    const scalar* w = weight_[s].data() + start_[i];
                    for (std::int64_t k = list_->mid[i]; k < list_->start[i + 1]; ++k)
                        p += *w++ * up[list_->index[k]].s[3];
                    Q[i].s += p * vec4::from(part.S).s;
                    P[i] += p * perVolume * part.S * part.e0.transpose();
                }
            }
        },
        256);
}

}  // namespace ispf
