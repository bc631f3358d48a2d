// SPDX-License-Identifier: GPL-3.0-or-later
// The list of coupling schemes.  fsiCase.C reads the entry `coupling`
#include "couplingScheme.H"

namespace ispf
{

std::unique_ptr<couplingScheme> newMonolithic(fsiCase& c);
std::unique_ptr<couplingScheme> newProjection(fsiCase& c);
void checkMonolithicEntries(const fsiCase& c);
void checkProjectionEntries(const fsiCase& c);

std::unique_ptr<couplingScheme> couplingScheme::New(fsiCase& c)
{
    // entries of the other scheme may stay, because one word changes the coupling; they are checked as that scheme reads
    // them
    (c.coupling == "monolithic" ? checkProjectionEntries : checkMonolithicEntries)(c);
    return c.coupling == "monolithic" ? newMonolithic(c) : newProjection(c);
}

}  // namespace ispf
