// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidBlock.H"

#include <algorithm>

namespace ispf
{

solidBlock::entries::entries(const dictionary& dict)
    : solver(dict.chooseOrDefault("solver", {"direct", "multigrid"}, "direct")),
      refactorInterval(dict.getInRangeOrDefault<label>("refactorInterval", 1, 1e6, 10))
{
    multigrid.cycle = "V", multigrid.omega = 0.9;
    multigrid.read(dict.subOrEmptyDict("multigrid"));
}

solidBlock::solidBlock(const entries& e)
    : solver_(e.solver), refactorInterval_(e.refactorInterval), options_(e.multigrid)
{
}

void solidBlock::assemble(const blockMatrix3& K, scalar dt, const List<scalar>& A,
                          const particleCloud& cloud)
{
    As_ = K;
    for (label i = 0; i < K.size(); ++i)
    {
        // inertia and viscosity: A_ii without the tangent
        const scalar rest = A[i] - dt * K.diagonal[i].trace() / cloud.nDims;
        As_.diagonal[i] = dt * K.diagonal[i] + rest * tensor::Identity();
        if (cloud.uFixed[i]) As_.diagonal[i] = A[i] * tensor::Identity();
        for (label k = K.rowStart[i]; k < K.rowStart[i + 1]; ++k)
            As_.value[k] = cloud.uFixed[i] || cloud.uFixed[K.column[k]] ? tensor(tensor::Zero())
                                                                        : tensor(dt * K.value[k]);
    }
}

void solidBlock::setup(const blockMatrix3& K, scalar dt, const List<scalar>& A,
                       const particleCloud& cloud, const List<vec4>& at, scalar cellSize)
{
    assemble(K, dt, A, cloud);
    if (solver_ == "direct")
    {
        if (age_ == 0)
        {
            direct_.factorise(As_);
            made_ = {dt};
            for (label i = 0; i < K.size(); ++i)
                made_.insert(made_.end(), {at[i][0], at[i][1], at[i][2], A[i]});
        }
        age_ = (age_ + 1) % refactorInterval_;
        return;
    }
    scalarBlock_ = As_.thirdOfTrace();
    for (scalar& v : scalarBlock_.value) v = std::min(v, 0.0);
    List<vector> x(K.size());
    for (label i = 0; i < K.size(); ++i) x[i] = cloud.x[i].xyz();
    options_.cellSize = cellSize;
    if (multigrid_) multigrid_->rebuild(scalarBlock_, x);
    else multigrid_ = std::make_unique<cellMultigrid>(scalarBlock_, x, options_);
}

List<scalar> solidBlock::state() const
{
    if (solver_ != "direct" || age_ == 0) return {};
    List<scalar> s = {scalar(age_)};
    s.insert(s.end(), made_.begin(), made_.end());
    return s;
}

void solidBlock::restore(const List<scalar>& state, const structureModel& structure,
                         const particleCloud& cloud, blockMatrix3& K)
{
    const label n = K.size();
    if (solver_ != "direct" || label(state.size()) != 2 + 4 * n || state[0] >= refactorInterval_)
        return;
    List<vec4> x(n);
    List<scalar> A(n);
    for (label i = 0; i < n; ++i)
    {
        const scalar* at = &state[2 + 4 * i];
        x[i].s = simd4{at[0], at[1], at[2], 0}, A[i] = at[3];
    }
    structure.assembleTangent(x, tangentKind::positive, K);
    assemble(K, state[1], A, cloud);
    direct_.factorise(As_);
    age_ = label(state[0]), made_.assign(state.begin() + 1, state.end());
}

void solidBlock::solve(const List<scalar>& A, const particleCloud& cloud, List<vec4>& u) const
{
    const label n = As_.size();
    r_.resize(n), z_.resize(n);
    for (label i = 0; i < n; ++i)
    {
        r_[i].s = A[i] * u[i].s;
        if (cloud.uFixed[i]) r_[i] = vec4{};
        r_[i][3] = 0;
    }
    if (multigrid_) multigrid_->applyBlock3(r_, z_);
    else direct_.apply(r_, z_);
    for (label i = 0; i < n; ++i)
        if (!cloud.uFixed[i]) u[i].s = simd4{z_[i][0], z_[i][1], z_[i][2], 0};
}

}  // namespace ispf
