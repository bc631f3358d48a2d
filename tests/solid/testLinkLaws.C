// SPDX-License-Identifier: GPL-3.0-or-later
// Links that stiffen and links along fibres, theory 5.11
#include "errorOf.H"
#include "homogeneousMotion.H"
#include "relative.H"
#include "springModuli.H"
#include "structureChecks.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

// Particle in the middle of a lattice: it has all its links
label middleOf(const structureReference& ref)
{
    label best = 0;
    vector centre = vector::Zero();
    for (const vector& x : ref.x0) centre += x / scalar(ref.n());
    for (label i = 0; i < ref.n(); ++i)
        if ((ref.x0[i] - centre).norm() < (ref.x0[best] - centre).norm()) best = i;
    return best;
}

tensor stressAt(const structureModel& model, const tensor& F, label k)
{
    List<tensor> tau;
    model.stress(affine(model.reference(), F), tau);
    return tau[k];
}

// Uniaxial stretch along `axis` that keeps the volume
tensor stretch(const vector& axis, scalar l, int nDims)
{
    const tensor along = axis * axis.transpose();
    tensor across = tensor::Identity() - along;
    if (nDims == 2) across(2, 2) = 0;
    tensor F = l * along + std::pow(l, -1.0 / (nDims - 1)) * across;
    if (nDims == 2) F(2, 2) = 1;
    return F;
}

// Young's modulus along `axis` of the incompressible solid at rest: the least energy, twice, of a strain without change of
// volume that has the part 1 along it
scalar youngsModulus(const structureModel& model, const vector& axis)
{
    const label k = middleOf(model.reference());
    const scalar e = 1e-5, half = std::sqrt(0.5);
    List<tensor> basis(5, tensor::Zero());
    basis[0].diagonal() = half * vector(1, -1, 0);
    basis[1].diagonal() = vector(1, 1, -2) / std::sqrt(6.0);
    basis[2](0, 1) = basis[2](1, 0) = basis[3](1, 2) = basis[3](2, 1) = half;
    basis[4](0, 2) = basis[4](2, 0) = half;
    Eigen::Matrix<scalar, 5, 5> C;
    Eigen::Matrix<scalar, 5, 1> along;
    for (int a = 0; a < 5; ++a)
    {
        along[a] = axis.dot(basis[a] * axis);
        const tensor stress = (stressAt(model, tensor::Identity() + e * basis[a], k) -
                               stressAt(model, tensor::Identity() - e * basis[a], k)) /
                              (2 * e);
        for (int b = 0; b < 5; ++b) C(b, a) = stress.cwiseProduct(basis[b]).sum();
    }
    return 1 / along.dot(C.inverse() * along);
}

// 18 equal links of the lattice of spacing dx with G = 1 MPa: without the fit, which changes them next to surfaces
word links18(const structureReference& ref)
{
    return "links lattice18; k_e " + str(1e6 * ref.dx / ref.h, 17) + "; ";
}

const word alongX = "fibres { type uniform; directions ((1 0 0)); } ";

}  // namespace

TEST_CASE("links that stiffen and links along fibres: force, energy and tangent agree")
{
    for (const word& entries :
         {word("stiffening 4;"), alongX + "fibreWeight 3; fibrePower 2;",
          word("stiffening 4; fibreWeight 5; fibres { type helix; point (-3e-3 0 "
               "0); axis (0 0 1); angles "
               "(30); }")})
        for (const bool images : {false, true})
        {
            CAPTURE(entries);
            CAPTURE(images);
            structureReference ref = disorderedBlock(4, 4, 3);
            if (images) ref = quarter(symmetricBody(1e-3), vector::Zero());
            const auto model = springs(ref, "links radius; radius 2.1; E 1e6; " + entries);
            List<vec4> x = shaken(ref, 0.15 * ref.dx);
            for (vec4& v : x) v.s *= simd4{1.3, 0.8, 1, 1};  // keeps the symmetry planes through 0
            CHECK(forceError(*model, x) < 1e-7);
            CHECK(tangentError(*model, x) < 1e-7);
            blockMatrix3 K = model->tangentPattern();
            model->assembleTangent(x, tangentKind::positive, K);
            const Eigen::MatrixXd positive = dense(K);
            CHECK((positive - positive.transpose()).norm() < 1e-13 * positive.norm());
            CHECK(leastEigenvalue(positive) > -1e-13);
            List<vec4> f;
            model->force(x, f);
            vector sum = vector::Zero();
            for (const vec4& v : f) sum += v.xyz();
            if (!images) CHECK(sum.norm() < 1e-13 * largest(f) * ref.n());
        }
}

TEST_CASE(
    "links that stiffen: the affine energy of the lattice, exactly, and the same modulus at rest")
{
    const structureReference ref = latticeBlock(7, 7, 7);
    const label k = middleOf(ref);
    for (const scalar b : {1.0, 6.0})
    {
        const auto linear = springs(ref, links18(ref)),
                   model = springs(ref, links18(ref) + "stiffening " + str(b) + ";");
        for (const vector& axis : {vector(1, 0, 0), vector(vector(1, 1, 1).normalized())})
        {
            CHECK(youngsModulus(*model, axis) == relative(youngsModulus(*linear, axis), 1e-6));
            CHECK(youngsModulus(*model, axis) == relative(3e6, 1e-6));
        }
        for (const scalar l : {0.7, 1.2, 1.6})
        {
            // d/dl of 1/(2V) sum k d0^2 (exp(b e) - 1 - b e)/b^2; stiffness k = G dx of 18 links
            scalar slope = 0;
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (int z = -1; z <= 1; ++z)
                    {
                        const scalar square = x * x + y * y + z * z;
                        if (square == 0 || square == 3) continue;
                        const scalar d = std::sqrt((l * l * x * x + (y * y + z * z) / l) / square);
                        const scalar ofLength =
                            (l * x * x - (y * y + z * z) / (2 * l * l)) / (d * square);
                        slope += 0.5e6 * square * (std::exp(b * (d - 1)) - 1) / b * ofLength;
                    }
            const tensor tau = stressAt(*model, stretch(vector(1, 0, 0), l, 3), k);
            CHECK((tau(0, 0) - tau(1, 1)) / l == relative(slope, 1e-9));
        }
    }
}

TEST_CASE("links along fibres: moduli along and across against the mean over all directions")
{
    const scalar weight = 3;
    const vector fibre = vector(1, 2, 0.5).normalized();
    const word fibres =
        "fibres { type uniform; directions ((1 2 0.5)); } fibreWeight 3; fibrePower ";
    // many links: their directions are nearly even
    const structureReference ref = latticeBlock(9, 9, 9);
    for (const int m : {1, 2})
    {
        const auto model =
            springs(ref, "links radius; radius 4; k_e 1e6; " + fibres + std::to_string(m) + ";");
        const auto plain = springs(ref, "links radius; radius 4; k_e 1e6;");
        const scalar c0 = 1.0 / (2 * m + 1), c2 = 1.0 / (2 * m + 3), c4 = 1.0 / (2 * m + 5);
        const scalar along = 1 + weight * 1.25 * (9 * c4 - 6 * c2 + c0);  // (5.44)
        const scalar S = c0 - 2 * c2 + c4, s4 = 8.0 / 15 + weight * S;    // (5.45)
        const scalar across =
            5 * (s4 / 2 - s4 * s4 / 16 / (4.0 / 15 + weight * (c4 - (c2 - c4) + 0.375 * S)));
        const vector side = fibre.unitOrthogonal();
        const scalar foundAlong = youngsModulus(*model, fibre) / youngsModulus(*plain, fibre),
                     foundAcross = youngsModulus(*model, side) / youngsModulus(*plain, side);
        MESSAGE("power ", m, ": along ", foundAlong, ", even directions ", along, "; across ",
                foundAcross, ", even directions ", across);
        CHECK(foundAlong == relative(along, 0.03));
        CHECK(foundAcross == relative(across, 0.03));
        CHECK(model->shearModulus() == plain->shearModulus());
    }
}

TEST_CASE("links along fibres: stretch along and across them is the affine sum of the lattice")
{
    const structureReference ref = latticeBlock(7, 7, 7);
    const label k = middleOf(ref);
    const auto model =
        springs(ref, links18(ref) + alongX + "fibreWeight 3; fibrePower 2; stiffening 3;");
    const auto exact = [](const vector& axis, scalar l) {
        const tensor F = stretch(axis, l, 3);
        tensor tau = tensor::Zero();
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                {
                    const vector d0(x, y, z);
                    if (d0.isZero(0) || d0.squaredNorm() > 2.5) continue;
                    const vector d = F * d0;
                    const scalar w = 1 + 3 * std::pow(d0.normalized()[0], 4),
                                 force = 1e6 * w * d0.norm() *
                                         std::expm1(3 * (d.norm() / d0.norm() - 1)) / 3;
                    tau += 0.5 * force / d.norm() * d * d.transpose();
                }
        return tau;
    };
    for (const vector& axis : {vector(1, 0, 0), vector(0, 1, 0)})
        for (const scalar l : {0.8, 1.001, 1.3})
        {
            const tensor tau = stressAt(*model, stretch(axis, l, 3), k), wanted = exact(axis, l);
            CHECK((tau - wanted).norm() < 1e-9 * wanted.norm());
        }
    // the sums over the 18 links by hand, (5.45) with sums in place of means
    CHECK(youngsModulus(*model, vector(1, 0, 0)) == relative(0.5e6 * 12.75, 1e-6));
    CHECK(youngsModulus(*model, vector(0, 1, 0)) ==
          relative(0.5e6 * (11 - 5.5 * 5.5 / 15.5), 1e-6));
    const auto plainPower = springs(ref, links18(ref) + alongX + "fibreWeight 3;");
    const scalar ofLattice = youngsModulus(*plainPower, vector(1, 0, 0)) / 3e6;
    MESSAGE("18 links along a fibre: ", ofLattice);
    CHECK(ofLattice == relative(2.25, 1e-6));
    // the factor that the log tells is that of the energy of the whole body
    const auto plain = springs(ref, links18(ref));
    const List<vec4> longer = affine(ref, stretch(vector(1, 0, 0), 1 + 1e-6, 3));
    const word log = plainPower->description(), before = "along the first family ";
    const scalar told = std::stod(log.substr(log.find(before) + before.size()));
    CHECK(told == relative(plainPower->energy(longer) / plain->energy(longer), 1e-3));
    // two families across each other in the plane: alike along both
    const structureReference sheet = latticeBlock(9, 9, 0);
    const auto crossed = springs(sheet,
                                 "links lattice8; G 1e6; fibreWeight 2; fibres { type uniform; "
                                 "directions ((1 0 0) (0 1 0)); }");
    const tensor x = stressAt(*crossed, stretch(vector(1, 0, 0), 1.1, 2), middleOf(sheet)),
                 y = stressAt(*crossed, stretch(vector(0, 1, 0), 1.1, 2), middleOf(sheet));
    CHECK(x(0, 0) == relative(y(1, 1), 1e-9));
}

TEST_CASE("links along fibres: entries without effect and wrong ones are refused")
{
    const structureReference ref = latticeBlock(4, 4, 3), sheet = latticeBlock(6, 6, 0);
    const auto error = [](const structureReference& body, const word& entries) {
        return errorOf([&] { springs(body, "links radius; radius 2.1; E 1e6; " + entries); });
    };
    CHECK(error(ref, "fibreWeight 2;").find("fibres { .. }") != word::npos);
    CHECK(error(ref, "fibrePower 2;").find("fibres { .. }") != word::npos);
    CHECK(error(ref, alongX).find("fibreWeight") != word::npos);
    CHECK(error(ref, alongX + "fibreWeight 0;").find("1e-06") != word::npos);
    CHECK(error(ref, alongX + "fibreWeight 1; fibrePower 0;").find("fibrePower") != word::npos);
    CHECK(error(ref, "stiffening -1;").find("stiffening") != word::npos);
    CHECK(error(sheet, "fibreWeight 1; fibres { type uniform; directions ((0 0 1)); }")
              .find("no effect") != word::npos);
    CHECK(error(ref, alongX + "fibreWeight 1;") == "");
    const word said =
        springs(ref, links18(ref) + alongX + "fibreWeight 3; stiffening 2;")->description();
    CHECK(said.find("stiffening 2") != word::npos);
    CHECK(said.find("links up to 4 times as stiff") != word::npos);
}
