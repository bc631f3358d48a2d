// SPDX-License-Identifier: GPL-3.0-or-later
// coupling projection: the paper's algorithm for fluid and soft walls, explicit springs.  Entries
// of system/sphSolution:
//
//     projection
//     {
//         viscosity      implicit;     // or explicit
//         positionUpdate symplectic;   // or mean, x += dt (u^n + u^{n+1})/2 as in the paper
//         limits { CFL 0.4; force 0.25; viscous 0.125; }
//     }
//     shifting { ... }     solvers { p { ... } U { ... } }
//
// and `divergence`, `gradient` of system/sphSchemes.
#include "particleShifting.H"
#include "projectionLimits.H"
#include "projectionStep.H"

#include <cmath>
#include <ostream>

namespace ispf
{

namespace
{

class projection : public couplingScheme
{
public:
    explicit projection(fsiCase& c)
        : c_(c),
          dict_(c.solution.subOrEmptyDict("projection")),
          explicit_(dict_.chooseOrDefault("viscosity", {"implicit", "explicit"}, "implicit") ==
                    "explicit"),
          mean_(dict_.chooseOrDefault("positionUpdate", {"symplectic", "mean"}, "symplectic") ==
                "mean"),
          limits_(c, explicit_, mean_, dict_.subOrEmptyDict("limits")),
          step_(c.rho, c.mu, explicit_ ? "explicit" : "implicit",
                operatorSchemes::fromDict(c.schemes), c.solution),
          shifting_(c.solution.subOrEmptyDict("shifting"))
    {
        hydrostatic_ = hydrostaticPart();
        info() << "projection: viscosity " << (explicit_ ? "explicit" : "implicit")
               << ", positionUpdate " << (mean_ ? "mean" : "symplectic") << ", shifting "
               << shifting_.describe() << std::endl;
    }

    stepLimit limit() const override { return limits_.ruling(accelerations()); }
    void step(scalar t, scalar dt) override;

private:
    List<vec4> accelerations() const;
    vector hydrostaticPart() const;
    void addHydrostatic(scalar sign);
    List<scalar> sources() const;
    void move(const List<vec4>& before, scalar dt);
    void printCourant(scalar dt) const;

    fsiCase& c_;
    dictionary dict_;
    bool explicit_, mean_;
    projectionLimits limits_;
    projectionStep step_;
    particleShifting shifting_;
    vector hydrostatic_;  // acceleration that the pressure alone carries
};

// The part of a uniform body force that has a potential in this domain, i.e. all but its components
// along cyclic directions.  The equations are solved for p - rho a.x, as with OpenFOAM's p_rgh: fluid
// at rest then stays so exactly, beside walls of any kind.
vector projection::hydrostaticPart() const
{
    if (c_.bodyForce.empty()) return vector::Zero();
    vector a = c_.bodyForce[0];
    for (const vector& other : c_.bodyForce)
        if (other != a) return vector::Zero();
    List<vector> along;
    for (const structureImage& image : c_.walls->images())
    {
        if (!image.R.isIdentity(1e-9)) continue;
        vector t = image.t;
        for (const vector& e : along) t -= t.dot(e) * e;
        if (t.norm() > 1e-6 * image.t.norm()) along.push_back(t.normalized());
    }
    for (const vector& e : along) a -= a.dot(e) * e;
    return a;
}

void projection::addHydrostatic(scalar sign)
{
    if (hydrostatic_.isZero(0)) return;
    particleCloud& cloud = c_.cloud;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar p = sign * c_.rho * hydrostatic_.dot(cloud.x[i].xyz());
        cloud.Up[i][3] += p, cloud.pGiven[i] += p;
    }
}

// Body force of the zone and springs, Eq. (2) of the paper
List<vec4> projection::accelerations() const
{
    const particleCloud& cloud = c_.cloud;
    List<vec4> a(cloud.n());
    if (c_.structure)
    {
        const scalar perMass = 1 / (c_.rho * cloud.volume());
        List<vec4> f;
        c_.structure->force(cloud.x, f);
        for (label i = 0; i < cloud.nSolid(); ++i) a[i].s = perMass * f[i].s;
    }
    if (!c_.bodyForce.empty())
        for (label i = 0; i < cloud.n(); ++i)
            a[i].s += vec4::from(c_.bodyForce[cloud.zone[i]] - hydrostatic_).s;
    for (label i = 0; i < cloud.n(); ++i)
        if (cloud.uFixed[i]) a[i] = vec4{};
    return a;
}

List<scalar> projection::sources() const
{
    List<scalar> q;
    if (c_.source.empty()) return q;
    for (label i = 0; i < c_.cloud.n(); ++i) q.push_back(c_.source[c_.cloud.zone[i]]);
    return q;
}

void projection::move(const List<vec4>& before, scalar dt)
{
    particleCloud& cloud = c_.cloud;
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const simd4 u = mean_ ? 0.5 * (before[i].s + cloud.Up[i].s) : cloud.Up[i].s;
            cloud.x[i].s += dt * simd4{u[0], u[1], u[2], 0};
        }
    });
}

void projection::printCourant(scalar dt) const
{
    const particleCloud& cloud = c_.cloud;
    scalar sum = 0, most = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar Co = cloud.Up[i].xyz().norm() * dt / cloud.dx;
        sum += Co, most = std::max(most, Co);
    }
    info() << "Courant Number mean: " << sum / cloud.n() << " max: " << most << std::endl;
}

void projection::step(scalar t, scalar dt)
{
    printCourant(dt);
    c_.updateNeighbours(t, t + dt);
    particleCloud& cloud = c_.cloud;
    const stencil s{cloud, c_.list, c_.correction};
    const List<vec4> before = mean_ ? cloud.Up : List<vec4>();
    const List<scalar> q = sources();

    step_.predict(cloud, s, accelerations(), dt);
    addHydrostatic(-1);
    step_.project(cloud, s, q, c_.kernel->support(), dt);
    addHydrostatic(1);
    step_.printContinuityErrors(cloud, s, q, dt);
    cloud.checkFinite(t + dt);

    // shifted with the neighbours at hand, then moved
    shifting_.shift(cloud, c_.list, c_.correction, dt,
                    [&](const vector& x) { return c_.walls->nearOpen(x); });
    move(before, dt);
    c_.walls->exchange(cloud, t + dt);
}

}  // namespace

std::unique_ptr<couplingScheme> newProjection(fsiCase& c)
{
    return std::make_unique<projection>(c);
}

}  // namespace ispf
