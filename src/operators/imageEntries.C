// SPDX-License-Identifier: GPL-3.0-or-later
#include "imageEntries.H"

#include <algorithm>

namespace ispf
{

namespace
{

struct weighted
{
    scalar w = 0, wb = 0;
    void operator+=(const weighted& a) { w += a.w, wb += a.wb; }
};

// w (p_i - m p_s - b) in row i: its own half and the half that mirrors the row of the source
struct link
{
    label row, column;
    scalar m;
    weighted own, mirrored;

    scalar weight() const { return own.w + mirrored.w; }
    // b is the row's own business (a wall's body-force jump has one sign on both sides, a cyclic
    // jump two); only a row that does not see the image takes the other's
    scalar source() const
    {
        const weighted& b = own.w > 0 ? own : mirrored;
        return weight() * b.wb / b.w;
    }
};

bool before(const link& a, const link& c)
{
    return a.column != c.column ? a.column < c.column : a.m < c.m;
}

// Links in order of rows, each row's sorted and equal ones summed
struct linkRows
{
    List<label> start, end;  // of row i: [start[i], end[i])
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
        for (label k = start[i] + 1; k < start[i + 1]; ++k)
            if (links[k].column == links[to].column && links[k].m == links[to].m)
                links[to].own += links[k].own, links[to].mirrored += links[k].mirrored;
            else links[++to] = links[k];
        end[i] = to + 1;
    }
};

void appendLinks(const particleCloud& cloud, const neighbourList& list, label i, List<link>& links)
{
    for (std::int64_t k = list.own[i]; k < list.wall[i]; ++k)
    {
        const label j = list.index[k];
        if (j < cloud.n()) continue;
        const scalar w = -2 * list.F[k];
        if (!negligible(w, cloud.dx))
            links.push_back({i,
                             cloud.ghostSource(j),
                             cloud.ruleOf(j).M(3, 3),
                             {w, w * cloud.ghostOffset(j)[3]},
                             {}});
    }
}

List<link> linksOf(const particleCloud& cloud, const neighbourList& list)
{
    constexpr label blockRows = 4096;
    const label nBlocks = (cloud.n() + blockRows - 1) / blockRows;
    List<List<link>> part(nBlocks);
    parallelFor(
        nBlocks,
        [&](label begin, label end) {
            for (label b = begin; b < end; ++b)
                for (label i = b * blockRows; i < std::min(cloud.n(), (b + 1) * blockRows); ++i)
                    appendLinks(cloud, list, i, part[b]);
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
        for (label k = rows.start[i]; k < rows.end[i]; ++k)
        {
            link l = rows.links[k];
            const bool pair = l.row != l.column && l.m != 0;
            if (pair) l.own.w *= 0.5, l.own.wb *= 0.5;
            links.push_back(l);
            if (pair) links.push_back({l.column, l.row, l.m, {}, l.own});
        }
    return links;
}

}  // namespace

void imageEntries::build(const particleCloud& cloud, const neighbourList& list)
{
    const label n = cloud.n();
    start.assign(n + 1, 0), diagonal.assign(n, 0), source.assign(n, 0), entries.clear();
    if (cloud.nGhosts() == 0) return;

    const linkRows oneSided(n, linksOf(cloud, list));
    const linkRows rows(n, symmetrised(oneSided));
    for (label i = 0; i < n; ++i)
    {
        start[i] = label(entries.size());
        for (label k = rows.start[i]; k < rows.end[i]; ++k)
        {
            const link& l = rows.links[k];
            source[i] += l.source();
            diagonal[i] += l.weight();
            if (l.column == i) diagonal[i] -= l.m * l.weight();
            else if (label(entries.size()) > start[i] && entries.back().column == l.column)
                entries.back().offDiagonal -= l.m * l.weight();
            else entries.push_back({l.column, -l.m * l.weight()});
        }
    }
    start[n] = label(entries.size());
}

}  // namespace ispf
