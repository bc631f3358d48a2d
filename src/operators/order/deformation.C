// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation.H"
#include "forPairs.H"

#include <cmath>

namespace ispf
{

pairDeformation fastestDeformation(const particleCloud& cloud, const neighbourList& list)
{
    List<vec4> u(cloud.Up.begin(), cloud.Up.begin() + cloud.n());
    cloud.fillGradientGhosts(u);
    const auto faster = [](scalar a, scalar b) { return a > b || (a != a && b == b); };
    // rate holds the square
    const auto parts = parallelParts(cloud.n(), [&](label begin, label end) {
        pairDeformation most;
        for (label i = begin; i < end; ++i)
            forNeighbours<among::media>(list, i, [&](pairIndex, label j) {
                const scalar rate = magSqr(u[i].s - u[j].s) / magSqr(cloud.x[i].s - cloud.x[j].s);
                if (faster(rate, most.rate)) most = {rate, i, j};
            });
        return most;
    });
    pairDeformation most;
    for (const pairDeformation& part : parts)
        if (faster(part.rate, most.rate)) most = part;
    most.rate = std::sqrt(most.rate);
    return most;
}

}  // namespace ispf
