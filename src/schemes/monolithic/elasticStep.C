// SPDX-License-Identifier: GPL-3.0-or-later
#include "elasticStep.H"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ispf
{

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

void elasticStep::begin(List<vec4> x0, scalar tau)
{
    x0_ = std::move(x0), tau_ = tau, pass_ = 0, first_ = last_ = 0;
    outside_.clear(), resists_.clear();
    structure_->force(x0_, force_);
    structure_->assembleTangent(x0_, tangentKind::positive, K_);
    if (!structure_->damps()) return;
    structure_->assembleDamping(x0_, D_);
    includeDamping();
}

// D is that of x_0 in all passes
void elasticStep::includeDamping()
{
    if (!structure_->damps()) return;
    forEach(0, label(K_.value.size()), [&](label e) { K_.value[e] += D_.value[e] / tau_; });
    forEach(0, structure_->n(), [&](label i) { K_.diagonal[i] += D_.diagonal[i] / tau_; });
}

scalar elasticStep::dissipated(const List<vec4>& u) const
{
    if (!structure_ || !structure_->damps()) return 0;
    List<vec4> Du(structure_->n());
    D_.apply(u, Du);
    return -tau_ * sumOf(0, structure_->n(),
                         [&](label i) -> scalar { return u[i].xyz().dot(Du[i].xyz()); });
}

void elasticStep::addOutside(const List<vec4>& f, const List<scalar>& D)
{
    outside_ = f, resists_ = D;
    includeOutside();
}

void elasticStep::includeOutside()
{
    if (outside_.empty()) return;
    forEach(0, structure_->n(), [&](label i) {
        force_[i].s += outside_[i].s;
        for (int a = 0; a < structure_->reference().nDims; ++a)
            K_.diagonal[i](a, a) += resists_[i] / tau_;
    });
}

// Moves the iterate to the end of the step, and returns the root of the mean square of d/A over the free solid
scalar elasticStep::residual(const List<scalar>& z, const List<scalar>& A,
                             const particleCloud& cloud)
{
    const label n = structure_->n();
    x_ = x0_, u_.resize(n), Ku_.resize(n);
    for (label i = 0; i < n; ++i)
    {
        u_[i].s = simd4{z[4 * i], z[4 * i + 1], z[4 * i + 2], 0};
        x_[i].s += tau_ * u_[i].s;
    }
    structure_->force(x_, f_);
    K_.apply(u_, Ku_);
    List<vec4> Du;
    if (structure_->damps()) Du.resize(n), D_.apply(u_, Du);
    scalar sum = 0;
    label nFree = 0;
    for (label i = 0; i < n; ++i)
    {
        if (cloud.uFixed[i]) continue;
        simd4 d = f_[i].s - force_[i].s + tau_ * Ku_[i].s;
        if (!outside_.empty()) d += outside_[i].s - resists_[i] * u_[i].s;
        if (!Du.empty()) d -= Du[i].s;
        sum += vec4{d}.xyz().squaredNorm() / (A[i] * A[i]), ++nFree;
    }
    return std::sqrt(sum / std::max<label>(nFree, 1));
}

bool elasticStep::again(const List<scalar>& z, const List<scalar>& A, const particleCloud& cloud,
                        scalar least)
{
    last_ = residual(z, A, cloud);
    if (++pass_ == 1) first_ = last_;
    scalar speed = 0;
    for (size_t k = 0; k < z.size(); k += 4)
        speed = std::max(speed, vector(z[k], z[k + 1], z[k + 2]).norm());
    const scalar limit = std::max(entries_.tolerance * speed, least);
    info() << "Newton: pass " << pass_ << ", residual " << str(last_, 3) << " m/s of "
           << str(limit, 3) << "\n";
    if (last_ <= limit || pass_ == entries_.maxIter) return false;
    structure_->assembleTangent(x_, tangentKind::full, K_);
    K_.apply(u_, Ku_);
    forEach(0, structure_->n(), [&](label i) { force_[i].s = f_[i].s + tau_ * Ku_[i].s; });
    includeOutside(), includeDamping();
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
