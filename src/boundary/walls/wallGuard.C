// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallGuard.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

const word seenField = "xGuarded";

constexpr scalar gap = 0.15;      // [dx] distance kept from every surface
constexpr scalar longStep = 0.1;  // [dx] a shorter way cannot pass a wall unseen
constexpr int passes = 4;         // at an edge a push off one wall may lead into another

// One particle against one surface, in the surface's frame
struct pusher
{
    const patchSurface& surface;
    scalar dx;

    // Moves x off the surface if it is too near or has passed it on the way from `seen`.  Returns the patch, -1 if x
    // was allowed
    label push(vector& x, const vector& seen, bool inStrip) const
    {
        if ((x - seen).norm() > longStep * dx && surface.crosses(seen, x))
        {
            const surfaceFoot f = surface.firstCrossing(seen, x);
            if (f.found && (seen - f.foot).dot(f.normal) < 0)
            {
                x = f.foot - gap * dx * f.normal;
                return f.patch;
            }
        }
        if (surface.surelyFar(x)) return -1;
        const surfaceFoot f = surface.find(x);
        // beside its rim a wall is continued only for the strip of an open face
        if (!f.found || (f.aside > 0 && !inStrip) || f.depth <= -(gap - 1e-9) * dx) return -1;
        x -= (f.depth + gap * dx) * f.normal;
        return f.patch;
    }
};

// One particle before its move, in space
struct approaching
{
    const wallSet::body& body;
    const bodyFrame& frame;
    const List<wall>& walls;
    scalar gap, dt;
    bool inStrip;

    bool finds(const surfaceFoot& f) const { return f.found && (f.aside == 0 || inStrip); }

    // The shift dr from x may lead no nearer to the surface than the gap, (8.36).  True if it has changed
    bool limitShift(const vector& x, vector& dr) const
    {
        const surfaceFoot f = body.surface->find(frame.toBody(x + dr));
        if (!finds(f) || !(f.depth > -gap)) return false;
        const surfaceFoot before = body.surface->find(frame.toBody(x));
        const scalar most = finds(before) ? std::max(before.depth, -gap) : -gap;
        if (!(f.depth > most)) return false;
        dr -= (f.depth - most) * frame.turn(f.normal);
        return true;
    }
    // The same for the velocity: tested at the tangent plane of the foot, then at the place after the step.  True if u has
    // changed
    bool limitVelocity(const vector& x, vector& u) const
    {
        const surfaceFoot now = body.surface->find(frame.toBody(x));
        if (!finds(now)) return false;
        const vector wall = walls[body.walls[now.patch]].velocity.at(x);
        const scalar room = std::max(-now.depth - gap, scalar(0));
        if (room > dt * (u - wall).norm()) return false;
        const auto meets = [&](const vector& n, scalar tooFar) {
            const scalar into = (u - wall).dot(n);
            if (!(into > 0 && tooFar > 0)) return false;
            u -= std::min(into, tooFar / dt) * n;
            return true;
        };
        const vector n = frame.turn(now.normal);
        bool met = meets(n, dt * (u - wall).dot(n) - room);
        const surfaceFoot then = body.surface->find(frame.toBody(x + dt * (u - wall)));
        if (finds(then))
            met = meets(frame.turn(then.normal), then.depth - std::max(now.depth, -gap)) || met;
        return met;
    }
};

// Puts particle i to x and takes away its velocity into the wall: its inertia would press on, step after step
void putBack(particleCloud& cloud, label i, const vector& x, const vector& wallVelocity)
{
    const vector off = (x - cloud.x[i].xyz()).normalized();
    const vector u = cloud.Up[i].xyz();
    cloud.Up[i].setXyz(u - std::min((u - wallVelocity).dot(off), 0.0) * off);
    cloud.x[i].setXyz(x);
}

}  // namespace

List<label> wallGuard::apply(particleCloud& cloud, const wallSet& walls) const
{
    const label first = cloud.nSolid(), n = cloud.n() - first;
    const auto field = cloud.vectors.find(seenField);
    const bool hasSeen = field != cloud.vectors.end();
    List<label> hit(n, -1);  // the wall that pushed particle i first
    parallelFor(n, [&](label begin, label end) {
        for (label k = begin; k < end; ++k)
        {
            const label i = first + k;
            vector x = cloud.x[i].xyz();
            const vector seen = hasSeen ? field->second[i].xyz() : x;
            bool again = true;
            for (int pass = 0; pass < passes && again; ++pass)
            {
                again = false;
                for (size_t b = 0; b < walls.bodies().size(); ++b)
                {
                    const wallSet::body& body = walls.bodies()[b];
                    const bodyFrame& frame = walls.frame(body);
                    vector y = frame.toBody(x);
                    const vector before = hasSeen && pass == 0 ? seenFrames_[b].toBody(seen) : y;
                    const label patch =
                        pusher{*body.surface, cloud.dx}.push(y, before, cloud.beyondOpen(i));
                    if (patch < 0) continue;
                    x = frame.toSpace(y), again = true;
                    if (hit[k] < 0) hit[k] = body.walls[patch];
                }
            }
            if (hit[k] >= 0) putBack(cloud, i, x, walls.walls()[hit[k]].velocity.at(x));
        }
    });
    List<label> pushed(walls.walls().size(), 0);
    for (const label w : hit)
        if (w >= 0) ++pushed[w];
    return pushed;
}

void wallGuard::limitShift(const particleCloud& cloud, const wallSet& walls, label i, scalar gap,
                           vector& dr) const
{
    const vector before = cloud.x[i].xyz();
    bool again = true;
    for (int pass = 0; pass < passes && again; ++pass)
    {
        again = false;
        for (const wallSet::body& body : walls.bodies())
        {
            const bodyFrame& frame = walls.frame(body);
            if (body.surface->surelyFar(frame.toBody(before + dr))) continue;
            const approaching a{body, frame, walls.walls(), gap, 0, cloud.beyondOpen(i)};
            again = a.limitShift(before, dr) || again;
        }
    }
}

void wallGuard::limitApproach(particleCloud& cloud, const wallSet& walls, scalar gap,
                              scalar dt) const
{
    const label first = cloud.nSolid(), n = cloud.n() - first;
    parallelFor(n, [&](label begin, label end) {
        for (label i = first + begin; i < first + end; ++i)
        {
            if (cloud.uFixed[i]) continue;
            const vector x = cloud.x[i].xyz();
            vector u = cloud.Up[i].xyz();
            bool again = true;
            for (int pass = 0; pass < passes && again; ++pass)
            {
                again = false;
                for (const wallSet::body& body : walls.bodies())
                {
                    const bodyFrame& frame = walls.frame(body);
                    if (body.surface->surelyFar(frame.toBody(x)) &&
                        body.surface->surelyFar(frame.toBody(x + dt * u)))
                        continue;
                    const approaching a{body, frame, walls.walls(), gap, dt, cloud.beyondOpen(i)};
                    again = a.limitVelocity(x, u) || again;
                }
            }
            cloud.Up[i].setXyz(u);
        }
    });
}

void wallGuard::remember(particleCloud& cloud) const
{
    cloud.vectors[seenField].assign(cloud.x.begin(), cloud.x.begin() + cloud.n());
}

void wallGuard::rememberWalls(const wallSet& walls)
{
    seenFrames_.clear();
    for (const wallSet::body& b : walls.bodies()) seenFrames_.push_back(walls.frame(b));
}

}  // namespace ispf
