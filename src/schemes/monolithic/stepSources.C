// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepSources.H"

#include "sphc.H"
#include "volumeLedger.H"

#include <algorithm>

namespace ispf
{

namespace
{

// Field of the particles: error of J that the rate of J has left in the last step
const word missedField = "missedJ";

// Returns the time for which the solid moves after its place in the equations.  It is 0 if forces are taken at x_b
scalar wayOf(const timeScheme& time, scalar dt)
{
    return time.midway() ? 0 : dt;
}

}  // namespace

scalar solidFeedback::rate(label i, scalar dt) const
{
    const auto steady = cloud_.scalars.find(steadyVolume);
    const scalar aim = steady == cloud_.scalars.end() ? 1 : steady->second[i];
    return -alpha_ * (F_[i].determinant() - aim) / dt;
}

void solidFeedback::addTo(List<scalar>& q, scalar dt)
{
    forEach(0, cloud_.nSolid(), [&](label i) { q[i] += rate(i, dt); });
}

void solidFeedback::book(scalar dt)
{
    const scalar sum = sumOf(0, cloud_.nSolid(), [&](label i) { return rate(i, dt); });
    cloud_.state.add(entries::solidFeedback, sum * cloud_.volume() * dt);
}

solidDefect::solidDefect(particleCloud& cloud, const volumeConstraint& volume,
                         const timeScheme& time, const List<scalar>& left, bool makesGood)
    : cloud_(cloud), volume_(volume), time_(time), left_(left), makesGood_(makesGood)
{
    cloud.scalars[missedField].resize(cloud.n(), 0);
}

scalar solidDefect::rate(label i, scalar dt) const
{
    return makesGood_ ? -cloud_.scalars.at(missedField)[i] / dt : 0;
}

void solidDefect::addTo(List<scalar>& q, scalar dt)
{
    forEach(0, cloud_.nSolid(), [&](label i) { q[i] += rate(i, dt); });
    ahead_.clear();
    if (!time_.wellStarts()) return;
    volume_.overStep(cloud_.Up, dt, ahead_);
    forEach(0, cloud_.nSolid(), [&](label i) { q[i] -= ahead_[i] / dt; });
}

void solidDefect::book(scalar dt)
{
    const scalar sum = sumOf(0, cloud_.nSolid(), [&](label i) { return rate(i, dt); });
    cloud_.state.add(entries::solidDefect, sum * cloud_.volume() * dt);
    List<scalar> missed;
    volume_.overStep(cloud_.Up, wayOf(time_, dt), missed);
    List<scalar>& field = cloud_.scalars.at(missedField);
    forEach(0, cloud_.nSolid(), [&](label i) {
        field[i] = missed[i] - (ahead_.empty() ? 0 : ahead_[i]) + dt * left_[i];
    });
}

void firstWaySource::addTo(List<scalar>& q, scalar dt)
{
    if (!time_.wellStarts()) return;
    particleCloud& cloud = c_.cloud;
    cloud.fillGhosts(cloud.Up, false);
    const List<scalar> loses = sphc::gradSquaredTrace({cloud, c_.list, c_.correction}, cloud.Up);
    forEach(cloud.nSolid(), cloud.n(), [&](label i) {
        if (!cloud.beyondOpen(i)) q[i] += dt * loses[i];
    });
}

void enclosedDefect::book(scalar dt)
{
    List<scalar> dJ;
    List<tensor> dF;
    if (volume_) volume_->rate(cloud_.Up, dJ, dF);
    enclosed_.account(cloud_, dt, dF, wayOf(time_, dt));
}

}  // namespace ispf
