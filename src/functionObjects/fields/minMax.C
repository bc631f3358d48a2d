// SPDX-License-Identifier: GPL-3.0-or-later
// Smallest and largest value of fields and their places; for a vector field of its magnitude.
//
//     extremes { type minMax; fields (U p); phase all; }     // or zones (a b)
#include "functionObject.H"

#include "dataFile.H"
#include "particleFields.H"
#include <cmath>

namespace ispf
{

namespace
{

class minMax : public functionObject
{
public:
    minMax(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          fields_(fieldsOf(c.cloud, dict, {"U", "p"}, &c)),
          chosen_(c.cloud, dict, "all"),
          file_(table("minMax.dat",
                      {"Least and greatest value and their positions; magnitudes of vectors"},
                      titles()))
    {
    }

    void write() override
    {
        file_.begin(case_.time.value());
        for (const particleField& f : fields_)
        {
            scalar least = std::nan(""), most = least;  // stays NaN without particles
            vector lowAt = vector::Constant(least), highAt = lowAt;
            for (label i = 0; i < case_.cloud.n(); ++i)
            {
                if (!chosen_(case_.cloud, i)) continue;
                const scalar v = f.isVector() ? f.vectorAt(i).norm() : f.at(i);
                if (!(v >= least)) least = v, lowAt = case_.cloud.x[i].xyz();
                if (!(v <= most)) most = v, highAt = case_.cloud.x[i].xyz();
            }
            file_ << least << lowAt << most << highAt;
        }
        file_.endRow();
    }

private:
    List<word> titles() const
    {
        List<word> all;
        for (const particleField& f : fields_)
            for (const word& what : {word("min"), word("max")})
                all.insert(all.end(),
                           {what + "(" + f.name() + ")", "at" + what + "(" + f.name() + ")"});
        return all;
    }

    List<particleField> fields_;
    particleSelection chosen_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newMinMax(const word& name, const dictionary& dict,
                                          const fsiCase& c)
{
    return std::make_unique<minMax>(name, dict, c);
}

}  // namespace ispf
