// SPDX-License-Identifier: GPL-3.0-or-later
#include "springLinks.H"
#include "springModuli.H"

#include <algorithm>
#include <limits>

namespace ispf
{

namespace
{

// Room for round-off and for a lattice known to a few digits only; the next shell is 20 % away
constexpr scalar latticeTolerance = 0.02;

scalar linkRadius(const dictionary& dict, const structureReference& ref)
{
    const word links = dict.choose("links", {"lattice8", "lattice18", "radius"});
    if (links == "radius") return dict.getInRange("radius", 0.5, 10) * ref.dx * (1 + 1e-6);
    const int dims = links == "lattice8" ? 2 : 3;
    if (dims != ref.nDims)
        dict.fail("links", links + " is for " + std::to_string(dims) +
                               " dimensions, the case has " + std::to_string(ref.nDims) + ". Use " +
                               (ref.nDims == 2 ? "lattice8" : "lattice18") + " or radius");
    return std::sqrt(2.0) * ref.dx * (1 + latticeTolerance);
}

}  // namespace

springLinks::springLinks(const dictionary& dict, const structureReference& ref)
    : pairs(ref, linkRadius(dict, ref)), rule(dict.get<word>("links"))
{
    d0.resize(size_t(pairs.nPairs())), k.assign(d0.size(), 1);
    for (label i = 0; i < ref.n(); ++i)
        for (std::int64_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p)
            d0[p] = pairs.separation(ref, i, p).norm();
    if (rule != "radius") checkLattice(dict, ref);
    setStiffness(dict, ref);
}

void springLinks::checkLattice(const dictionary& dict, const structureReference& ref) const
{
    for (label i = 0; i < ref.n(); ++i)
        for (std::int64_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p)
        {
            const scalar d = d0[p] / ref.dx;
            if (std::abs(d - 1) < latticeTolerance ||
                std::abs(d - std::sqrt(2.0)) < std::sqrt(2.0) * latticeTolerance)
                continue;
            dict.fail("links", "solid particles " + std::to_string(i) + " and " +
                                   std::to_string(pairs.index[p]) + " are " + str(d) +
                                   " dx apart, which no lattice has. On relaxed particles use "
                                   "'links radius; radius 2.6;'");
        }
}

scalar springLinks::shearModulus(const structureReference& ref, label i) const
{
    return isotropicShear(particleModulus(ref, pairs, k, i), ref.nDims);
}

}  // namespace ispf
