// SPDX-License-Identifier: GPL-3.0-or-later
// Branches of relaxation, theory 5.9, of homogeneous bodies against exact solutions
#include "errorOf.H"
#include "relative.H"
#include "structureChecks.H"

#include <cmath>
#include <complex>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

constexpr scalar G = 1e4;
struct branch
{
    scalar g, time;
};

word listOf(const List<branch>& branches, scalar branch::*part)
{
    word text;
    for (const branch& b : branches) text += " " + str(b.*part, 17);
    return "(" + text + ")";
}

word relaxing(const List<branch>& branches)
{
    return "relaxation { moduli " + listOf(branches, &branch::g) + "; times " +
           listOf(branches, &branch::time) + "; }";
}

// A body of any law with its places
struct body
{
    structureReference ref;
    std::unique_ptr<structureModel> model;
    List<vec4> x;

    body(const List<branch>& branches, const word& law = "type neoHookean; G 1e4;",
         const structureReference& r = latticeBlock(4, 4, 3))
        : ref(r),
          model(structureModel::New(
              dictionary::fromString("structureModel totalLagrangian; material { " + law +
                                     relaxing(branches) + "}"),
              ref)),
          x(atRest(ref))
    {
    }
    // Returns what is lost
    scalar step(const tensor& F, scalar dt) { return step(affine(ref, F), dt); }
    scalar step(const List<vec4>& to, scalar dt)
    {
        model->memory()->begin(x, dt);
        x = to;
        return model->memory()->end(x, dt);
    }
    // Kirchhoff stress in the middle of a homogeneous body
    tensor stress() const
    {
        List<tensor> tau;
        model->stress(x, tau);
        return tau[size_t(ref.n()) / 2];
    }
    scalar shearStress() const { return stress()(0, 1); }
    scalar energyPerVolume() const { return model->energy(x) / (ref.volume() * scalar(ref.n())); }
};

tensor shear(scalar gamma)
{
    tensor F = tensor::Identity();
    F(0, 1) = gamma;
    return F;
}

tensor stretch(scalar l)
{
    return vector(l, 1 / std::sqrt(l), 1 / std::sqrt(l)).asDiagonal();
}

// det F = 1
tensor randomShape(std::mt19937& generator, scalar size)
{
    std::uniform_real_distribution<scalar> part(-size, size);
    tensor F = tensor::Identity();
    for (int c = 0; c < 9; ++c) F.data()[c] += part(generator);
    return F / std::cbrt(F.determinant());
}

const List<branch> two = {{0.5, 0.02}, {0.8, 0.3}};

}  // namespace

TEST_CASE("relaxation: the stress of a held shear falls as its exponentials, whatever the steps")
{
    for (const scalar gamma : {1e-3, 0.8})
        for (const int n : {1, 7, 60})
        {
            CAPTURE(gamma);
            CAPTURE(n);
            body b(two);
            b.x = affine(b.ref, shear(gamma));  // the start of a run that begins deformed
            CHECK(b.shearStress() == relative(G * 2.3 * gamma, 1e-9));
            const scalar end = 0.4;
            for (int k = 1; k <= n; ++k)
            {
                b.step(shear(gamma), end / n);
                const scalar t = end * k / n;
                const scalar exact =
                    G * gamma * (1 + 0.5 * std::exp(-t / 0.02) + 0.8 * std::exp(-t / 0.3));
                CHECK(b.shearStress() == relative(exact, 1e-9));
            }
        }
}

TEST_CASE("relaxation: a uniaxial stretch of large strain that is held")
{
    for (const scalar l : {0.6, 1.1, 2.0})
        for (const word law : {"type neoHookean; G 1e4;", "type Yeoh; c1 5e3; c2 2e3; c3 100;"})
        {
            CAPTURE(l);
            CAPTURE(law);
            body b(two, law);
            const auto difference = [&] { return b.stress()(0, 0) - b.stress()(1, 1); };
            body limit({{1e-12, 1}}, law);
            limit.x = affine(b.ref, stretch(l));
            const scalar remains = limit.stress()(0, 0) - limit.stress()(1, 1);
            b.x = affine(b.ref, stretch(l));
            for (int k = 1; k <= 5; ++k)
            {
                b.step(stretch(l), 0.05);
                const scalar t = 0.05 * k;
                const scalar exact =
                    remains +
                    G * (l * l - 1 / l) * (0.5 * std::exp(-t / 0.02) + 0.8 * std::exp(-t / 0.3));
                CHECK(difference() == relative(exact, 1e-8));
            }
        }
}

// Fourier components of the last period; steps of a third of the shortest time at most
TEST_CASE("relaxation: moduli of storage and loss in cyclic shear, and what a period loses")
{
    for (const scalar amplitude : {1e-3, 0.5})
        for (const scalar wTau : {0.1, 1.0, 10.0})
        {
            const List<branch> branches = {{0.7, 0.1}, {0.4, 0.02}};
            const scalar w = wTau / 0.1, period = 2 * M_PI / w;
            const int n = wTau < 1 ? 1000 : 200;
            const int periods = 10 + int(8 * 0.1 / period);  // until the start is forgotten
            body b(branches);
            scalar inPhase = 0, outOfPhase = 0, lost = 0;
            for (int k = 1; k <= n * periods; ++k)
            {
                const scalar t = period * k / n;
                const scalar lostNow = b.step(shear(amplitude * std::sin(w * t)), period / n);
                CHECK(lostNow >= 0);
                if (k <= n * (periods - 1)) continue;
                inPhase += 2 * b.shearStress() * std::sin(w * t) / n / amplitude;
                outOfPhase += 2 * b.shearStress() * std::cos(w * t) / n / amplitude;
                lost += lostNow / (b.ref.volume() * scalar(b.ref.n()));
            }
            std::complex<scalar> modulus = G;
            for (const branch& a : branches)
            {
                const std::complex<scalar> i(0, w * a.time);
                modulus += G * a.g * i / (1.0 + i);
            }
            MESSAGE("amplitude ", amplitude, ", w tau ", wTau, ": G' ", inPhase / modulus.real(),
                    " and G\" ", outOfPhase / modulus.imag(), " of the exact ones, loss ",
                    lost / (M_PI * modulus.imag() * amplitude * amplitude));
            CHECK(inPhase == relative(modulus.real(), 1e-3));
            CHECK(outOfPhase == relative(modulus.imag(), 2e-3));
            CHECK(lost == relative(M_PI * modulus.imag() * amplitude * amplitude, 1e-2));
        }
}

TEST_CASE("relaxation: a very long time is a spring, a very short one is nothing or a viscosity")
{
    const tensor F = shear(0.3);
    body spring({{0.5, 1e9}}), none({{0.5, 1e-9}});
    for (int k = 1; k <= 20; ++k) spring.step(shear(0.3 * k / 20), 0.01);
    CHECK(spring.shearStress() == relative(1.5 * G * 0.3, 1e-9));
    CHECK(spring.energyPerVolume() == relative(1.5 * G * 0.045, 1e-9));
    none.step(F, 0.01), none.step(F, 0.01);
    CHECK(none.shearStress() == relative(G * 0.3, 1e-9));
    CHECK(none.energyPerVolume() == relative(G * 0.045, 1e-9));
    // a hundred and ten thousand times of relaxation in a step, sheared steadily
    for (const scalar ratio : {100.0, 1e4})
    {
        const scalar dt = 0.01, rate = 2;
        body fluid({{40, dt / ratio}});
        for (int k = 1; k <= 50; ++k)
        {
            fluid.step(shear(rate * dt * k), dt);
            const scalar viscous = fluid.shearStress() - G * rate * dt * k;
            CHECK(viscous == relative(40 * G * dt / ratio * rate, 1e-6));
        }
    }
}

TEST_CASE("relaxation: the energy of a step is its work less a loss that is never negative")
{
    std::mt19937 generator(3);
    std::uniform_real_distribution<scalar> exponent(-3, 4);
    for (const int nz : {3, 0})
    {
        body b(two, "type neoHookean; G 1e4;", latticeBlock(4, 4, nz));
        const body bare({{1e-12, 1}}, "type neoHookean; G 1e4;", b.ref);
        for (int k = 0; k < 40; ++k)
        {
            const scalar dt = 0.02 * std::pow(10, exponent(generator));
            const List<vec4> next = shaken(b.ref, 0.3 * b.ref.dx, 100 + k);
            const scalar before = b.model->energy(b.x), size = before + G * b.ref.volume();
            b.model->memory()->begin(b.x, dt);
            const scalar started = b.model->energy(b.x), foreseen = b.model->energy(next);
            const scalar lost = b.model->memory()->end(next, dt);
            b.x = next;
            const scalar after = b.model->energy(b.x);
            CHECK(lost >= 0);
            CHECK(started <= before + 1e-12 * size);  // (5.37)
            CHECK(std::abs(foreseen - after) < 1e-11 * size);
            CHECK(after >= bare.model->energy(b.x) * (1 - 1e-9));
        }
    }
    body turned(two), still(two);
    const tensor Q = Eigen::AngleAxisd(0.9, vector(1, 2, 3).normalized()).toRotationMatrix();
    for (int k = 0; k < 5; ++k)
    {
        const tensor F = randomShape(generator, 0.4);
        still.step(F, 0.05), turned.step(Q * F, 0.05);
        CHECK((turned.stress() - Q * still.stress() * Q.transpose()).norm() < 1e-9 * G);
    }
}

TEST_CASE(
    "relaxation: in a step the force is the slope of the energy, the tangent that of the force")
{
    for (const structureReference& ref : {disorderedBlock(4, 4, 4), latticeBlock(6, 5, 0)})
    {
        body b({{2, 0.02}, {0.5, 1}}, "type neoHookean; G 1e4;", ref);
        b.step(shaken(ref, 0.2 * ref.dx, 5), 0.01), b.step(shaken(ref, 0.2 * ref.dx, 6), 0.03);
        const List<vec4> x = shaken(ref, 0.2 * ref.dx, 8);
        for (const bool within : {false, true})
        {
            if (within) b.model->memory()->begin(b.x, 0.02);
            CHECK(forceError(*b.model, x) < 1e-7);
            CHECK(tangentError(*b.model, x) < 1e-7);
        }
        CHECK(b.model->shearModulus() == relative(3.5 * G));
    }
}

TEST_CASE("relaxation: what is remembered is told and recalled exactly, and undoes a step")
{
    const structureReference ref = latticeBlock(4, 4, 0);
    body b(two, "type neoHookean; G 1e4;", ref), other(two, "type neoHookean; G 1e4;", ref);
    b.step(shaken(ref, 0.2 * ref.dx, 1), 0.01);
    const List<scalar> numbers = b.model->memory()->numbers();
    CHECK(numbers.size() == size_t(6 * 2 * ref.n()));
    const List<vec4> x = b.x;
    const scalar energy = b.model->energy(x);
    b.step(shaken(ref, 0.2 * ref.dx, 2), 0.05);
    CHECK(b.model->energy(x) != energy);
    b.model->memory()->recall(numbers), other.model->memory()->recall(numbers);
    CHECK(b.model->energy(x) == energy);
    CHECK(other.model->energy(x) == energy);
    CHECK(b.model->memory()->numbers() == numbers);
    body one({{0.5, 0.1}}, "type neoHookean; G 1e4;", ref);
    CHECK(errorOf([&] { one.model->memory()->recall(numbers); }).find("as many branches") !=
          word::npos);
}

TEST_CASE("relaxation: of zones; none costs nothing; wrong entries are refused")
{
    structureReference ref = latticeBlock(8, 4, 0);
    ref.zoneNames = {"left", "right"};
    for (const vector& x : ref.x0) ref.zone.push_back(x[0] > 4 * ref.dx);
    const auto model = [&](const word& entries) {
        return structureModel::New(
            dictionary::fromString("structureModel totalLagrangian; " + entries), ref);
    };
    const word law = "type neoHookean; G 1e4; ";
    const auto half =
        model("materials { left { " + law + "} right { " + law + relaxing(two) + "} }");
    CHECK(half->memory()->numbers().size() == size_t(6 * 2 * ref.n() / 2));
    List<tensor> tau;
    half->stress(affine(ref, shear(0.1)), tau);
    CHECK(tau[8](0, 1) == relative(0.1 * G, 1e-9));
    CHECK(tau[15](0, 1) == relative(0.23 * G, 1e-9));
    CHECK(half->description().find("2 relaxing branches") != word::npos);
    CHECK(model("material { " + law + "}")->memory() == nullptr);
    const auto error = [&](const word& relaxation) {
        return errorOf([&] { model("material { " + law + relaxation + "}"); });
    };
    CHECK(error("relaxation { moduli (1 2); times (1); }").find("2 moduli and 1 times") !=
          word::npos);
    CHECK(error("relaxation { moduli (); times (); }").find("0 moduli") != word::npos);
    CHECK(error("relaxation { moduli (1); }").find("times") != word::npos);
    CHECK(error("relaxation { moduli (1 -2); times (1 1); }").find("-2 of branch 2") != word::npos);
    CHECK(error("relaxation { moduli (1); times (0); }").find("0 s of branch 1") != word::npos);
    CHECK(error("relaxation { moduli (1); times (1); time 2; }").find("time") != word::npos);
    CHECK(errorOf([&] {
              structureModel::New(dictionary::fromString("structureModel springNetwork; E 1; links "
                                                         "radius; radius 2.1; relaxation { moduli "
                                                         "(1); times (1); }"),
                                  ref);
          }).find("relaxation") != word::npos);
}
