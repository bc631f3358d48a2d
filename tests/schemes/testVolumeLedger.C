// SPDX-License-Identifier: GPL-3.0-or-later
// The volume that feedback adds to a solid is booked in every step, and also after a restart
#include "caseOnDisk.H"
#include "relative.H"
#include "volumeLedger.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 0.01, swollen = 1.01, alpha = 0.1, dt = 0.01;
constexpr int n = 10;

// Half of a block, swollen by 1 % in each direction, at the symmetry plane x = 0
void writeSwollen(caseOnDisk& files)
{
    files.fill(n, n, dx);
    particleTable& t = files.particles();
    t.attributes["zones"] = "wall", t.attributes["phases"] = "solid";
    t.vectors["x0"] = t.x;
    for (vector& x : t.x) x.head<2>() *= swollen;
    files.boundary = "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }";
    files.solution = "coupling monolithic; monolithic { volumeFeedback " + str(alpha) + "; }";
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel springNetwork; E 1e3; links radius; radius 2.1;");
}

}  // namespace

TEST_CASE("the ledger books what the wall's feedback takes out, of the whole body")
{
    caseOnDisk files("volumeLedger");
    writeSwollen(files);
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    const volumeLedger ledger(c);
    CHECK(ledger.wallFeedback() == 0);
    const scalar excess = ledger.wallVolume() - 2 * n * n * dx * dx;
    CHECK(excess == relative(2 * n * n * dx * dx * (swollen * swollen - 1), 1e-9));
    runSteps(c, *scheme, dt, 1);
    CHECK(ledger.wallFeedback() == relative(-alpha * excess, 1e-9));
    // a change that is measured later is booked later, also after a restart
    const scalar before = ledger.wallFeedback(), left = ledger.wallVolume() - 2 * n * n * dx * dx;
    c.write();
    setContent(files.path() + "/system/controlDict",
               "startFrom latestTime; startTime 0; endTime 1; deltaT 0.01; writeControl timeStep; "
               "writeInterval 1e6;");
    Time later(files.path());
    fsiCase again(later);
    const auto sameScheme = couplingScheme::New(again);
    const volumeLedger ledgerAgain(again);
    CHECK(ledgerAgain.wallFeedback() == relative(before, 1e-12));
    runSteps(again, *sameScheme, dt, 1);
    CHECK(ledgerAgain.wallFeedback() - before == relative(-alpha * left, 1e-9));
}
