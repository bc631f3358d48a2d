// SPDX-License-Identifier: GPL-3.0-or-later
// The coupling schemes that there are; fsiCase.C reads which one
#include "couplingScheme.H"

namespace ispf
{

std::unique_ptr<couplingScheme> newMonolithic(fsiCase& c);
std::unique_ptr<couplingScheme> newProjection(fsiCase& c);
void checkMonolithicEntries(const fsiCase& c);
void checkProjectionEntries(const fsiCase& c);

std::unique_ptr<couplingScheme> couplingScheme::New(fsiCase& c)
{
    // what the other scheme reads may stay, as one word changes the coupling, but must be what it would read
    (c.coupling == "monolithic" ? checkProjectionEntries : checkMonolithicEntries)(c);
    return c.coupling == "monolithic" ? newMonolithic(c) : newProjection(c);
}

}  // namespace ispf
