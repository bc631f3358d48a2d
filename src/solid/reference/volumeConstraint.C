// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumeConstraint.H"
#include "forPairs.H"

namespace ispf
{

tensor cofactorOf(const tensor& F)
{
    return F.determinant() * F.inverse().transpose();
}

volumeConstraint::volumeConstraint(const structureModel& s)
    : gradient_(s.gradient()), ref_(s.reference()), acts_(s.n())
{
    forEach(0, s.n(), [&](label i) {
        bool acts = !ref_.fixed[i];
        forNeighbours<among::all>(gradient_.neighbours(), i,
                                  [&](pairIndex, label j) { acts = acts || !ref_.fixed[j]; });
        acts_[i] = acts && !gradient_.follows(i);
    });
}

void volumeConstraint::setup(const List<tensor>& F)
{
    F_ = F;
    cofactor_.resize(F.size());
    parallelFor(
        label(F.size()),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i) cofactor_[i] = cofactorOf(F[i]);
        },
        256);
}

void volumeConstraint::moveRest(const List<tensor>& toRest)
{
    toRest_ = toRest, restCofactor_.clear();
    for (const tensor& H : toRest) restCofactor_.push_back(cofactorOf(H));
}

void volumeConstraint::rate(const List<vec4>& u, List<scalar>& dJ, List<tensor>& dF) const
{
    const bool moves = !toRest_.empty();
    List<vec4> w(toRest_.size());
    forEach(0, label(w.size()), [&](label i) { w[i] = vec4::from(toRest_[i] * u[i].xyz()); });
    gradient_.applyLinear(moves ? w : u, dF);
    dJ.resize(dF.size());
    const List<tensor>& cofactor = moves ? restCofactor_ : cofactor_;
    forEach(0, label(dF.size()), [&](label i) { dJ[i] = cofactor[i].cwiseProduct(dF[i]).sum(); });
}

// D u_i = sum_j g_ij.(u_j - u_i) with g_ij = w_ij cof F_i B_i R_ij: p_i acts on j with the force V g_ij
void volumeConstraint::diagonal(const List<scalar>& tau, List<scalar>& DG) const
{
    DG.resize(acts_.size());
    forEach(0, label(acts_.size()), [&](label i) {
        const tensor A = cofactor_[i] * gradient_.inverseMoment(i);
        vector own = vector::Zero();
        scalar sum = 0;
        forNeighbours<among::all>(gradient_.neighbours(), i, [&](pairIndex k, label j) {
            const vector g =
                gradient_.weight(k) * (A * gradient_.neighbours().separation(ref_, i, k));
            own += g;
            if (!ref_.fixed[j]) sum += tau[j] * g.squaredNorm();
        });
        DG[i] = sum + (ref_.fixed[i] ? 0 : tau[i] * own.squaredNorm());
    });
}

// F is linear in time and its cofactor at most quadratic: Simpson's rule is exact
tensor meanCofactor(const tensor& F, const tensor& change)
{
    return (cofactorOf(F) + 4 * cofactorOf(F + 0.5 * change) + cofactorOf(F + change)) / 6;
}

void volumeConstraint::overStep(const List<vec4>& u, scalar dt, List<scalar>& missed) const
{
    gradient_.applyLinear(u, work_);
    missed.resize(work_.size());
    parallelFor(
        label(work_.size()),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                const tensor change = dt * work_[i];
                missed[i] = (meanCofactor(F_[i], change) - cofactor_[i]).cwiseProduct(change).sum();
            }
        },
        256);
}

void volumeConstraint::addStress(const List<vec4>& up, List<tensor>& P) const
{
    forEach(0, label(cofactor_.size()), [&](label i) { P[i] -= up[i][3] * cofactor_[i]; });
}

}  // namespace ispf
