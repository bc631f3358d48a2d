// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidMotions.H"
#include "volumeConstraint.H"

#include "relative.H"

using namespace ispf;
using namespace ispf::test;

namespace
{

// Random velocities (and pressures in the fourth component)
List<vec4> noise(label n)
{
    List<vec4> u(n);
    std::mt19937 generator(3);
    std::uniform_real_distribution<scalar> part(-1, 1);
    for (vec4& v : u)
        v.s = simd4{part(generator), part(generator), part(generator), part(generator)};
    return u;
}

struct deformed
{
    structureReference ref = relaxedBlock();
    std::unique_ptr<structureModel> model = springs(ref, "E 1e5; links radius; radius 2.1;");
    List<vec4> x = shaken(ref, 0.1 * ref.dx);
    volumeConstraint volume{*model};

    deformed()
    {
        List<tensor> F;
        model->deformationGradient(x, F);
        volume.setup(F);
    }
    static structureReference relaxedBlock()
    {
        structureReference ref = latticeBlock(7, 6, 5);
        std::mt19937 generator(5);
        std::uniform_real_distribution<scalar> part(-0.1, 0.1);
        for (vector& X : ref.x0)
            X += ref.dx * vector(part(generator), part(generator), part(generator));
        return ref;
    }
};

}  // namespace

TEST_CASE("The rate of J is its derivative in the direction of the velocity")
{
    const deformed d;
    const List<vec4> u = noise(d.ref.n());
    List<scalar> rate;
    d.volume.rate(u, rate);
    const scalar step = 1e-6 * d.ref.dx;
    List<tensor> ahead, behind;
    for (const int side : {1, -1})
    {
        List<vec4> x = d.x;
        for (size_t i = 0; i < x.size(); ++i)
            x[i].s += side * step * simd4{u[i][0], u[i][1], u[i][2], 0};
        d.model->deformationGradient(x, side > 0 ? ahead : behind);
    }
    scalar most = 0, error = 0;
    for (size_t i = 0; i < rate.size(); ++i)
    {
        const scalar exact = (ahead[i].determinant() - behind[i].determinant()) / (2 * step);
        most = std::max(most, std::abs(exact)), error = std::max(error, std::abs(rate[i] - exact));
    }
    CHECK(error < 1e-6 * most);
}

TEST_CASE("What the rate of J misses over a step, from the cofactor's mean: exact")
{
    const deformed d;
    const List<vec4> u = noise(d.ref.n());
    const scalar dt = 0.1 * d.ref.dx;  // a tenth of a spacing
    List<tensor> F0, F1;
    List<scalar> rate, missed;
    d.volume.rate(u, rate);
    d.volume.overStep(u, dt, missed);
    List<vec4> x = d.x;
    for (size_t i = 0; i < x.size(); ++i) x[i].s += dt * simd4{u[i][0], u[i][1], u[i][2], 0};
    d.model->deformationGradient(d.x, F0);
    d.model->deformationGradient(x, F1);
    scalar most = 0, error = 0;
    for (size_t i = 0; i < rate.size(); ++i)
    {
        const scalar exact = F1[i].determinant() - F0[i].determinant();
        most = std::max(most, std::abs(missed[i]));
        error = std::max(error, std::abs(dt * rate[i] + missed[i] - exact));
    }
    CHECK(most > 1e-3);
    CHECK(error < 1e-12);
}

TEST_CASE(
    "The constraint's pressure works with the rate of J; when uniform it moves and turns nothing")
{
    const deformed d;
    const List<vec4> u = noise(d.ref.n());
    List<scalar> rate;
    List<tensor> P(d.ref.n(), tensor::Zero());
    List<vec4> f;
    d.volume.rate(u, rate);
    d.volume.addStress(u, P);
    d.volume.gradient().forces(P, f);
    scalar power = 0, work = 0;
    for (size_t i = 0; i < rate.size(); ++i)
        power += f[i].xyz().dot(u[i].xyz()), work += d.ref.volume() * u[i][3] * rate[i];
    CHECK(power == relative(work, 1e-10));

    P.assign(d.ref.n(), tensor::Zero());
    d.volume.addStress(List<vec4>(d.ref.n(), vec4::from(vector::Zero(), 1)), P);
    d.volume.gradient().forces(P, f);
    vector sum = vector::Zero(), moment = vector::Zero();
    scalar size = 0;
    for (size_t i = 0; i < rate.size(); ++i)
    {
        sum += f[i].xyz(), moment += d.x[i].xyz().cross(f[i].xyz());
        size += f[i].xyz().norm();
    }
    CHECK(sum.norm() < 1e-12 * size);
    CHECK(moment.norm() < 1e-12 * size * 7 * d.ref.dx);
}
