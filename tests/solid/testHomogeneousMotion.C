// SPDX-License-Identifier: GPL-3.0-or-later
// The stress of the links compared with their forces and their energy, and with the exact law of the endless lattice.
#include "homogeneousMotion.H"
#include "solidMotions.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

tensor sumOf(const List<tensor>& values)
{
    tensor sum = tensor::Zero();
    for (const tensor& v : values) sum += v;
    return sum;
}

scalar energyIn(const structureModel& model, const homogeneousMotion& motion)
{
    return model.energy(affine(model.reference(), motion.F));
}

}  // namespace

TEST_CASE("The stresses add up to the virial of the forces, in any motion")
{
    for (const structureReference& ref :
         {latticeBlock(5, 4, 3), disorderedBlock(5, 4, 4), latticeBlock(7, 5, 0)})
    {
        const auto model = springs(ref, "links radius; radius 2.1; E 1e6;");
        const List<vec4> x = shaken(ref, 0.3 * ref.dx);
        List<vec4> f;
        model->force(x, f);
        tensor virial = tensor::Zero();
        for (label i = 0; i < ref.n(); ++i) virial -= f[i].xyz() * x[i].xyz().transpose();
        List<tensor> tau;
        model->stress(x, tau);
        CHECK((ref.volume() * sumOf(tau) - virial).norm() < 1e-12 * virial.norm());
    }
}

TEST_CASE("The stress turns with the body")
{
    const structureReference ref = disorderedBlock(5, 4, 4);
    const auto model = springs(ref, "links radius; radius 2.1; E 1e6;");
    const tensor R = Eigen::AngleAxisd(1.1, vector(1, 2, -0.5).normalized()).toRotationMatrix();
    List<vec4> x = shaken(ref, 0.2 * ref.dx), turned(x);
    for (vec4& v : turned) v = vec4::from(R * v.xyz());
    List<tensor> tau, there;
    model->stress(x, tau);
    model->stress(turned, there);
    for (label i = 0; i < ref.n(); ++i)
        CHECK((there[i] - R * tau[i] * R.transpose()).norm() < 1e-9 * tau[i].norm());
}

TEST_CASE("Through symmetry planes a quarter has the stresses of the whole")
{
    const structureReference whole = latticeBlock(6, 6, 4);
    structureReference part = whole;
    part.x0.clear(), part.fixed.clear();
    const scalar middle = 3 * whole.dx;
    for (const vector& x : whole.x0)
        if (x[0] > middle && x[1] > middle) part.x0.push_back(x), part.fixed.push_back(0);
    const isometry mx = mirrorAt(0, middle), my = mirrorAt(1, middle);
    part.images = {mx, my, {mx.R * my.R, mx.t + my.t}};
    // a motion that keeps both planes in place
    const homogeneousMotion motion = motionOf("uniaxial", frameAlong({0, 0, 1}), 3, 1.3);
    const vector fixed(middle, middle, 0), shift = fixed - motion.F * fixed;
    List<tensor> all, some;
    springs(whole, "links lattice18; k_e 1e6;")->stress(affine(whole, motion.F, shift), all);
    springs(part, "links lattice18; k_e 1e6;")->stress(affine(part, motion.F, shift), some);
    size_t k = 0;
    for (label i = 0; i < whole.n(); ++i)
        if (whole.x0[i][0] > middle && whole.x0[i][1] > middle)
            CHECK((some[k++] - all[i]).norm() < 1e-9 * sumOf(all).norm() / whole.n());
    CHECK(k == some.size());
}

TEST_CASE("Motions keep the volume, and their stress is the slope of the energy")
{
    const vector direction(1, 2, 0.5), inPlane(1, 2, 0);
    for (const int nDims : {2, 3})
    {
        const structureReference ref = nDims == 3 ? latticeBlock(5, 5, 4) : latticeBlock(7, 5, 0);
        const auto model = springs(ref, "links radius; radius 2; k_e 1e6;");
        const tensor frame = frameAlong(nDims == 3 ? direction : inPlane);
        const List<char> all(ref.x0.size(), 1);
        for (const word& name : homogeneousMotions(nDims))
            for (const scalar lambda : {0.8, 1.25})
            {
                CAPTURE(name);
                const auto at = [&](scalar l) { return motionOf(name, frame, nDims, l); };
                CHECK(at(lambda).F.determinant() == doctest::Approx(1).epsilon(1e-13));
                const scalar step = 1e-5;
                const homogeneousMotion up = at(lambda + step), down = at(lambda - step);
                // amount of the stretch or of the shear
                const scalar amount = name == "shear" ? (up.F - down.F).norm() : 2 * step;
                const scalar per = (name == "equibiaxial" ? 0.5 : 1) / amount;
                const scalar slope = per * (energyIn(*model, up) - energyIn(*model, down));
                CHECK(nominalStress(*model, at(lambda), all) * ref.n() * ref.volume() ==
                      doctest::Approx(slope).epsilon(1e-7));
                // W = G/2 (tr F F^T - 3)
                const scalar neoHooke = per * 0.5 * (up.F.squaredNorm() - down.F.squaredNorm());
                CHECK(at(lambda).neoHooke == doctest::Approx(neoHooke).epsilon(1e-7));
            }
    }
}

TEST_CASE("The endless cubic lattice of radius 2 follows its exact law")
{
    // K/dx = 1; stretch along [100], sides by lambda^-1/2; the lattice sum was evaluated separately
    structureReference ref = latticeBlock(7, 7, 7);
    const auto model = springs(ref, "links radius; radius 2; k_e 1e3;");
    List<char> inside(ref.x0.size(), 0);
    inside[3 + 7 * (3 + 7 * 3)] = 1;
    const scalar unit = 1e3 * ref.h / ref.dx;
    const tensor frame = frameAlong(vector::UnitX());
    for (const auto& [lambda, P] :
         {std::pair{0.7, -4.092245061}, {0.725, -3.539180092}, {0.75, -3.050743408}})
        CHECK(nominalStress(*model, motionOf("uniaxial", frame, 3, lambda), inside) ==
              doctest::Approx(unit * P).epsilon(1e-8));
}
