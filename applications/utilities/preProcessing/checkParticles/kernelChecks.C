// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.H"

#include "cellList.H"
#include "wallLayers.H"
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar band = 0.02;    // of kernel sums, in a fresh packing
constexpr scalar uneven = 0.08;  // beyond this the operators are no longer consistent

// Marks particles farther from every open side than the support.  The last half spacing belongs to the
// surface particle
List<char> interiorParticles(const particleCloud& cloud, const List<vector>& x, scalar support)
{
    const particleSurface surface(x, cloud.n(), cloud.dx, cloud.nDims);
    List<vector> open;
    for (label i = 0; i < cloud.n(); ++i)
        if (surface.open(i)) open.push_back(x[i]);
    const cellList cells(open, support);
    List<char> interior(cloud.n());
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            interior[i] = open.empty() || !cells.anyWithin(x[i], support - 0.5 * cloud.dx);
    });
    return interior;
}

}  // namespace

void checkNeighbours(const fsiCase& c, findings& found)
{
    found.heading("Checking neighbours...");
    const particleCloud& cloud = c.cloud;
    valueRange fluid, solid;
    label lonely = -1;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar n = scalar(c.list.start[i + 1] - c.list.start[i]);
        (cloud.isFluid(i) ? fluid : solid).add(n);
        if (n < cloud.nDims + 1) lonely = i;
    }
    found.note("Kernel " + c.kernel->name() + ", support " +
               str(c.kernel->support() / cloud.dx, 4) + " dx; ghosts " +
               std::to_string(cloud.nGhosts()) + ", pairs " + std::to_string(c.list.nPairs()));
    for (const auto& [name, range] : {std::pair("fluid", &fluid), std::pair("solid", &solid)})
        if (range->n > 0)
            found.note("Neighbours of " + word(name) +
                       " particles, least/mean/most: " + range->text());
    if (lonely >= 0)
        found.fail("Particle " + std::to_string(cloud.id[lonely]) + " (zone " +
                   cloud.zones[cloud.zone[lonely]].name +
                   ") has too few neighbours for a gradient");
}

void checkKernelSums(const fsiCase& c, findings& found)
{
    found.heading("Checking kernel sums over the lattice's, of particles without an open side...");
    const particleCloud& cloud = c.cloud;
    const List<vector> x = allPoints(cloud);
    const scalar support = c.kernel->support(), full = c.kernel->latticeSum(cloud.dx);
    const List<char> interior = interiorParticles(cloud, x, support);
    const cellList cells(x, support);
    List<scalar> sum(cloud.n(), 0);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            cells.near(x[i], support, [&](label, scalar d2) {
                sum[i] += cloud.volume() * c.kernel->W(std::sqrt(d2)) / full;
            });
    });
    List<valueRange> perZone(cloud.zones.size());
    List<label> outside(cloud.zones.size(), 0);
    scalar worst = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        if (!interior[i]) continue;
        const scalar off = sum[i] - 1;
        perZone[cloud.zone[i]].add(off);
        outside[cloud.zone[i]] += std::abs(off) > band;
        worst = std::max(worst, std::abs(off));
    }
    for (size_t z = 0; z < perZone.size(); ++z)
    {
        const valueRange& r = perZone[z];
        found.note(cloud.zones[z].name + ": " +
                   (r.n == 0 ? word("no particle has neighbours all around")
                             : percent(r.least) + " to " + percent(r.most) + ", mean " +
                                   percent(r.mean()) + "; " + std::to_string(outside[z]) + " of " +
                                   std::to_string(r.n) + " beyond " + str(100 * band) + " %"));
    }
    if (worst > uneven) found.warn("Kernel sums are uneven: off by up to " + percent(worst));
}

}  // namespace ispf
