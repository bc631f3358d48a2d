// SPDX-License-Identifier: GPL-3.0-or-later
// Inner or outer diameter of a surface that moves with the solid, where a plane fixed in space
// cuts it: mean, smallest and largest value over the angle, and the change of the mean over its value at rest.
//
//     midDiameter { type zoneDiameter; surface wall_to_chamber; point (0 0 10e-3); axis (0 0 1);
//                   band 1e-3; nAngles 360; }
//
// With a band the radii are the mean of five planes over it.  Symmetry planes that contain the
// axis complete the section: the diameter is that of the whole body.  An angle without an opposite side does not count.
#include "functionObject.H"

#include "dataFile.H"
#include "surfaceSection.H"
#include "trackedSurface.H"
#include <cmath>

namespace ispf
{

namespace
{

class zoneDiameter : public functionObject
{
public:
    zoneDiameter(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          surface_(dict.get<word>("surface"), c, dict.where("surface")),
          frame_(dict.get<vector>("point", dims::length), dict.get<vector>("axis")),
          band_(dict.getInRangeOrDefault("band", 0, 1e30, 0, dims::length)),
          nAngles_(2 * (dict.getInRangeOrDefault<label>("nAngles", 4, 1e6, 360) / 2)),
          images_(imagesAboutAxis(c.walls->images(), frame_)),
          rest_(measure(surface_.rest()).mean),
          file_(table("zoneDiameter.dat",
                      ofWhole({"Diameter of " + surface_.name() + " [m], over " +
                                   std::to_string(nAngles_) + " angles",
                               "at rest: " + str(rest_, 9)}),
                      {"diameter", "dDoverD", "min", "max"}, 9))
    {
        if (!(dict.get<vector>("axis").norm() > 0)) dict.fail("axis", "The axis has no direction.");
        if (std::isnan(rest_))
            dict.fail("point",
                      "The plane does not cut the surface " + surface_.name() +
                          " on two opposite sides of the axis. Correct point and axis; a "
                          "symmetry plane completes the section only if the axis lies in it.");
    }

    void write() override
    {
        surface_.update(case_.cloud.x);
        const diameterRange d = measure(surface_.now());
        file_.begin(case_.time.value()) << d.mean << (d.mean - rest_) / rest_ << d.min << d.max;
        file_.endRow();
    }

private:
    diameterRange measure(const triSurface& surface) const
    {
        const int nPlanes = band_ > 0 ? 5 : 1;
        List<scalar> mean(nAngles_, 0);
        for (int k = 0; k < nPlanes; ++k)
        {
            const scalar height = band_ * ((k + 0.5) / nPlanes - 0.5);
            const List<scalar> radii = sectionRadii(surface, images_, frame_, height, nAngles_);
            for (label a = 0; a < nAngles_; ++a) mean[a] += radii[a] / nPlanes;
        }
        return diametersOf(mean);
    }

    trackedSurface surface_;
    axisFrame frame_;
    scalar band_;
    label nAngles_;
    List<structureImage> images_;
    scalar rest_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newZoneDiameter(const word& name, const dictionary& dict,
                                                const fsiCase& c)
{
    return std::make_unique<zoneDiameter>(name, dict, c);
}

}  // namespace ispf
