// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidSurface.H"
#include "followWeights.H"
#include "forPairs.H"
#include "imagedPoints.H"
#include "solidSides.H"
#include "surfaceCover.H"
#include "volumeConstraint.H"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ispf
{

namespace
{

constexpr const char* areaField[2] = {"surfaceAreaA", "surfaceAreaB"};  // {S0, zone + 1}
constexpr const char* wayField[2] = {"surfaceWayA", "surfaceWayB"};     // {e0, -}

// The particles near a foot, with their weights and slopes [1/m] (followWeights.H).  At a sharp tip it looks farther, by half
// more at a time, until its particles span the space or are all
void findFoot(const pointGrid& solids, const vector& foot, int nDims, scalar usual,
              List<label>& near, List<scalar>& weight, List<vector>& slope)
{
    scalar spanned = 0;  // number of directions
    near.clear();
    for (scalar reach = usual; spanned < nDims - 0.5 && label(near.size()) < solids.size();
         reach *= 1.5)
    {
        near.clear(), slope.clear(), spanned = 0;
        List<vector> r;
        solids.within(foot, reach, [&](label k, scalar) { near.push_back(k); });
        std::sort(near.begin(), near.end());
        for (const label k : near) r.push_back((solids[k] - foot) / reach);
        weight = followWeights(r, &slope);
        for (size_t k = 0; k < slope.size(); ++k) spanned += slope[k].dot(r[k]), slope[k] /= reach;
    }
}

}  // namespace

List<sideAtRest> sidesAtRest(const particleCloud& cloud, label k)
{
    List<sideAtRest> sides;
    for (const int s : {0, 1})
        if (const auto area = cloud.vectors.find(areaField[s]); area != cloud.vectors.end())
            if (const vec4& S0 = area->second[k]; S0[3] > 0)
                sides.push_back(
                    {label(S0[3]) - 1, S0.xyz(), cloud.vectors.at(wayField[s])[k].xyz()});
    return sides;
}

void solidSurface::initialise(particleCloud& cloud, const neighbourList& list,
                              const List<tensor>& F, const List<isometry>& images) const
{
    if (cloud.vectors.count(areaField[0])) return;
    for (const int s : {0, 1})
        for (const char* name : {areaField[s], wayField[s]})
            cloud.vectors[name].assign(cloud.n(), vec4{});
    const solidSides all(cloud, list, images);
    List<solidSides::sides> sides;
    for (label i = 0; i < cloud.nSolid(); ++i) sides.push_back(all.of(i));
    for (label z = 0; z <= label(cloud.zones.size()); ++z)
    {
        List<std::pair<label, int>> looking;  // particle, its side
        List<vector> feet, areas;
        for (label i = 0; i < cloud.nSolid(); ++i)
            for (const int s : {0, 1})
            {
                if (sides[i].zone[s] != z) continue;
                looking.push_back({i, s}), areas.push_back(sides[i].area[s]);
                feet.push_back(cloud.x[i].xyz() + sides[i].way[s]);
            }
        const List<scalar> factor = coverFactors(feet, areas, cloud.nDims, cloud.dx, images);
        for (size_t k = 0; k < looking.size(); ++k)
        {
            const auto [i, s] = looking[k];
            cloud.vectors[areaField[s]][i] = vec4::from(
                factor[k] * F[i].transpose() * areas[k] / F[i].determinant(), scalar(z + 1));
            cloud.vectors[wayField[s]][i] = vec4::from(F[i].inverse() * sides[i].way[s]);
        }
    }
}

void solidSurface::setup(const particleCloud& cloud, const neighbourList& list,
                         const smoothingKernel& kernel, const List<tensor>& cofactor,
                         const List<isometry>& images)
{
    cloud_ = &cloud, list_ = &list;
    if (feet_[0].start.empty()) findFeet(cloud, kernel.support(), images);
    const label nSolid = cloud.nSolid();
    start_.assign(nSolid + 1, 0);
    for (label i = 0; i < nSolid; ++i)
        start_[i + 1] = start_[i] + rowOf<among::others>(list, i).size();
    for (const int s : {0, 1}) part_[s].resize(nSolid), weight_[s].assign(start_[nSolid], 0);
    parallelFor(
        nSolid,
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i) setupParticle(i, kernel, cofactor);
        },
        256);
    findReceivers();
}

void solidSurface::findReceivers()
{
    List<label>& start = receiverStart_;
    start.assign(cloud_->n() + 1, 0);
    forShares([&](label, int, label j, scalar) { ++start[cloud_->ownerOf(j) + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    received_.resize(start.back());
    List<label> place(start.begin(), start.end() - 1);
    forShares([&](label k, int s, label j, scalar w) {
        received_[place[cloud_->ownerOf(j)]++] = {2 * k + s, w};
    });
}

// Finds the feet from the rest state, once: they do not move within the solid
void solidSurface::findFeet(const particleCloud& cloud, scalar support,
                            const List<isometry>& images)
{
    map_ = {isometry()};
    map_.insert(map_.end(), images.begin(), images.end());
    const List<vec4>& x0 = cloud.vectors.at("x0");
    const scalar reach = std::max(3 * cloud.dx, support);
    List<vector> rest;
    for (label i = 0; i < cloud.nSolid(); ++i) rest.push_back(x0[i].xyz());
    const imagedPoints solids(rest, reach, images);
    for (const int s : {0, 1})
    {
        const List<vec4>&A = cloud.vectors.at(areaField[s]), &e = cloud.vectors.at(wayField[s]);
        List<List<label>> near(cloud.nSolid());
        List<List<scalar>> weight(cloud.nSolid());
        List<List<vector>> slope(cloud.nSolid());
        parallelFor(
            cloud.nSolid(),
            [&](label begin, label end) {
                for (label i = begin; i < end; ++i)
                {
                    if (A[i][3] == 0) continue;
                    const vector foot = rest[i] + e[i].xyz();
                    findFoot(solids.grid, foot, cloud.nDims, reach, near[i], weight[i], slope[i]);
                }
            },
            16);
        feet& f = feet_[s];
        f.start.push_back(0);
        for (label i = 0; i < cloud.nSolid(); ++i)
        {
            for (const label k : near[i])
                f.index.push_back(solids.source[k]), f.image.push_back(solids.image[k]);
            f.weight.insert(f.weight.end(), weight[i].begin(), weight[i].end());
            f.slope.insert(f.slope.end(), slope[i].begin(), slope[i].end());
            f.start.push_back(label(f.index.size()));
        }
    }
}

// F on the surface, (5.2).  The layers of an inflated ring are stretched less the deeper they lie, and F of the particles
// next to the surface contains only the layers behind them
tensor solidSurface::gradientAtFoot(int s, label i) const
{
    const feet& f = feet_[s];
    const vector from = cloud_->x[i].xyz();
    tensor F = vector(0, 0, cloud_->nDims == 2).asDiagonal();
    forNeighbours<among::all>(f, i, [&](pairIndex k, label j) {
        F += (map_[f.image[k]](cloud_->x[j].xyz()) - from) * f.slope[k].transpose();
    });
    return F;
}

tensor solidSurface::rateAtFoot(int s, label i, const List<vec4>& u) const
{
    const feet& f = feet_[s];
    tensor rate = tensor::Zero();
    forNeighbours<among::all>(f, i, [&](pairIndex k, label j) {
        rate += map_[f.image[k]].R * u[j].xyz() * f.slope[k].transpose();
    });
    return rate;
}

vector solidSurface::areaAtRest(int s, label i) const
{
    return cloud_->vectors.at(areaField[s])[i].xyz();
}

vector solidSurface::velocityAtFoot(int s, label i, const List<vec4>& u) const
{
    // a clamped body moves as one up to its edge, whatever an extrapolation from its neighbours gives
    if (cloud_->uFixed[i]) return u[i].xyz();
    const feet& f = feet_[s];
    vector at = vector::Zero();
    forNeighbours<among::all>(
        f, i, [&](pairIndex k, label j) { at += f.weight[k] * (map_[f.image[k]].R * u[j].xyz()); });
    return at;
}

scalar solidSurface::missed(const List<vec4>& u, const List<tensor>& dF, scalar dt,
                            const List<char>& zones) const
{
    return parallelSum(cloud_->nSolid(), [&](label begin, label end) {
        scalar sum = 0;
        for (label i = begin; i < end; ++i)
            for (const int s : {0, 1})
            {
                const sided& part = part_[s][i];
                if (part.side < 0 || !zones[part.side]) continue;
                const tensor F = gradientAtFoot(s, i), change = dt * rateAtFoot(s, i, u);
                sum += (meanCofactor(F, change) * areaAtRest(s, i)).dot(velocityAtFoot(s, i, u)) -
                       part.S.dot(u[i].xyz() + dF[i] * part.e0);
            }
        return sum;
    });
}

void solidSurface::setupParticle(label i, const smoothingKernel& kernel,
                                 const List<tensor>& cofactor)
{
    const particleCloud& cloud = *cloud_;
    for (const int s : {0, 1})
    {
        const vec4& S0 = cloud.vectors.at(areaField[s])[i];
        sided& part = part_[s][i];
        part = sided();
        part.side = int(S0[3]) - 1, part.e0 = cloud.vectors.at(wayField[s])[i].xyz();
        if (part.side < 0) continue;
        part.S = cofactorOf(gradientAtFoot(s, i)) * areaAtRest(s, i);
        // F = J (cof F)^-T, and det cof F = J^2
        part.e = std::sqrt(cofactor[i].determinant()) * cofactor[i].inverse().transpose() * part.e0;
        part.outside = part.side == int(cloud.zones.size());
        if (part.outside) part.side = -1;
        if (part.outside) continue;
        scalar sum = 0;
        scalar* w = weight_[s].data() + start_[i];
        const pairRange row = rowOf<among::others>(*list_, i);
        forNeighbours(*list_, row, [&](pairIndex k, label j) {
            if (fluidZone(cloud, j) != part.side) return;
            w[k - row.first] = kernel.W((cloud.x[i].xyz() - cloud.x[j].xyz()).norm());
            sum += w[k - row.first];
        });
        if (sum == 0) part.side = -1;  // the particle sees no fluid: no load, no flux
        for (pairIndex q = 0; q < row.size() && sum > 0; ++q) w[q] /= sum;
    }
}

// p^ of the header
scalar solidSurface::pressureOn(int s, label i, const List<vec4>& up) const
{
    const scalar* w = weight_[s].data() + start_[i];
    const pairRange row = rowOf<among::others>(*list_, i);
    return sumNeighbours(*list_, row, 0.0,
                         [&](pairIndex k, label j) { return w[k - row.first] * up[j].s[3]; });
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
                    const scalar p = pressureOn(s, i, up);
                    Q[i].s += p * vec4::from(part.S).s;
                    P[i] += p * perVolume * part.S * part.e0.transpose();
                }
            }
        },
        256);
}

void solidSurface::outsideLoads(const pressureAt& at, List<vec4>& Q, List<tensor>& P) const
{
    const label nSolid = cloud_->nSolid();
    Q.assign(nSolid, vec4{}), P.assign(nSolid, tensor::Zero());
    forEach(0, nSolid, [&](label i) {
        for (const int s : {0, 1})
        {
            const sided& part = part_[s][i];
            if (!part.outside) continue;
            const scalar p = at(cloud_->x[i].xyz() + part.e);
            Q[i].s += p * vec4::from(part.S).s;
            P[i] += p / cloud_->volume() * part.S * part.e0.transpose();
        }
    });
}

List<scalar> solidSurface::overSurface(const List<vec4>& up, const volumeConstraint& volume,
                                       const pressureAt& at) const
{
    const scalar mean = meanPressure(up, at);
    List<scalar> p(cloud_->nSolid());
    forEach(0, cloud_->nSolid(), [&](label i) { p[i] = volume.acts(i) ? up[i][3] - mean : 0; });
    return p;
}

// Mean of the pressure over the whole surface, zero without one
scalar solidSurface::meanPressure(const List<vec4>& up, const pressureAt& at) const
{
    const auto [load, area] = sumsOf(0, cloud_->nSolid(), [&](label i) -> std::array<scalar, 2> {
        std::array<scalar, 2> sum = {};
        for (const int s : {0, 1})
        {
            const sided& part = part_[s][i];
            if (part.outside ? !at : part.side < 0) continue;
            const scalar A = part.S.norm();
            sum[1] += A;
            sum[0] += A * (part.outside ? at(cloud_->x[i].xyz() + part.e) : pressureOn(s, i, up));
        }
        return sum;
    });
    return area > 0 ? load / area : 0;
}

std::array<scalar, 2> solidSurface::wetAndOpen() const
{
    return sumsOf(0, cloud_->nSolid(), [&](label i) {
        std::array<scalar, 2> sum = {};
        for (const int s : {0, 1})
        {
            if (cloud_->uFixed[i] || (part_[s][i].side < 0 && !part_[s][i].outside)) continue;
            sum[part_[s][i].outside] += areaAtRest(s, i).norm();
        }
        return sum;
    });
}

vector solidSurface::middleOfOpen() const
{
    const auto [area, x, y, z] = sumsOf(0, cloud_->nSolid(), [&](label i) {
        std::array<scalar, 4> sum = {};
        for (const int s : {0, 1})
        {
            if (cloud_->uFixed[i] || !part_[s][i].outside) continue;
            const scalar a = areaAtRest(s, i).norm();
            const vector at = a * (cloud_->x[i].xyz() + part_[s][i].e);
            sum[0] += a, sum[1] += at[0], sum[2] += at[1], sum[3] += at[2];
        }
        return sum;
    });
    return vector(x, y, z) / area;
}

// Calls visit(solid particle, number of its side, neighbour, weight)
template <class Visit>
void solidSurface::forShares(const Visit& visit) const
{
    for (label i = 0; i < cloud_->nSolid(); ++i)
        for (const int s : {0, 1})
        {
            if (part_[s][i].side < 0) continue;
            const scalar* w = weight_[s].data() + start_[i];
            const pairRange row = rowOf<among::others>(*list_, i);
            forNeighbours(*list_, row, [&](pairIndex k, label j) {
                if (w[k - row.first] != 0) visit(i, s, j, w[k - row.first]);
            });
        }
}

void solidSurface::shares(List<vec4>& b, List<tensor>& moment) const
{
    const particleCloud& cloud = *cloud_;
    const scalar perVolume = 1 / cloud.volume();
    b.assign(cloud.n(), vec4{}), moment.assign(cloud.n(), tensor::Zero());
    forShares([&](label k, int s, label j, scalar w) {
        const sided& part = part_[s][k];
        vector S = part.S, way = cloud.x[k].xyz() + part.e - cloud.x[j].xyz();
        if (j >= cloud.n())
        {
            const tensor back = cloud.ruleOf(j).R.transpose();
            S = back * S, way = back * way;
        }
        const label i = cloud.ownerOf(j);
        b[i].s -= 0.5 * w * perVolume * vec4::from(S).s;
        moment[i] -= w * perVolume * S * way.transpose();
    });
}

void solidSurface::addFlux(const List<vec4>& u, const List<tensor>& dF, List<scalar>& div) const
{
    const scalar perVolume = 1 / cloud_->volume();
    List<scalar> gives(2 * cloud_->nSolid());  // of each particle's two sides
    forEach(0, cloud_->nSolid(), [&](label k) {
        for (const int s : {0, 1})
        {
            const sided& part = part_[s][k];
            gives[2 * k + s] = perVolume * part.S.dot(u[k].xyz() + dF[k] * part.e0);
        }
    });
    forEach(0, cloud_->n(), [&](label i) {
        for (label r = receiverStart_[i]; r < receiverStart_[i + 1]; ++r)
            div[i] -= received_[r].weight * gives[received_[r].side];
    });
}

}  // namespace ispf
