// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceRepair.H"

#include "boundaryLoops.H"
#include "duplicateFacets.H"
#include "seams.H"
#include "surfaceTopology.H"
#include "windingNumber.H"
#include <algorithm>
#include <numeric>

namespace ispf
{

namespace
{

// Joins nodes that differ by less than the tolerance; returns their number
label joinNear(triSurface& s, scalar tolerance)
{
    s.weld(0);
    const size_t before = s.nodes.size();
    s.weld(tolerance);
    return label(before - s.nodes.size());
}

label dropFlat(triSurface& s)
{
    const label before = s.size();
    const auto hasArea = [&](label t) {
        scalar longest = 0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, (s.corner(t, k) - s.corner(t, (k + 1) % 3)).squaredNorm());
        return s.areaVector(t).norm() > 1e-10 * longest;
    };
    bool all = true;
    for (label t = 0; t < s.size() && all; ++t) all = hasArea(t);
    if (!all) s = s.subset(hasArea);
    return before - s.size();
}

// Closes a hole by a fan about the centre of its rim: it is smaller than the resolution, so its shape does not matter
void closeHole(triSurface& s, const boundaryLoop& loop)
{
    const size_t n = loop.nodes.size();
    label patch = 0;  // that of a neighbour
    for (label t = 0; t < s.size(); ++t)
        if (const auto& f = s.triangles[t];
            std::find(f.begin(), f.end(), loop.nodes[0]) != f.end() &&
            std::find(f.begin(), f.end(), loop.nodes[1]) != f.end())
            patch = s.patch[t];
    if (n == 3) s.triangles.push_back({loop.nodes[0], loop.nodes[2], loop.nodes[1]});
    else
    {
        const label centre = label(s.nodes.size());
        s.nodes.push_back(loop.centre);
        for (size_t k = 0; k < n; ++k)
            s.triangles.push_back({loop.nodes[(k + 1) % n], loop.nodes[k], centre});
    }
    s.patch.resize(s.triangles.size(), patch);
}

bool sameSense(const triSurface::triangle& a, const triSurface::triangle& b)
{
    return a == b || (a[0] == b[1] && a[1] == b[2] && a[2] == b[0]) ||
           (a[0] == b[2] && a[1] == b[0] && a[2] == b[1]);
}

// Repairs the surface; returns the facets before they were turned
List<triSurface::triangle> mend(triSurface& s, bool tells, scalar weld, repairReport& report)
{
    const triSurface given = s;
    const duplicatesDropped dropped = dropDuplicates(s, tells);
    report.duplicates = dropped.count;
    report.sewn = sewSeams(s, weld);
    const List<triSurface::triangle> before = s.triangles;
    orientOutward(s);
    if (tells) return before;
    // if the given sides make no sense: a wall between bodies that touch has bodies on both sides; else bodies overlap
    const windingNumber winding(s);
    const triSurface& walls = dropped.walls;
    for (label t = 0; t < walls.size(); ++t)
    {
        const vector c = walls.centre(t),
                     step = 1e-3 * std::sqrt(walls.areaVector(t).norm()) * walls.normal(t);
        if (winding.inside(c - step) && winding.inside(c + step)) continue;
        s = given;
        return mend(s, true, weld, report);
    }
    return before;
}

}  // namespace

repairReport repair(triSurface& s, const repairSettings& settings)
{
    repairReport report;
    report.weld = settings.weld;
    report.joined = joinNear(s, settings.weld);
    report.flat = dropFlat(s);
    const List<triSurface::triangle> before = mend(s, sidesTell(s), settings.weld, report);
    for (const boundaryLoop& loop : boundaryLoops(s))
        if (loop.size <= settings.hole)
        {
            if (report.holes++ == 0) report.largestHole = loop.size, report.holeAt = loop.centre;
            closeHole(s, loop);
        }
    if (report.holes > 0) orientOutward(s);
    report.facets = label(before.size());
    for (size_t t = 0; t < before.size(); ++t)
        report.turned += !sameSense(before[t], s.triangles[t]);
    return report;
}

word repairReport::describe() const
{
    List<word> done;
    const auto add = [&](label n, const word& what) {
        if (n > 0) done.push_back(std::to_string(n) + " " + what);
    };
    add(joined, "nodes joined that were less than " + str(weld, 3) + " m apart");
    add(flat, "facets without area dropped");
    add(duplicates, "facets dropped that lay on others");
    add(sewn, "facets cut at nodes of the other side of a seam");
    if (turned == facets && facets > 0)
        done.push_back("all normals pointed inwards and were turned");
    else add(turned, "of " + std::to_string(facets) + " facets turned to agree with the others");
    if (holes > 0)
        done.push_back(std::to_string(holes) + " holes closed, the largest " + str(largestHole, 3) +
                       " m across at (" + str(holeAt[0]) + " " + str(holeAt[1]) + " " +
                       str(holeAt[2]) + ")");
    return join(done, "; ");
}

void sortByPlace(triSurface& s)
{
    List<label> order(s.nodes.size()), newNode(s.nodes.size()), facets(s.size());
    std::iota(order.begin(), order.end(), 0), std::iota(facets.begin(), facets.end(), 0);
    std::sort(order.begin(), order.end(), [&](label a, label b) {
        return std::lexicographical_compare(s.nodes[a].begin(), s.nodes[a].end(),
                                            s.nodes[b].begin(), s.nodes[b].end());
    });
    List<vector> nodes;
    for (const label n : order) newNode[n] = label(nodes.size()), nodes.push_back(s.nodes[n]);
    s.nodes = std::move(nodes);
    for (triSurface::triangle& f : s.triangles)
    {
        for (label& n : f) n = newNode[n];
        std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    }
    // the key of a facet does not depend on its orientation
    const auto key = [&](label t) {
        triSurface::triangle f = s.triangles[t];
        std::sort(f.begin(), f.end());
        return std::make_pair(f, s.patch[t]);
    };
    std::stable_sort(facets.begin(), facets.end(),
                     [&](label a, label b) { return key(a) < key(b); });
    triSurface sorted = s;
    for (label t = 0; t < s.size(); ++t)
        sorted.triangles[t] = s.triangles[facets[t]], sorted.patch[t] = s.patch[facets[t]];
    s = std::move(sorted);
}

}  // namespace ispf
