// SPDX-License-Identifier: GPL-3.0-or-later
// Checks for every material of the table.  A new material adds its entries to `samples`
#include "errorOf.H"
#include "material.H"

#include <doctest/doctest.h>
#include <map>
#include <random>

using namespace ispf;
using namespace ispf::test;

namespace
{

const std::map<word, word> samples = {{"neoHookean", "E 1.5e6;"},
                                      {"Yeoh", "c1 2e5; c2 -1e4; c3 2e3;"}};

List<std::unique_ptr<material>> all()
{
    List<std::unique_ptr<material>> laws;
    for (const word& kind : material::kinds())
    {
        INFO(kind);
        REQUIRE(samples.count(kind) == 1);
        laws.push_back(
            material::New(dictionary::fromString("type " + kind + "; " + samples.at(kind))));
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
    for (const auto& law : all())
        for (const tensor& F : gradients())
        {
            CAPTURE(law->description());
            CAPTURE(F);
            const tensor P = law->stress(F);
            const modulusMatrix C = law->tangent(F);
            const scalar G = law->shearModulus();
            for (int k = 0; k < 9; ++k)
            {
                const tensor ahead = F + step * along(k), behind = F - step * along(k);
                const scalar slope = (law->energy(ahead) - law->energy(behind)) / (2 * step);
                CHECK(std::abs(P.data()[k] - slope) < 1e-8 * (G + P.norm()));
                const tensor change = (law->stress(ahead) - law->stress(behind)) / (2 * step);
                const tensor column = Eigen::Map<const tensor>(C.col(k).eval().data());
                CHECK((column - change).norm() < 1e-8 * C.norm());
            }
            CHECK((C - C.transpose()).norm() < 1e-14 * C.norm());
        }
}

TEST_CASE("every material: nothing at rest, no mean pressure, the shear modulus it tells")
{
    for (const auto& law : all())
    {
        CAPTURE(law->description());
        const scalar G = law->shearModulus();
        CHECK(G > 0);
        CHECK(law->energy(tensor::Identity()) == 0);
        const tensor rest = law->stress(tensor::Identity());
        CHECK((rest - rest.trace() / 3 * tensor::Identity()).norm() < 1e-15 * G);
        const tensor shear = tensor::Identity() + 1e-6 * along(3);
        CHECK(law->stress(shear)(0, 1) == doctest::Approx(1e-6 * G).epsilon(1e-8));
        for (const tensor& F : gradients())
        {
            const scalar size = G + law->stress(F).norm();
            CHECK(law->energy(F) >= 0);
            CHECK(std::abs((law->stress(F) * F.transpose()).trace()) < 1e-13 * size);
            CHECK(std::abs(law->energy(1.3 * F) - law->energy(F)) < 1e-13 * size);
        }
    }
}

TEST_CASE("every material is objective")
{
    const tensor Q = Eigen::AngleAxisd(1.1, vector(1, 2, 3).normalized()).toRotationMatrix();
    for (const auto& law : all())
        for (const tensor& F : gradients())
        {
            CAPTURE(law->description());
            const tensor P = law->stress(F), tau = P * F.transpose();
            const scalar size = law->shearModulus() + P.norm();
            CHECK(std::abs(law->energy(Q * F) - law->energy(F)) < 1e-13 * size);
            CHECK((law->stress(Q * F) - Q * P).norm() < 1e-13 * size);
            CHECK((tau - tau.transpose()).norm() < 1e-13 * size);
        }
}

TEST_CASE("a wrong material: the message lists the valid types and ranges")
{
    const auto error = [](const word& text) {
        return errorOf([&] { material::New(dictionary::fromString(text)); });
    };
    for (const word& kind : material::kinds())
        CHECK(error("type jelly; E 1e6;").find(kind) != word::npos);
    CHECK(error("type neoHookean;").find("exactly one of E") != word::npos);
    CHECK(error("type neoHookean; E 3; G 1;").find("exactly one of E") != word::npos);
    CHECK(error("type neoHookean; E -3;").find("1e-12") != word::npos);
    CHECK(error("type neoHookean; G 0;").find("1e-12") != word::npos);
    CHECK(error("type Yeoh; c1 -1;").find("1e-12") != word::npos);
    CHECK(error("type Yeoh; c1 1; c2 -2; c3 1;").find("c2^2 below 3 c1 c3") != word::npos);
    CHECK(error("type Yeoh; c1 1; c2 -1;").find("c2^2 below 3 c1 c3") != word::npos);
    CHECK(error("E 1e6;").find("type") != word::npos);
    CHECK(material::New(dictionary::fromString("type neoHookean; E 3 [kPa];"))->shearModulus() ==
          doctest::Approx(1000).epsilon(1e-14));
}

TEST_CASE("Yeoh without c2 and c3 is neoHookean; with them it stiffens as its law says")
{
    const auto law = [](const word& text) { return material::New(dictionary::fromString(text)); };
    const auto plain = law("type Yeoh; c1 2e5;"), neo = law("type neoHookean; G 4e5;");
    for (const tensor& F : gradients())
        CHECK((plain->stress(F) - neo->stress(F)).norm() < 1e-13 * (4e5 + neo->stress(F).norm()));
    // uniaxial stretch 2: i = 4 + 1 - 3, nominal stress 2 w'(i) (2 - 1/4)
    const vector stretch(2, std::sqrt(0.5), std::sqrt(0.5));
    const tensor P = law("type Yeoh; c1 2e5; c2 1e4; c3 2e3;")->stress(stretch.asDiagonal());
    const scalar slope = 2e5 + 2e4 * 2 + 6e3 * 4;
    CHECK(P(0, 0) - P(1, 1) * stretch[1] / 2 ==
          doctest::Approx(2 * slope * (2 - 0.25)).epsilon(1e-12));
}
