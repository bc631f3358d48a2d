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
//     sigma_x, sigma_y, sigma_z       rows of Cauchy's stress sigma = tau/J - p 1 [Pa]
//     vonMises                        sqrt(3/2 s : s) [Pa], s the deviator of sigma
//     p, U, id, zone                  as in particles.hdf
//
// tau is Kirchhoff's stress of the elastic model (structureModel::stress), p the pressure of the particle.  solid.hdf.series
// lists the times.  solidStress.dat has mean and largest values over the particles, of the modelled part.
#include "functionObject.H"

#include "particleTable.H"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <filesystem>

namespace ispf
{

namespace
{

// Square roots of the eigenvalues of F^T F, the largest first
vector stretchesOf(const tensor& F)
{
    const Eigen::SelfAdjointEigenSolver<tensor> e(F.transpose() * F, Eigen::EigenvaluesOnly);
    return e.eigenvalues().cwiseMax(0).cwiseSqrt().reverse();
}

scalar vonMises(const tensor& sigma)
{
    const tensor s = sigma - sigma.trace() / 3 * tensor::Identity();
    return std::sqrt(1.5 * s.squaredNorm());
}

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
        listTimes();
        writeRow(t);
    }

private:
    particleTable particles() const
    {
        const particleCloud& cloud = case_.cloud;
        const List<vec4>& rest = cloud.vectors.at("x0");
        List<tensor> F, tau;
        case_.structure->fromRest(cloud.x, F);
        case_.structure->stress(cloud.x, tau);
        particleTable t;
        for (label i = 0; i < cloud.nSolid(); ++i)
        {
            const scalar p = cloud.Up[i][3];
            const tensor sigma = tau[i] / F[i].determinant() - p * tensor::Identity();
            t.x.push_back(cloud.x[i].xyz());
            t.vectors["displacement"].push_back(cloud.x[i].xyz() - rest[i].xyz());
            t.vectors["U"].push_back(cloud.Up[i].xyz());
            addRows(t, "F", F[i]), addRows(t, "sigma", sigma);
            t.vectors["stretches"].push_back(stretchesOf(F[i]));
            t.scalars["vonMises"].push_back(vonMises(sigma));
            t.scalars["p"].push_back(p);
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

    // All times of the folder, also those of earlier runs
    void listTimes() const
    {
        List<seriesEntry> series;
        for (const auto& item : std::filesystem::directory_iterator(folder("")))
            if (const word time = item.path().filename().string();
                std::filesystem::exists(item.path() / "solid.hdf"))
                series.push_back({std::stod(time), time + "/solid.hdf"});
        std::sort(series.begin(), series.end(),
                  [](const auto& a, const auto& b) { return a.time < b.time; });
        writeSeries(folder("solid.hdf.series"), series);
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
