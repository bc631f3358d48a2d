// SPDX-License-Identifier: GPL-3.0-or-later
// One number for a field in a volume, as OpenFOAM's function object of this name:
//
//     mean { type volFieldValue; operation volAverage; fields (U p); phase fluid; }     // or zones (a b)
//
//     volAverage      mean over the particles, which all have the same volume
//     volIntegrate    sum of value times volume [m^3; m^2 in two dimensions]
//     sum             sum over the particles
//
// Fluid beyond open faces does not count.  All of the modelled part where symmetry planes cut the body.
#include "functionObject.H"

#include "dataFile.H"
#include "particleFields.H"

namespace ispf
{

namespace
{

class volFieldValue : public functionObject
{
public:
    volFieldValue(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          operation_(dict.choose("operation", {"volAverage", "volIntegrate", "sum"})),
          fields_(fieldsOf(c.cloud, dict, {"U", "p"}, &c)),
          chosen_(c.cloud, dict, "all"),
          file_(table("volFieldValue.dat",
                      ofModelled({operation_ + " of the fields over the particles chosen"}),
                      titles()))
    {
    }

    void write() override
    {
        const particleCloud& cloud = case_.cloud;
        file_.begin(case_.time.value());
        for (const particleField& f : fields_)
        {
            vector sum = vector::Zero();
            label n = 0;
            for (label i = 0; i < cloud.n(); ++i)
                if (chosen_(cloud, i) && !cloud.beyondOpen(i))
                    sum += f.isVector() ? f.vectorAt(i) : vector(f.at(i), 0, 0), ++n;
            const scalar factor = operation_ == "volAverage"     ? 1 / scalar(n)
                                  : operation_ == "volIntegrate" ? cloud.volume()
                                                                 : 1;
            if (f.isVector()) file_ << vector(factor * sum);
            else file_ << factor * sum[0];
        }
        file_.endRow();
    }

private:
    List<word> titles() const
    {
        List<word> all;
        for (const particleField& f : fields_) all.push_back(f.name());
        return all;
    }

    word operation_;
    List<particleField> fields_;
    particleSelection chosen_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newVolFieldValue(const word& name, const dictionary& dict,
                                                 const fsiCase& c)
{
    return std::make_unique<volFieldValue>(name, dict, c);
}

}  // namespace ispf
