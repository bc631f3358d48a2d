// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluidSources.H"

#include "closedBodies.H"

namespace ispf
{

void zoneSource::addTo(List<scalar>& q, scalar)
{
    if (c_.source.empty()) return;
    for (label i = c_.cloud.nSolid(); i < c_.cloud.n(); ++i) q[i] += c_.source[c_.cloud.zone[i]];
}

void drainedSource::addTo(List<scalar>& q, scalar dt)
{
    if (!feedback_.on() || c_.walls->hasCyclic()) return;
    const List<label> bodyOf = closedBodies(c_.cloud, c_.list);
    feedback_.addTo(q, pair_, drainedFluid(c_.cloud, c_.list, bodyOf), dt);
}

}  // namespace ispf
