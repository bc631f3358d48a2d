// SPDX-License-Identifier: GPL-3.0-or-later
#include "errorOf.H"
#include "execution.H"
#include "homogeneousMotion.H"
#include "structureChecks.H"

#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::test;

namespace
{

const scalar G = 1e6;
const word rubber = "material { type neoHookean; G 1e6; }";

std::unique_ptr<structureModel> lagrangian(const structureReference& ref,
                                           const word& entries = rubber)
{
    return structureModel::New(dictionary::fromString("structureModel totalLagrangian; " + entries),
                               ref);
}

// Neighbours on a lattice move against each other: no gradient sees it
List<vec4> alternating(const structureReference& ref, scalar amplitude)
{
    List<vec4> x = atRest(ref);
    for (vec4& v : x)
    {
        const vector cell = v.xyz() / ref.dx;
        const int sum = int(std::floor(cell[0])) + int(std::floor(cell[1]));
        v[0] += sum % 2 ? amplitude : -amplitude;
    }
    return x;
}

List<structureReference> bodies()
{
    return {latticeBlock(5, 4, 4), disorderedBlock(5, 4, 4), latticeBlock(7, 5, 0)};
}

}  // namespace

TEST_CASE("homogeneous motions without change of volume have the exact stress of the material")
{
    for (const structureReference& ref :
         {disorderedBlock(5, 5, 5), latticeBlock(6, 6, 0), triangularBlock(7, 7)})
        for (const word& name : homogeneousMotions(ref.nDims))
            for (const scalar lambda : {0.6, 0.9, 1.05, 1.5, 2.0})
            {
                CAPTURE(name);
                CAPTURE(lambda);
                const auto model = lagrangian(ref);
                const homogeneousMotion motion =
                    motionOf(name, frameAlong(vector(2, 1, 0)), ref.nDims, lambda);
                const List<char> inside(size_t(ref.n()), 1);
                CHECK(nominalStress(*model, motion, inside) ==
                      doctest::Approx(G * motion.neoHooke).epsilon(1e-10));
            }
}

TEST_CASE("the viscous stress of a uniform rate of strain is 2 eta d, none of it of a turn")
{
    const scalar eta = 3;
    tensor F = tensor::Identity(), L = tensor::Zero();
    F(0, 1) = 0.4, L(0, 1) = 5, L(1, 0) = -2;
    for (const structureReference& ref : {disorderedBlock(5, 5, 5), latticeBlock(6, 6, 0)})
    {
        const auto model =
            lagrangian(ref, "material { type neoHookean; G 1e6; viscosity " + str(eta) + "; }");
        const List<tensor> stretched(size_t(ref.n()), F);
        structureModel::motion m{stretched, stretched, List<tensor>(stretched.size(), L * F)};
        List<tensor> tau, still;
        CHECK(model->stress(m, tau));
        m.rate.assign(stretched.size(), tensor::Zero());
        model->stress(m, still);
        for (size_t k = 0; k < tau.size(); ++k)
            CHECK((tau[k] - still[k] - eta * (L + L.transpose())).norm() < 1e-9 * eta);
    }
}

TEST_CASE("nothing acts at rest and after a rigid motion")
{
    for (const structureReference& ref : bodies())
    {
        const auto model = lagrangian(ref);
        const vector axis = ref.nDims == 2 ? vector(0, 0, 1) : vector(1, 2, 3).normalized();
        const tensor R = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
        const scalar unit = G * ref.volume() / ref.dx;
        List<vec4> f;
        for (const List<vec4>& x : {atRest(ref), affine(ref, R, vector(0.1, 0.2, 0) * ref.dx)})
        {
            model->force(x, f);
            CHECK(largest(f) < 1e-12 * unit);
            CHECK(std::abs(model->energy(x)) < 1e-12 * unit * ref.dx);
        }
        CHECK(model->shearModulus() == G);
    }
}

TEST_CASE(
    "the force is the slope of the energy, balances in force and moment, and its virial is V sum "
    "tau")
{
    for (const structureReference& ref : bodies())
    {
        const auto model = lagrangian(ref);
        const List<vec4> x = shaken(ref, 0.2 * ref.dx);
        CHECK(forceError(*model, x) < 1e-7);
        List<vec4> f;
        List<tensor> tau;
        model->force(x, f);
        model->stress(x, tau);
        vector sum = vector::Zero(), moment = vector::Zero();
        tensor virial = tensor::Zero(), stress = tensor::Zero();
        scalar size = 0;
        for (size_t i = 0; i < f.size(); ++i)
        {
            sum += f[i].xyz(), moment += x[i].xyz().cross(f[i].xyz());
            virial -= f[i].xyz() * x[i].xyz().transpose(), stress += ref.volume() * tau[i];
            size += f[i].xyz().norm();
        }
        CHECK(sum.norm() < 1e-14 * size);
        CHECK(moment.norm() < 1e-14 * size * 5 * ref.dx);
        if (ref.nDims == 2) stress.col(2).setZero(), stress.row(2).setZero();
        CHECK((virial - stress).norm() < 1e-12 * stress.norm());
    }
}

TEST_CASE(
    "the full tangent is the slope of the force, within the pattern; the positive one has no "
    "negative eigenvalue")
{
    List<structureReference> all = bodies();
    all.push_back(quarter(symmetricBody(1e-3), vector::Zero()));
    for (const structureReference& ref : all)
    {
        const auto model = lagrangian(ref);
        List<vec4> x = shaken(ref, 0.15 * ref.dx);
        for (vec4& v : x) v.s *= simd4{0.8, 1.3, 1, 1};  // keeps the symmetry planes through 0
        CHECK(tangentError(*model, x) < 1e-7);
        blockMatrix3 K = model->tangentPattern();
        model->assembleTangent(x, tangentKind::full, K);
        const Eigen::MatrixXd full = dense(K);
        CHECK((full - full.transpose()).norm() < 1e-13 * full.norm());
        CHECK(leastEigenvalue(full) < -1e-5);
        model->assembleTangent(x, tangentKind::positive, K);
        const Eigen::MatrixXd used = dense(K);
        CHECK((used - used.transpose()).norm() < 1e-13 * used.norm());
        CHECK(leastEigenvalue(used) > -1e-12);
        CHECK(leastEigenvalue(used - full) > -1e-12);  // K >= H, section 7.2
    }
}

TEST_CASE("the tangent of rest places that move is the slope of the force where they move back")
{
    structureReference ref = latticeBlock(5, 4, 0);
    const List<vec4> x = atRest(ref);
    const auto forceOf = [&](const List<vec4>& rest, List<vec4>& f) {
        ref.rest.clear();
        for (const vec4& X : rest) ref.rest.push_back(X.xyz());
        lagrangian(ref)->force(x, f);
    };
    List<vec4> rest = shaken(ref, 0.15 * ref.dx), f;
    for (vec4& X : rest) X.s *= simd4{0.8, 1.3, 1, 1};
    forceOf(rest, f);
    const auto model = lagrangian(ref);
    blockMatrix3 J = model->tangentPattern(), back = J.withZeros();
    model->assembleTangent(x, tangentKind::rest, J);
    back.addScaled(-1, J);
    CHECK(slopeError(*model, rest, back, forceOf) < 1e-7);
}

TEST_CASE("with a pressure the tangent has the slope of - p cof F too, and stays positive")
{
    for (const structureReference& ref : bodies())
    {
        const auto model = lagrangian(ref);
        const List<vec4> x = shaken(ref, 0.15 * ref.dx);
        structureReference near = ref;
        near.support = 1.75 * ref.dx * (1 + 1e-6);
        const referenceGradient fit(near);
        List<scalar> p;
        for (label k = 0; k < ref.n(); ++k) p.push_back(G * std::sin(3.0 * k));
        blockMatrix3 K = model->tangentPattern();
        model->assembleTangent(x, tangentKind::full, p, K);
        const auto force = [&](const List<vec4>& y, List<vec4>& f) {
            List<tensor> F;
            List<vec4> turning;
            fit.apply(y, F);
            for (label k = 0; k < ref.n(); ++k)
                F[k] = -p[k] * F[k].determinant() * F[k].inverse().transpose();
            fit.forces(F, turning);
            model->force(y, f);
            for (label k = 0; k < ref.n(); ++k) f[k].s += turning[k].s;
        };
        CHECK(slopeError(*model, x, K, force) < 1e-7);
        model->assembleTangent(x, tangentKind::positive, p, K);
        CHECK(leastEigenvalue(dense(K)) > -1e-12);
    }
}

TEST_CASE("a pressure far below that of the surroundings leaves the tangent half of the material's")
{
    for (const structureReference& ref : bodies())
    {
        const auto model = lagrangian(ref);
        const List<vec4> x = shaken(ref, 0.1 * ref.dx);
        blockMatrix3 K = model->tangentPattern(), alone = K;
        model->assembleTangent(x, tangentKind::positive, alone);
        model->assembleTangent(x, tangentKind::positive, List<scalar>(size_t(ref.n()), -20 * G), K);
        K.addScaled(-0.5, alone);
        CHECK(leastEigenvalue(dense(K)) > -1e-12);
    }
}

TEST_CASE("a motion that no gradient sees has energy and a force against it")
{
    for (const structureReference& ref : {latticeBlock(6, 6, 5), latticeBlock(8, 8, 0)})
    {
        const scalar a = 0.01 * ref.dx;
        const List<vec4> x = alternating(ref, a);
        List<tensor> F;
        const auto model = lagrangian(ref, rubber + "zeroEnergy 0.2;");
        model->deformationGradient(x, F);
        const label middle = ref.nDims == 3 ? (2 * 6 + 3) * 6 + 3 : 3 * 8 + 3;
        CHECK((F[middle] - tensor::Identity()).norm() < 1e-12);
        List<vec4> f;
        model->force(x, f);
        const scalar way = x[middle][0] - ref.x0[middle][0];
        // most of the weight is that of the nearest neighbours, which move by 2 a
        CHECK(f[middle][0] * way < -0.2 * G * ref.volume() * way * way / (ref.dx * ref.dx));
        // the energy is proportional to the entry
        const auto twice = lagrangian(ref, rubber + "zeroEnergy 0.4;");
        const auto none = lagrangian(ref, rubber + "zeroEnergy 0;");
        const scalar without = none->energy(x), once = model->energy(x) - without;
        CHECK(once > 1e-5 * G * ref.volume() * ref.n());
        CHECK(twice->energy(x) - without == doctest::Approx(2 * once).epsilon(1e-9));
    }
}

TEST_CASE("a quarter between two symmetry planes is a quarter of the whole, its tangent too")
{
    const structureReference whole = symmetricBody(1e-3), part = quarter(whole, vector::Zero());
    const auto all = lagrangian(whole), one = lagrangian(part);
    const List<vec4> x = shaken(part, 0.2 * part.dx);
    List<vec4> y(x);
    for (const vector& sign : {vector(-1, 1, 1), vector(1, -1, 1), vector(-1, -1, 1)})
        for (const vec4& v : x) y.push_back(vec4::from(sign.cwiseProduct(v.xyz())));
    List<vec4> f, g;
    one->force(x, f);
    all->force(y, g);
    for (label i = 0; i < part.n(); ++i)
        CHECK((f[i].xyz() - g[i].xyz()).norm() < 1e-9 * largest(g));
    CHECK(4 * one->energy(x) == doctest::Approx(all->energy(y)).epsilon(1e-9));
    CHECK(forceError(*one, x) < 1e-6);
    blockMatrix3 K = one->tangentPattern(), wholeK = all->tangentPattern();
    one->assembleTangent(x, tangentKind::positive, K);
    all->assembleTangent(y, tangentKind::positive, wholeK);
    for (label i = 0; i < part.n(); ++i)
        CHECK((K.diagonal[i] - wholeK.diagonal[i]).norm() < 1e-9 * K.diagonal[i].norm());
}

TEST_CASE("a sector whose images are turned pulls like the ring")
{
    isometry turn;
    const structureReference ref = ringSector(turn);
    structureReference ring = ref;
    ring.images.clear(), ring.x0.clear();
    const List<vec4> x = shaken(ref, 0.1 * ref.dx);
    List<vec4> y;
    isometry image;
    for (int copy = 0; copy < 4; ++copy, image.R = turn.R * image.R)
        for (label i = 0; i < ref.n(); ++i)
            ring.x0.push_back(image(ref.x0[i])), y.push_back(vec4::from(image(x[i].xyz())));
    ring.fixed.assign(ring.x0.size(), 0);
    const auto sector = lagrangian(ref), whole = lagrangian(ring);
    List<vec4> f, g;
    sector->force(x, f);
    whole->force(y, g);
    for (label i = 0; i < ref.n(); ++i) CHECK((f[i].xyz() - g[i].xyz()).norm() < 1e-9 * largest(g));
    CHECK(forceError(*sector, x) < 1e-6);
    CHECK(tangentError(*sector, x) < 1e-7);
}

TEST_CASE("particles among clamped ones alone are left out, towards free ones nothing is")
{
    structureReference ref = latticeBlock(4, 4, 7);
    for (label i = 0; i < ref.n(); ++i) ref.fixed[i] = ref.x0[i][2] < 4 * ref.dx;
    const auto model = lagrangian(ref);
    List<vec4> x = shaken(ref, 0.1 * ref.dx), f;
    CHECK(forceError(*model, x) < 1e-7);
    CHECK(model->linkCounts()[0] == 0);
    CHECK(model->linkCounts().back() > 5);
    // the lowest layer acts on nothing that the points near free particles do not see
    const auto unclamped = [&] {
        structureReference free = ref;
        free.fixed.assign(ref.x0.size(), 0);
        return lagrangian(free);
    }();
    List<vec4> g;
    model->force(x, f);
    unclamped->force(x, g);
    for (label i = 0; i < ref.n(); ++i)
        if (!ref.fixed[i]) CHECK((f[i].xyz() - g[i].xyz()).norm() < 1e-12 * largest(g));
}

TEST_CASE("results do not depend on the number of threads")
{
    const structureReference ref = latticeBlock(8, 8, 9);
    setThreads(1);
    const auto one = lagrangian(ref);
    const List<vec4> x = shaken(ref, 0.1 * ref.dx);
    List<vec4> f, g;
    one->force(x, f);
    const scalar energy = one->energy(x), step = one->stableTimeStep(x, 1e-6);
    setThreads(2);
    const auto two = lagrangian(ref);
    two->force(x, g);
    CHECK(flat(f, 3) == flat(g, 3));
    CHECK(two->energy(x) == energy);
    CHECK(two->stableTimeStep(x, 1e-6) == step);
    setThreads(0);
}

TEST_CASE("wrong entries of totalLagrangian are refused with what is valid")
{
    const auto error = [](const word& entries) {
        return errorOf([&] { lagrangian(latticeBlock(4, 4, 4), entries); });
    };
    CHECK(error("").find("material") != word::npos);
    CHECK(error(rubber + "zeroEnergy -1;").find("0") != word::npos);
    CHECK(error(rubber + "links radius;").find("links") != word::npos);
    CHECK(error("material { type neoHookean; G 1e6; nu 0.5; }").find("nu") != word::npos);
}

namespace
{

// A layer of soft material below one of stiff material, endless along x; the lowest and the highest row are held
structureReference layers(int rows, label softRows)
{
    constexpr int columns = 8;
    structureReference ref = latticeBlock(columns, rows, 0);
    const vector period(columns * ref.dx, 0, 0);
    ref.images = {{tensor::Identity(), period}, {tensor::Identity(), -period}};
    ref.zoneNames = {"soft", "stiff"};
    scalar low = 1e30, high = -1e30;
    for (const vector& x : ref.x0) low = std::min(low, x[1]), high = std::max(high, x[1]);
    for (label i = 0; i < ref.n(); ++i)
    {
        const scalar row = (ref.x0[i][1] - low) / ref.dx;
        ref.zone.push_back(row > softRows - 0.5 ? 1 : 0);
        ref.fixed[i] = row < 0.5 || ref.x0[i][1] > high - 0.5 * ref.dx;
    }
    return ref;
}

}  // namespace

TEST_CASE("layers of two materials, in stiffness up to 1000 to one: shear spreads as in series")
{
    for (const scalar contrast : {1.0, 10.0, 1000.0})
    {
        CAPTURE(contrast);
        constexpr int rows = 20;
        constexpr label softRows = 10;
        const structureReference ref = layers(rows, softRows);
        const auto model = lagrangian(ref,
                                      "materials { soft { type neoHookean; G 1e3; } stiff { "
                                      "type Yeoh; c1 " +
                                          str(500 * contrast, 17) + "; } }");
        CHECK(model->shearModulus(0) == 1e3);
        CHECK(model->shearModulus() == doctest::Approx(1e3 * contrast).epsilon(1e-12));
        // the highest row moves along x by a small way; the free rows find their places
        List<vec4> x = atRest(ref), f;
        const scalar way = 1e-6 * ref.dx;
        for (label i = 0; i < ref.n(); ++i)
            if (ref.fixed[i] && ref.zone[i] == 1) x[i][0] += way;
        model->force(x, f);
        blockMatrix3 K = model->tangentPattern();
        model->assembleTangent(atRest(ref), tangentKind::full, K);
        List<label> row(size_t(ref.n()), -1);
        label n = 0;
        for (label i = 0; i < ref.n(); ++i)
            if (!ref.fixed[i]) row[i] = n, n += 2;
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd b(n);
        for (label i = 0; i < ref.n(); ++i)
        {
            if (row[i] < 0) continue;
            A.block<2, 2>(row[i], row[i]) = K.diagonal[i].topLeftCorner<2, 2>();
            b.segment<2>(row[i]) = f[i].xyz().head<2>();
            for (label s = K.rowStart[i]; s < K.rowStart[i + 1]; ++s)
                if (const label j = row[K.column[s]]; j >= 0)
                    A.block<2, 2>(row[i], j) += K.value[s].topLeftCorner<2, 2>();
        }
        const Eigen::VectorXd u = A.ldlt().solve(b);
        for (label i = 0; i < ref.n(); ++i)
            if (row[i] >= 0) x[i].s += vec4::from({u[row[i]], u[row[i] + 1], 0}).s;
        model->force(x, f);
        scalar pull = 0, most = 0;
        for (label i = 0; i < ref.n(); ++i)
            if (!ref.fixed[i]) most = std::max(most, f[i].xyz().norm());
            else if (ref.zone[i] == 1) pull -= f[i][0];
        // heights between the held rows: the interface lies in the middle
        const scalar height = (rows - 1) / 2.0 * ref.dx;
        const scalar exact = way / (height / 1e3 + height / (1e3 * contrast)) * 8 * ref.dx;
        CHECK(most < 1e-3 * pull);  // of second order in the way
        CHECK(pull == doctest::Approx(exact).epsilon(0.05));
    }
}

TEST_CASE("materials of zones: the same law in two zones is one solid; wrong names are told")
{
    const structureReference ref = layers(8, 4);
    const word law = "{ type neoHookean; G 1e6; }";
    const auto one = lagrangian(ref),
               two = lagrangian(ref, "materials { soft " + law + " stiff " + law + " }");
    const List<vec4> x = alternating(ref, 0.1 * ref.dx);
    List<vec4> f, g;
    one->force(x, f), two->force(x, g);
    for (label i = 0; i < ref.n(); ++i)
        CHECK((f[i].xyz() - g[i].xyz()).norm() < 1e-12 * G * ref.dx);
    // laws of the same G are two materials
    const auto differ = lagrangian(
        ref, "materials { soft " + law + " stiff { type MooneyRivlin; c1 2.5e5; c2 2.5e5; } }");
    CHECK(differ->shearModulus(0) == differ->shearModulus(ref.n() - 1));
    CHECK(differ->material(0) != differ->material(ref.n() - 1));
    CHECK(two->material(0) == two->material(ref.n() - 1));
    const auto error = [&](const word& entries) {
        return errorOf([&] { lagrangian(ref, entries); });
    };
    CHECK(error("materials { soft " + law + " }").find("for the zone stiff") != word::npos);
    CHECK(error("materials { soft " + law + " stiff " + law + " wall " + law + " }")
              .find("soft stiff") != word::npos);
    CHECK(error("zeroEnergy 0.2;").find("exactly one of 'material") != word::npos);
    CHECK(error(rubber + " materials { soft " + law + " stiff " + law + " }").find("exactly one") !=
          word::npos);
}

TEST_CASE(
    "viscosity of Kelvin and Voigt: symmetric, never negative, nothing in rigid motions, 2 eta d "
    "in others")
{
    constexpr scalar eta = 3;
    for (const structureReference& ref : bodies())
    {
        const auto model = lagrangian(ref, "material { type neoHookean; G 1e6; viscosity 3; }");
        REQUIRE(model->damps());
        blockMatrix3 D = model->tangentPattern();
        tensor stretch = tensor::Identity();
        stretch(0, 0) = 1.25, stretch(1, 1) = 0.8, stretch(0, 1) = 0.3;
        const List<vec4> x = affine(ref, stretch, vector::Zero());
        model->assembleDamping(x, D);
        const auto dissipation = [&](const tensor& L) {  // of velocities L x
            List<vec4> u(x.size()), Du(x.size());
            for (size_t i = 0; i < x.size(); ++i) u[i] = vec4::from(L * x[i].xyz());
            D.apply(u, Du);
            scalar sum = 0;
            for (size_t i = 0; i < x.size(); ++i) sum += u[i].xyz().dot(Du[i].xyz());
            return sum;
        };
        tensor spin = tensor::Zero(), shear = tensor::Zero(), pull = tensor::Zero();
        spin(0, 1) = 1, spin(1, 0) = -1, shear(0, 1) = 1, pull(0, 0) = 1, pull(1, 1) = -1;
        const scalar whole = ref.volume() * ref.n();
        CHECK(std::abs(dissipation(spin)) < 1e-10 * eta * whole);
        CHECK(dissipation(shear) == doctest::Approx(eta * whole).epsilon(1e-9));
        CHECK(dissipation(pull) == doctest::Approx(4 * eta * whole).epsilon(1e-9));
    }
    CHECK(!lagrangian(latticeBlock(4, 4, 0))->damps());
}
