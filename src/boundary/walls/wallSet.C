// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallSet.H"
#include "siteFile.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ispf
{

void wallSet::read(const word& caseFolder, const dictionary& patches, const imageGroup& group,
                   const particleCloud& cloud, scalar support, scalar t0)
{
    support_ = support, nDims_ = cloud.nDims, dx_ = cloud.dx, group_ = &group;
    for (const wall& w : walls_)
        if (nDims_ == 2 && !w.motion.inPlane())
            patches.subDict(w.name).fail(patches.subDict(w.name).found("motion")     ? "motion"
                                         : patches.subDict(w.name).found("velocity") ? "velocity"
                                                                                     : "rotation",
                                         "The case is two-dimensional, in x and y: patch " +
                                             w.name +
                                             " must not move along z nor turn about another axis");
    lattice_.set(group, cloud, support);
    if (empty()) return;
    makeBodies(caseFolder, patches, group, support + cloud.dx);
    for (wall& w : walls_) w.moveTo(t0);
    checkSides(patches, cloud);
    // walls are at displacement zero whatever the time, so that every restart finds the same data
    for (wall& w : walls_) w.frame = bodyFrame();
    readRigid(caseFolder, patches);
    // rigid particles beyond symmetry planes and cyclic sides are images of others
    for (wall& w : walls_)
        std::erase_if(w.rigid, [&](const vector& x) { return group.beyond(x) > 1e-6 * cloud.dx; });
    findFeet();
    makeElements(cloud);
    cover(cloud);
}

// Finds the feet of the rigid particles.  A rigid particle of a rotating wall has the velocity at its foot: its own velocity
// would turn the fluid twice.  Viscosity needs the distance to the wall
void wallSet::findFeet()
{
    for (const body& b : bodies_)
        for (const label index : b.walls)
        {
            wall& w = walls_[index];
            if (w.plane) continue;
            for (const vector& x : w.rigid)
            {
                const surfaceFoot f = b.surface->find(x);
                w.rigidFoot.push_back(f.found ? f.foot : x);
            }
        }
}

void wallSet::makeBodies(const word& caseFolder, const dictionary& patches, const imageGroup& group,
                         scalar reach)
{
    triSurface still;
    List<label> stillWalls;
    for (label w = 0; w < label(walls_.size()); ++w)
    {
        const wall& own = walls_[w];
        if (own.plane)
        {
            bodies_.push_back({patchSurface::plane(own.point, own.normal, reach), {w}});
            continue;
        }
        const dictionary& dict = patches.subDict(own.name);
        triSurface surface = readPatch(caseFolder, own.name, dict);
        if (const scalar share = own.motion.leavesItself(surface); share > 0.1)
            dict.fail(dict.found("velocity") ? "velocity" : "rotation",
                      "The surface stays where it is, and slides or turns in itself, but " +
                          str(100 * share, 2) +
                          " % of this velocity points out of it. Name the faces that slide a patch "
                          "of their own, or let the wall itself move with motion { ... }");
        if (own.motion.moves() || own.twoSided)
            bodies_.push_back(
                {patchSurface::triangles(std::move(surface), group, reach, own.twoSided),
                 {w},
                 own.twoSided});
        else still.append(surface), stillWalls.push_back(w);
    }
    if (!stillWalls.empty())
        bodies_.push_back({patchSurface::triangles(std::move(still), group, reach), stillWalls});
    for (body& b : bodies_)
        if (const triSurface* mesh = b.surface->mesh()) b.bounds = mesh->bounds();
}

// fatalError if particles are on the wrong side: shows normals that point the wrong way, and surfaces in millimetres
void wallSet::checkSides(const dictionary& patches, const particleCloud& cloud) const
{
    List<label> before(walls_.size(), 0), behind(walls_.size(), 0);
    for (const body& b : bodies_)
        for (label i = 0; i < cloud.n(); ++i)
        {
            const vector x = frame(b).toBody(cloud.x[i].xyz());
            if (b.surface->surelyFar(x)) continue;
            const surfaceFoot f = b.surface->find(x);
            if (!f.found || f.aside > 0) continue;
            ++(f.depth < 0 ? before : behind)[b.walls[f.patch]];
        }
    for (size_t w = 0; w < walls_.size(); ++w)
    {
        const word& name = walls_[w].name;
        if (behind[w] > before[w])
            patches.subDict(name).fail(
                "type", "Patch " + name + ": " + std::to_string(behind[w]) +
                            " particles are behind the wall and " + std::to_string(before[w]) +
                            " before it. Its normals must point out of the fluid: turn them, or "
                            "say 'twoSided yes;' of a sheet with fluid on both sides");
        if (behind[w] + before[w] == 0)
            warning("Patch " + name + ": no particle is within " + str(support_) +
                    " m of this wall. Is its surface in metres?");
    }
}

void wallSet::readRigid(const word& caseFolder, const dictionary& patches)
{
    const auto wanted = [](const wall& w) {
        return w.representation == wallRepresentation::particles && !w.plane && !w.twoSided;
    };
    if (std::none_of(walls_.begin(), walls_.end(), wanted)) return;
    const siteFile file(caseFolder + "/constant/wallParticles.hdf");
    for (wall& w : walls_)
        if (wanted(w)) w.rigid = file.positions(w.name, patches.subDict(w.name).where("type"));
}

void wallSet::setStep(scalar t0, scalar t1)
{
    for (wall& w : walls_) w.setStep(t0, t1);
}

scalar wallSet::perDepth(const patchSurface& s) const
{
    if (nDims_ == 3) return 1;
    const boundBox box = s.mesh()->bounds();
    return 1 / (box.max[2] - box.min[2]);
}

vector wallSet::planeArea(const wall& w) const
{
    return lattice_.area(w, walls_) * w.normal;
}

const wall& wallSet::named(const word& name, const fileLocation& where) const
{
    List<word> names;
    for (const wall& w : walls_)
    {
        if (w.name == name) return w;
        names.push_back(w.name);
    }
    throw fatalError("There is no wall '" + name + "'." + didYouMean(name, names) + "\n" +
                         validWords("wall", names),
                     where);
}

triSurface wallSet::surfaceOf(label w, const boundBox& region) const
{
    triSurface s;
    if (walls_[w].plane) s = lattice_.rectangle(walls_[w].point, walls_[w].normal, walls_, region);
    for (const body& b : bodies_)
        for (size_t k = 0; k < b.walls.size() && !walls_[w].plane; ++k)
            if (b.walls[k] == w)
            {
                const triSurface& all = *b.surface->mesh();
                s = all.subset([&](label t) { return all.patch[t] == label(k); });
            }
    for (vector& x : s.nodes) x = walls_[w].frame.toSpace(x);
    return s;
}

List<scalar> wallSet::moveTo(scalar t)
{
    List<scalar> swept(walls_.size(), 0);
    List<bodyFrame> from;
    for (wall& w : walls_) from.push_back(w.frame), w.moveTo(t);
    for (const body& b : bodies_)
        for (size_t k = 0; k < b.walls.size(); ++k)
        {
            const label w = b.walls[k];
            if (walls_[w].motion.turns())
            {
                swept[w] = turnedVolume(b, from[w], walls_[w].frame);
                continue;
            }
            const vector moved = walls_[w].frame.t - from[w].t;
            const vector area =
                walls_[w].plane ? planeArea(walls_[w])
                                : vector(perDepth(*b.surface) * b.surface->areaVector(label(k)));
            swept[w] = -moved.dot(area);
        }
    return swept;
}

// Swept volume of a turning body: each facet sweeps the way of its centre times the mean of its areas before and after.
// This is exact to the third order of the angle
scalar wallSet::turnedVolume(const body& b, const bodyFrame& from, const bodyFrame& to) const
{
    if (b.twoSided) return 0;
    const triSurface& s = *b.surface->mesh();
    scalar volume = 0;
    for (label t = 0; t < s.size(); ++t)
    {
        const vector area = s.areaVector(t),
                     way = to.toSpace(s.centre(t)) - from.toSpace(s.centre(t));
        volume -= 0.5 * way.dot(from.turn(area) + to.turn(area));
    }
    return perDepth(*b.surface) * volume;
}

scalar wallSet::maxSpeed() const
{
    scalar most = 0;
    for (const body& b : bodies_)
        for (const label k : b.walls)
        {
            const wall& w = walls_[k];
            if (w.velocity.uniform)
            {
                most = std::max(most, w.velocity.u.norm());
                continue;
            }
            // a plane has no end: its rigid particles are where the fluid is
            const List<vector>& points = w.plane ? w.rigid : b.surface->mesh()->nodes;
            for (const vector& X : points)
                most = std::max(most, w.velocity.at(w.frame.toSpace(X)).norm());
        }
    return most;
}

bool wallSet::clear(const vector& x, scalar distance) const
{
    for (const body& b : bodies_)
    {
        const surfaceFoot f = b.surface->find(frame(b).toBody(x));
        if (b.twoSided && f.aside > 0) continue;
        if (f.found && f.depth > -distance) return false;
    }
    return true;
}

scalar wallSet::distance(label w, const vector& X) const
{
    for (const body& b : bodies_)
        if (const auto at = std::find(b.walls.begin(), b.walls.end(), w); at != b.walls.end())
        {
            const surfaceFoot f = b.surface->find(X);
            if (f.found && f.patch == label(at - b.walls.begin()))
                return std::hypot(f.depth, f.aside);
        }
    return std::numeric_limits<scalar>::infinity();
}

bool wallSet::holds(const vector& x) const
{
    const scalar near = 0.1 * support_;
    bool slips = false;
    for (const body& b : bodies_)
    {
        const surfaceFoot f = b.surface->find(frame(b).toBody(x));
        if (!f.found || std::abs(f.depth) > near || f.aside > near) continue;
        if (!walls_[b.walls[f.patch]].slip) return true;
        slips = true;
    }
    return !slips;
}

bool wallSet::anyMoves() const
{
    return std::any_of(walls_.begin(), walls_.end(),
                       [](const wall& w) { return w.motion.moves(); });
}

bool wallSet::movingWithin(const vector& x, scalar distance) const
{
    for (const body& b : bodies_)
    {
        const wall& w = b.carrier(*this);
        if (!w.motion.moves()) continue;
        const vector y = w.frame.toBody(x);
        const scalar off =
            w.plane ? std::abs((y - w.point).dot(w.normal)) : std::sqrt(b.bounds.distSqr(y));
        if (off < distance) return true;
    }
    return false;
}

bool wallSet::movedOver(const vector& x, scalar distance) const
{
    for (const body& b : bodies_)
    {
        if (!b.carrier(*this).motion.moves() || b.twoSided) continue;
        // the wall is continued beside its rim, as in wallGuard for the strip; relative to the wall, x moves from x to y
        const vector y = frame(b).toBody(x);
        if (b.surface->crosses(x, y)) return true;
        const label n = label((y - x).norm() / (0.5 * support_));
        for (label k = 0; k <= n; ++k)
        {
            const vector p = y + (x - y) * scalar(k) / scalar(n + 1);
            if (b.surface->mesh() && b.bounds.distSqr(p) > support_ * support_) continue;
            const surfaceFoot f = b.surface->find(p);
            if (f.found && f.depth > (k == 0 ? -distance : 0)) return true;
        }
    }
    return false;
}

bool wallSet::inside(const vector& x) const
{
    for (const body& b : bodies_)
    {
        const surfaceFoot f = b.surface->find(frame(b).toBody(x));
        if (f.found && f.aside == 0 && f.depth > 0) return false;
    }
    return true;
}

}  // namespace ispf
