// SPDX-License-Identifier: GPL-3.0-or-later
// Volume enclosed by a surface that moves with the solid, closed over its openings by caps; of the whole
// body [m3; m2 in two dimensions].  surface: constant/triSurface/<surface>.stl, see
// trackedSurface.H.
//
//     cavity { type cavityVolume; surface wall_to_chamber; }
//
// changeOverRest is NaN if the surface is flat at rest.
#include "functionObject.H"

#include "dataFile.H"
#include "trackedSurface.H"
#include <cmath>

namespace ispf
{

namespace
{

class cavityVolume : public functionObject
{
public:
    cavityVolume(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          surface_(dict.get<word>("surface"), c, dict.where("surface")),
          rest_(surface_.restVolume()),
          file_(table("cavityVolume.dat",
                      ofWhole({"Volume inside " + surface_.name() +
                                   (c.cloud.nDims == 3 ? " [m3]" : " [m2]"),
                               "at rest: " + str(rest_, 9)}),
                      {"volume", "change", "changeOverRest"}, 9))
    {
    }

    void write() override
    {
        surface_.update(case_.cloud.x);
        const scalar volume = surface_.enclosedVolume();
        // a flat surface encloses hardly any volume at rest to compare with
        const bool flat = std::abs(rest_) < 1e-6 * case_.cloud.volume();
        file_.begin(case_.time.value())
            << volume << volume - rest_ << (flat ? std::nan("") : (volume - rest_) / rest_);
        file_.endRow();
    }

private:
    trackedSurface surface_;
    scalar rest_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newCavityVolume(const word& name, const dictionary& dict,
                                                const fsiCase& c)
{
    return std::make_unique<cavityVolume>(name, dict, c);
}

}  // namespace ispf
