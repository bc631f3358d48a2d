// SPDX-License-Identifier: GPL-3.0-or-later
#include "restState.H"

#include "surfaceRefinement.H"
#include <cmath>

namespace ispf
{

namespace
{

// Change of a particle's volume from rest to start: the solid is incompressible
constexpr scalar largestGrowth = 0.02;
constexpr scalar planeSlip = 1e-3;  // [dx]

word text(const vector& x)
{
    return "(" + str(x[0], 4) + " " + str(x[1], 4) + " " + str(x[2], 4) + ")";
}

// Volume ratio of the map, by central differences
scalar volumeRatio(const initialFields& zone, const vector& x, scalar dx, int nDims)
{
    const scalar step = 1e-3 * dx;
    tensor slope = tensor::Identity();
    for (int a = 0; a < nDims; ++a)
    {
        const vector d = step * vector::Unit(a);
        slope.col(a) = (zone.rest(x + d) - zone.rest(x - d)) / (2 * step);
    }
    return slope.determinant();
}

void check(const initialFields& zone, const word& name, const vector& x,
           const zoneGeometry& geometry)
{
    const scalar J = volumeRatio(zone, x, geometry.dx(), geometry.nDims());
    if (!(std::abs(J - 1) < largestGrowth))
        throw fatalError("Zone " + name + ", the particle at " + text(x) +
                             ": at rest it would be " + str(J, 4) +
                             " times as large as placed, but the solid is incompressible. Take "
                             "formulas that keep volumes, their Jacobian is 1",
                         zone.whereRest());
    const scalar reach = 3 * geometry.dx();  // images further away are not neighbours
    for (const halfSpace& plane : geometry.symmetryPlanes())
    {
        if (std::abs(plane.distance(x)) > reach) continue;
        const vector image = zone.rest(plane.mirror(x)), mirrored = plane.mirror(zone.rest(x));
        if ((image - mirrored).norm() > planeSlip * geometry.dx())
            throw fatalError("Zone " + name + ", the particle at " + text(x) + ": it rests at " +
                                 text(zone.rest(x)) + ", its image beyond the symmetry plane at " +
                                 text(image) + ", which is not the image of the former " +
                                 text(mirrored) + ". Take formulas that are as symmetric",
                             zone.whereRest());
    }
}

}  // namespace

bool restsElsewhere(const List<initialFields>& initial)
{
    for (const initialFields& zone : initial)
        if (zone.restsElsewhere()) return true;
    return false;
}

List<vector> restPositions(const zoneGeometry& geometry, const placedParticles& placed,
                           const List<initialFields>& initial)
{
    List<vector> rest;
    for (size_t i = 0; i < placed.x.size(); ++i)
    {
        const label z = placed.zone[i];
        const bool solid = geometry.zones()[z].phase == phaseType::solid;
        if (initial[z].restsElsewhere())
            check(initial[z], geometry.zones()[z].name, placed.x[i], geometry);
        rest.push_back(solid ? initial[z].rest(placed.x[i]) : vector::Zero());
    }
    return rest;
}

triSurface atRest(triSurface surface, const initialFields& zone, const zoneGeometry& geometry)
{
    if (!zone.restsElsewhere()) return surface;
    surface.weld(1e-3 * geometry.dx());
    refine(surface, geometry.dx());  // facets do not bend
    for (vector& x : surface.nodes)
    {
        const scalar z = x[2];
        if (geometry.nDims() == 2) x[2] = 0;
        x = zone.rest(x);
        if (geometry.nDims() == 2) x[2] = z;
    }
    return surface;
}

}  // namespace ispf
