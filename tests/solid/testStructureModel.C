// SPDX-License-Identifier: GPL-3.0-or-later
#include "errorOf.H"
#include "execution.H"
#include "solidMotions.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

// Energy after `steps` of symplectic Euler from a small random motion, over the energy at the start
scalar growth(const structureModel& model, scalar mass, scalar dt, int steps)
{
    const structureReference& ref = model.reference();
    List<vec4> x = shaken(ref, 1e-5 * ref.dx), v(x.size()), f;
    for (vec4& u : v) u = vec4::from(vector::Zero());
    const scalar start = model.energy(x);
    for (int step = 0; step < steps; ++step)
    {
        model.force(x, f);
        for (size_t i = 0; i < x.size(); ++i) v[i].s += dt / mass * f[i].s, x[i].s += dt * v[i].s;
    }
    return model.energy(x) / start;
}

bool contains(const word& text, const word& part)
{
    return text.find(part) != word::npos;
}

}  // namespace

TEST_CASE("Without a dictionary there is no structure")
{
    CHECK(structureModel::New(dictionary(), latticeBlock(4, 4, 4)) == nullptr);
}

TEST_CASE("Wrong entries are refused with what is valid")
{
    const structureReference ref = latticeBlock(5, 5, 5);
    const auto error = [&](const word& text) {
        return errorOf([&] { structureModel::New(dictionary::fromString(text), ref); });
    };
    CHECK(contains(error("structureModel rubber;"), "springNetwork"));
    CHECK(contains(error("structureModel springNetwork; links latice; E 1;"), "lattice18"));
    const word net = "structureModel springNetwork; ";
    CHECK(contains(error(net + "links lattice18;"), "none is given"));
    CHECK(contains(error(net + "links lattice18; E 1; k_e 2;"), "E and k_e"));
    CHECK(contains(error(net + "links lattice8; E 1;"), "lattice18"));
    CHECK(contains(error(net + "links lattice18; E 1; rho 1100;"), "1000"));
    CHECK(error(net + "links lattice18; E 1; rho 1000;") == "");
    CHECK(contains(error(net + "links lattice18; E 1; nu 0.5;"), "nu"));
    // six neighbours have no resistance to shear
    CHECK(contains(error(net + "links radius; radius 1; E 1;"), "shear"));
    CHECK(contains(error(net + "links radius; radius 1; k_e 1;"), "shear"));
}

TEST_CASE("A lattice rule on disordered particles is refused")
{
    const structureReference ref = disorderedBlock(5, 5, 5);
    CHECK(contains(errorOf([&] { springs(ref, "links lattice18; E 1;"); }), "links radius"));
}

TEST_CASE("References that cannot be are refused")
{
    structureReference ref = latticeBlock(4, 4, 4);
    const auto error = [](const structureReference& r) {
        return errorOf([&] { springs(r, "links lattice18; E 1;"); });
    };
    structureReference doubled = ref;
    doubled.x0.push_back(ref.x0[5]), doubled.fixed.push_back(0);
    CHECK(contains(error(doubled), "coincide"));
    structureReference sheet = latticeBlock(6, 6, 1);
    CHECK(contains(error(sheet), "less than two layers"));
    structureReference onPlane = ref;
    onPlane.images = {mirrorAt(0, 0.5 * ref.dx)};
    CHECK(contains(error(onPlane), "symmetry plane"));
    isometry shift;
    shift.t = vector(4 * ref.dx, 0, 0);
    structureReference oneWay = ref;
    oneWay.images = {shift};
    CHECK(contains(error(oneWay), "no inverse"));
    structureReference unclamped = ref;
    unclamped.fixed.clear();
    CHECK(contains(error(unclamped), "clamping"));
}

TEST_CASE("F and J are exact for affine maps")
{
    tensor A;
    A << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.15, 0.1, 1.1;
    for (const structureReference& ref : {latticeBlock(5, 4, 3), disorderedBlock(5, 4, 3)})
    {
        const referenceGradient gradient(ref);
        List<tensor> F;
        gradient.apply(affine(ref, A, vector(1, 2, 3)), F);
        for (const tensor& Fi : F)
        {
            CHECK((Fi - A).norm() < 1e-12);
            CHECK(Fi.determinant() == doctest::Approx(A.determinant()).epsilon(1e-12));
        }
    }
    const structureReference plane = disorderedBlock(7, 4, 0);
    const referenceGradient gradient(plane);
    List<tensor> F;
    tensor B = tensor::Identity();
    B.topLeftCorner<2, 2>() = A.topLeftCorner<2, 2>();
    gradient.apply(affine(plane, B), F);
    for (const tensor& Fi : F) CHECK((Fi - B).norm() < 1e-12);
}

TEST_CASE("F is exact over symmetry planes and cyclic patches")
{
    structureReference ref = disorderedBlock(4, 4, 3);
    ref.images = {mirrorAt(0, 0)};
    tensor A = vector(1.3, 0.8, 1.1).asDiagonal();  // respects the plane x = 0
    List<tensor> F;
    referenceGradient(ref).apply(affine(ref, A), F);
    for (const tensor& Fi : F) CHECK((Fi - A).norm() < 1e-12);

    isometry shift;
    shift.t = vector(0, 4 * ref.dx, 0);
    ref.images = {shift, shift.inverse()};
    A << 1.2, 0, 0.1, 0.3, 1, 0, 0, 0, 0.9;  // keeps the period
    referenceGradient(ref).apply(affine(ref, A), F);
    for (const tensor& Fi : F) CHECK((Fi - A).norm() < 1e-12);
}

TEST_CASE("Stress forces are the adjoint of the deformation gradient")
{
    structureReference ref = disorderedBlock(4, 4, 4);
    ref.images = {mirrorAt(2, 0)};
    const referenceGradient gradient(ref);
    List<tensor> P(ref.x0.size()), dF;
    for (size_t i = 0; i < P.size(); ++i)
        for (int a = 0; a < 9; ++a) P[i](a) = std::sin(scalar(9 * i + size_t(a)));
    List<vec4> u = shaken(ref, ref.dx), f;
    for (size_t i = 0; i < u.size(); ++i) u[i].s -= vec4::from(ref.x0[i]).s;
    gradient.forces(P, f);
    gradient.applyLinear(u, dF);
    scalar work = 0, power = 0;
    for (size_t i = 0; i < u.size(); ++i)
    {
        work += f[i].xyz().dot(u[i].xyz());
        power += ref.volume() * P[i].cwiseProduct(dF[i]).sum();
    }
    CHECK(work == doctest::Approx(-power).epsilon(1e-11));
}

TEST_CASE("The stable time step is where explicit integration blows up")
{
    const structureReference ref = disorderedBlock(6, 6, 6);
    const auto model = springs(ref, "links radius; radius 2.1; E 1e6;");
    const scalar mass = ref.rho * ref.volume(), dt = model->stableTimeStep(atRest(ref), mass);
    CHECK(growth(*model, mass, 0.98 * dt, 3000) < 5);
    CHECK(growth(*model, mass, 1.03 * dt, 100) > 1e6);
}

TEST_CASE("Small explicit steps keep the energy")
{
    const structureReference ref = latticeBlock(4, 4, 4);
    const auto model = springs(ref, "links lattice18; E 1e6;");
    const scalar mass = ref.rho * ref.volume();
    const scalar dt = 0.02 * model->stableTimeStep(atRest(ref), mass);
    List<vec4> x = shaken(ref, 0.05 * ref.dx), v(x.size()), f;
    for (vec4& u : v) u = vec4::from(vector::Zero());
    const scalar start = model->energy(x);
    model->force(x, f);
    scalar worst = 0;
    for (int step = 0; step < 2000; ++step)  // velocity Verlet
    {
        for (size_t i = 0; i < x.size(); ++i)
            v[i].s += 0.5 * dt / mass * f[i].s, x[i].s += dt * v[i].s;
        model->force(x, f);
        scalar kinetic = 0;
        for (size_t i = 0; i < x.size(); ++i)
        {
            v[i].s += 0.5 * dt / mass * f[i].s;
            kinetic += 0.5 * mass * v[i].xyz().squaredNorm();
        }
        worst = std::max(worst, std::abs((kinetic + model->energy(x)) / start - 1));
    }
    CHECK(worst < 1e-3);
}
