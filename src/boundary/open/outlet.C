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

// kept: Q and dQ/dp of the last step, then the state of the kind
scalar outletPressure::begin(const outlet::step& s, const List<scalar>& kept)
{
    step_ = s;
    if (again_) return p_;  // agrees() has found it
    tried_ = 0;
    scalar Q = 0;
    if (kept.size() == 2 + kind_->state().size())
        Q = kept[0], Y_ = kept[1], kind_->restore(List<scalar>(kept.begin() + 2, kept.end()));
    return p_ = kind_->pressure(s, Q);
}

bool outletPressure::agrees(scalar Q, const scales& s)
{
    const scalar slope = kind_->slope(step_);
    if (slope == 0) return true;
    if (tried_ > 0 && p_ != lastP_) Y_ = std::min((Q - lastQ_) / (p_ - lastP_), scalar(0));
    else if (Y_ == 0) Y_ = s.Y0;
    const scalar lacks = kind_->pressure(step_, Q) - p_, change = lacks / (1 - slope * Y_);
    again_ = std::abs(Y_ * change) > exactness * (std::abs(Q) + s.Q0);
    if (!again_) return true;
    lastP_ = p_, lastQ_ = Q, p_ += change, ++tried_;
    return false;
}

List<scalar> outletPressure::accept(const outlet::step& s, scalar Q)
{
    again_ = false;
    kind_->accept(s, Q);
    List<scalar> kept = {Q, Y_};
    for (const scalar s : kind_->state()) kept.push_back(s);
    return kept;
}

}  // namespace ispf
