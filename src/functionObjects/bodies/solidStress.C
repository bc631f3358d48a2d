// SPDX-License-Identifier: GPL-3.0-or-later
// Deformation and stress of the solid's particles, for ParaView:
//
//     stress { type solidStress; }
//
// postProcessing/<name>/<time>/solid.hdf has the particles at their present places with
//
//     displacement                    x - x0 [m]
//     F_x, F_y, F_z                   rows of F = dx/dX
//     stretches                       principal stretches, the largest first
//     sigma_x, sigma_y, sigma_z       rows of Cauchy's stress [Pa], elastic and viscous, solidFields.H
//     vonMises                        sqrt(3/2 s : s) [Pa], s the deviator of sigma
//     p, U, id, zone                  as in particles.hdf
//
// solid.hdf.series lists the times.  solidStress.dat has mean and largest values over the particles, of the modelled part.
#include "functionObject.H"

#include "particleTable.H"
#include "solidFields.H"

#include <algorithm>
#include <filesystem>

namespace ispf
{

namespace
{

class solidStress : public functionObject
{
public:
    solidStress(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          file_(table(
              "solidStress.dat",
              ofModelled({"Stress [Pa] and principal stretches over the particles of the solid"}),
              {"mean(vonMises)", "max(vonMises)", "max(stretch)", "min(stretch)",
               "max(|displacement|)"}))
    {
        if (!c.structure)
            throw fatalError("solidStress wants a solid, but the case has none.", dict.where());
    }

    word defaultWriteControl() const override { return "writeTime"; }

    void write() override
    {
        const particleTable t = particles();
        const word time = case_.time.timeName();
        std::filesystem::create_directories(folder(time));
        writeParticles(t, folder(time) + "/solid.hdf");
        listTimes("solid.hdf");
        writeRow(t);
    }

private:
    particleTable particles() const
    {
        const particleCloud& cloud = case_.cloud;
        const List<vec4>& rest = cloud.vectors.at("x0");
        solidFields fields(case_);
        particleTable t;
        for (label i = 0; i < cloud.nSolid(); ++i)
        {
            const tensor &F = fields.F(i), &sigma = fields.sigma(i);
            t.x.push_back(cloud.x[i].xyz());
            t.vectors["displacement"].push_back(cloud.x[i].xyz() - rest[i].xyz());
            t.vectors["U"].push_back(cloud.Up[i].xyz());
            addRows(t, "F", F), addRows(t, "sigma", sigma);
            t.vectors["stretches"].push_back(stretchesOf(F));
            t.scalars["vonMises"].push_back(vonMisesOf(sigma));
            t.scalars["p"].push_back(cloud.Up[i][3]);
            t.integers["id"].push_back(cloud.id[i]);
            t.integers["zone"].push_back(cloud.zone[i]);
        }
        t.setAttribute("time", case_.time.value());
        return t;
    }

    static void addRows(particleTable& t, const word& name, const tensor& T)
    {
        const char* const ends[] = {"_x", "_y", "_z"};
        for (int a = 0; a < 3; ++a) t.vectors[name + ends[a]].push_back(T.row(a).transpose());
    }

    void writeRow(const particleTable& t)
    {
        scalar sum = 0, most = 0, longest = 0, shortest = 1e30, way = 0;
        for (size_t i = 0; i < t.size(); ++i)
        {
            const scalar mises = t.scalars.at("vonMises")[i];
            const vector& l = t.vectors.at("stretches")[i];
            sum += mises, most = std::max(most, mises);
            longest = std::max(longest, l[0]), shortest = std::min(shortest, l[2]);
            way = std::max(way, t.vectors.at("displacement")[i].norm());
        }
        file_.begin(case_.time.value())
            << sum / scalar(t.size()) << most << longest << shortest << way;
        file_.endRow();
    }

    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newSolidStress(const word& name, const dictionary& dict,
                                               const fsiCase& c)
{
    return std::make_unique<solidStress>(name, dict, c);
}

}  // namespace ispf
