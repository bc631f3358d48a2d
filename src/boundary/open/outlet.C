// SPDX-License-Identifier: GPL-3.0-or-later
#include "outlet.H"

#include <cmath>

namespace ispf
{

namespace
{

// Largest difference between the step's flow and that of (4.11), over |Q| plus the small flow
constexpr scalar exactness = 1e-4;

}  // namespace

// kept: Q of the last step, the number of values of the kind's state, these values, and dQ/dp.  An outlet of another kind takes
// Q alone
scalar outletPressure::begin(const outlet::step& s, const List<scalar>& kept)
{
    step_ = s;
    if (again_) return p_;  // agree() has found it
    tried_ = 0;
    flow_ = 0;
    const size_t own = kind_->state().size();
    if (!kept.empty()) flow_ = kept[0];
    if (kept.size() >= 2 + own && kept[1] == scalar(own))
    {
        const auto state = kept.begin() + 2, rest = state + own;
        kind_->restore(List<scalar>(state, rest));
        Y_.assign(rest, kept.end());
    }
    return p_ = kind_->pressure(s, flow_);
}

// Broyden's rule: the least change of dQ/dp with which it explains the last change of Q.  `own` is the place of this outlet
void outletPressure::learn(const List<solved>& all, size_t own)
{
    if (Y_.size() != all.size()) Y_.assign(all.size(), 0), Y_[own] = all[own].Y0;
    if (tried_ == 0) return;
    scalar unexplained = all[own].Q - lastQ_, way = 0;
    for (size_t k = 0; k < all.size(); ++k)
    {
        const scalar dp = all[k].of->p_ - all[k].of->lastP_;
        unexplained -= Y_[k] * dp, way += dp * dp;
    }
    for (size_t k = 0; way > 0 && k < all.size(); ++k)
        Y_[k] += unexplained * (all[k].of->p_ - all[k].of->lastP_) / way;
    Y_[own] = std::min(Y_[own], scalar(0));
}

bool outletPressure::agree(List<solved> all)
{
    std::erase_if(all, [](const solved& s) { return s.of->slope() == 0; });
    const label n = label(all.size());
    Eigen::MatrixXd Y(n, n), A(n, n);
    Eigen::VectorXd lacks(n);
    for (label i = 0; i < n; ++i)
    {
        outletPressure& o = *all[i].of;
        o.learn(all, size_t(i));
        Y.row(i) = Eigen::Map<const Eigen::RowVectorXd>(o.Y_.data(), n);
        A.row(i) = -o.slope() * Y.row(i), A(i, i) += 1;
        lacks[i] = o.kind_->pressure(o.step_, all[i].Q) - o.p_;
    }
    const Eigen::VectorXd change = A.partialPivLu().solve(lacks), dQ = Y * change;
    bool again = false;
    for (label i = 0; i < n; ++i)
    {
        // also of the flow that has the pressure, in place of the one that it causes: a Y near 0 says nothing of p
        const scalar off = std::max(std::abs(dQ[i]), std::abs(change[i]) / all[i].of->slope());
        again = again || off > exactness * (std::abs(all[i].Q) + all[i].Q0);
    }
    for (label i = 0; i < n; ++i)
    {
        outletPressure& o = *all[i].of;
        o.again_ = again;
        if (again) o.lastP_ = o.p_, o.lastQ_ = all[i].Q, o.p_ += change[i], ++o.tried_;
    }
    return !again;
}

List<scalar> outletPressure::accept(const outlet::step& s, scalar Q)
{
    again_ = false;
    kind_->accept({s.start, s.end, step_.inertia}, Q);
    const List<scalar> state = kind_->state();
    List<scalar> kept = {Q};
    if (state.empty() && Y_.empty()) return kept;
    kept.push_back(scalar(state.size()));
    kept.insert(kept.end(), state.begin(), state.end());
    kept.insert(kept.end(), Y_.begin(), Y_.end());
    return kept;
}

}  // namespace ispf
