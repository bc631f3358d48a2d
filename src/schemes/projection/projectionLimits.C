// SPDX-License-Identifier: GPL-3.0-or-later
#include "projectionLimits.H"

#include <array>
#include <cmath>
#include <limits>

namespace ispf
{

namespace entries
{

// Stable step of the network [s], and the time index of its last renewal
const stateEntry<std::array<scalar, 2>> stableStep{"stableStep"};

}  // namespace entries

namespace
{

constexpr scalar none = std::numeric_limits<scalar>::infinity();
constexpr label stepsBetweenUpdates = 50;

scalar longest(const List<vec4>& v, label n)
{
    const scalar most = maxOf(n, [&](label begin, label end) {
        scalar m = 0;
        for (label i = begin; i < end; ++i) m = std::max(m, v[i].xyz().squaredNorm());
        return m;
    });
    return std::sqrt(std::max(most, 0.0));
}

}  // namespace

projectionLimits::projectionLimits(const fsiCase& c, bool explicitViscosity, bool meanUpdate,
                                   const dictionary& dict)
    : c_(c),
      explicit_(explicitViscosity),
      mean_(meanUpdate),
      CFL_(dict.getInRangeOrDefault("CFL", 1e-6, 1, 0.4)),
      force_(dict.getInRangeOrDefault("force", 1e-6, 1, 0.25)),
      viscousFactor_(dict.getInRangeOrDefault("viscous", 1e-6, 1, 0.125))
{
    if (const auto kept = c.cloud.state.find(entries::stableStep))
        stableStep_ = (*kept)[0], lastUpdate_ = (*kept)[1];
}

void projectionLimits::keep(particleCloud& cloud) const
{
    if (std::isfinite(stableStep_))
        cloud.state.set(entries::stableStep, {stableStep_, lastUpdate_});
}

scalar projectionLimits::viscous() const
{
    const scalar h = c_.kernel->h();
    return explicit_ && c_.mu > 0 ? viscousFactor_ * h * h / c_.largestNu() : none;
}

scalar projectionLimits::stiffness() const
{
    if (!c_.structure) return none;
    const label now = c_.time.timeIndex();
    if (stableStep_ < 0 || now >= lastUpdate_ + stepsBetweenUpdates)
    {
        stableStep_ = c_.structure->stableTimeStep(c_.cloud.x, c_.rho * c_.cloud.volume());
        lastUpdate_ = now;
    }
    return mean_ ? std::min(stableStep_, 2 * c_.mu / (3 * c_.structure->shearModulus()))
                 : stableStep_;
}

couplingScheme::stepLimit projectionLimits::ruling(const List<vec4>& acceleration) const
{
    const scalar h = c_.kernel->h();
    const scalar u = std::max(longest(c_.cloud.Up, c_.cloud.n()), c_.walls->maxGivenSpeed());
    const scalar f = longest(acceleration, c_.cloud.n());
    couplingScheme::stepLimit limit{none, "none"};
    const auto atMost = [&](scalar dt, const char* rule) {
        if (dt < limit.dt) limit = {dt, rule};
    };
    if (u > 0) atMost(CFL_ * h / u, "CFL");
    if (f > 0) atMost(force_ * std::sqrt(h / f), "force");
    atMost(viscous(), "explicit viscosity");
    atMost(stiffness(), mean_ ? "stiffness (positionUpdate mean)" : "stiffness");
    return limit;
}

}  // namespace ispf
