// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum of the particles; of the modelled part where symmetry planes cut the body, or cyclic patches repeat it.  Without a force from
// outside it is constant.  In two dimensions per metre:
//
//     motion { type momentum; phase all; }        // or zones (a b)
//
//     momentum    sum rho V U [kg m/s]
//     angular     sum rho V x x U [kg m^2/s], about the origin
//     centre      mean position [m]
#include "functionObject.H"

#include "dataFile.H"
#include "particleFields.H"

namespace ispf
{

namespace
{

class momentum : public functionObject
{
public:
    momentum(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          chosen_(c.cloud, dict, "all"),
          file_(table("momentum.dat",
                      ofModelled({"Momentum, moment of momentum about the origin, centre of mass"}),
                      {"momentum", "angular", "centre"}, 16))
    {
    }

    void write() override
    {
        const particleCloud& cloud = case_.cloud;
        const scalar mass = case_.rho * cloud.volume();
        vector linear = vector::Zero(), angular = linear, centre = linear;
        label n = 0;
        for (label i = 0; i < cloud.n(); ++i)
        {
            if (!chosen_(cloud, i)) continue;
            const vector x = cloud.x[i].xyz(), U = cloud.Up[i].xyz();
            linear += mass * U, angular += mass * x.cross(U), centre += x, ++n;
        }
        // without particles
        file_.begin(case_.time.value()) << linear << angular << vector(centre / scalar(n));
        file_.endRow();
    }

private:
    particleSelection chosen_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newMomentum(const word& name, const dictionary& dict,
                                            const fsiCase& c)
{
    return std::make_unique<momentum>(name, dict, c);
}

}  // namespace ispf
