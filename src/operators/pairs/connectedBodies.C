// SPDX-License-Identifier: GPL-3.0-or-later
#include "connectedBodies.H"

namespace ispf
{

connectedBodies::connectedBodies(const particleCloud& cloud, const neighbourList& list,
                                 const medium& within)
    : of(cloud.n(), -1)
{
    List<List<label>> strips(cloud.stripArea.size());
    for (label i = within.first; i < cloud.n(); ++i)
        if (const label k = cloud.stripOf(i); k > 0) strips[k].push_back(i);
    label left = cloud.n() - within.first;
    List<label> reached;
    const auto reach = [&](label i) {
        if (of[i] < 0) of[i] = n, reached.push_back(i), --left;
    };
    for (label first = within.first; left > 0; ++first)
    {
        if (of[first] >= 0) continue;
        reached.clear(), reach(first);
        while (!reached.empty() && left > 0)
        {
            const label i = reached.back();
            reached.pop_back();
            forNeighbours(list, within.row(list, i), [&](pairIndex, label j) {
                if (const label owner = cloud.ownerOf(j); owner >= within.first) reach(owner);
            });
            if (const label k = cloud.stripOf(i); k > 0)
            {
                for (const label j : strips[k]) reach(j);
                strips[k].clear();
            }
        }
        ++n;
    }
}

}  // namespace ispf
