// SPDX-License-Identifier: GPL-3.0-or-later
// Checks for every material of the table.  A new material adds its entries to `samples`
#include "errorOf.H"
#include "material.H"

#include <doctest/doctest.h>
#include <map>
#include <random>
#include <set>

using namespace ispf;
using namespace ispf::test;

namespace
{

const word along1 = "fibres { type uniform; directions ((1 0 0)); }";
const word crossed = "fibres { type uniform; directions ((1 0.5 0) (1 -0.5 0.2)); }";

const std::map<word, word> samples = {
    {"neoHookean", "E 1.5e6;"},
    {"MooneyRivlin", "c1 2e5; c2 3e4;"},
    {"Yeoh", "c1 2e5; c2 -1e4; c3 2e3;"},
    {"Ogden", "mu (6.3e5 1.2e3 -1e4); alpha (1.3 5 -2);"},
    {"Fung", "c 2e4; normal (1 0.7 0.5 0.3 0.2 0.1); shear (0.4 0.3 0.2); " + crossed},
    {"HolzapfelGasserOgden", "G 3e4; k1 2e4; k2 0.8; kappa 0.1; " + crossed},
    {"Guccione", "C 2e4; bf 0.8; bt 0.3; bfs 0.4; " + along1}};
// Their stiffness at rest depends on the direction
const std::set<word> withFibres = {"Fung", "HolzapfelGasserOgden", "Guccione"};

std::unique_ptr<material> law(const word& text)
{
    return material::New(dictionary::fromString(text), {vector(1, 2, 0)});
}

std::map<word, std::unique_ptr<material>> all()
{
    std::map<word, std::unique_ptr<material>> laws;
    for (const word& kind : material::kinds())
    {
        INFO(kind);
        REQUIRE(samples.count(kind) == 1);
        laws[kind] = law("type " + kind + "; " + samples.at(kind));
    }
    return laws;
}

// Deformation gradients of moderate and of large strain; J is not one
List<tensor> gradients()
{
    List<tensor> all = {tensor::Identity()};
    std::mt19937 generator(5);
    std::uniform_real_distribution<scalar> part(-1, 1);
    for (const scalar size : {0.05, 0.3, 0.3, 0.6})
    {
        tensor F = tensor::Identity();
        for (int k = 0; k < 9; ++k) F.data()[k] += size * part(generator);
        all.push_back(F);
    }
    return all;
}

tensor along(int k)
{
    tensor t = tensor::Zero();
    t.data()[k] = 1;
    return t;
}

constexpr scalar step = 1e-6;

}  // namespace

TEST_CASE("every material: the stress is the slope of the energy, the tangent that of the stress")
{
    for (const auto& [kind, law] : all())
        for (const tensor& F : gradients())
        {
            // at rest the fibres of this law begin to act: its stress has two slopes there
            if (kind == "HolzapfelGasserOgden" && F == tensor::Identity()) continue;
            CAPTURE(kind);
            CAPTURE(F);
            const tensor P = law->stress(F, 0);
            const modulusMatrix C = law->tangent(F, 0);
            const scalar G = law->shearModulus();
            for (int k = 0; k < 9; ++k)
            {
                const tensor ahead = F + step * along(k), behind = F - step * along(k);
                const scalar slope = (law->energy(ahead, 0) - law->energy(behind, 0)) / (2 * step);
                CHECK(std::abs(P.data()[k] - slope) < 1e-8 * (G + P.norm()));
                const tensor change = (law->stress(ahead, 0) - law->stress(behind, 0)) / (2 * step);
                const tensor column = Eigen::Map<const tensor>(C.col(k).eval().data());
                CHECK((column - change).norm() < 1e-8 * C.norm());
            }
            CHECK((C - C.transpose()).norm() < 1e-14 * C.norm());
        }
}

TEST_CASE("every material: nothing at rest, no mean pressure, the shear modulus it tells")
{
    for (const auto& [kind, law] : all())
    {
        CAPTURE(kind);
        const scalar G = law->shearModulus();
        CHECK(G > 0);
        CHECK(law->energy(tensor::Identity(), 0) == 0);
        const tensor rest = law->stress(tensor::Identity(), 0);
        CHECK((rest - rest.trace() / 3 * tensor::Identity()).norm() < 1e-15 * G);
        const tensor shear = tensor::Identity() + 1e-6 * along(3);
        if (!withFibres.count(kind))
            CHECK(law->stress(shear, 0)(0, 1) == doctest::Approx(1e-6 * G).epsilon(1e-8));
        for (const tensor& F : gradients())
        {
            const scalar size = G + law->stress(F, 0).norm();
            CHECK(law->energy(F, 0) >= 0);
            CHECK(std::abs((law->stress(F, 0) * F.transpose()).trace()) < 1e-13 * size);
            CHECK(std::abs(law->energy(1.3 * F, 0) - law->energy(F, 0)) < 1e-13 * size);
        }
    }
}

TEST_CASE("every material is objective")
{
    const tensor Q = Eigen::AngleAxisd(1.1, vector(1, 2, 3).normalized()).toRotationMatrix();
    for (const auto& [kind, law] : all())
        for (const tensor& F : gradients())
        {
            CAPTURE(kind);
            const tensor P = law->stress(F, 0), tau = P * F.transpose();
            const scalar size = law->shearModulus() + P.norm();
            CHECK(std::abs(law->energy(Q * F, 0) - law->energy(F, 0)) < 1e-13 * size);
            CHECK((law->stress(Q * F, 0) - Q * P).norm() < 1e-13 * size);
            CHECK((tau - tau.transpose()).norm() < 1e-13 * size);
        }
}

TEST_CASE("a wrong material: the message lists the valid types and ranges")
{
    const auto error = [](const word& text) { return errorOf([&] { law(text); }); };
    for (const word& kind : material::kinds())
        CHECK(error("type jelly; E 1e6;").find(kind) != word::npos);
    CHECK(error("type neoHookean;").find("exactly one of E") != word::npos);
    CHECK(error("type neoHookean; E 3; G 1;").find("exactly one of E") != word::npos);
    CHECK(error("type neoHookean; E -3;").find("1e-12") != word::npos);
    CHECK(error("type neoHookean; G 0;").find("1e-12") != word::npos);
    CHECK(error("type Yeoh; c1 -1;").find("1e-12") != word::npos);
    CHECK(error("type Yeoh; c1 1; c2 -2; c3 1;").find("c2^2 below 3 c1 c3") != word::npos);
    CHECK(error("type Yeoh; c1 1; c2 -1;").find("c2^2 below 3 c1 c3") != word::npos);
    CHECK(error("type MooneyRivlin; c1 0; c2 0;").find("must be positive") != word::npos);
    CHECK(error("type Ogden; mu (1 2); alpha (1);").find("2 numbers and alpha 1") != word::npos);
    CHECK(error("type Ogden; mu (1 2); alpha (1 -2);").find("Term 2") != word::npos);
    CHECK(error("type Fung; c 1; normal (1 1 1); shear (1 1 1); " + along1).find("6 numbers") !=
          word::npos);
    CHECK(error("type Fung; c 1; normal (1 1 1 -3 0 0); shear (1 1 1); " + along1)
              .find("negative for some strain") != word::npos);
    CHECK(error("type Guccione; C 1; bf 1; bt 1; bfs 1;").find("fibres") != word::npos);
    // the second axis has a direction where it matters, and none where it does not
    const word orthotropic = "type Fung; c 1; normal (1 2 1 0 0 0); shear (0.5 0.5 0.5); ",
               alike = "type Fung; c 1; normal (2 1 1 0 0.5 0); shear (0.5 0.25 0.5); ",
               twice = "fibres { type uniform; directions ((1 0 0) (2 0 0)); }";
    CHECK(error(orthotropic + along1).find("wants two families") != word::npos);
    CHECK(error(orthotropic + twice).find("the same direction") != word::npos);
    CHECK(error(orthotropic + crossed).empty());
    CHECK(error(alike + along1).empty());
    CHECK(error(alike + crossed).find("wants one family") != word::npos);
    CHECK(error("type Guccione; C 1; bf 1; bt 2; bfs 1; " + crossed).find("wants one family") !=
          word::npos);
    const word HGO = "type HolzapfelGasserOgden; G 1; k1 1; k2 1; ";
    CHECK(error(HGO + "kappa 0.4; " + along1).find("kappa") != word::npos);
    CHECK(error(HGO + "fibres { type woven; }").find("uniform") != word::npos);
    CHECK(error("type HolzapfelGasserOgden; G 1; k1 0; k2 1; " + along1).find("neoHookean") !=
          word::npos);
    CHECK(error(HGO + "fibres { type helix; point (1 0 0); axis (0 0 2); angles (30 400); }")
              .find("-180 to 180") != word::npos);
    const word across = "fibres { type uniform; directions ((1 0 0) (0 0 1)); }";
    CHECK(error(HGO + across).find("across the plane") != word::npos);
    CHECK(error(HGO + "kappa 0.1; " + across).empty());
    CHECK(error(HGO + "fibres { type uniform; directions ((0 0 0)); }")
              .find("no direction at (1 2 0)") != word::npos);
    CHECK(
        error(HGO + "fibres { type formula; direction1 (\"x\" \"y\"); }").find("three formulas") !=
        word::npos);
    CHECK(error("E 1e6;").find("type") != word::npos);
    CHECK(law("type neoHookean; E 3 [kPa];")->shearModulus() ==
          doctest::Approx(1000).epsilon(1e-14));
}

TEST_CASE("Yeoh without c2 and c3 is neoHookean; with them it stiffens as its law says")
{
    const auto plain = law("type Yeoh; c1 2e5;"), neo = law("type neoHookean; G 4e5;");
    for (const tensor& F : gradients())
        CHECK((plain->stress(F, 0) - neo->stress(F, 0)).norm() <
              1e-13 * (4e5 + neo->stress(F, 0).norm()));
    // uniaxial stretch 2: i = 4 + 1 - 3, nominal stress 2 w'(i) (2 - 1/4)
    const vector stretch(2, std::sqrt(0.5), std::sqrt(0.5));
    const tensor P = law("type Yeoh; c1 2e5; c2 1e4; c3 2e3;")->stress(stretch.asDiagonal(), 0);
    const scalar slope = 2e5 + 2e4 * 2 + 6e3 * 4;
    CHECK(P(0, 0) - P(1, 1) * stretch[1] / 2 ==
          doctest::Approx(2 * slope * (2 - 0.25)).epsilon(1e-12));
}

namespace
{

// sigma_11 - sigma_22 of an incompressible stretch: the pressure cancels
scalar difference(const material& law, const vector& stretch)
{
    const tensor P = law.stress(stretch.asDiagonal(), 0);
    return P(0, 0) * stretch[0] - P(1, 1) * stretch[1];
}

vector uniaxial(scalar l)
{
    return {l, 1 / std::sqrt(l), 1 / std::sqrt(l)};
}
vector equibiaxial(scalar l)  // thin along x
{
    return {1 / (l * l), l, l};
}
vector planar(scalar l)
{
    return {l, 1 / l, 1};
}

}  // namespace

// Formulas as in G. A. Holzapfel 2000, Nonlinear Solid Mechanics, 6.5 to 6.8
TEST_CASE("materials against their exact responses: uniaxial, equibiaxial and planar stretch")
{
    const auto MooneyRivlin = law("type MooneyRivlin; c1 2e5; c2 3e4;");
    const auto Yeoh = law("type Yeoh; c1 2e5; c2 -1e4; c3 2e3;");
    const auto Ogden = law("type Ogden; mu (6.3e5 1.2e3 -1e4); alpha (1.3 5 -2);");
    const auto HGO = law("type HolzapfelGasserOgden; G 3e4; k1 2e4; k2 1.5; " + along1);
    const auto Guccione = law("type Guccione; C 2e3; bf 8; bt 2; bfs 4; " + along1);
    const auto Fung =
        law("type Fung; c 3e3; normal (8 3 2 1 0.5 0.7); shear (1 1 1); fibres { type "
            "uniform; directions ((1 0 0) (0 1 0)); }");
    const auto is = [](scalar value) { return doctest::Approx(value).epsilon(1e-11); };
    for (const scalar l : {0.8, 1.05, 1.3, 1.6})
        for (const vector& s : {uniaxial(l), equibiaxial(l), planar(l)})
        {
            CAPTURE(l);
            CAPTURE(s);
            const scalar a = s[0] * s[0], b = s[1] * s[1], c = s[2] * s[2], i = a + b + c - 3;
            CHECK(difference(*MooneyRivlin, s) == is(2 * (a - b) * (2e5 + 3e4 * c)));
            CHECK(difference(*Yeoh, s) == is(2 * (a - b) * (2e5 - 2e4 * i + 6e3 * i * i)));
            const auto powers = [](scalar x) {
                return 6.3e5 * std::pow(x, 1.3) + 1.2e3 * std::pow(x, 5) - 1e4 * std::pow(x, -2);
            };
            CHECK(difference(*Ogden, s) == is(powers(s[0]) - powers(s[1])));
            const scalar E = std::max(a - 1, 0.0);
            CHECK(difference(*HGO, s) ==
                  is(3e4 * (a - b) + 2 * a * 2e4 * E * std::exp(1.5 * E * E)));
            const vector e = 0.5 * (s.cwiseProduct(s) - vector::Ones());
            const scalar Q = 8 * e[0] * e[0] + 2 * (e[1] * e[1] + e[2] * e[2]);
            CHECK(difference(*Guccione, s) ==
                  is(2e3 * std::exp(Q) * (8 * e[0] * a - 2 * e[1] * b)));
            const scalar first = 8 * e[0] + e[1] + 0.7 * e[2],
                         second = 3 * e[1] + e[0] + 0.5 * e[2],
                         third = 2 * e[2] + 0.5 * e[1] + 0.7 * e[0];
            const scalar sum = first * e[0] + second * e[1] + third * e[2];
            CHECK(difference(*Fung, s) == is(3e3 * std::exp(sum) * (first * a - second * b)));
        }
}

TEST_CASE("simple shear along the fibres and across them")
{
    const scalar g = 0.7;
    const tensor F = tensor::Identity() + g * along(3), back = tensor::Identity() + g * along(1);
    const auto shear = [](const material& m, const tensor& by) {
        return (m.stress(by, 0) * by.transpose())(0, 1);
    };
    const auto is = [](scalar value) { return doctest::Approx(value).epsilon(1e-12); };
    CHECK(shear(*law("type MooneyRivlin; c1 2e5; c2 3e4;"), F) == is(2 * (2e5 + 3e4) * g));
    const auto HGO = law("type HolzapfelGasserOgden; G 3e4; k1 2e4; k2 1.5; " + along1);
    CHECK(shear(*HGO, F) ==
          is(3e4 * g));      // shear in planes along the fibres: these keep their length
    const scalar E = g * g;  // a fibre that is turned: F e1 = (1, g, 0)
    CHECK(shear(*HGO, back) == is(3e4 * g + 2 * g * 2e4 * E * std::exp(1.5 * E * E)));
}

TEST_CASE(
    "fibres: helices turn with the place, formulas give what they say, compressed ones do nothing")
{
    const word HGO = "type HolzapfelGasserOgden; G 1; k1 1e4; k2 1; ";
    const word helix = "fibres { type helix; point (1 0 0); axis (0 0 2); angles (0 30); }";
    // at (1 2 0) the circumference is along -x
    const auto helices = law(HGO + helix);
    const scalar cosine = std::cos(M_PI / 6), sine = 0.5;
    const auto same =
        law(HGO + "fibres { type formula; direction1 (\"-1\" \"y-2\" \"0\"); direction2 (\"" +
            str(-cosine, 17) + "*x\" \"0\" \"" + str(sine, 17) + "\"); }");
    for (const tensor& F : gradients())
        CHECK((helices->stress(F, 0) - same->stress(F, 0)).norm() <
              1e-12 * (1 + same->stress(F, 0).norm()));
    const auto one = law(HGO + along1), ground = law("type neoHookean; G 1;");
    const tensor shorter = uniaxial(0.8).asDiagonal();
    CHECK((one->stress(shorter, 0) - ground->stress(shorter, 0)).norm() < 1e-14);
    CHECK((one->tangent(shorter, 0) - ground->tangent(shorter, 0)).norm() < 1e-13);
}
