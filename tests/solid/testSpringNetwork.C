// SPDX-License-Identifier: GPL-3.0-or-later
#include "execution.H"
#include "structureChecks.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

const scalar E = 1e6;

}  // namespace

TEST_CASE("At rest a network has no force, no energy and carries no strain")
{
    const structureReference ref = disorderedBlock(5, 5, 4);
    const auto model = springs(ref, "links radius; radius 2.1; E 1e6;");
    List<vec4> f;
    model->force(atRest(ref), f);
    const scalar unit = E * ref.dx * ref.dx;
    for (const vec4& v : f) CHECK(v.xyz().norm() < 1e-14 * unit);
    CHECK(model->energy(atRest(ref)) < 1e-28 * unit * ref.dx);
    CHECK(3 * model->shearModulus() == doctest::Approx(E).epsilon(1e-14));
}

TEST_CASE("The force is the energy's derivative and balances in force and moment")
{
    for (const word links : {"links lattice18; k_e 1e6;", "links radius; radius 2.1; E 1e6;"})
    {
        const structureReference ref = latticeBlock(4, 4, 3);
        const auto model = springs(ref, links);
        const List<vec4> x = shaken(ref, 0.2 * ref.dx);
        CHECK(forceError(*model, x) < 1e-7);
        List<vec4> f;
        model->force(x, f);
        vector sum = vector::Zero(), moment = vector::Zero();
        scalar size = 0;
        for (size_t i = 0; i < f.size(); ++i)
        {
            sum += f[i].xyz(), moment += x[i].xyz().cross(f[i].xyz());
            size += f[i].xyz().norm();
        }
        CHECK(sum.norm() < 1e-14 * size);
        CHECK(moment.norm() < 1e-14 * size * 4 * ref.dx);
    }
}

TEST_CASE("Rigid motions cost nothing")
{
    const structureReference ref = disorderedBlock(5, 4, 4);
    const auto model = springs(ref, "links radius; radius 2.1; E 1e6;");
    const tensor R = Eigen::AngleAxisd(1.1, vector(1, 2, 3).normalized()).toRotationMatrix();
    const List<vec4> x = affine(ref, R, vector(0.1, 0.2, 0.3));
    List<vec4> f;
    model->force(x, f);
    for (const vec4& v : f) CHECK(v.xyz().norm() < 1e-11 * E * ref.dx * ref.dx);
}

TEST_CASE("The full tangent is the force's derivative; the positive one has no negative eigenvalue")
{
    for (const bool images : {false, true})
    {
        CAPTURE(images);
        structureReference ref = latticeBlock(4, 4, 3);
        if (images) ref = quarter(symmetricBody(1e-3), vector::Zero());
        const auto model = springs(ref, "links radius; radius 2.1; E 1e6;");
        List<vec4> x = shaken(ref, 0.15 * ref.dx);
        for (vec4& v : x) v.s *= 0.8;  // squeezed: also keeps the symmetry planes through 0
        CHECK(tangentError(*model, x) < 1e-7);

        blockMatrix3 K = model->tangentPattern();
        model->assembleTangent(x, tangentKind::full, K);
        const Eigen::MatrixXd full = dense(K);
        CHECK((full - full.transpose()).norm() < 1e-13 * full.norm());
        // squeezed links make the full tangent indefinite, which is why it is not used
        CHECK(leastEigenvalue(full) < -1e-5);

        model->assembleTangent(x, tangentKind::positive, K);
        const Eigen::MatrixXd used = dense(K);
        CHECK((used - used.transpose()).norm() < 1e-13 * used.norm());
        CHECK(leastEigenvalue(used) > -1e-13);
    }
}

TEST_CASE("Both tangents agree where every link is stretched")
{
    const structureReference ref = latticeBlock(4, 3, 3);
    const auto model = springs(ref, "links lattice18; E 1e6;");
    const List<vec4> x = affine(ref, 1.1 * tensor::Identity());
    blockMatrix3 full = model->tangentPattern(), positive = full;
    model->assembleTangent(x, tangentKind::full, full);
    model->assembleTangent(x, tangentKind::positive, positive);
    CHECK((dense(full) - dense(positive)).norm() == 0);
}

TEST_CASE("A quarter between two symmetry planes is a quarter of the whole")
{
    const structureReference whole = symmetricBody(1e-3), part = quarter(whole, vector::Zero());
    for (const word links :
         {"links radius; radius 2.1; E 1e6;", "links radius; radius 1.5; k_e 1e6;"})
    {
        CAPTURE(links);
        const auto all = springs(whole, links), one = springs(part, links);
        CHECK(one->shearModulus() == doctest::Approx(all->shearModulus()).epsilon(1e-10));
        // any motion of the quarter, reflected
        const List<vec4> x = shaken(part, 0.2 * part.dx);
        List<vec4> y(x);
        for (const vector& sign : {vector(-1, 1, 1), vector(1, -1, 1), vector(-1, -1, 1)})
            for (const vec4& v : x) y.push_back(vec4::from(sign.cwiseProduct(v.xyz())));
        List<vec4> f, g;
        one->force(x, f);
        all->force(y, g);
        for (label i = 0; i < part.n(); ++i)
            CHECK((f[i].xyz() - g[i].xyz()).norm() < 1e-8 * largest(g));
        CHECK(4 * one->energy(x) == doctest::Approx(all->energy(y)).epsilon(1e-9));
        CHECK(forceError(*one, x) < 1e-6);
        List<tensor> F, Fall;
        one->deformationGradient(x, F);
        all->deformationGradient(y, Fall);
        for (label i = 0; i < part.n(); ++i) CHECK((F[i] - Fall[i]).norm() < 1e-12);
    }
}

TEST_CASE("A cyclic block pulls like an endless one, also through turned images")
{
    isometry turn;
    const structureReference ref = ringSector(turn);
    structureReference ring = ref;
    ring.images.clear();
    const auto sector = springs(ref, "links radius; radius 1.7; k_e 1e6;");
    const List<vec4> x = shaken(ref, 0.1 * ref.dx);
    List<vec4> y;
    ring.x0.clear();
    isometry image;
    for (int copy = 0; copy < 4; ++copy, image.R = turn.R * image.R)
        for (label i = 0; i < ref.n(); ++i)
            ring.x0.push_back(image(ref.x0[i])), y.push_back(vec4::from(image(x[i].xyz())));
    ring.fixed.assign(ring.x0.size(), 0);
    const auto whole = springs(ring, "links radius; radius 1.7; k_e 1e6;");
    List<vec4> f, g;
    sector->force(x, f);
    whole->force(y, g);
    for (label i = 0; i < ref.n(); ++i) CHECK((f[i].xyz() - g[i].xyz()).norm() < 1e-9 * largest(g));
    CHECK(forceError(*sector, x) < 1e-6);
    CHECK(tangentError(*sector, x) < 1e-7);
}

TEST_CASE("Between clamped particles there is no link, towards free ones there is")
{
    structureReference ref = latticeBlock(4, 4, 4);
    for (label i = 0; i < ref.n(); ++i) ref.fixed[i] = ref.x0[i][2] < 2 * ref.dx;
    const auto model = springs(ref, "links lattice18; k_e 1e6;");
    List<vec4> x = atRest(ref), f;
    x[0][0] += 0.3 * ref.dx;  // clamped, its neighbours in the lowest two layers too
    model->force(x, f);
    for (label i = 0; i < ref.n(); ++i) CHECK(f[i].xyz().norm() == 0);
    // a free particle above the clamped ones is held as if nothing were clamped, and pulls at them
    ref.fixed.assign(ref.x0.size(), 0);
    const auto unclamped = springs(ref, "links lattice18; k_e 1e6;");
    x = atRest(ref);
    const label above = 2 * 16 + 5, below = 1 * 16 + 5;
    x[above][2] += 0.3 * ref.dx;
    List<vec4> g;
    model->force(x, f);
    unclamped->force(x, g);
    CHECK(f[above].xyz().norm() > 1e-3);
    CHECK(f[above].xyz() == g[above].xyz());
    CHECK(f[below].xyz() == g[below].xyz());
}

TEST_CASE("Results do not depend on the number of threads")
{
    const structureReference ref = latticeBlock(8, 8, 9);
    setThreads(1);
    const auto one = springs(ref, "links radius; radius 2.1; E 1e6;");
    const List<vec4> x = shaken(ref, 0.1 * ref.dx);
    List<vec4> f, g;
    one->force(x, f);
    const scalar energy = one->energy(x), step = one->stableTimeStep(x, 1e-6);
    setThreads(2);
    const auto two = springs(ref, "links radius; radius 2.1; E 1e6;");
    two->force(x, g);
    CHECK(flat(f, 3) == flat(g, 3));
    CHECK(two->energy(x) == energy);
    CHECK(two->stableTimeStep(x, 1e-6) == step);
    setThreads(0);
}
