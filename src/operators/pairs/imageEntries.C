// SPDX-License-Identifier: GPL-3.0-or-later
#include "imageEntries.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

namespace
{

// The term w (p_i - m p_s) of row i; s is `column`
struct link
{
    label row, column;
    scalar m, w;
};

bool before(const link& a, const link& c)
{
    return a.column != c.column ? a.column < c.column : a.m < c.m;
}

// Links in the order of their rows.  Within a row they are sorted, and equal links are summed
struct linkRows
{
    List<label> start, end;  // row i has links [start[i], end[i])
    List<link> links;

    linkRows(label n, const List<link>& unsorted) : start(n + 1, 0), end(n), links(unsorted.size())
    {
        for (const link& l : unsorted) ++start[l.row + 1];
        for (label i = 0; i < n; ++i) start[i + 1] += start[i];
        List<label> next(start.begin(), start.end() - 1);
        for (const link& l : unsorted) links[next[l.row]++] = l;
        parallelFor(n, [&](label begin, label stop) {
            for (label i = begin; i < stop; ++i) mergeRow(i);
        });
    }

    void mergeRow(label i)
    {
        end[i] = start[i];
        if (start[i] == start[i + 1]) return;
        std::sort(links.begin() + start[i], links.begin() + start[i + 1], before);
        label to = start[i];
        // by hand: the links of a row are moved within it
        for (label k = start[i] + 1; k < start[i + 1]; ++k)
            if (links[k].column == links[to].column && links[k].m == links[to].m)
                links[to].w += links[k].w;
            else links[++to] = links[k];
        end[i] = to + 1;
    }
};

void appendLinks(const particleCloud& cloud, const neighbourList& list,
                 const List<scalar>& stiffness, label i, List<link>& links)
{
    forNeighbours<among::connected>(list, i, [&](pairIndex k, label j) {
        if (j < cloud.n()) return;
        const scalar w = -(stiffness[i] + stiffness[cloud.ghostSource(j)]) * list.F[k];
        if (!negligible(w, cloud.dx))
            links.push_back({i, cloud.ghostSource(j), cloud.ruleOf(j).M(3, 3), w});
    });
}

List<link> linksOf(const particleCloud& cloud, const neighbourList& list,
                   const List<scalar>& stiffness)
{
    constexpr label blockRows = 4096;
    const label nBlocks = (cloud.n() + blockRows - 1) / blockRows;
    List<List<link>> part(nBlocks);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label b = begin; b < end; ++b)
                for (label i = b * blockRows; i < std::min(cloud.n(), (b + 1) * blockRows); ++i)
                    appendLinks(cloud, list, stiffness, i, part[b]);
        },
        1);
    List<link> links;
    for (const List<link>& p : part) links.insert(links.end(), p.begin(), p.end());
    return links;
}

// Half of each link stays in its own row, half goes to the row of the source
List<link> symmetrised(const linkRows& rows)
{
    List<link> links;
    links.reserve(2 * rows.links.size());
    for (size_t i = 0; i < rows.end.size(); ++i)
        // by hand: links are no list of neighbours
        for (label k = rows.start[i]; k < rows.end[i]; ++k)
        {
            link l = rows.links[k];
            const bool pair = l.row != l.column && l.m != 0;
            if (pair) l.w *= 0.5;
            links.push_back(l);
            if (pair) links.push_back({l.column, l.row, l.m, l.w});
        }
    return links;
}

}  // namespace

void imageEntries::build(const particleCloud& cloud, const neighbourList& list,
                         const List<scalar>& stiffness)
{
    const label n = cloud.n();
    start.assign(n + 1, 0), diagonal.assign(n, 0), entries.clear();
    if (cloud.nGhosts() == 0) return;

    const linkRows oneSided(n, linksOf(cloud, list, stiffness));
    const linkRows rows(n, symmetrised(oneSided));
    for (label i = 0; i < n; ++i)
    {
        start[i] = label(entries.size());
        // by hand: links are no list of neighbours
        for (label k = rows.start[i]; k < rows.end[i]; ++k)
        {
            const link& l = rows.links[k];
            diagonal[i] += l.w;
            if (l.column == i) diagonal[i] -= l.m * l.w;
            else if (label(entries.size()) > start[i] && entries.back().column == l.column)
                entries.back().offDiagonal -= l.m * l.w;
            else entries.push_back({l.column, -l.m * l.w});
        }
    }
    start[n] = label(entries.size());
}

}  // namespace ispf
