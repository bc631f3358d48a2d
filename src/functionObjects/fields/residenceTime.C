// SPDX-License-Identifier: GPL-3.0-or-later
// The time that fluid has spent in the case [s], a field of the particles:
//
//     age { type residenceTime; }
//
// Each particle carries the scalar `residenceTime`: 0 at the start and beyond open faces, and it grows by dt in each step.
// The field is written and restarted with the particles.  Particles that shifting has moved keep their value.
// residenceTime.dat has its mean and its largest value over the fluid before the open faces, of the modelled part
// where symmetry planes cut the body.
#include "functionObject.H"
#include "thrombus.H"

namespace ispf
{

namespace
{

const word& field = residenceTimeField;

class residenceTime : public functionObject
{
public:
    residenceTime(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          where_(dict.where()),
          file_(
              table("residenceTime.dat",
                    ofModelled({"Residence time of the fluid before open faces [s]: mean over the "
                                "particles and largest value"}),
                    {"mean", "max"}))
    {
    }

    List<word> carriedFields() const override { return {field}; }

    void advance(particleCloud& cloud, scalar dt) override
    {
        List<scalar>& age = cloud.scalars[field];
        age.resize(size_t(cloud.n()), 0);
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            age[i] = cloud.beyondOpen(i) ? 0 : age[i] + dt;
    }

    void write() override
    {
        const particleCloud& cloud = case_.cloud;
        const auto found = cloud.scalars.find(field);
        if (found == cloud.scalars.end())
            throw fatalError("The particles of time " + case_.time.timeName() + " have no field " +
                                 field + ": it grows while the solver runs. Have " + name() +
                                 " in system/controlDict during the run.",
                             where_);
        scalar sum = 0, most = 0;
        label n = 0;
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (!cloud.beyondOpen(i))
                sum += found->second[i], most = std::max(most, found->second[i]), ++n;
        file_.begin(case_.time.value()) << (n > 0 ? sum / scalar(n) : 0) << most;
        file_.endRow();
    }

private:
    fileLocation where_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newResidenceTime(const word& name, const dictionary& dict,
                                                 const fsiCase& c)
{
    return std::make_unique<residenceTime>(name, dict, c);
}

}  // namespace ispf
