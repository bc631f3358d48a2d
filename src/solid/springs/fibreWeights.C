// SPDX-License-Identifier: GPL-3.0-or-later
#include "fibreWeights.H"

#include "fibres.H"
#include "forPairs.H"

#include <cmath>

namespace ispf
{

namespace
{

// A weight above one by less is rounding
constexpr scalar noWeight = 1e-12;

// Resistance of a link of stiffness k to a stretch along f that keeps the volume, over d^2: the strain of its direction n is
// (n.f)^2 less what the directions across lose
scalar along(const vector& n, const vector& f, int nDims)
{
    const scalar c = n.dot(f) * n.dot(f), strain = c - (1 - c) / (nDims - 1);
    return strain * strain;
}

}  // namespace

word weighAlongFibres(const dictionary& dict, const structureReference& ref,
                      const referenceNeighbours& pairs, List<scalar>& k)
{
    if (!dict.found("fibres"))
    {
        for (const word key : {"fibreWeight", "fibrePower"})
            if (dict.found(key))
                dict.fail(key, "It acts with 'fibres { .. }' beside it, and there are none");
        return "";
    }
    const fibreDirections fibres(dict.subDict("fibres"), ref.x0);
    const scalar weight = dict.getInRange("fibreWeight", 1e-6, 1e6);
    const label power = dict.getInRangeOrDefault<label>("fibrePower", 1, 20, 1);
    scalar most = 0, before = 0, after = 0;
    for (label i = 0; i < ref.n(); ++i)
        forNeighbours<among::all>(pairs, i, [&](pairIndex p, label j) {
            const vector d = pairs.separation(ref, i, p), n = d.normalized();
            // the partner's fibres are turned with its image
            const vector nOfPartner =
                pairs.image[p] ? vector(ref.images[pairs.image[p] - 1].R.transpose() * n) : n;
            scalar w = 0;
            for (label a = 0; a < fibres.nFamilies(); ++a)
                w += weight / 2 *
                     (std::pow(n.dot(fibres.of(a, i)), 2 * power) +
                      std::pow(nOfPartner.dot(fibres.of(a, j)), 2 * power));
            const scalar resists = k[p] * d.squaredNorm() * along(n, fibres.of(0, i), ref.nDims);
            before += resists, after += (1 + w) * resists;
            k[p] *= 1 + w, most = std::max(most, w);
        });
    if (most < noWeight)
        dict.fail("fibres", "No link has a part along the fibres: they have no effect");
    return "fibres: links up to " + str(1 + most, 4) +
           " times as stiff, the body along the first family " + str(after / before, 4) + " times";
}

}  // namespace ispf
