// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundaryLoops.H"

#include "surfaceTopology.H"
#include <algorithm>
#include <array>
#include <map>

namespace ispf
{

namespace
{

boundaryLoop measured(List<label> nodes, const triSurface& s)
{
    boundaryLoop loop;
    loop.nodes = std::move(nodes);
    const size_t n = loop.nodes.size();
    const auto at = [&](size_t k) -> const vector& { return s.nodes[loop.nodes[k % n]]; };
    boundBox box;
    for (size_t k = 0; k < n; ++k)
    {
        const scalar side = (at(k + 1) - at(k)).norm();
        loop.length += side;
        loop.centre += 0.5 * side * (at(k) + at(k + 1));
        box.add(at(k));
    }
    loop.centre /= loop.length;
    // the missing facets run along the rim in the opposite direction
    for (size_t k = 0; k < n; ++k)
        loop.area -= 0.5 * (at(k) - loop.centre).cross(at(k + 1) - loop.centre);
    loop.size = (box.max - box.min).maxCoeff();
    for (size_t k = 0; k < n; ++k)
        loop.offPlane = std::max(loop.offPlane, std::abs((at(k) - loop.centre).dot(loop.normal())));
    return loop;
}

}  // namespace

word place(const vector& x, scalar nothing)
{
    List<word> text;
    for (const scalar value : x) text.push_back(str(std::abs(value) < nothing ? 0 : value));
    return "(" + join(text) + ")";
}

vector boundaryLoop::normal() const
{
    return area.norm() > 0 ? vector(area.normalized()) : vector(vector::Zero());
}

scalar boundaryLoop::width() const
{
    return 2 * area.norm() / length;
}

word boundaryLoop::describe(scalar dx) const
{
    return "at " + place(centre, 1e-6 * dx) + " m, " + str(size, 3) + " m = " + str(size / dx, 3) +
           " dx across, " + std::to_string(nodes.size()) + " edges";
}

List<boundaryLoop> boundaryLoops(const triSurface& s)
{
    std::multimap<label, label> next;
    for (const auto& [a, b] : openHalfEdges(s)) next.emplace(a, b);
    List<boundaryLoop> loops;
    std::map<label, size_t> onPath;  // place of a node in the path
    List<label> path;
    while (!next.empty())
    {
        if (path.empty()) path.push_back(next.begin()->first), onPath[path[0]] = 0;
        const auto step = next.find(path.back());
        const label to = step->second;
        next.erase(step);
        const auto met = onPath.find(to);
        if (met == onPath.end())
        {
            onPath[to] = path.size(), path.push_back(to);
            continue;
        }
        // rims that touch in a node are separated here
        const size_t from = met->second;
        loops.push_back(measured({path.begin() + from, path.end()}, s));
        for (size_t k = from + 1; k < path.size(); ++k) onPath.erase(path[k]);
        path.resize(from + 1);
        if (from == 0) path.clear(), onPath.clear();
    }
    // the largest first, equal sizes sorted by place; the last digits do not count
    scalar largest = 0;
    for (const boundaryLoop& loop : loops) largest = std::max(largest, loop.size);
    const auto rank = [&](const boundaryLoop& loop) {
        const auto rounded = [&](scalar x) { return std::round(1e6 * x / largest); };
        const vector& c = loop.centre;
        return std::array{-rounded(loop.size), rounded(c[0]), rounded(c[1]), rounded(c[2])};
    };
    std::stable_sort(loops.begin(), loops.end(), [&](const boundaryLoop& a, const boundaryLoop& b) {
        return rank(a) < rank(b);
    });
    return loops;
}

}  // namespace ispf
