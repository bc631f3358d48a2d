// SPDX-License-Identifier: GPL-3.0-or-later
#include "adjointPair.H"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace ispf
{

namespace
{

struct view
{
    const neighbourList& list;
    const std::int64_t* end;
    const vec4* x;
    const faceVectors& faces;

    // Neighbours of i in the medium, but for those across an open face that gives the velocity
    ISPF_INLINE pairRange row(label i) const { return {list.own[i], end[i]}; }
    // a_ij of entry k.  Components from nDims on are those of the next entry
    ISPF_INLINE simd4 face(std::int64_t k) const
    {
        simd4 a;
        std::memcpy(&a, faces.a.data() + faces.nDims * k, sizeof a);
        return a;
    }
    simd4 inSpace() const { return simd4{1, 1, faces.nDims == 3 ? 1.0 : 0.0, 0}; }
};

ISPF_HOT void gradientRange(const view& v, const scalar* p, label begin, label end, vec4* gp)
{
    const simd4 inSpace = v.inSpace();
    for (label i = begin; i < end; ++i)
    {
        const scalar pi = p[i];
        const simd4 sum = sumNeighbours(v.list, v.row(i), simd4{}, [&](pairIndex k, label j) {
            return (p[j] - pi) * v.face(k);
        });
        gp[i].s = sum * inSpace;
    }
}

ISPF_INLINE simd4 plainGradient(const view& v, const scalar* p, label i)
{
    const scalar pi = p[i];
    return sumNeighbours(v.list, v.row(i), simd4{}, [&](pairIndex k, label j) {
        return (v.list.F[k] * (p[j] - pi)) * (v.x[i].s - v.x[j].s);
    });
}

ISPF_HOT void divergenceRange(const view& v, const vec4* u, label begin, label end, scalar* div)
{
    const scalar inSpace = v.inSpace()[2];
    for (label i = begin; i < end; ++i)
    {
        const simd4 ui = u[i].s;
        const simd4 sum = sumNeighbours(v.list, v.row(i), simd4{}, [&](pairIndex k, label j) {
            return v.face(k) * (ui + u[j].s);
        });
        div[i] = sum[0] + sum[1] + inSpace * sum[2];
    }
}

ISPF_INLINE scalar wallPart(const view& v, const vec4* h, label i)
{
    const simd4 sum = sumNeighbours(v.list, v.row(i), simd4{}, [&](pairIndex k, label j) {
        return v.list.F[k] * (v.x[i].s - v.x[j].s) * (h[i].s + h[j].s);
    });
    return sum[0] + sum[1] + sum[2];
}

// weight(i, j) multiplies W_ij of (2.8)
template <class Weight>
ISPF_INLINE void remainderOf(const view& v, const vec4* g, label i, vec4* m, scalar* direct,
                             const Weight& weight)
{
    const simd4 inSpace = {1, 1, 1, 0}, gi = g[i].s, xi = v.x[i].s;
    simd4 moment = {};
    scalar sum = 0;
    forNeighbours(v.list, v.row(i), [&](pairIndex k, label j) {
        const simd4 d = (v.x[j].s - xi) * inSpace, s = (gi + g[j].s) * d;
        const scalar jump = gi[3] - g[j].s[3] + 0.5 * (s[0] + s[1] + s[2]);
        const scalar weighted = -adjointPair::stabiliserWeight * v.list.F[k] * weight(i, j) * jump;
        sum += weighted, moment += weighted * d;
    });
    m[i].s = moment, direct[i] = 2 * sum;
}

ISPF_HOT void remainderRange(const view& v, const vec4* g, label begin, label end, vec4* m,
                             scalar* direct)
{
    for (label i = begin; i < end; ++i)
        remainderOf(v, g, i, m, direct, [](label, label) { return 1.0; });
}

// The same with W_ij root_i root_j
ISPF_HOT void weakenedRange(const view& v, const vec4* g, const scalar* root, label begin,
                            label end, vec4* m, scalar* direct)
{
    for (label i = begin; i < end; ++i)
        remainderOf(v, g, i, m, direct, [&](label a, label b) { return root[a] * root[b]; });
}

}  // namespace

scalar closureTolerance(const dictionary& solution)
{
    return solution.subOrEmptyDict("closure").getInRangeOrDefault("tolerance", 1e-14, 1e-2, 1e-4);
}

void adjointPair::setup(particleCloud& cloud, const neighbourList& list,
                        const smoothingKernel& kernel, medium within, const List<vec4>& solidB,
                        const List<tensor>& solidMoment)
{
    cloud_ = &cloud, list_ = &list, within_ = std::move(within);
    const label n = cloud.n(), first = within_.first;
    walls_.build(cloud, list, kernel, first == 0);
    List<vec4> b = walls_.b;
    moment_ = walls_.moment;
    for (label i = first; i < label(solidB.size()); ++i)
        b[i].s += solidB[i].s, moment_[i] += solidMoment[i];
    const faceVectors::fitted psi = {&cloud.vectors["closure1"], &cloud.vectors["closure2"],
                                     &cloud.vectors["closure"]};
    closure_ = faces_.build(cloud, list, within_, b, moment_, psi, tolerance_);

    free_ = cloud.freeDirections();
    List<tensor> linear(walls_.linear), one(within_.one);
    List<vec4> drag(n, vec4{});
    wallFlux_ = walls_.flux, faceFlux_.clear();
    addCut(linear, one, drag);
    fitArms(linear, drag);
    linearRow_.assign(n, -1), linearB_.clear();
    for (label i = first; i < n; ++i)
        if (!linear[i].isZero(0) && !faces_.poor[i])
        {
            linearRow_[i] = label(linearB_.size());
            linearB_.push_back(linear[i] * one[i]);
        }
    besideWall_.assign(n, 0);
    if (!linearB_.empty())
        parallelFor(n - first, [&](label begin, label end) {
            for (label i = first + begin; i < first + end; ++i)
            {
                besideWall_[i] =
                    linearRow_[i] >= 0 ||
                    anyNeighbour(list, within_.connected(list, i), [&](pairIndex, label j) {
                        return linearRow_[cloud.ownerOf(j)] >= 0;
                    });
            }
        });

    addDrag(one, walls_.drag, wallFlux_);
    if (!faceFlux_.empty()) addDrag(one, drag, faceFlux_);
    for (label i = 0; i < label(faceFlux_.size()); ++i) wallFlux_[i] += faceFlux_[i];
}

// sum_j a_ij (x) (x_j - x_i) + M_i, see (2.5)
tensor adjointPair::momentOf(label i) const
{
    tensor sum = moment_[i];
    forNeighbours(*list_, within_.row(*list_, i), [&](pairIndex k, label j) {
        sum += faces_.of(k) * (cloud_->x[j].xyz() - cloud_->x[i].xyz()).transpose();
    });
    return sum;
}

scalar adjointPair::cell(label i) const
{
    const auto term = [&](pairIndex k, label j) {
        return faces_.of(k).dot(cloud_->x[j].xyz() - cloud_->x[i].xyz());
    };
    return sumNeighbours(*list_, within_.row(*list_, i), moment_[i].trace(), term) / cloud_->nDims;
}

// Chooses the arms C_i of (3.13) so that G is exact for linear p beside walls, where (2.5) has an error
void adjointPair::fitArms(List<tensor>& linear, List<vec4>& drag)
{
    // eps^2 of (3.13) [1], and the largest norm of C_i - 1 (doc/constants.md)
    constexpr scalar least = 0.01, most = 0.5;
    arm_.assign(cloud_->n(), tensor::Identity());
    const label first = within_.first;
    const tensor one = vector(1, 1, cloud_->nDims == 2 ? 0 : 1).asDiagonal();
    parallelFor(cloud_->n() - first, [&](label begin, label end) {
        for (label i = first + begin; i < first + end; ++i)
        {
            if (linear[i].isZero(0) || faces_.poor[i]) continue;
            const tensor& T = linear[i];
            tensor change = T.transpose() *
                            (T * T.transpose() + least * tensor::Identity()).inverse() *
                            (one - momentOf(i));
            if (const scalar size = change.norm(); size > most) change *= most / size;
            const tensor arm = tensor::Identity() + change;
            arm_[i] = arm, linear[i] = T * arm;
            walls_.drag[i] = vec4::from(arm.transpose() * walls_.drag[i].xyz());
            if (!drag.empty()) drag[i] = vec4::from(arm.transpose() * drag[i].xyz());
        }
    });
}

// Adds to flux the terms of drag in (3.5), that is (3.5) with u = 0 less flux_i
void adjointPair::addDrag(const List<tensor>& one, const List<vec4>& drag, List<scalar>& flux) const
{
    if (linearB_.empty() || drag.empty()) return;
    const label first = within_.first, n = cloud_->n();
    h_.resize(cloud_->nAll());
    forEach(0, n, [&](label i) {
        const bool has = i >= first && linearRow_[i] >= 0;
        h_[i] = has ? vec4::from(-(one[i].transpose() * drag[i].xyz())) : vec4{};
    });
    cloud_->fillGradientGhosts(h_);
    const view v{*list_, within_.end->data(), cloud_->x.data(), faces_};
    forEach(first, n, [&](label i) {
        if (besideWall_[i]) flux[i] += wallPart(v, h_.data(), i);
    });
}

// Twice the mean of term(i, d) over each body, projected to directions that symmetry planes do not turn
template <class Term>
List<vec4> adjointPair::twiceMean(const Term& term) const
{
    const connectedBodies& bodies = faces_.bodies;
    const label first = within_.first;
    List<vec4> mean(bodies.n);
    if (free_.isZero(0)) return mean;
    const auto sums = [&](label begin, label end) {
        List<vec4> sum(bodies.n);
        for (label i = first + begin; i < first + end; ++i)
        {
            vec4& s = sum[bodies.of[i]];
            for (int d = 0; d < cloud_->nDims; ++d) s[d] += term(i, d);
            s[3] += 1;
        }
        return sum;
    };
    const List<List<vec4>> parts = parallelParts(cloud_->n() - first, sums);
    for (label body = 0; body < bodies.n; ++body)
    {
        simd4 sum = {};
        for (const List<vec4>& part : parts) sum += part[body].s;
        mean[body] = vec4::from(free_ * vec4{2 * sum / sum[3]}.xyz());
    }
    return mean;
}

// Adds the faces a_ij across open faces whose velocity is given, as elements of a moving wall with p linear to it, (4.9).
// The flux through these elements lacks a part of the volume that should enter; it is spread over their area.  Open faces
// that meet share this part: a cell at their rim belongs to one or the other by chance
void adjointPair::addCut(List<tensor>& linear, List<tensor>& one, List<vec4>& drag)
{
    const particleCloud& cloud = *cloud_;
    const auto known = cloud.vectors.find(givenVelocity);
    if (known == cloud.vectors.end()) return;
    List<vec4> given(known->second);
    given.resize(cloud.nAll());
    cloud.fillGhosts(given, true);
    List<label> cut;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (list_->start[i] < list_->own[i] && !cloud.beyondOpen(i)) cut.push_back(i);
    const auto velocity = [&](label i, label j) -> vector {  // in the middle of the face
        if (given[i][3] != given[j][3]) return given[j].xyz();
        return 0.5 * (given[i].xyz() + given[j].xyz());
    };
    const auto faceOf = [&](label j) { return size_t(given[j][3]); };
    List<size_t> group(cloud.entering.size());
    std::iota(group.begin(), group.end(), 0);
    for (const label i : cut)
        forNeighbours<among::cut>(*list_, i, [&](pairIndex, label j) {
            const size_t one = group[faceOf(j)],
                         other = group[faceOf(list_->index[list_->start[i]])];
            std::replace(group.begin(), group.end(), std::max(one, other), std::min(one, other));
        });
    List<scalar> lacks(group.size(), 0), area(group.size(), 0);
    for (size_t f = 1; f < group.size(); ++f) lacks[group[f]] -= cloud.entering[f];
    for (const label i : cut)
        forNeighbours<among::cut>(*list_, i, [&](pairIndex k, label j) {
            const vector a = 2 * cloud.volume() * faces_.of(k);
            lacks[group[faceOf(j)]] -= a.dot(velocity(i, j)), area[group[faceOf(j)]] += a.norm();
        });
    const auto added = [&](size_t f) {  // added normal velocity [m/s]
        const bool known = std::isfinite(lacks[group[f]]) && area[group[f]] > 0;
        return known ? lacks[group[f]] / area[group[f]] : 0;
    };
    faceFlux_.assign(cloud.n(), 0);
    parallelFor(label(cut.size()), [&](label begin, label end) {
        for (label c = begin; c < end; ++c)
        {
            const label i = cut[c];
            one[i] = kernelCorrection::of(cloud, *list_, i, within_.connected(*list_, i));
            forNeighbours<among::cut>(*list_, i, [&](pairIndex k, label j) {
                const vector a = faces_.of(k), x = cloud.x[j].xyz() - cloud.x[i].xyz();
                const scalar through = a.dot(velocity(i, j)) + a.norm() * added(faceOf(j));
                faceFlux_[i] += 2 * through;
                linear[i] += a * x.transpose(), drag[i].s += through * vec4::from(x).s;
            });
        }
    });
}

void adjointPair::gradient(const List<vec4>& phi, List<vec4>& gp) const
{
    const label first = within_.first;
    const view v{*list_, within_.end->data(), cloud_->x.data(), faces_};
    const List<vec4>& c = faces_.left;
    const List<vec4> all = twiceMean([&](label i, int d) { return c[i][d] * phi[i][3]; });
    // p in an array of its own: the loop over pairs then reads 8 bytes per neighbour, not 32
    p_.resize(cloud_->nAll());
    parallelFor(cloud_->nAll(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) p_[i] = phi[i].s[3];
    });
    parallelFor(cloud_->n() - first, [&](label begin, label end) {
        begin += first, end += first;
        gradientRange(v, p_.data(), begin, end, gp.data());
        for (label i = begin; i < end; ++i) gp[i].s += all[faces_.bodies.of[i]].s;
        for (label i = begin; i < end; ++i)
            if (linearRow_[i] >= 0)
            {
                const simd4 s = plainGradient(v, p_.data(), i);
                gp[i].s += vec4::from(linearB_[linearRow_[i]] * vector(s[0], s[1], s[2])).s;
            }
    });
    countPairs(list_->nPairs() - list_->start[first],
               label(sizeof(label)) + faces_.nDims * label(sizeof(scalar)));
}

void adjointPair::divergence(const List<vec4>& u, List<scalar>& div) const
{
    const label first = within_.first, n = cloud_->n();
    const view v{*list_, within_.end->data(), cloud_->x.data(), faces_};
    if (!linearB_.empty())
    {
        h_.resize(cloud_->nAll());
        forEach(0, n, [&](label i) {
            const label row = i < first ? -1 : linearRow_[i];
            h_[i] = row < 0 ? vec4{} : vec4::from(linearB_[row].transpose() * u[i].xyz());
        });
        cloud_->fillGradientGhosts(h_);
    }
    const List<vec4>& c = faces_.left;
    const List<vec4> all = twiceMean([&](label i, int d) { return u[i][d]; });
    parallelFor(n - first, [&](label begin, label end) {
        begin += first, end += first;
        divergenceRange(v, u.data(), begin, end, div.data());
        for (label i = begin; i < end; ++i)
        {
            const simd4 open = all[faces_.bodies.of[i]].s * c[i].s;
            div[i] -= open[0] + open[1] + open[2];
        }
        for (label i = begin; i < end; ++i)
            if (besideWall_[i]) div[i] += wallPart(v, h_.data(), i);
    });
    countPairs(list_->nPairs() - list_->start[first],
               label(sizeof(label)) + faces_.nDims * label(sizeof(scalar)));
}

void adjointPair::remainder(const List<vec4>& g, List<vec4>& m, List<scalar>& direct) const
{
    const label first = within_.first;
    const view v{*list_, within_.end->data(), cloud_->x.data(), faces_};
    parallelFor(cloud_->n() - first, [&](label begin, label end) {
        begin += first, end += first;
        if (root_.empty()) remainderRange(v, g.data(), begin, end, m.data(), direct.data());
        else weakenedRange(v, g.data(), root_.data(), begin, end, m.data(), direct.data());
    });
    countPairs(list_->nPairs() - list_->start[first], label(sizeof(label)) + label(sizeof(scalar)));
}

void adjointPair::weaken(const List<scalar>& mobility)
{
    root_.resize(mobility.empty() ? 0 : cloud_->nAll());
    forEach(0, label(root_.size()), [&](label j) {
        const label owner = cloud_->ownerOf(j);
        root_[j] = owner < 0 ? 1 : std::sqrt(mobility[owner]);
    });
}

List<scalar> adjointPair::stiffness() const
{
    constexpr scalar besidePlane = 2;  // lambda_max of a row beside a plane wall
    List<scalar> s(cloud_->n(), 1);
    const label first = within_.first;
    const view v{*list_, within_.end->data(), cloud_->x.data(), faces_};
    parallelFor(cloud_->n() - first, [&](label begin, label end) {
        for (label i = first + begin; i < first + end; ++i)
        {
            tensor sum = tensor::Zero();
            forNeighbours(*list_, v.row(i), [&](pairIndex k, label j) {
                vector a = faces_.of(k);
                if (linearRow_[i] >= 0)
                    a += list_->F[k] * linearB_[linearRow_[i]] *
                         (cloud_->x[i].xyz() - cloud_->x[j].xyz());
                sum -= a * a.transpose() / list_->F[k];
            });
            if (!(sum.norm() > besidePlane)) continue;  // the norm is not less than lambda_max
            const Eigen::SelfAdjointEigenSolver<tensor> e(sum, Eigen::EigenvaluesOnly);
            s[i] = std::max(1.0, e.eigenvalues()[2] / besidePlane);
        }
    });
    return s;
}

}  // namespace ispf
