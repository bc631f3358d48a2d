// SPDX-License-Identifier: GPL-3.0-or-later
#include "couplingScheme.H"

namespace ispf
{

std::unique_ptr<couplingScheme> couplingScheme::New(fsiCase& c)
{
    return c.coupling == "monolithic" ? newMonolithic(c) : newProjection(c);
}

}  // namespace ispf
