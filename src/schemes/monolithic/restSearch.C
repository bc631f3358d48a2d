// SPDX-License-Identifier: GPL-3.0-or-later
#include "restSearch.H"
#include "FGMRES.H"
#include "elasticStep.H"
#include "outsideWall.H"
#include "solidState.H"
#include "stepSources.H"
#include "solidMemory.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// theta of the passes: C of the last pressure leaves little, and what it forgets converges
constexpr scalar memory = 0.5;
// Largest change of the deformation gradient in a pass
constexpr scalar longestPass = 0.2;
// Times that a shear wave takes along the solid: a step so long has no inertia
constexpr scalar longStep = 100;

class restSearch
{
public:
    restSearch(fsiCase& c, const dictionary& dict, const monolithicPreconditioner::entries& e,
               scalar forgotten)
        : c_(c),
          preconditioner_(e),
          forgotten_(forgotten),
          pressure_(pressures(dict.subOrEmptyDict("pressures"))),
          tolerance_(dict.getInRangeOrDefault("tolerance", 1e-12, 1e-2, 1e-4)),
          maxIter_(dict.getInRangeOrDefault<label>("maxIter", 1, 10000, 100)),
          dict_(dict)
    {
        dict.refuseOthers({"pressures", "tolerance", "maxIter"});
    }
    void run();

private:
    List<scalar> pressures(const dictionary& dict) const;
    void hold();
    scalar stepLength() const;
    void setSteadyVolume(const coupledSystem& system, List<scalar> z);
    scalar pass();
    scalar moveRest(const List<scalar>& z, scalar tau);

    fsiCase& c_;
    monolithicPreconditioner::entries preconditioner_;
    scalar forgotten_;       // (1 - theta)/volumeFeedback of (7.21)
    List<scalar> pressure_;  // per zone [Pa]
    scalar tolerance_;
    label maxIter_;
    const dictionary& dict_;
};

List<scalar> restSearch::pressures(const dictionary& dict) const
{
    List<scalar> p(c_.cloud.zones.size(), 0);
    for (const word& zone : dict.keys())
    {
        const label z = c_.cloud.zoneIndex(zone, dict.where(zone));
        if (c_.cloud.zones[z].phase != phaseType::fluid)
            dict.fail(zone,
                      "Zone " + zone + " is solid: a prestress is given by the pressure of fluid");
        p[z] = dict.get<scalar>(zone, dims::pressure);
    }
    return p;
}

// The fluid stands still with its pressure
void restSearch::hold()
{
    particleCloud& cloud = c_.cloud;
    for (label i = 0; i < cloud.n(); ++i)
    {
        scalar p = cloud.Up[i][3];
        if (cloud.isFluid(i))
            p = pressure_[cloud.zone[i]], cloud.pGiven[i] = p,
            cloud.uFixed[i] = cloud.pFixed[i] = 1;
        cloud.Up[i].s = simd4{0, 0, 0, p};
    }
}

scalar restSearch::stepLength() const
{
    Eigen::AlignedBox3d box;
    for (label i = 0; i < c_.cloud.nSolid(); ++i) box.extend(c_.cloud.x[i].xyz());
    return longStep * box.diagonal().norm() * std::sqrt(c_.rho / c_.structure->shearModulus());
}

// Moves the rest places against the motion in which the present shape would come to rest, (7.20).  Returns the largest
// strain of it
scalar restSearch::moveRest(const List<scalar>& z, scalar tau)
{
    const label n = c_.cloud.nSolid();
    List<vec4> d(n);
    forEach(0, n, [&](label i) {
        if (!c_.cloud.uFixed[i]) d[i].s = tau * simd4{z[4 * i], z[4 * i + 1], z[4 * i + 2], 0};
    });
    List<vec4>& rest = c_.cloud.vectors.at(restPlaces);
    List<tensor> change, toRest;
    c_.structure->gradient().applyLinear(d, change);
    c_.structure->gradient().apply(rest, toRest);
    const auto most = [&](const auto& size) { return largestOf(0, n, size); };
    const scalar gradient = most([&](label i) { return change[i].norm(); });
    const scalar share = std::min(scalar(1), longestPass / std::max(gradient, scalar(1e-30)));
    forEach(0, n, [&](label i) { rest[i].s -= vec4::from(share * toRest[i] * d[i].xyz()).s; });
    return most([&](label i) { return scalar(0.5 * (change[i] + change[i].transpose()).norm()); });
}

// (7.21), from the continuity rows of p alone, - C p, which are scaled by dx
void restSearch::setSteadyVolume(const coupledSystem& system, List<scalar> z)
{
    const particleCloud& cloud = c_.cloud;
    for (label i = 0; i < cloud.n(); ++i)
        for (int a = 0; a < 3; ++a) z[4 * i + a] = 0;
    List<scalar> rows(z.size());
    system.apply(z, rows);
    List<scalar>& aim = c_.cloud.scalars[steadyVolume];
    aim.assign(cloud.n(), 1);
    for (label i = 0; i < cloud.nSolid(); ++i)
        if (system.rows().acts(i)) aim[i] += forgotten_ * system.dt() * rows[4 * i + 3] / cloud.dx;
}

scalar restSearch::pass()
{
    particleCloud& cloud = c_.cloud;
    if (solidMemory* memory = c_.structure->memory())
        memory->recall({}), memory->begin(cloud.x, 0), memory->end(cloud.x, 1e30);
    List<tensor> F;
    c_.structure->deformationGradient(cloud.x, F);
    solidSurface surface;
    volumeConstraint volume(*c_.structure);
    const auto outside = outsideWall::New(c_.structureProperties, c_.caseFolder());
    const List<isometry>& images = c_.structure->reference().images;
    surface.initialise(cloud, c_.list, F, images, bool(outside));
    volume.setup(F);
    surface.setup(cloud, c_.list, *c_.kernel, volume.cofactor(), images);

    const scalar tau = stepLength(), t = c_.time.value();
    coupledSystem system(c_);
    system.setStep(t, t);
    elasticStep elastic(c_.structure.get(), elasticStep::entries(dictionary()));
    const auto outsidePressure = outside ? outside->pressureAt(t, system.hydrostatic()) : nullptr;
    List<scalar> p(cloud.nSolid());
    cloud.fillGhosts(cloud.Up, false);
    const scalar mean = surface.meanPressure(cloud.Up, outsidePressure);
    for (label i = 0; i < cloud.nSolid(); ++i) p[i] = volume.acts(i) ? cloud.Up[i][3] - mean : 0;
    const List<vec4> start(cloud.x.begin(), cloud.x.begin() + cloud.nSolid());
    elastic.begin(start, tau, p);
    if (outside)
    {
        outside->setStep(c_, surface, system.hydrostatic(), {tau, t, start});
        elastic.addOutside(outside->force(), outside->resistance());
    }
    system.setup(tau, &volume, &surface, &elastic.tangent());
    monolithicPreconditioner preconditioner(system, preconditioner_);
    preconditioner.setup();

    List<scalar> q(cloud.n(), 0);
    List<tensor> toRest;
    c_.structure->gradient().apply(cloud.vectors.at(restPlaces), toRest);
    forEach(0, cloud.nSolid(), [&](label i) { q[i] = (toRest[i].determinant() - 1) / tau; });
    List<scalar> b, z(4 * cloud.n());
    for (label i = 0; i < cloud.n(); ++i) z[4 * i + 3] = cloud.Up[i][3];
    system.rightHandSide(memory, elastic.force(), q, b);
    solverControls controls;
    controls.tolerance = 0, controls.relTol = 1e-6, controls.absTol = 0, controls.maxIter = 500;
    FGMRES solver(controls, "rest", controls.maxIter);
    solver.solve(system, preconditioner, b, z).print();
    for (label i = 0; i < cloud.nSolid(); ++i) cloud.Up[i][3] = volume.acts(i) ? z[4 * i + 3] : 0;
    setSteadyVolume(system, z);
    return moveRest(z, tau);
}

void restSearch::run()
{
    particleCloud& cloud = c_.cloud;
    const scalar t = c_.time.value();
    cloud.vectors["x0"].assign(cloud.x.begin(), cloud.x.begin() + cloud.n());
    cloud.vectors[restPlaces] = cloud.vectors["x0"];
    c_.makeStructure();
    c_.updateNeighbours(t, t);
    hold();
    scalar strain = 0;
    for (label k = 1; k <= maxIter_; ++k)
    {
        strain = pass();
        c_.makeStructure();
        info() << "Prestress: pass " << k << ", strain " << str(strain, 3) << "\n";
        if (!std::isfinite(strain)) break;
        if (strain > tolerance_) continue;
        c_.updateNeighbours(t, t);  // with the flags of the case
        hydrostaticPart weight(c_);
        weight.setStep(t, t);
        weight.giveBack(cloud);
        keepSolid(c_);
        return;
    }
    throw fatalError("No shape at rest is found for prestress: after " + std::to_string(maxIter_) +
                         " passes its strain still changes by " + str(strain, 3) +
                         ". Is the pressure more than the wall can carry? Try a smaller one",
                     dict_.where());
}

}  // namespace

void findRest(fsiCase& c, const monolithicPreconditioner::entries& e, scalar theta,
              scalar volumeFeedback)
{
    if (!c.structureProperties.found("prestress")) return;
    const dictionary& dict = c.structureProperties.subDict("prestress");
    if (c.structureProperties.get<word>("structureModel") == "springNetwork")
        c.structureProperties.fail("prestress",
                                   "Springs have their rest lengths from the particles' places. "
                                   "Take structureModel totalLagrangian");
    const scalar forgets = std::min(1 - theta, volumeFeedback);
    restSearch search(c, dict, e, forgets > 0 ? forgets / volumeFeedback : 0);
    if (!c.cloud.vectors.count(restPlaces)) search.run();
}

}  // namespace ispf
