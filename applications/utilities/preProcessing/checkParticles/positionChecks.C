// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.H"

#include "cellList.H"
#include "patchSurface.H"
#include "surfaceSearch.H"
#include "trackedSurface.H"
#include "wallLayers.H"
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <set>

namespace ispf
{

namespace
{

constexpr scalar samePlace = 1e-3;  // in dx
constexpr scalar tooClose = 0.4;    // in dx; a packing has 0.7 and more
constexpr scalar tooWide = 1.3;     // in dx; a lattice has 0.87

word at(const vector& x)
{
    return "(" + str(x[0]) + " " + str(x[1]) + " " + str(x[2]) + ")";
}

label notFinite(const particleCloud& cloud)
{
    for (label i = 0; i < cloud.n(); ++i)
        for (int k = 0; k < 4; ++k)
            if (!std::isfinite(cloud.x[i][k] + cloud.Up[i][k])) return i;
    return -1;
}

struct pairFound
{
    label i = -1, j = -1;
    scalar distance = 1e300;
};

// The closest pair with an owned particle; ghosts count as partners
pairFound closestPair(const List<vector>& x, label n, scalar dx)
{
    const cellList cells(x, dx);
    List<pairFound> best;
    best.resize(n);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            cells.near(x[i], dx, [&](label j, scalar d2) {
                if (j != i && d2 < best[i].distance) best[i] = {i, j, d2};
            });
    });
    pairFound closest;
    for (const pairFound& b : best)
        if (b.distance < closest.distance) closest = b;
    closest.distance = std::sqrt(closest.distance);
    return closest;
}

// Moves p uphill to a place where the nearest particles are farthest
scalar climb(const cellList& cells, const List<vector>& x, vector& p, scalar dx)
{
    const auto nearest = [&](const vector& q) {
        scalar least = 4 * dx * dx;
        cells.near(q, 2 * dx, [&](label, scalar d2) { least = std::min(least, d2); });
        return std::sqrt(least);
    };
    scalar radius = nearest(p);
    for (scalar step = 0.2 * dx; step > 0.003 * dx;)
    {
        // from all that are about equally near: otherwise ridges stop it
        vector away = vector::Zero();
        cells.near(p, radius + step, [&](label j, scalar d2) {
            away += (p - x[j]) / std::max(std::sqrt(d2), 1e-9 * dx);
        });
        const vector there = p + step * away.normalized();
        const scalar radiusThere = nearest(there);
        if (radiusThere > radius) p = there, radius = radiusThere;
        else step *= 0.5;
    }
    return radius;
}

// Radius of the largest ball without a particle.  Every side of fluid counts, because fluid fills its room;
// of solids only places far from their open sides count
scalar largestGap(const fsiCase& c, const List<vector>& x, vector& where)
{
    const particleCloud& cloud = c.cloud;
    const scalar dx = cloud.dx, far = (cloud.nDims == 3 ? 0.866 : 0.707) * dx;  // of a lattice
    const particleSurface surface(x, cloud.n(), dx, cloud.nDims);
    const cellList cells(x, dx);
    scalar gap = 0;
    const auto nearOpen = [&](label i) {
        bool open = false;
        cells.near(x[i], 2 * dx,
                   [&](label j, scalar) { open = open || (j < cloud.n() && surface.open(j)); });
        return open;
    };
    for (label i = 0; i < cloud.n(); ++i)
    {
        if (cloud.beyondOpen(i) || (!cloud.isFluid(i) && nearOpen(i))) continue;
        for (int k = 0; k < 27; ++k)
        {
            const vector way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            if (k == 13 || (cloud.nDims == 2 && way[2] != 0)) continue;
            vector p = x[i] + far * way.normalized();
            if (cells.anyWithin(p, 0.85 * far)) continue;
            const scalar radius = climb(cells, x, p, dx);
            if (radius > gap && c.walls->inside(p)) gap = radius, where = p;
        }
    }
    return gap;
}

// Checks for fluid in and behind a surface that moves with a solid
void checkSurface(const fsiCase& c, const word& name, label fluidZone, findings& found)
{
    trackedSurface surface(name, c);
    surface.update(c.cloud.x);
    const surfaceSearch search(surface.now());
    label wrong = 0;
    scalar deepest = 0;
    for (label i = c.cloud.nSolid(); i < c.cloud.n(); ++i)
    {
        if (c.cloud.zone[i] != fluidZone) continue;
        const vector x = c.cloud.x[i].xyz();
        const surfacePoint p = search.nearest(x);
        if (!p.found || p.rim || p.signedDistance(x) >= 0) continue;
        ++wrong, deepest = std::max(deepest, p.distance / c.cloud.dx);
    }
    const word text = std::to_string(wrong) + " particles of zone " +
                      c.cloud.zones[fluidZone].name + " on the wrong side of " + name;
    if (wrong == 0) found.fine("No particle on the wrong side of " + name);
    else if (deepest <= 0.5) found.warn(text + ", by at most " + str(deepest, 2) + " dx");
    else found.fail(text + ", by up to " + str(deepest, 3) + " dx");
}

}  // namespace

List<vector> allPoints(const particleCloud& cloud)
{
    List<vector> x;
    for (const vec4& p : cloud.x) x.push_back(p.xyz());
    return x;
}

word phaseName(const zoneInfo& zone)
{
    return zone.phase == phaseType::fluid ? "fluid" : zone.fixed ? "clamped" : "solid";
}

void printZones(const fsiCase& c, findings& found)
{
    found.heading("Zones, and their volumes without what lies beyond open faces");
    const particleCloud& cloud = c.cloud;
    List<label> n(cloud.zones.size(), 0), beyond(cloud.zones.size(), 0);
    for (label i = 0; i < cloud.n(); ++i)
        ++n[cloud.zone[i]], beyond[cloud.zone[i]] += cloud.beyondOpen(i);
    info() << "    " << std::left << std::setw(16) << "zone" << std::setw(10) << "phase"
           << std::right << std::setw(10) << "particles" << std::setw(10) << "beyond"
           << std::setw(14) << (cloud.nDims == 3 ? "volume [m3]" : "area [m2]") << "\n";
    for (size_t z = 0; z < n.size(); ++z)
        info() << "    " << std::left << std::setw(16) << cloud.zones[z].name << std::setw(10)
               << phaseName(cloud.zones[z]) << std::right << std::setw(10) << n[z] << std::setw(10)
               << beyond[z] << std::setw(14) << str((n[z] - beyond[z]) * cloud.volume(), 5) << "\n";
}

void checkPositions(const particleCloud& cloud, scalar time, findings& found)
{
    found.heading("Particles at time " + str(time));
    found.note("number " + std::to_string(cloud.n()) + ", dx " + str(cloud.dx) + " m, " +
               std::to_string(cloud.nDims) + "D");

    found.heading("Checking positions...");
    if (const label i = notFinite(cloud); i >= 0)
        return found.fail("Particle " + std::to_string(cloud.id[i]) + " (zone " +
                          cloud.zones[cloud.zone[i]].name + ") at " + at(cloud.x[i].xyz()) +
                          " has a position, velocity or pressure that is not finite");
    found.fine("All values finite");
    const List<vector> x = allPoints(cloud);
    vector low = x[0], high = x[0];
    for (const vector& p : x) low = low.cwiseMin(p), high = high.cwiseMax(p);
    found.note("Bounding box " + at(low) + " " + at(high) + " m");
    const std::set<globalId> ids(cloud.id.begin(), cloud.id.end());
    found.judge(label(ids.size()) == cloud.n(), "One id a particle");
    const pairFound closest = closestPair(x, cloud.n(), cloud.dx);
    if (closest.i < 0 || closest.distance > samePlace * cloud.dx)
        return found.fine("No two in one place");
    found.fail("Particles " + std::to_string(cloud.id[closest.i]) + " and " +
               std::to_string(cloud.id[closest.j]) + " are in the same place " + at(x[closest.i]));
}

void checkSides(const fsiCase& c, findings& found)
{
    found.heading("Checking sides...");
    label outside = -1, n = 0;
    for (label i = c.cloud.nSolid(); i < c.cloud.n(); ++i)
        if (!c.walls->inside(c.cloud.x[i].xyz())) outside = i, ++n;
    if (n == 0) found.fine("No fluid particle beyond a wall or plane");
    else
        found.fail(std::to_string(n) + " fluid particles beyond a wall or plane, e.g. " +
                   std::to_string(c.cloud.id[outside]) + " (zone " +
                   c.cloud.zones[c.cloud.zone[outside]].name + ") at " +
                   at(c.cloud.x[outside].xyz()));
    for (const zoneInfo& solid : c.cloud.zones)
        for (const zoneInfo& fluid : c.cloud.zones)
        {
            const word name = solid.name + "_to_" + fluid.name;
            if (solid.phase == phaseType::solid && fluid.phase == phaseType::fluid &&
                std::filesystem::exists(patchFile(c.caseFolder(), name)))
                checkSurface(c, name, c.cloud.zoneIndex(fluid.name), found);
        }
}

void checkSpacing(const fsiCase& c, findings& found)
{
    found.heading("Checking spacing...");
    const List<vector> x = allPoints(c.cloud);
    const scalar close = closestPair(x, c.cloud.n(), c.cloud.dx).distance / c.cloud.dx;
    const word pair = "Closest pair " + (close < 1.5 ? str(close, 3) : word("more than 1")) + " dx";
    if (close > tooClose) found.fine(pair);
    else found.warn(pair + ": below " + str(tooClose) + " dx, clumping");
    vector where = vector::Zero();
    const scalar gap = largestGap(c, x, where) / c.cloud.dx;
    const word hole = "Largest gap, radius of an empty ball: " + str(gap, 3) + " dx";
    if (gap < tooWide) found.fine(hole);
    else found.warn(hole + ", at " + at(where) + ": wider than " + str(tooWide) + " dx");
}

}  // namespace ispf
