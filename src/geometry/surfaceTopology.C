// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceTopology.H"

#include "surfaceSides.H"

namespace ispf
{

List<List<std::pair<label, bool>>> edgeNeighbours(const triSurface& s)
{
    List<List<std::pair<label, bool>>> next(s.size());
    const List<side> sides = sortedSides(s);
    forEdges(sides, [&](size_t i, size_t j) {
        if (j - i != 2) return;
        const bool same = sides[i].forward == sides[i + 1].forward;
        next[sides[i].triangle].push_back({sides[i + 1].triangle, same});
        next[sides[i + 1].triangle].push_back({sides[i].triangle, same});
    });
    return next;
}

List<std::array<label, 2>> openHalfEdges(const triSurface& s)
{
    List<std::array<label, 2>> open;
    const List<side> sides = sortedSides(s);
    forEdges(sides, [&](size_t i, size_t j) {
        label balance = 0;
        for (size_t k = i; k < j; ++k) balance += sides[k].forward ? 1 : -1;
        for (; balance > 0; --balance) open.push_back({sides[i].low, sides[i].high});
        for (; balance < 0; ++balance) open.push_back({sides[i].high, sides[i].low});
    });
    return open;
}

closednessReport checkClosed(const triSurface& s)
{
    closednessReport report;
    const List<side> sides = sortedSides(s);
    forEdges(sides, [&](size_t i, size_t j) {
        if (j - i == 2 && sides[i].forward == sides[i + 1].forward) ++report.flippedPairs;
    });
    scalar longest = -1;
    for (const auto& [a, b] : openHalfEdges(s))
    {
        const scalar length = (s.nodes[b] - s.nodes[a]).norm();
        ++report.openEdges;
        report.openLength += length;
        if (length > longest) longest = length, report.openAt = 0.5 * (s.nodes[a] + s.nodes[b]);
    }
    return report;
}

word closednessReport::describe() const
{
    if (closed()) return "closed";
    const vector at = openAt;
    word text;
    if (openEdges > 0)
        text = std::to_string(openEdges) + (openEdges == 1 ? " open edge" : " open edges") +
               " of total length " + str(openLength) + " m, the longest at (" + str(at[0]) + " " +
               str(at[1]) + " " + str(at[2]) + ") m";
    if (flippedPairs > 0)
        text += (text.empty() ? "" : ", and ") + std::to_string(flippedPairs) +
                (flippedPairs == 1 ? " edge" : " edges") +
                " whose two triangles disagree on the outside";
    return text;
}

List<label> connectedComponents(const triSurface& s)
{
    const auto next = edgeNeighbours(s);
    List<label> component(s.size(), -1), stack;
    label count = 0;
    for (label seed = 0; seed < s.size(); ++seed)
    {
        if (component[seed] >= 0) continue;
        stack.push_back(seed);
        component[seed] = count;
        while (!stack.empty())
        {
            const label t = stack.back();
            stack.pop_back();
            for (const auto& [other, same] : next[t])
                if (component[other] < 0) component[other] = count, stack.push_back(other);
        }
        ++count;
    }
    return component;
}

}  // namespace ispf
