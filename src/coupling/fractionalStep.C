// SPDX-License-Identifier: GPL-3.0-or-later
#include "fractionalStep.H"
#include "adjointStep.H"
#include "projectionStep.H"
#include "timeScheme.H"

namespace ispf
{

std::unique_ptr<fractionalStep> fractionalStep::New(const fsiCase& c, const word& viscosity)
{
    if (c.cloud.wallsApart)
        return std::make_unique<adjointStep>(c.rho, c.mu, viscosity, c.solution,
                                             timeScheme(c).secondOrder());
    return std::make_unique<projectionStep>(c.rho, c.mu, viscosity,
                                            operatorSchemes::fromDict(c.schemes), c.solution);
}

}  // namespace ispf
