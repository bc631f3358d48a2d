// SPDX-License-Identifier: GPL-3.0-or-later
// The coupling schemes that there are; fsiCase.C reads which one
#include "couplingScheme.H"

namespace ispf
{

std::unique_ptr<couplingScheme> newMonolithic(fsiCase& c);
std::unique_ptr<couplingScheme> newProjection(fsiCase& c);

std::unique_ptr<couplingScheme> couplingScheme::New(fsiCase& c)
{
    return c.coupling == "monolithic" ? newMonolithic(c) : newProjection(c);
}

}  // namespace ispf
