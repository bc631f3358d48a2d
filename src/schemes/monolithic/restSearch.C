// SPDX-License-Identifier: GPL-3.0-or-later
#include "restSearch.H"
#include "FGMRES.H"
#include "elasticStep.H"
#include "forPairs.H"
#include "outsideWall.H"
#include "rigidMotion.H"
#include "solidState.H"
#include "stepSources.H"
#include "solidMemory.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

// theta of the passes: C of the last pressure leaves little, and what it forgets converges
constexpr scalar memory = 0.5;
// Largest change of the deformation gradient in a pass
constexpr scalar longestPass = 0.2;
// Times that a shear wave takes along the solid: a step so long has no inertia
constexpr scalar longStep = 10;
constexpr scalar nothing = 1e-12;  // strain that is rounding

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
          dict_(dict),
          outside_(c.structureProperties, c.caseFolder()),
          hydrostatic_(c)
    {
        dict.refuseOthers({"pressures", "tolerance", "maxIter"});
    }
    void run();

private:
    List<scalar> pressures(const dictionary& dict) const;
    void hold();
    void warnOfFaces() const;
    void lookAtShape();
    void setForces(elasticStep& elastic, scalar tau);
    List<scalar> missingVolume(scalar tau) const;
    void release(const List<vec4>& velocities);
    void holdBodies(List<vec4>& w) const;
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
    outsideWall outside_;
    std::unique_ptr<volumeConstraint> volume_;
    solidSurface surface_;
    List<tensor> toRest_;  // dX/dx
    hydrostaticPart hydrostatic_;
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
    }
    for (size_t z = 0; z < p.size(); ++z)  // patterns too
        if (const word& zone = c_.cloud.zones[z].name;
            c_.cloud.zones[z].phase == phaseType::fluid && dict.found(zone))
            p[z] = dict.get<scalar>(zone, dims::pressure);
    return p;
}

// Warns once of an open face whose pressure differs from that of its fluid by more than the tolerance of the search
void restSearch::warnOfFaces() const
{
    const particleCloud& cloud = c_.cloud;
    const scalar largest =
        std::abs(*std::max_element(pressure_.begin(), pressure_.end(),
                                   [](scalar a, scalar b) { return std::abs(a) < std::abs(b); }));
    for (label i = 0; i < cloud.n(); ++i)
    {
        if (!cloud.pFixed[i]) continue;
        const scalar p = cloud.pGiven[i] -
                         c_.rho * hydrostatic_.acceleration().dot(cloud.x[i].xyz()),
                     asked = pressure_[cloud.zone[i]];
        if (std::abs(p - asked) <= tolerance_ * largest) continue;
        return warning("The open face at " + cloud.describe(i) + " has " + str(p, 6) +
                       " Pa at the start, and prestress.pressures has " + str(asked, 6) +
                       " Pa in zone " + cloud.zones[cloud.zone[i]].name +
                       ": the solid will not start at rest. Give both the same");
    }
}

// Holds the fluid still with its pressure, less the level that the run will take off.  The forces of a level cancel but for
// what the areas of the surface miss, and the rest would have to balance what is left
void restSearch::hold()
{
    particleCloud& cloud = c_.cloud;
    const scalar t = c_.time.value();
    hydrostatic_.setStep(t, t);
    lookAtShape();
    const scalar level = hydrostatic_.setLevel(cloud, outside_.mostlyWet(), outside_.level(t, t));
    warnOfFaces();
    for (label i = 0; i < cloud.n(); ++i)
    {
        scalar p = cloud.Up[i][3];
        if (cloud.isFluid(i))
            p = pressure_[cloud.zone[i]] - level, cloud.pGiven[i] = p,
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

// A force or a moment on a body as a whole has no rest: a body that no clamp and no image holds keeps its place and its turn
void restSearch::holdBodies(List<vec4>& w) const
{
    const label n = c_.cloud.nSolid();
    const List<vec4>& rest = c_.cloud.vectors.at(restPlaces);
    const referenceNeighbours& pairs = c_.structure->gradient().neighbours();
    const List<label> bodyOf = c_.structure->tangentPattern().connectedSets();
    List<rigidMotion> of(n);  // at the first particle of each body
    for (label i = 0; i < n; ++i)
    {
        rigidMotion& body = of[bodyOf[i]];
        body.add(rest[i].xyz(), w[i].xyz());
        forNeighbours<among::all>(
            pairs, i, [&](pairIndex p, label) { body.held = body.held || pairs.image[p]; });
        body.held = body.held || c_.cloud.uFixed[i];
    }
    for (label i = 0; i < n; ++i)
        if (const rigidMotion& body = of[bodyOf[i]]; !body.held)
            w[i] = vec4::from(w[i].xyz() - body.at(rest[i].xyz()));
}

// (7.20).  Returns the largest strain of the rest in it
scalar restSearch::moveRest(const List<scalar>& z, scalar tau)
{
    const label n = c_.cloud.nSolid();
    List<vec4> w(n);
    forEach(0, n, [&](label i) {
        const vector u(z[4 * i], z[4 * i + 1], z[4 * i + 2]);
        if (!c_.cloud.uFixed[i]) w[i] = vec4::from(tau * toRest_[i] * u);
    });
    holdBodies(w);
    List<tensor> change;  // over places at rest: a turn of the rest has no strain
    c_.structure->gradient().applyLinear(w, change);
    forEach(0, n, [&](label i) { change[i] *= toRest_[i].inverse().eval(); });
    const auto most = [&](const auto& size) { return largestOf(0, n, size); };
    const scalar gradient = most([&](label i) { return change[i].norm(); });
    const scalar share = std::min(scalar(1), longestPass / std::max(gradient, scalar(1e-30)));
    List<vec4>& rest = c_.cloud.vectors.at(restPlaces);
    forEach(0, n, [&](label i) { rest[i].s -= share * w[i].s; });
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

// Sets surface and volume for the first shape, where F = 1
void restSearch::lookAtShape()
{
    particleCloud& cloud = c_.cloud;
    const List<tensor> F(cloud.nSolid(), tensor::Identity());
    const List<isometry>& images = c_.structure->reference().images;
    volume_ = std::make_unique<volumeConstraint>(*c_.structure);
    volume_->setup(F);
    surface_.initialise(cloud, c_.list, F, images);
    surface_.setup(cloud, c_.list, *c_.kernel, volume_->cofactor(), images);
    outside_.find(c_, surface_);
    c_.structure->gradient().apply(cloud.vectors.at(restPlaces), toRest_);
}

// Sets the forces and the tangent at the first shape
void restSearch::setForces(elasticStep& elastic, scalar tau)
{
    const scalar t = c_.time.value();
    const List<vec4> x(c_.cloud.x.begin(), c_.cloud.x.begin() + c_.cloud.nSolid());
    const auto outsidePressure = outside_.pressureAt(t, hydrostatic_);
    c_.cloud.fillGhosts(c_.cloud.Up, false);
    elastic.begin(x, tau, surface_.overSurface(c_.cloud.Up, *volume_, outsidePressure));
    if (!outsidePressure) return;
    outside_.setStep(c_, surface_, hydrostatic_, {tau, t, x});
    elastic.addOutside(outside_.force(), nullptr);  // its springs have no length yet
}

// det(dX/dx) - 1, over tau: the source with which the rest gets the volume of the image
List<scalar> restSearch::missingVolume(scalar tau) const
{
    List<scalar> q(c_.cloud.n(), 0);
    forEach(0, c_.cloud.nSolid(), [&](label i) { q[i] = (toRest_[i].determinant() - 1) / tau; });
    return q;
}

// One linear system: keeps its pressures, moves the rest places.  Returns the largest strain, not finite if the system has not
// been solved
scalar restSearch::pass()
{
    particleCloud& cloud = c_.cloud;
    if (solidMemory* past = c_.structure->memory())
        past->recall({}), past->begin(cloud.x, 0), past->end(cloud.x, 1e30);
    lookAtShape();
    const scalar tau = stepLength();
    coupledSystem system(c_);
    system.setStep(c_.time.value(), c_.time.value());
    elasticStep elastic(c_.structure.get(), elasticStep::entries(dictionary()));
    setForces(elastic, tau);
    system.setup(tau, volume_.get(), &surface_, &elastic.tangent(), &elastic.stiffness());
    monolithicPreconditioner preconditioner(system, preconditioner_);
    preconditioner.setup();  // with the tangent of a step, which is positive
    elastic.moveRest(toRest_), volume_->moveRest(toRest_);

    List<scalar> b, z(4 * cloud.n());
    for (label i = 0; i < cloud.n(); ++i) z[4 * i + 3] = cloud.Up[i][3];
    system.rightHandSide(memory, elastic.force(), missingVolume(tau), b);
    solverControls controls;
    controls.tolerance = 0, controls.relTol = 1e-6, controls.absTol = 0, controls.maxIter = 500;
    FGMRES solver(controls, "rest", controls.maxIter);
    const solverPerformance result = solver.solve(system, preconditioner, b, z);
    result.print();
    if (!result.converged) return std::numeric_limits<scalar>::infinity();
    for (label i = 0; i < cloud.nSolid(); ++i) cloud.Up[i][3] = volume_->acts(i) ? z[4 * i + 3] : 0;
    setSteadyVolume(system, z);
    return moveRest(z, tau);
}

// Gives back what hold() has taken, and the hydrostatic part
void restSearch::release(const List<vec4>& velocities)
{
    particleCloud& cloud = c_.cloud;
    const scalar t = c_.time.value();
    forEach(0, cloud.n(), [&](label i) { cloud.Up[i].setXyz(velocities[i].xyz()); });
    c_.updateNeighbours(t, t);  // with the flags of the case
    hydrostatic_.giveBack(cloud);
    keepSolid(c_);
}

void restSearch::run()
{
    particleCloud& cloud = c_.cloud;
    const scalar t = c_.time.value();
    cloud.vectors["x0"].assign(cloud.x.begin(), cloud.x.begin() + cloud.n());
    cloud.vectors[restPlaces] = cloud.vectors["x0"];
    c_.makeStructure();
    c_.updateNeighbours(t, t);
    const List<vec4> velocities(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    hold();
    scalar strain = 0;
    for (label k = 1; k <= maxIter_; ++k)
    {
        strain = pass();
        if (k == 1 && strain < nothing)
            c_.structureProperties.fail(
                "prestress",
                "Nothing loads the solid at the start, so that it is at rest as it is. Give "
                "`pressures` of the fluid's zones, or leave it away");
        c_.makeStructure();
        info() << "Prestress: pass " << k << ", strain " << str(strain, 3) << "\n";
        if (strain <= tolerance_) return release(velocities);
        if (!std::isfinite(strain)) break;
    }
    throw fatalError(
        "No shape at rest is found for prestress: the last pass changes its strain by " +
            str(strain, 3) + ", and " + str(tolerance_, 3) + " is asked for (tolerance, maxIter " +
            std::to_string(maxIter_) +
            "). Would the rest be so narrow that the particles cannot tell it, or is the pressure "
            "more than the wall can carry? Then try a smaller one",
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
    const auto rest = c.cloud.vectors.find("x0");
    if (c.time.timeIndex() > 0 && !c.cloud.vectors.count(restPlaces))
        c.structureProperties.fail(
            "prestress", "The case has run without it until " + c.time.timeName() +
                             " s, and it belongs to the start. Remove the time folders but the "
                             "first, or leave it away");
    if (rest != c.cloud.vectors.end() && !c.cloud.vectors.count(restPlaces))
        for (label i = 0; i < c.cloud.nSolid(); ++i)
            if ((rest->second[i].xyz() - c.cloud.x[i].xyz()).norm() > 1e-6 * c.cloud.dx)
                c.structureProperties.fail(
                    "prestress",
                    "It finds the places at rest, and 'rest' of system/particleDict "
                    "gives them. Leave one of the two away");
    const scalar forgets = std::min(1 - theta, volumeFeedback);
    restSearch search(c, dict, e, forgets > 0 ? forgets / volumeFeedback : 0);
    if (!c.cloud.vectors.count(restPlaces)) search.run();
    else
        info() << "prestress: the places at rest were found at the start; its pressures count "
                  "there alone\n";
}

}  // namespace ispf
