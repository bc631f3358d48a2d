// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundaryContent.H"

#include <algorithm>
#include <limits>

namespace ispf
{

boundary::~boundary() = default;

void boundary::content::setStep(const stepTimes& times)
{
    for (const auto& p : patches) p->setStep(times);
    rims.check(times.end);
}

void boundary::setStep(const stepTimes& times)
{
    content_->t0 = times.start;
    content_->walls.setStep(times.start, times.end);
    if (times.at != times.start) content_->walls.moveTo(times.at);
    content_->group.setTime(times.pressures);
    content_->setStep(times);
}

void boundary::setStepBehind(scalar t0, scalar t1)
{
    setStep(t0, t1);
    content_->walls.moveTo(t1);
}

openFace::movingWalls boundary::content::movingWalls() const
{
    return {walls.anyMoves(),
            [&](const vector& x, scalar distance) { return walls.movingWithin(x, distance); },
            [&](const vector& x, scalar distance) { return walls.movedOver(x, distance); }};
}

void boundary::setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce) const
{
    std::fill(cloud.pFixed.begin(), cloud.pFixed.end(), 0);
    std::fill(cloud.uFixed.begin() + cloud.nSolid(), cloud.uFixed.end(), 0);
    if (const auto given = cloud.vectors.find(givenVelocity); given != cloud.vectors.end())
        std::fill(given->second.begin(), given->second.end(), vec4{});
    cloud.entering.assign(1, std::numeric_limits<scalar>::quiet_NaN());
    for (const auto& p : content_->patches) p->setFlags(cloud, rho, bodyForce);
    cloud.strip.assign(cloud.n(), 0), cloud.stripArea.assign(1, vector::Zero());
    cloud.stripIntake.assign(1, 0);
    const openFace::movingWalls moving = content_->movingWalls();
    for (const auto& p : content_->patches) p->setStrip(cloud, moving);
}

bool boundary::hasCyclic() const
{
    return content_->any([](const patch& p) { return p.pair() != nullptr; });
}

bool boundary::hasOpen() const
{
    return content_->any([](const patch& p) { return p.face() != nullptr; });
}

void boundary::setOpenVelocity(particleCloud& cloud, const List<vec4>& friction, scalar rho,
                               scalar dt) const
{
    for (const auto& p : content_->patches) p->follow(cloud, friction, rho, dt);
}

bool boundary::outletsAgree(const particleCloud& cloud, scalar rho, scalar dt) const
{
    List<outletPressure::solved> all;
    for (const auto& p : content_->patches) p->addOutlet(cloud, rho, dt, all);
    return outletPressure::agree(std::move(all));
}

List<outletLink> boundary::outletLinks() const
{
    List<outletLink> all;
    for (const auto& p : content_->patches) p->addLink(all);
    return all;
}

void boundary::updateGhosts(particleCloud& cloud) const
{
    cloud.clearGhosts();
    content_->walls.addRigid(cloud);
    content_->walls.addSurface(cloud);
    content_->facing.assign(cloud.nGhosts(), vector::Zero());
    content_->mirror.addImages(cloud, content_->walls, content_->facing);
    content_->group.addImages(cloud, content_->facing);
}

neighbourList::visibility boundary::visible(const particleCloud& cloud) const
{
    return content_->visibility.test(cloud, content_->walls, content_->facing);
}

// Reflects fluid that has passed a symmetry plane, and moves fluid that has passed a cyclic side to the other side.
// All vector fields of a particle turn with it
List<label> boundary::content::putBack(particleCloud& cloud) const
{
    List<label> turned(balance.size(), 0);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        vector x = cloud.x[i].xyz();
        tensor R = tensor::Identity();
        imageGroup::wayHome back = group.wayBack(x);
        if (!back.map) continue;
        for (int k = 0; back.map && k < 8; ++k)
        {
            const structureImage& map = *back.map;
            x = map(x), R = map.R * R, cloud.Up[i][3] += group.pressureOffset(map);
            for (const patchBalance& b : balance)
                if (back.reflects && b.name == *back.patch) ++turned[&b - balance.data()];
            back = group.wayBack(x);
        }
        cloud.x[i].setXyz(x), cloud.Up[i].setXyz(R * cloud.Up[i].xyz());
        if (R == tensor::Identity()) continue;
        for (auto& [name, field] : cloud.vectors)
            if (label(field.size()) > i) field[i].setXyz(R * field[i].xyz());
    }
    return turned;
}

void boundary::bringHome(particleCloud& cloud) const
{
    cloud.clearGhosts();
    content_->putBack(cloud);
}

vector boundary::wayOverCyclic(const vector& x) const
{
    return content_->group.wayOverCyclic(x);
}

void boundary::limitShift(const particleCloud& cloud, label i, scalar gap, vector& dr) const
{
    if (nearOpen(i)) dr.setZero();
    if (!dr.isZero(0)) content_->guard.limitShift(cloud, content_->walls, i, gap, dr);
}

void boundary::limitApproach(particleCloud& cloud, scalar gap, scalar dt) const
{
    if (!content_->walls.empty()) content_->guard.limitApproach(cloud, content_->walls, gap, dt);
}

List<nearWall> boundary::wallsNear(const vector& x, const vector& rest, scalar reach) const
{
    List<nearWall> near;
    const wallSet& walls = content_->walls;
    for (const wallSet::body& b : walls.bodies())
    {
        const bodyFrame& frame = walls.frame(b);
        const vector X = frame.toBody(x);
        if (b.surface->surelyFar(X)) continue;
        const surfaceFoot f = b.surface->find(X);
        if (!f.found || f.aside > 0 || !(-f.depth < reach)) continue;
        const surfaceFoot then = b.surface->find(rest);
        near.push_back({frame.turn(f.normal), frame.toSpace(f.foot),
                        then.found ? std::max(-then.depth, scalar(0)) : reach});
    }
    return near;
}

// Moves the walls to the end t1 of the step, puts fluid back before them, and balances what they sweep
label boundary::content::guardWalls(particleCloud& cloud, scalar t1)
{
    walls.moveTo(t0);
    guard.rememberWalls(walls);
    const List<scalar> swept = walls.moveTo(t1);
    leaving.check(t1, cloud.dx);
    if (walls.empty()) return 0;
    const List<label> perWall = guard.apply(cloud, walls);
    label pushed = 0;
    for (size_t k = 0; k < perWall.size(); ++k)
    {
        patchBalance& b = balance[walls.walls()[k].index];
        b.swept += swept[k], b.pushed += perWall[k], b.flux = -swept[k] / (t1 - t0);
        pushed += perWall[k];
    }
    return pushed;
}

label boundary::exchange(particleCloud& cloud, scalar t1)
{
    content& c = *content_;
    const auto forPatches = [&](const auto& visit) {
        for (size_t k = 0; k < c.patches.size(); ++k) visit(*c.patches[k], c.balance[k]);
    };
    cloud.clearGhosts();
    forPatches([&](const patch& p, patchBalance& b) { p.measure(cloud, t1 - c.t0, b); });
    forPatches([&](const patch& p, patchBalance&) { p.keepAlongNormals(cloud); });
    const label pushed = c.guardWalls(cloud, t1);
    const List<label> turned = c.putBack(cloud);
    for (size_t k = 0; k < turned.size(); ++k) c.balance[k].pushed += turned[k];
    const openFace::movingWalls moving = c.movingWalls();
    forPatches([&](const patch& p, patchBalance& b) { p.exchange(cloud, moving, c.t0, t1, b); });
    // sets z to zero: rounding errors of surfaces would grow, and nothing else keeps a two-dimensional case flat
    for (label i = cloud.nSolid(); cloud.nDims == 2 && i < cloud.n(); ++i)
        cloud.x[i][2] = cloud.Up[i][2] = 0;
    if (!c.walls.empty()) c.guard.remember(cloud);
    c.walls.cover(cloud);
    return pushed;
}

List<structureImage> boundary::images() const
{
    return content_->group.maps();
}

scalar boundary::pressureOffset(const structureImage& image) const
{
    return content_->group.pressureOffset(image);
}

vector boundary::pressureSlope() const
{
    return content_->group.pressureSlope();
}

List<std::pair<vector, vector>> boundary::symmetryPlanes() const
{
    return content_->group.symmetryPlanes();
}

scalar boundary::symmetryFactor() const
{
    return content_->group.symmetryFactor();
}

triSurface boundary::surfaceOf(const word& name, const particleCloud& cloud,
                               const fileLocation& where) const
{
    boundBox region;
    for (label i = 0; i < cloud.n(); ++i) region.add(cloud.x[i].xyz());
    region.min.array() -= 0.5 * cloud.dx, region.max.array() += 0.5 * cloud.dx;
    const wall& w = content_->walls.named(name, where);
    const triSurface s =
        content_->walls.surfaceOf(label(&w - content_->walls.walls().data()), region);
    return s.subset([&](label t) { return content_->group.beyond(s.centre(t)) < 1e-6 * cloud.dx; });
}

List<word> boundary::openFaces() const
{
    List<word> names;
    for (const auto& p : content_->patches)
        if (p->face()) names.push_back(p->name());
    return names;
}

const triSurface& boundary::openSurface(const word& name) const
{
    for (const auto& p : content_->patches)
        if (p->face() && p->name() == name) return p->face()->mesh().surface();
    throw fatalError("There is no open face '" + name + "'. " + validWords("face", openFaces()));
}

bool boundary::isTwoSided(const word& name) const
{
    return content_->walls.named(name).twoSided;
}

List<word> boundary::wallNames() const
{
    List<word> names;
    for (const wall& w : content_->walls.walls()) names.push_back(w.name);
    return names;
}

List<word> boundary::noSlipWalls() const
{
    List<word> names;
    for (const wall& w : content_->walls.walls())
        if (!w.slip) names.push_back(w.name);
    return names;
}

List<word> boundary::movingWalls() const
{
    List<word> names;
    for (const wall& w : content_->walls.walls())
        if (w.motion.moves() || w.motion.slides()) names.push_back(w.name);
    return names;
}

vector boundary::wallVelocity(const word& name, const vector& x) const
{
    return content_->walls.named(name).velocity.at(x);
}

scalar boundary::maxGivenSpeed() const
{
    scalar most = content_->walls.maxSpeed();
    for (const auto& p : content_->patches) most = std::max(most, p->givenSpeed());
    return most;
}

sweptRates boundary::swept(const particleCloud& cloud) const
{
    sweptRates r = content_->wetted.rates(content_->walls, cloud);
    for (const auto& p : content_->patches) p->addSwept(cloud, r);
    return r;
}

bool boundary::inside(const vector& x) const
{
    return content_->group.beyond(x) <= 0 && content_->walls.inside(x);
}

bool boundary::nearOpen(label i) const
{
    return content_->any([&](const patch& p) { return p.near(i); });
}

bool boundary::reachesBeyondOpen(label i, scalar reach) const
{
    return content_->any([&](const patch& p) { return p.reachesBeyond(i, reach); });
}

}  // namespace ispf
