// SPDX-License-Identifier: GPL-3.0-or-later
// Solids with sharp tips: particles whose own neighbours lie in one line or plane follow others
#include "errorOf.H"
#include "followerTies.H"
#include "structureChecks.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

// The lattice particles in a triangle (2D) or cone that ends in a tip at y = 0 after a line of `line` particles, and one
// particle beyond it that no chain of neighbours joins to it
structureReference sharpTip(int nDims, int line)
{
    structureReference ref = emptyReference(nDims, 1e-3);
    const scalar dx = ref.dx;
    const auto add = [&](scalar x, scalar y, scalar z) { ref.x0.push_back(dx * vector(x, y, z)); };
    add(0, -1.7, 0);
    for (int j = 0; j < line; ++j) add(0, j, 0);
    for (int j = line; j < line + 3; ++j)
        for (int a = -1; a <= 1; ++a)
            for (int b = nDims == 3 ? -1 : 0; b <= (nDims == 3 ? 1 : 0); ++b) add(a, j, b);
    ref.fixed.assign(ref.x0.size(), 0);
    return ref;
}

List<std::unique_ptr<structureModel>> models(const structureReference& ref)
{
    List<std::unique_ptr<structureModel>> all;
    all.push_back(springs(ref, "links radius; radius 2.1; G 1e6;"));
    all.push_back(structureModel::New(
        dictionary::fromString("structureModel totalLagrangian; material { type neoHookean; G "
                               "1e6; viscosity 1; relaxation { moduli (1); times (1); } }"),
        ref));
    return all;
}

List<structureReference> bodies()
{
    List<structureReference> all{sharpTip(2, 4), sharpTip(3, 4)};
    // half of it behind a plane of symmetry
    structureReference half = emptyReference(2, 1e-3);
    for (const vector& X : sharpTip(2, 3).x0)
        if (X[0] >= 0) half.x0.push_back(X + vector(0.5, 0, 0) * half.dx);
    half.fixed.assign(half.x0.size(), 0);
    half.images = {mirrorAt(0, 0)};
    all.push_back(half);
    return all;
}

}  // namespace

TEST_CASE("a sharp tip takes its gradient from the nearest particles with neighbours all around")
{
    const structureReference ref = sharpTip(2, 4);
    const referenceGradient gradient(ref);
    CHECK(gradient.follows(0));
    CHECK(gradient.follows(1));
    CHECK(!gradient.follows(8));
    tensor A = tensor::Identity();
    A.topLeftCorner<2, 2>() << 1.2, 0.3, 0.05, 0.9;
    List<tensor> F;
    gradient.apply(affine(ref, A, vector(1, 2, 0)), F);
    for (const tensor& Fi : F) CHECK((Fi - A).norm() < 1e-12);
    // forces() is the adjoint of the gradient
    List<tensor> P(F.size()), dF;
    for (size_t i = 0; i < P.size(); ++i) P[i] = tensor::Random();
    List<vec4> f, u = shaken(ref, ref.dx);
    gradient.forces(P, f), gradient.applyLinear(u, dF);
    scalar work = 0, power = 0;
    for (size_t i = 0; i < P.size(); ++i)
    {
        dF[i](2, 2) = 0;
        work += ref.volume() * P[i].cwiseProduct(dF[i]).sum();
        power -= f[i].xyz().dot(u[i].xyz());
    }
    CHECK(power == doctest::Approx(work).epsilon(1e-12));
}

TEST_CASE("a body with a sharp tip has the forces of its energy, in balance, and their tangent")
{
    for (const structureReference& ref : bodies())
        for (const auto& model : models(ref))
        {
            CAPTURE(model->description());
            CAPTURE(ref.nDims);
            const tensor R = Eigen::AngleAxisd(0.8, vector::UnitZ()).toRotationMatrix();
            const scalar unit = 1e6 * ref.volume() / ref.dx;
            List<vec4> f;
            if (ref.images.empty())
            {
                model->force(affine(ref, R, vector(1, 2, 0)), f);
                CHECK(largest(f) < 1e-8 * unit);
            }
            const List<vec4> x = shaken(ref, 0.2 * ref.dx);
            CHECK(forceError(*model, x) < 1e-7);
            CHECK(tangentError(*model, x) < 1e-6);
            blockMatrix3 K = model->tangentPattern();
            model->assembleTangent(x, tangentKind::positive, K);
            CHECK(leastEigenvalue(dense(K)) > -1e-12);
            if (!ref.images.empty()) continue;
            List<tensor> tau;
            model->force(x, f), model->stress(x, tau);
            vector sum = vector::Zero(), moment = vector::Zero();
            tensor virial = tensor::Zero(), stress = tensor::Zero();
            for (size_t i = 0; i < f.size(); ++i)
            {
                sum += f[i].xyz(), moment += x[i].xyz().cross(f[i].xyz());
                virial -= f[i].xyz() * x[i].xyz().transpose(), stress += ref.volume() * tau[i];
            }
            CHECK(sum.norm() < 1e-10 * unit);
            CHECK(moment.norm() < 1e-10 * unit * ref.dx);
            CHECK((virial - stress).topLeftCorner(ref.nDims, ref.nDims).norm() <
                  1e-10 * unit * ref.dx);
        }
}

TEST_CASE("a tip that is moved alone is pulled back")
{
    for (const structureReference& ref : bodies())
        for (const auto& model : models(ref))
        {
            List<vec4> x = atRest(ref), f;
            x[0][0] += 0.1 * ref.dx;
            model->force(x, f);
            CHECK(f[0][0] < -1e-3 * 1e6 * ref.volume() / ref.dx);
            CHECK(model->linkCounts()[0] > 0);
        }
}

TEST_CASE("a wall of one layer has no leaders near it, and is refused")
{
    structureReference ref = sharpTip(2, 12);
    CHECK(errorOf([&] { const referenceGradient gradient(ref); }).find("less than two layers") !=
          word::npos);
}
