// SPDX-License-Identifier: GPL-3.0-or-later
// Checks contacts: a solid that no fluid reaches has a wrong place or a wrong unit
#include "zoneGeometry.H"

#include <algorithm>

namespace ispf
{

namespace
{

struct approach
{
    scalar distance = std::numeric_limits<scalar>::max();
    vector from = vector::Zero(), to = vector::Zero();
};

// Nearest approach of s to the other surface, by the centres of its facets
approach nearestApproach(const triSurface& s, const surfaceSearch& other, int nDims)
{
    approach best;
    for (label t = 0; t < s.size(); ++t)
    {
        vector x = s.centre(t);
        if (nDims == 2) x[2] = 0;
        const surfacePoint q = other.nearest(x, best.distance);
        if (q.found && q.distance < best.distance) best = {q.distance, x, q.point};
    }
    return best;
}

word place(const vector& x)
{
    return "(" + str(x[0]) + " " + str(x[1]) + " " + str(x[2]) + ")";
}

constexpr scalar farOff = 3;  // dx: beyond it no kernel reaches

}  // namespace

void zoneGeometry::checkContacts() const
{
    const auto isFluid = [&](size_t z) { return zones_[z].phase == phaseType::fluid; };
    const auto touch = [&](size_t a, size_t b) {
        const auto names = [](const triSurface& s, const word& other) {
            return std::find(s.patchNames.begin(), s.patchNames.end(), towards(other)) !=
                   s.patchNames.end();
        };
        return names(boundary_[a], zones_[b].name) || names(boundary_[b], zones_[a].name);
    };
    List<char> reached(zones_.size());
    triSurface fluid;
    for (size_t z = 0; z < zones_.size(); ++z)
    {
        reached[z] = isFluid(z);
        if (isFluid(z)) fluid.append(boundary_[z]);
    }
    if (fluid.empty()) return;
    for (size_t round = 0; round < zones_.size(); ++round)
        for (size_t a = 0; a < zones_.size(); ++a)
            for (size_t b = 0; b < zones_.size(); ++b)
                if (reached[a] && touch(a, b)) reached[b] = 1;
    const surfaceSearch search(fluid);
    for (size_t z = 0; z < zones_.size(); ++z)
    {
        if (reached[z]) continue;
        const approach gap = nearestApproach(boundary_[z], search, nDims_);
        const word text = "The solid zone " + zones_[z].name +
                          " touches no fluid, nor a zone that does: its nearest face, at " +
                          place(gap.from) + ", is " + str(gap.distance, 3) +
                          " m = " + str(gap.distance / dx_, 3) + " dx away from the fluid's at " +
                          place(gap.to);
        if (gap.distance > farOff * dx_)
            throw fatalError(text + ". Are the units and places of both right?");
        warning(text + ": nothing is put into the gap");
    }
}

}  // namespace ispf
