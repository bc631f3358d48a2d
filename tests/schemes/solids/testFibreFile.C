// SPDX-License-Identifier: GPL-3.0-or-later
// Fibres of a case from a file in its folder, for a material and for springs (theory 5.10, 5.11)
#include "caseOnDisk.H"
#include "core/errorOf.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3;

word structureOf(const word& name, const word& entries)
{
    caseOnDisk files(name);
    files.fill(8, 8, dx);
    files.particles().attributes["zones"] = "solid";
    files.particles().attributes["phases"] = "solid";
    files.boundary = "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }";
    files.solution = "coupling monolithic;";
    files.write();
    setContent(files.path() + "/constant/structureProperties", entries);
    setContent(files.path() + "/constant/fibres.csv",
               "x [mm],y [mm],z [mm],fx,fy,fz\n2,2,0,1,0.5,0\n6,6,0,-1,-0.5,0\n");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    return c.structure->description();
}

}  // namespace

TEST_CASE("a case reads fibres at points from a file in its folder")
{
    const word fibres =
        "fibres { type points; files (\"constant/fibres.csv\"); farthest 6 [mm]; } ";
    CHECK(structureOf("fibreFile",
                      "structureModel totalLagrangian; material { type "
                      "HolzapfelGasserOgden; G 1; k1 1; k2 1; " +
                          fibres + "}")
              .find("1 families of fibres") != word::npos);
    CHECK(structureOf("fibreFile",
                      "structureModel springNetwork; links radius; radius 2.1; E 1; "
                      "fibreWeight 2; " +
                          fibres)
              .find("links up to 2.") != word::npos);
    const word lost =
        "structureModel springNetwork; links radius; radius 2.1; E 1; fibreWeight 2; "
        "fibres { type points; files (\"fibres.csv\"); farthest 5 [mm]; }";
    CHECK_ERROR(structureOf("fibreFile", lost), "There is no file", 1);
}
