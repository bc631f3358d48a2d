// SPDX-License-Identifier: GPL-3.0-or-later
// solidStress on a block of neo-Hookean material under a homogeneous motion: every particle has the exact stress
#include "core/errorOf.H"
#include "relative.H"
#include "testCase.H"

#include <Eigen/Geometry>

using namespace ispf;

namespace
{

constexpr scalar E = 3e3, G = E / 3, p = 123;

struct block : testCase
{
    explicit block(const word& phase = "solid")
    {
        addBlock("block", {0, 0, 0}, {6, 6, 6}, phase);
        if (phase != "solid") addBlock("free", {0, 0, 6 * dx}, {6, 6, 3}, "solid");
        structure = "structureModel totalLagrangian; material { type neoHookean; E 3e3; }";
        functions = "s { type solidStress; writePrecision 12; }";
    }

    // solid.hdf and the last row of the table after this motion
    std::pair<particleTable, List<scalar>> after(const tensor& F)
    {
        auto r = start();
        particleCloud& cloud = r.c->cloud;
        for (label i = 0; i < cloud.n(); ++i)
        {
            cloud.x[i].setXyz(F * cloud.x[i].xyz() + vector(1e-3, 0, 0));
            cloud.Up[i][3] = p;
        }
        functionObjectList f(*r.c);
        f.start();
        return {readParticles(path + "/postProcessing/s/0/solid.hdf"),
                rows("s/0/solidStress.dat").back()};
    }
};

tensor rowsOf(const particleTable& t, const word& name, size_t i)
{
    tensor T;
    T << t.vectors.at(name + "_x")[i].transpose(), t.vectors.at(name + "_y")[i].transpose(),
        t.vectors.at(name + "_z")[i].transpose();
    return T;
}

}  // namespace

TEST_CASE("a bar that is stretched and turned: F, stretches, Cauchy's stress and von Mises stress")
{
    block b;
    const scalar l = 1.5, across = 1 / std::sqrt(l);
    const tensor Q = Eigen::AngleAxisd(0.7, vector(1, 2, -1).normalized()).toRotationMatrix();
    const tensor F = Q * tensor(vector(l, across, across).asDiagonal());
    const auto [t, row] = b.after(F);
    const tensor B = F * F.transpose();
    const tensor exact = G * (B - B.trace() / 3 * tensor::Identity()) - p * tensor::Identity();
    const scalar mises = G * (l * l - 1 / l);  // of uniaxial tension
    REQUIRE(t.size() == 216);
    for (size_t i = 0; i < t.size(); ++i)
    {
        CHECK((rowsOf(t, "F", i) - F).norm() < 1e-9);
        CHECK((rowsOf(t, "sigma", i) - exact).norm() < 1e-8 * exact.norm());
        CHECK((t.vectors.at("stretches")[i] - vector(l, across, across)).norm() < 1e-9);
        CHECK(t.scalars.at("vonMises")[i] == relative(mises, 1e-8));
        const vector X = F.inverse() * (t.x[i] - vector(1e-3, 0, 0));
        CHECK((t.vectors.at("displacement")[i] - (t.x[i] - X)).norm() < 1e-12);
        CHECK(t.scalars.at("p")[i] == p);
    }
    CHECK(row[1] == relative(mises, 1e-8));
    CHECK(row[2] == relative(mises, 1e-8));
    CHECK(row[3] == relative(l, 1e-9));
    CHECK(row[4] == relative(across, 1e-9));
    CHECK(readText(b.path + "/postProcessing/s/solid.hdf.series").find("\"0/solid.hdf\"") !=
          word::npos);
}

TEST_CASE("simple shear has the stress G gamma, and a volume that changes divides by J")
{
    block b;
    tensor F = tensor::Identity();
    F(0, 1) = 0.4;
    const tensor sigma = rowsOf(b.after(F).first, "sigma", 100);
    CHECK(sigma(0, 1) == relative(0.4 * G, 1e-8));
    CHECK(sigma(0, 1) == relative(sigma(1, 0), 1e-8));
    CHECK(sigma(0, 0) - sigma(1, 1) == relative(0.16 * G, 1e-8));
    // the deviator of tau depends on the change of shape alone
    const tensor grown = rowsOf(b.after(1.1 * F).first, "sigma", 100);
    CHECK(grown(0, 1) == relative(0.4 * G / std::pow(1.1, 3), 1e-8));
}

TEST_CASE("a clamped particle among clamped ones has the stress of its deformation")
{
    block b("clamped");
    const vector stretch(1.25, 0.8, 1);
    const auto [t, row] = b.after(stretch.asDiagonal());
    const vector B = G * stretch.cwiseProduct(stretch);
    const scalar mises = (B - vector::Constant(B.mean())).norm() * std::sqrt(1.5);
    for (size_t i = 0; i < t.size(); ++i)
        CHECK(t.scalars.at("vonMises")[i] == relative(mises, 1e-8));
}

TEST_CASE("without a solid it is refused")
{
    testCase t;
    t.addBlock("water", {0, 0, 0}, {4, 4, 4});
    t.functions = "s { type solidStress; }";
    auto r = t.start();
    CHECK_ERROR(functionObjectList(*r.c), "wants a solid", 3);
}
