// SPDX-License-Identifier: GPL-3.0-or-later
// Blood in a plane channel under a body force: the steady profile of Casson's and of Carreau and Yasuda's fluid.  The shear
// stress is tau = rho a |y|; the profile is the integral of the shear rate g with mu(g) g = tau
#include "boxCase.H"
#include "core/errorOf.H"
#include "elasticSlabs.H"
#include "pairViscosity.H"
#include "relative.H"
#include "viscosityModel.H"

#include <doctest/doctest.h>
#include <functional>

using namespace ispf;

namespace
{

constexpr scalar mu = 0.05, rho = 1000, drive = 0.005;  // [Pa s] [kg/m^3] [m/s^2]
const word CarreauYasuda = "viscosityModel CarreauYasuda; mu0 0.8; lambda 3.313; a 2; n 0.3568; ";
const word Casson = "viscosityModel Casson; yieldStress 0.005; muMax 5; ";
// Half of the channel does not shear: what shears is 5 dx wide on each side, and the mean over neighbours blurs its edge
const word CassonPlug = "viscosityModel Casson; yieldStress 0.025; muMax 5; ";

scalar ofCarreauYasuda(scalar g)
{
    return mu + (0.8 - mu) * std::pow(1 + std::pow(3.313 * g, 2), (0.3568 - 1) / 2);
}
scalar ofCasson(scalar g, scalar yieldStress = 0.005)
{
    return std::min(5.0, std::pow(std::sqrt(mu) + std::sqrt(yieldStress / g), 2));
}

const std::map<word, std::function<scalar(scalar)>> laws = {
    {CarreauYasuda, ofCarreauYasuda},
    {Casson, [](scalar g) { return ofCasson(g); }},
    {CassonPlug, [](scalar g) { return ofCasson(g, 0.025); }}};

// u at the distance y from the middle of a channel of half the height h
scalar exact(const std::function<scalar(scalar)>& viscosity, scalar y, scalar h)
{
    constexpr int n = 400;
    scalar u = 0;
    for (int k = 0; k < n; ++k)
    {
        const scalar tau = rho * drive * (std::abs(y) + (h - std::abs(y)) * (k + 0.5) / n);
        scalar low = 0, high = tau / mu;
        for (int step = 0; step < 80; ++step)
        {
            const scalar g = 0.5 * (low + high);
            (viscosity(g) * g < tau ? low : high) = g;
        }
        u += low * (h - std::abs(y)) / n;
    }
    return u;
}

boxCase channel(const word& coupling, const word& model, const word& wallKind = "mirror")
{
    boxCase box;
    box.nx = 6, box.ny = 20, box.mu = mu, box.coupling = coupling;
    const word wall = "type wall; representation " + wallKind + ";";
    box.patch = {"type cyclic;", "", wall, wall};
    box.fluid = model + "bodyForce { fluid (" + str(drive, 17) + " 0 0); }";
    return box;
}

}  // namespace

TEST_CASE(
    "steady profiles of shear-thinning blood in a channel, both couplings, both kinds of walls")
{
    for (const word coupling : {"projection", "monolithic"})
        for (const word wall : {"mirror", "particles"})
            for (const auto& [model, viscosity] : laws)
            {
                CAPTURE(coupling);
                CAPTURE(wall);
                CAPTURE(model);
                const boxCase box = channel(coupling, model, wall);
                runningBox run(box, "blood");
                run.run(0.05, 120);
                const scalar h = box.height() / 2, most = exact(viscosity, 0, h);
                scalar worst = 0, plain = 0;
                for (label i = 0; i < run.c.cloud.n(); ++i)
                {
                    const scalar y = run.c.cloud.x[i][1] - h, u = run.c.cloud.Up[i][0];
                    worst = std::max(worst, std::abs(u - exact(viscosity, y, h)) / most);
                    plain = std::max(plain, u);
                }
                CHECK(worst < (model == CassonPlug ? 0.1 : 0.02));
                // a Newtonian fluid of this mu would be faster by far
                CHECK(plain < 0.7 * rho * drive * h * h / (2 * mu));
            }
}

// With the harmonic mean of the fluid's viscosity and a solid's mu the flow would be too large by far
TEST_CASE("flow of shear-thinning blood between two elastic slabs")
{
    for (const auto& [model, viscosity] : laws)
    {
        CAPTURE(model);
        constexpr int rows = 20;
        const elasticSlabs s(rows, "monolithic", drive, "mu " + str(mu) + "; " + model);
        capturedLog log;
        Time time(s.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, 0.05, 120);
        const scalar h = 0.5 * rows * elasticSlabs::dx;
        scalar flow = 0;
        constexpr int n = 200;
        for (int k = 0; k < n; ++k) flow += 2 * h / n * exact(viscosity, h * (k + 0.5) / n, h);
        CHECK(elasticSlabs::flow(c.cloud) == relative(flow, model == CassonPlug ? 0.06 : 0.02));
    }
}

TEST_CASE("limits of the laws: mu at high shear rates, mu0 and muMax at rest")
{
    const auto law = [](const word& text) {
        return viscosityModel::New(dictionary::fromString(text), mu);
    };
    CHECK(law("viscosityModel Newtonian;") == nullptr);
    CHECK(law("") == nullptr);
    const auto carreau = law(CarreauYasuda), casson = law(Casson);
    CHECK(carreau->ratio(0) == relative(0.8 / mu, 1e-14));
    CHECK(carreau->ratio(1e12) == relative(1, 1e-5));
    CHECK(casson->ratio(0) == relative(5 / mu, 1e-14));
    CHECK(casson->ratio(1e12) == relative(1, 1e-5));
    CHECK(casson->ratio(2) == relative(ofCasson(2) / mu, 1e-13));
}

TEST_CASE("a Newtonian fluid has no field of viscosities; a shear-thinning one keeps its own")
{
    const runningBox plain(channel("projection", ""), "newtonian");
    CHECK(plain.c.cloud.scalars.count("viscosityRatio") == 0);
    runningBox blood(channel("projection", Casson), "blood");
    blood.run(0.05, 1);
    CHECK(blood.c.cloud.scalars.at("viscosityRatio").size() == size_t(blood.c.cloud.n()));
}

TEST_CASE(
    "pairs: the harmonic mean; what has just entered counts with the limit at high shear rates")
{
    particleCloud cloud = scene::fluid({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1);
    CHECK(pairViscosity(cloud).of(0, 1) == 1);
    cloud.scalars[viscosityRatio] = {3, 6, 0};
    const pairViscosity v(cloud);
    CHECK(v.of(0, 1) == relative(4, 1e-14));
    CHECK(v.of(2, 0) == relative(1.5, 1e-14));
    CHECK(v.of(2, 2) == 1);
}

TEST_CASE("a wrong viscosity is refused with what would be right")
{
    const auto make = [](const word& text) {
        viscosityModel::New(dictionary::fromString(text), mu);
    };
    CHECK_ERROR(make("viscosityModel water;"), "CarreauYasuda", 1);
    CHECK_ERROR(make("viscosityModel Casson; yieldStress 1;"), "muMax", 0);
    CHECK_ERROR(make("viscosityModel Casson; yieldStress 1; muMax 0.01;"), "must not be below", 1);
    CHECK_ERROR(make("viscosityModel CarreauYasuda; mu0 0.01; lambda 1; n 0.3;"),
                "must not be below", 1);
    CHECK_ERROR(make("viscosityModel CarreauYasuda; mu0 1; lambda 1; n 3;"), "n", 1);
}
