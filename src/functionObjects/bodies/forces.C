// SPDX-License-Identifier: GPL-3.0-or-later
// Force and moment of the fluid on walls and solid zones, [N] and [N m], per metre in two dimensions:
//
//     drag { type forces; patches (lid walls); zones (wall); CofR (0 0 0); pRef 0; }
//
// See bodyLoad.H.  force.dat and moment.dat have the sum over all bodies, as in OpenFOAM.  With several bodies,
// force_<body>.dat and moment_<body>.dat have each of them.  `covered` is the share of the area with particles before
// it; the rest does not count.  Values are of the modelled part where symmetry planes cut a body.
#include "functionObject.H"

#include "bodyLoad.H"

#include <ostream>

namespace ispf
{

namespace
{

class forces : public functionObject
{
public:
    forces(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          centre_(dict.getOrDefault<vector>("CofR", vector::Zero(), dims::length)),
          pRef_(dict.getOrDefault<scalar>("pRef", 0, dims::pressure))
    {
        for (const word& patch : dict.getOrDefault<List<word>>("patches", {}))
            bodies_.push_back(loadedBody::wall(patch, c, dict.where("patches")));
        for (const word& zone : dict.getOrDefault<List<word>>("zones", {}))
            bodies_.push_back(loadedBody::solid(zone, c, dict.where("zones")));
        if (bodies_.empty())
            throw fatalError("forces wants patches, the names of walls, or zones, of solids.",
                             dict.where());
        files_.push_back(filesOf(""));
        for (const loadedBody& b : bodies_)
            if (bodies_.size() > 1) files_.push_back(filesOf("_" + b.name()));
    }

    void write() override
    {
        bodyLoad sum;
        const pairFriction friction(case_);
        for (size_t k = 0; k < bodies_.size(); ++k)
        {
            const bodyLoad part = loadOn(bodies_[k], friction, {centre_, pRef_});
            sum.add(part);
            if (files_.size() > 1) put(files_[k + 1], part);
        }
        put(files_.front(), sum);
    }

private:
    struct pairOfFiles
    {
        dataFile force, moment;
    };

    pairOfFiles filesOf(const word& suffix) const
    {
        const auto titles = [](const List<word>& names) {
            List<word> all;
            for (const word& n : names) all.push_back("(" + n + "_x " + n + "_y " + n + "_z)");
            return all;
        };
        List<word> ofForce = titles({"total", "pressure", "viscous"});
        const List<word> ofMoment = ofForce;
        ofForce.push_back("covered");
        const word about = "CofR       : (" + str(centre_[0]) + " " + str(centre_[1]) + " " +
                           str(centre_[2]) + ")";
        return {table("force" + suffix + ".dat", ofModelled({"Force", about}), ofForce, 9),
                table("moment" + suffix + ".dat", ofModelled({"Moment", about}), ofMoment, 9)};
    }

    void put(pairOfFiles& files, const bodyLoad& l) const
    {
        const scalar t = case_.time.value();
        files.force.begin(t) << l.total() << l.pressure << l.viscous
                             << (l.area > 0 ? l.covered / l.area : 0);
        files.force.endRow();
        files.moment.begin(t) << l.totalMoment() << l.pressureMoment << l.viscousMoment;
        files.moment.endRow();
    }

    vector centre_;
    scalar pRef_;
    List<loadedBody> bodies_;
    List<pairOfFiles> files_;
};

}  // namespace

std::unique_ptr<functionObject> newForces(const word& name, const dictionary& dict,
                                          const fsiCase& c)
{
    return std::make_unique<forces>(name, dict, c);
}

}  // namespace ispf
