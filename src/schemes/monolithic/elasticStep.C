// SPDX-License-Identifier: GPL-3.0-or-later
#include "elasticStep.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

namespace ispf
{

namespace
{

// Most passes of a step in which solids meet: pairs begin and end to act in it
constexpr label contactPasses = 8;

}  // namespace

elasticStep::entries::entries(const dictionary& dict)
    : maxIter(dict.getInRangeOrDefault<label>("maxIter", 1, 100, 1)),
      tolerance(dict.getInRangeOrDefault("tolerance", 1e-12, 0.1, 1e-5))
{
}

elasticStep::elasticStep(const structureModel* structure, const entries& e)
    : structure_(structure), entries_(e)
{
    if (!structure) return;
    K_ = structure->tangentPattern();
    if (structure->damps()) D_ = structure->tangentPattern();
}

label elasticStep::mostPasses() const
{
    return contact_ ? std::max(entries_.maxIter, contactPasses) : entries_.maxIter;
}

void elasticStep::begin(List<vec4> x0, scalar tau, const List<scalar>& p, const List<vec4>& xp)
{
    x0_ = std::move(x0), tau_ = tau, pass_ = 0, first_ = last_ = 0;
    outside_.clear(), resists_ = nullptr, contact_ = nullptr;
    structure_->force(x0_, force_);
    structure_->assembleTangent(x0_, tangentKind::positive, p, K_);
    stiffness_.resize(structure_->n());
    forEach(0, structure_->n(), [&](label i) {
        stiffness_[i] = K_.diagonal[i].trace() / structure_->reference().nDims;
    });
    if (structure_->damps()) structure_->assembleDamping(x0_, D_);
    ahead_.clear();
    if (newton() || !xp.empty()) keepTurning(p);
    if (!xp.empty()) bringBack(xp);
    if (structure_->damps())
    {
        K_.addScaled(1 / tau_, D_);
        if (newton()) R_.addScaled(1 / tau_, D_);
    }
    start_ = force_;
}

// K_p of (7.17) and (7.25), which is that of x_0 in all passes
void elasticStep::keepTurning(const List<scalar>& p)
{
    blockMatrix3 without = structure_->tangentPattern();
    R_ = structure_->tangentPattern();
    structure_->assembleTangent(x0_, tangentKind::full, p, R_);
    structure_->assembleTangent(x0_, tangentKind::full, without);
    R_.addScaled(-1, without);
}

// (7.25): K_p leads from x_p, where the force of the pressure is taken, to the end of the step
void elasticStep::bringBack(const List<vec4>& xp)
{
    const label n = structure_->n();
    List<vec4> way(n);
    forEach(0, n, [&](label i) { way[i] = vec4::from(xp[i].xyz() - x0_[i].xyz()); });
    ahead_.resize(n);
    R_.apply(way, ahead_);
    forEach(0, n, [&](label i) { force_[i].s += ahead_[i].s; });
}

scalar elasticStep::dissipated(const List<vec4>& u) const
{
    if (!structure_ || !structure_->damps()) return 0;
    List<vec4> Du(structure_->n());
    D_.apply(u, Du);
    return -tau_ * sumOf(0, structure_->n(),
                         [&](label i) -> scalar { return u[i].xyz().dot(Du[i].xyz()); });
}

void elasticStep::addOutside(const List<vec4>& f, const blockMatrix3* D)
{
    outside_ = f, resists_ = D;
    forEach(0, structure_->n(), [&](label i) { force_[i].s += outside_[i].s; });
    includeOutside();
    start_ = force_;
}

void elasticStep::includeOutside()
{
    if (!resists_) return;
    blockMatrix3 D = resists_->withZeros();
    D.addScaled(1 / tau_, *resists_);
    withOutside_ = K_.plus(D);
}

void elasticStep::moveRest(const List<tensor>& toRest)
{
    structure_->assembleTangent(x0_, tangentKind::rest, K_);
    K_.scaleColumns(toRest);
    includeOutside();
}

void elasticStep::addContact(const solidContact& contact, const List<vec4>& u)
{
    contact_ = &contact;
    move(u);
    contact.addTangent(x_, withoutContact(), withContact_);
    f_.assign(x_.size(), vec4{});
    contact.addForce(x_, f_);
    List<vec4> Ku(x_.size());
    withContact_.apply(u_, Ku_), withoutContact().apply(u_, Ku);
    forEach(0, structure_->n(),
            [&](label i) { force_[i].s += f_[i].s + tau_ * (Ku_[i].s - Ku[i].s); });
}

// To the places where u leads
void elasticStep::move(const List<vec4>& u)
{
    const label n = structure_->n();
    x_ = x0_, u_.assign(u.begin(), u.begin() + n), Ku_.resize(n);
    forEach(0, n, [&](label i) { u_[i][3] = 0, x_[i].s += tau_ * u_[i].s; });
}

// Takes the iterate to the end of the step, and its forces
void elasticStep::iterate(const List<scalar>& z)
{
    const label n = structure_->n();
    List<vec4> u(n), Ru(n);
    forEach(0, n, [&](label i) { u[i].s = simd4{z[4 * i], z[4 * i + 1], z[4 * i + 2], 0}; });
    move(u);
    if (newton())
    {
        structure_->force(x_, f_);
        R_.apply(u_, Ru);
        forEach(0, n, [&](label i) { f_[i].s -= tau_ * Ru[i].s; });
        for (const List<vec4>* constant : {&outside_, &ahead_})
            if (!constant->empty()) forEach(0, n, [&](label i) { f_[i].s += (*constant)[i].s; });
        if (resists_)
        {
            resists_->apply(u_, Ru);
            forEach(0, n, [&](label i) { f_[i].s -= Ru[i].s; });
        }
    }
    else
    {
        f_ = start_;
        withoutContact().apply(u_, Ru);
        forEach(0, n, [&](label i) { f_[i].s -= tau_ * Ru[i].s; });
    }
    if (contact_) contact_->addForce(x_, f_);
}

// K at the iterate
void elasticStep::setTangent()
{
    if (newton())
    {
        structure_->assembleTangent(x_, tangentKind::full, K_);
        K_.addScaled(1, R_);
        includeOutside();
    }
    if (contact_) contact_->addTangent(x_, withoutContact(), withContact_);
}

// Root of the mean square of d/A over the free solid
scalar elasticStep::residual(const List<scalar>& A, const particleCloud& cloud)
{
    tangent().apply(u_, Ku_);
    const auto [sum, n] = sumsOf(0, structure_->n(), [&](label i) -> std::array<scalar, 2> {
        if (cloud.uFixed[i]) return {};
        const vec4 d{f_[i].s - force_[i].s + tau_ * Ku_[i].s};
        return {d.xyz().squaredNorm() / (A[i] * A[i]), 1};
    });
    return std::sqrt(sum / std::max<scalar>(n, 1));
}

bool elasticStep::again(const List<scalar>& z, const List<scalar>& A, const particleCloud& cloud,
                        scalar least)
{
    iterate(z);
    last_ = residual(A, cloud);
    if (++pass_ == 1) first_ = last_;
    const scalar speed = largestOf(0, label(z.size() / 4), [&](label i) {
        return vector(z[4 * i], z[4 * i + 1], z[4 * i + 2]).norm();
    });
    const scalar limit = std::max(entries_.tolerance * speed, least);
    info() << "Newton: pass " << pass_ << ", residual " << str(last_, 3) << " m/s of "
           << str(limit, 3) << "\n";
    if (last_ <= limit || pass_ == mostPasses()) return false;
    setTangent();
    tangent().apply(u_, Ku_);
    forEach(0, structure_->n(), [&](label i) { force_[i].s = f_[i].s + tau_ * Ku_[i].s; });
    return true;
}

word elasticStep::failure() const
{
    if (!(last_ > first_) && std::isfinite(last_)) return "";
    return "Newton's method for the solid does not converge (residual " + str(first_, 3) +
           " m/s after the first pass, " + str(last_, 3) + " after pass " + std::to_string(pass_) +
           ")";
}

}  // namespace ispf
