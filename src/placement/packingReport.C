// SPDX-License-Identifier: GPL-3.0-or-later
#include "packingReport.H"

#include "cellList.H"
#include "packing.H"
#include "smoothingKernel.H"
#include "wallLayers.H"
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>

namespace ispf
{

namespace
{

constexpr scalar tooClose = 0.4;  // [dx]

// Positions of all particles, rigid ones and images included
List<vector> everything(const zoneGeometry& geometry, const placedParticles& placed, scalar support)
{
    List<vector> all = placed.x;
    all.insert(all.end(), placed.rigid.begin(), placed.rigid.end());
    for (const halfSpace& plane : geometry.symmetryPlanes())
        for (size_t i = 0, n = all.size(); i < n; ++i)
            if (plane.distance(all[i]) > -support) all.push_back(plane.mirror(all[i]));
    return all;
}

// Counts the layers of solids; solids that touch are one body
void setLayers(const zoneGeometry& geometry, const placedParticles& placed,
               List<zoneQuality>& quality)
{
    List<vector> body;
    List<label> zone;
    for (size_t i = 0; i < placed.x.size(); ++i)
        if (geometry.zones()[placed.zone[i]].phase == phaseType::solid)
            body.push_back(placed.x[i]), zone.push_back(placed.zone[i]);
    const label n = label(body.size());
    if (n == 0) return;
    for (const halfSpace& plane : geometry.symmetryPlanes())
        for (size_t i = 0, m = body.size(); i < m; ++i)
            if (plane.distance(body[i]) > -12 * geometry.dx())
                body.push_back(plane.mirror(body[i]));
    const List<scalar> layers = layersBelow(body, n, geometry.dx(), geometry.nDims());
    for (label i = 0; i < n; ++i)
        if (scalar& least = quality[zone[i]].layers; layers[i] > 0)
            least = least == 0 ? layers[i] : std::min(least, layers[i]);
}

}  // namespace

// Overlaps by the particles of each zone.  A particle beside a face that two zones share lies in one of them only
List<zoneOverlap> zoneOverlaps(const zoneGeometry& geometry, const placedParticles& placed)
{
    constexpr scalar sag = 0.02;  // share of a zone's particles
    const label n = label(placed.x.size());
    List<List<label>> claims(n);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i) claims[i] = geometry.claims(placed.x[i]);
    });
    std::map<std::pair<label, label>, zoneOverlap> taken;
    List<label> own(geometry.zones().size(), 0), shared = own, drawn = own;
    for (label i = 0; i < n; ++i)
    {
        const label zone = placed.zone[i];
        if (placed.strip[i] >= 0) continue;
        ++own[zone];
        for (const label drawnHere : std::set<label>(claims[i].begin(), claims[i].end()))
            if (drawnHere >= 0) ++drawn[drawnHere];
        const auto at = std::find(claims[i].rbegin(), claims[i].rend(), zone);
        std::set<label> others(at, claims[i].rend());
        others.erase(zone), others.erase(-1);
        shared[zone] += !others.empty();
        for (const label other : others)
        {
            zoneOverlap& o = taken[{other, zone}];
            o.zone = zone, o.of = other;
            o.volume += std::pow(geometry.dx(), geometry.nDims()), o.middle += placed.x[i];
        }
    }
    List<zoneOverlap> all;
    const scalar cell = std::pow(geometry.dx(), geometry.nDims());
    for (auto& [zones, o] : taken)
    {
        o.middle *= cell / o.volume;
        const scalar part = scalar(shared[o.zone]) / own[o.zone],
                     partOfOther = o.volume / cell / drawn[o.of];
        o.crosses = part < 1 - sag && std::max(part, partOfOther) > sag;
        all.push_back(o);
    }
    return all;
}

List<zoneQuality> packingQuality(const zoneGeometry& geometry, const placedParticles& placed,
                                 scalar support)
{
    const scalar dx = geometry.dx(), cell = std::pow(dx, geometry.nDims());
    const auto kernel = smoothingKernel::New("WendlandC2", geometry.nDims(), support / 2);
    const scalar full = kernel->latticeSum(dx);
    const List<vector> all = everything(geometry, placed, support);
    const cellList cells(all, support);
    const surfaceSearch ends(openEnds(geometry));

    const label n = label(placed.x.size());
    List<scalar> sum(n, 0), nearest(n, support);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            cells.near(placed.x[i], support, [&](label j, scalar d2) {
                sum[i] += cell * kernel->W(std::sqrt(d2)) / full;
                if (j != i) nearest[i] = std::min(nearest[i], std::sqrt(d2));
            });
    });
    List<zoneQuality> quality(geometry.zones().size());
    for (zoneQuality& q : quality) q.least = 1e9, q.most = 0, q.minDistance = 1e9;
    for (label i = 0; i < n; ++i)
    {
        zoneQuality& q = quality[placed.zone[i]];
        q.nTooClose += nearest[i] < tooClose * dx;
        if (nearest[i] / dx < q.minDistance)
            q.minDistance = nearest[i] / dx, q.closest = placed.x[i];
        if (placed.strip[i] >= 0) continue;
        ++q.n;
        if (ends.within(placed.x[i], support)) continue;
        ++q.nInterior;
        q.least = std::min(q.least, sum[i]), q.most = std::max(q.most, sum[i]);
        q.mean += sum[i], q.rms += (sum[i] - 1) * (sum[i] - 1);
    }
    setLayers(geometry, placed, quality);
    for (size_t z = 0; z < quality.size(); ++z)
    {
        zoneQuality& q = quality[z];
        const scalar count = std::max<label>(1, q.nInterior);
        q.mean /= count, q.rms = std::sqrt(q.rms / count);
        q.volumeError = q.n * cell / geometry.volume(label(z)) - 1;
    }
    return quality;
}

// How many particles of a zone are too near to others, and where the nearest are
static word crowding(const zoneQuality& q, const word& name)
{
    const auto coordinate = [&](int d) { return str(q.closest[d], 4); };
    return std::to_string(q.nTooClose) + " particles of zone " + name +
           " or beyond its open faces have another, or its image beyond a symmetry plane, nearer "
           "than " +
           str(tooClose) + " dx. The nearest pair is " + str(q.minDistance, 3) + " dx apart, at (" +
           coordinate(0) + " " + coordinate(1) + " " + coordinate(2) + ") m. ";
}

void reportPacking(const zoneGeometry& geometry, const placedParticles& placed,
                   const List<zoneOverlap>& overlaps, scalar support, bool bodyFitted)
{
    const List<zoneQuality> quality = packingQuality(geometry, placed, support);
    std::ostream& out = info();
    const auto percent = [](scalar v) {
        char text[32];
        std::snprintf(text, sizeof text, "%+.2f", std::round(1e4 * v) / 100 + 0.0);  // no -0.00
        return word(text);
    };
    out << "\nzone              volume  particles  error %   kernel sum %: least   mean    most    "
           "rms"
           "   closest/dx   layers\n";
    for (size_t z = 0; z < quality.size(); ++z)
    {
        const zoneQuality& q = quality[z];
        const word& name = geometry.zones()[z].name;
        if (q.n == 0)
            throw fatalError("Zone " + name + " has no particle. Is dx = " + str(geometry.dx()) +
                             " m right, and the unit of its file?");
        out << std::left << std::setw(12) << name << std::right << std::setw(12)
            << str(geometry.volume(label(z)), 5) << std::setw(11) << q.n << std::setw(9)
            << percent(q.volumeError);
        if (q.nInterior > 0)
            out << std::setw(22) << percent(q.least - 1) << std::setw(8) << percent(q.mean - 1)
                << std::setw(8) << percent(q.most - 1) << std::setw(7) << percent(q.rms).substr(1);
        else out << std::setw(45) << "no particle has neighbours all around";
        out << std::setw(13) << str(q.minDistance, 3);
        if (q.layers > 0) out << std::setw(9) << str(q.layers, 2);
        out << "\n";
        if (q.minDistance < tooClose)
            warning(crowding(q, name) +
                    (bodyFitted ? "There the thickness of the zone is no multiple of dx, or its "
                                  "faces meet in a sharp edge. Look at that place; a finer dx "
                                  "brings the particles nearer to their distance"
                                : "A lattice fits planes along its axes at whole or half spacings "
                                  "only: choose placement bodyFitted"));
        if (std::abs(q.volumeError) > 0.005)
            warning("The particles of zone " + name + " miss its volume by " +
                    percent(q.volumeError) + " %: choose " +
                    (bodyFitted ? "a finer dx; a zone of few particles cannot hold half of one"
                                : "a dx that divides its lengths, or placement bodyFitted"));
    }
    for (size_t z = 0; z < quality.size(); ++z)
        if (const scalar layers = quality[z].layers; layers > 0 && layers < 2.5)
            warning("Zone " + geometry.zones()[z].name + " has " + str(layers, 2) +
                    " layers of particles where it is thinnest. So few cannot bend: a strip of two "
                    "goes a thirtieth of a beam's way. They carry what stretches them alone, as a "
                    "pressure within a tube does. Choose a finer dx; 4 layers bend");
    for (const zoneOverlap& o : overlaps)
        out << "zones overlap: " << geometry.zones()[o.zone].name << " takes " << str(o.volume, 4)
            << (geometry.nDims() == 3 ? " m3" : " m2") << " of " << geometry.zones()[o.of].name
            << ", which comes before it, around (" << str(o.middle[0], 4) << " "
            << str(o.middle[1], 4) << " " << str(o.middle[2], 4) << ")\n";
    label strip = 0;
    for (const label p : placed.strip) strip += p >= 0;
    out << "beyond open faces " << strip << ", rigid wall " << placed.rigid.size() << ", together "
        << placed.x.size() + placed.rigid.size() << "\n"
        << std::endl;
}

}  // namespace ispf
