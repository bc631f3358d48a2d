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

drainedSource::drainedSource(fsiCase& c, const adjointPair& pair)
    : c_(c), pair_(pair), feedback_(c.solution, c.cloud)
{
    if (feedback_.on() && (c.walls->openFaces().empty() || c.walls->hasCyclic()))
        c.solution.fail(
            "densityFeedback",
            word("It keeps the number of particles before open faces, and the case has ") +
                (c.walls->hasCyclic() ? "cyclic patches, with which it has no effect"
                                      : "none: it has no effect") +
                ". Leave it away");
}

void drainedSource::addTo(List<scalar>& q, scalar dt)
{
    if (!feedback_.on() || c_.walls->hasCyclic()) return;
    const List<label> bodyOf = closedBodies(c_.cloud, c_.list);
    feedback_.addTo(q, pair_, drainedFluid(c_.cloud, c_.list, bodyOf), dt);
}

}  // namespace ispf
