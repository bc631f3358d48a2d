// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidRecovery.H"

#include "followWeights.H"
#include "forPairs.H"
#include "pointSampler.H"
#include "solidSurface.H"
#include "surfaceFit.H"

#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

constexpr scalar reach = 2.6;  // [dx] of the fits, that of the constraint
constexpr scalar ofSurface =
    3;  // [1] weight of a place of the surface over that of a particle in (5.50)
constexpr scalar none = std::numeric_limits<scalar>::quiet_NaN();

// F' of (5.48)
tensor withVolume(tensor F, scalar J, const tensor& C)
{
    for (int pass = 0; pass < 4; ++pass)
    {
        const scalar now = F.determinant();
        const tensor cofactor = now * F.inverse().transpose(), way = cofactor * C;
        F += (J - now) / cofactor.cwiseProduct(way).sum() * way;
    }
    return F;
}

tensor deviatorOf(const tensor& T)
{
    return T - T.trace() / 3 * tensor::Identity();
}

}  // namespace

solidRecovery::solidRecovery(const fsiCase& c)
    : case_(c),
      structure_(c.structure.get()),
      ref_(structure_->reference()),
      pairs_(structure_->gradient().neighbours()),
      map_{isometry()},
      mixed_(ref_.n(), 0),
      fit_(ref_.n()),
      spread_(ref_.n()),
      feet_(findFeet()),
      firstFoot_(ref_.n() + 1, 0),
      outside_(c.structureProperties, c.caseFolder())
{
    map_.insert(map_.end(), ref_.images.begin(), ref_.images.end());
    for (const foot& f : feet_) ++firstFoot_[f.particle + 1];
    for (label k = 0; k < ref_.n(); ++k) firstFoot_[k + 1] += firstFoot_[k];
    List<vec4> image;
    for (const vector& X : ref_.x0) image.push_back(vec4::from(X));
    forEach(0, ref_.n(), [&](label k) {
        fit_[k] = quadraticFit(k, vector::Zero());
        if (gradient(fit_[k], image).trace() < 2.99)
            mixed_[k] = 1, fit_[k] = quadraticFit(k, vector::Zero());
        spread_[k] = spreadOf(k);
    });
    forEach(0, label(feet_.size()),
            [&](label f) { feet_[f].fit = quadraticFit(feet_[f].particle, feet_[f].e0); });
    if (!ref_.rest.empty()) prestretch_ = prestretch(image);
}

List<solidRecovery::foot> solidRecovery::findFeet() const
{
    List<foot> feet;
    for (label k = 0; k < ref_.n(); ++k)
        for (const sideAtRest& s : sidesAtRest(case_.cloud, k))
            feet.push_back({k, s.zone, s.S0, s.e0, {}});
    return feet;
}

bool solidRecovery::isCurrent() const
{
    return structure_ == case_.structure.get() && findFeet().size() == feet_.size();
}

// Calls visit(particle, image, place at rest) for k and its neighbours, of the same material unless mixed_[k]
template <class Visit>
void solidRecovery::forNear(label k, const Visit& visit) const
{
    visit(k, 0, ref_.x0[k]);
    const label own = structure_->material(k);
    forNeighbours<among::all>(pairs_, k, [&](pairIndex p, label i) {
        if (mixed_[k] || structure_->material(i) == own)
            visit(i, pairs_.image[p], ref_.x0[k] - pairs_.separation(ref_, k, p));
    });
}

// The fit at `way` from particle k at rest
List<solidRecovery::member> solidRecovery::quadraticFit(label k, const vector& way) const
{
    List<member> fit;
    List<vector> r, slopes;
    const scalar range = reach * ref_.dx + way.norm();
    forNear(k, [&](label i, label image, const vector& X) {
        fit.push_back({i, image, 0, vector::Zero()});
        r.push_back((X - ref_.x0[k] - way) / range);
    });
    const List<scalar> weights = followWeights(r, &slopes);
    for (size_t a = 0; a < fit.size(); ++a)
        fit[a].weight = weights[a], fit[a].slope = slopes[a] / range;
    return fit;
}

tensor solidRecovery::spreadOf(label k) const
{
    tensor C = tensor::Zero();
    for (const member& a : fit_[k])
    {
        const scalar d = (map_[a.image](ref_.x0[a.index]) - ref_.x0[k]).norm();
        if (const scalar w = 1 - d / (reach * ref_.dx); w > 0)
            C += a.slope * a.slope.transpose() / (w * w);  // w^2: weight in followWeights
    }
    return C;
}

// Of places x
tensor solidRecovery::gradient(const List<member>& fit, const List<vec4>& x) const
{
    tensor F = vector(0, 0, ref_.nDims == 2).asDiagonal();
    for (const member& a : fit) F += map_[a.image](x[a.index].xyz()) * a.slope.transpose();
    return F;
}

tensor solidRecovery::gradientOfVectors(const List<member>& fit, const List<vec4>& u) const
{
    tensor rate = tensor::Zero();
    for (const member& a : fit) rate += turn(a.image) * u[a.index].xyz() * a.slope.transpose();
    return rate;
}

// Mean of J of the constraint about k
scalar solidRecovery::meanVolume(label k, const List<tensor>& F) const
{
    scalar sum = 0, total = 0;
    forNear(k, [&](label i, label, const vector& X) {
        const scalar w =
            std::max(0.0, 1 - (X - ref_.x0[k]).squaredNorm() / std::pow(reach * ref_.dx, 2));
        sum += w * F[i].determinant(), total += w;
    });
    return sum / total;
}

// F: of the constraint
structureModel::motion solidRecovery::motion(const List<tensor>& F) const
{
    const label n = ref_.n();
    structureModel::motion m;
    m.F.resize(n), m.rate.resize(n);
    forEach(0, n, [&](label k) {
        m.F[k] = withVolume(gradient(fit_[k], case_.cloud.x), meanVolume(k, F), spread_[k]);
        m.rate[k] = gradientOfVectors(fit_[k], case_.cloud.Up);
    });
    m.fromRest = m.F;
    for (size_t k = 0; k < prestretch_.size(); ++k) m.fromRest[k] *= prestretch_[k];
    return m;
}

// F0 of (7.19), smoothed, (5.52)
List<tensor> solidRecovery::prestretch(const List<vec4>& image) const
{
    const label n = ref_.n();
    List<tensor> H, F0(n);
    structure_->fromRest(image, H);
    forEach(0, n, [&](label k) { H[k] = H[k].inverse().eval(); });
    forEach(0, n, [&](label k) {
        tensor sum = tensor::Zero();
        for (const member& a : linearFit(k, [&](label i) { return i < n; }))
            sum += a.weight * turn(a.image) * H[a.index] * turn(a.image).transpose();
        F0[k] = withVolume(sum, 1, spread_[k]).inverse();
    });
    return F0;
}

void solidRecovery::evaluate(List<tensor>& F, List<tensor>& sigma) const
{
    const label n = ref_.n();
    List<tensor> ofForce, tau, s(n);
    List<scalar> q(n);
    structure_->stress(case_.cloud.x, ofForce);
    structure_->deformationGradient(case_.cloud.x, F);
    structureModel::motion m = motion(F);
    if (!structure_->stress(m, tau)) tau = ofForce;
    forEach(0, n, [&](label k) {
        s[k] = deviatorOf(tau[k]) / m.F[k].determinant();
        bool acts = false;  // theory 5.4
        forNear(k, [&](label i, label, const vector&) { acts = acts || !ref_.fixed[i]; });
        q[k] = acts ? case_.cloud.Up[k][3] - ofForce[k].trace() / (3 * F[k].determinant()) : none;
    });
    const List<scalar> surface = onSurface(s);
    q.insert(q.end(), surface.begin(), surface.end());
    sigma.resize(n);
    forEach(0, n, [&](label k) { sigma[k] = s[k] - pressure(k, q) * tensor::Identity(); });
    F = std::move(m.fromRest);
}

// The facet of a foot, its area out of what lies before the solid
facet solidRecovery::facetAt(const foot& f) const
{
    vector x = vector::Zero();
    for (const member& a : f.fit) x += a.weight * map_[a.image](case_.cloud.x[a.index].xyz());
    const tensor F = gradient(f.fit, case_.cloud.x);
    return {x, -F.determinant() * F.inverse().transpose() * f.S0};
}

// Normal pressure of (5.27)
scalar solidRecovery::outsidePressure(const foot& f, const facet& at) const
{
    vector u = vector::Zero();
    for (const member& a : f.fit) u += a.weight * turn(a.image) * case_.cloud.Up[a.index].xyz();
    const vector pull =
        outside_.stiffness() * (at.centre - ref_.x0[f.particle] - f.e0) + outside_.damping() * u;
    return outside_.pressure(case_.time.value()) -
           f.S0.norm() * pull.dot(at.area) / at.area.squaredNorm();
}

// n.s n + p of what lies before the solid at each foot, NaN where it is not known
List<scalar> solidRecovery::onSurface(const List<tensor>& s) const
{
    const label nZones = label(case_.cloud.zones.size());
    List<facet> facets(feet_.size());
    List<List<facet>> before(nZones);
    for (size_t f = 0; f < feet_.size(); ++f)
    {
        facets[f] = facetAt(feet_[f]);
        if (feet_[f].zone < nZones) before[feet_[f].zone].push_back(facets[f]);
    }
    List<List<fluidAt>> fluid(nZones);
    for (label z = 0; z < nZones; ++z)
    {
        List<char> one(nZones, 0);
        one[z] = 1;
        if (!before[z].empty()) fluid[z] = surfaceFit(case_, one, before[z]).of(before[z]);
    }
    List<size_t> next(nZones, 0);
    List<scalar> q;
    for (size_t f = 0; f < feet_.size(); ++f)
    {
        const label z = feet_[f].zone;
        const fluidAt* wet = z < nZones ? &fluid[z][next[z]++] : nullptr;
        const vector n = facets[f].area.normalized();
        tensor T = tensor::Zero();
        for (const member& a : feet_[f].fit)
            T += a.weight * turn(a.image) * s[a.index] * turn(a.image).transpose();
        const scalar p = !wet ? outsidePressure(feet_[f], facets[f]) : wet->covered ? wet->p : none;
        q.push_back(p + n.dot(T * n));
    }
    return q;
}

// (5.50) about k: weights of the particles and feet that `counts` takes.  Feet have the indices from n() on
template <class Counts>
List<solidRecovery::member> solidRecovery::linearFit(label k, const Counts& counts) const
{
    List<vector> offsets;
    List<label> images;
    List<pointSampler::contribution> weights;
    const auto add = [&](label index, label image, const vector& X, scalar weight) {
        const vector d = (X - ref_.x0[k]) / (reach * ref_.dx);
        if (!(d.norm() < 1) || !counts(index)) return;
        offsets.push_back(d), images.push_back(image);
        weights.push_back({index, weight * (1 - d.squaredNorm())});
    };
    forNear(k, [&](label i, label image, const vector& X) {
        add(i, image, X, 1);
        for (label f = firstFoot_[i]; f < firstFoot_[i + 1]; ++f)
            add(ref_.n() + f, image, X + turn(image) * feet_[f].e0, ofSurface);
    });
    List<member> fit;
    if (weights.empty()) return fit;
    pointSampler::makeLinear(offsets, weights);
    for (size_t a = 0; a < weights.size(); ++a)
        fit.push_back({weights[a].index, images[a], weights[a].weight, vector::Zero()});
    return fit;
}

// q: of all particles, then of all feet
scalar solidRecovery::pressure(label k, const List<scalar>& q) const
{
    scalar sum = 0;
    for (const member& a : linearFit(k, [&](label i) { return !std::isnan(q[i]); }))
        sum += a.weight * q[a.index];
    return sum;
}

}  // namespace ispf
