// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.H"

#include "wallLayers.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar many = 12;  // layers are counted up to this number

// Solid particles at rest, then their images
List<vector> solidAtRest(const fsiCase& c)
{
    List<vector> body = c.structure->reference().x0;
    const size_t n = body.size();
    vector low = body[0], high = body[0];
    for (const vector& x : body) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const scalar reach = many * c.cloud.dx;
    for (const isometry& image : c.structure->reference().images)
        for (size_t i = 0; i < n; ++i)
        {
            const vector x = image(body[i]), off = (low - x).cwiseMax(x - high).cwiseMax(0);
            if (off.norm() < reach) body.push_back(x);
        }
    return body;
}

void checkLayers(const fsiCase& c, findings& found)
{
    const particleCloud& cloud = c.cloud;
    const label nSolid = cloud.nSolid();
    const int wanted = int(std::ceil(c.kernel->support() / cloud.dx - 1e-9)) + 1;
    const List<scalar> layers = layersBelow(solidAtRest(c), nSolid, cloud.dx, cloud.nDims, many);
    for (size_t z = 0; z < cloud.zones.size(); ++z)
    {
        List<scalar> seen;
        for (label i = 0; i < nSolid; ++i)
            if (cloud.zone[i] == z && layers[i] > 0) seen.push_back(layers[i]);
        if (seen.empty() || cloud.zones[z].fixed) continue;
        std::sort(seen.begin(), seen.end());
        const scalar least = seen[0], middle = seen[seen.size() / 2];
        const word text = "Layers through zone " + cloud.zones[z].name + ": " +
                          str(std::round(least)) + " at its thinnest (" + str(least, 3) +
                          "), median " + (middle > 0.8 * many ? "more than " : "") + str(middle, 3);
        const int n = int(std::round(least));
        const word advice = text + "; " + std::to_string(wanted) +
                            " are recommended (support/dx rounded up, and one): refine dx";
        if (n >= wanted) found.fine(text);
        else if (n == wanted - 1) found.warn(advice);
        else
            found.fail(advice + (n > 2 ? ""
                                       : ". Two layers cannot bend: they thin and widen "
                                         "together, and each keeps its volume"));
    }
}

void checkLinks(const fsiCase& c, findings& found)
{
    const List<label> links = c.structure->linkCounts();
    valueRange count;
    label loose = -1;
    for (label i = 0; i < c.structure->n(); ++i)
    {
        if (c.structure->reference().fixed[i]) continue;
        count.add(links[i]);
        if (links[i] < c.cloud.nDims) loose = i;
    }
    if (count.n == 0) return;
    found.note("Links of moving solid particles, least/mean/most: " + count.text());
    found.note(c.structure->description());
    if (loose >= 0)
        found.fail("Solid particle " + std::to_string(c.cloud.id[loose]) +
                   " is held by fewer links than there are directions");
}

}  // namespace

void checkSolids(const fsiCase& c, findings& found)
{
    if (!c.structure) return;
    found.heading("Checking solids...");
    checkLayers(c, found);
    checkLinks(c, found);
}

}  // namespace ispf
