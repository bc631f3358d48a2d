// SPDX-License-Identifier: GPL-3.0-or-later
#include "closedGaps.H"
#include "forPairs.H"
#include "pairViscosity.H"

#include <algorithm>

namespace ispf
{

namespace
{

// Cosine of the angle between normals of surfaces that face each other, at most
constexpr scalar opposite = -0.7;

const word remedy = "Give more, or leave 'contact' away";

}  // namespace

std::unique_ptr<closedGaps> closedGaps::New(const dictionary& structureProperties)
{
    if (!structureProperties.found("contact")) return nullptr;
    return std::make_unique<closedGaps>(structureProperties.subDict("contact"));
}

closedGaps::closedGaps(const dictionary& dict)
    : gap_(dict.getInRange("gap", 0, 3)),
      factor_(dict.getInRangeOrDefault<scalar>("viscosity", 1, 1e6, 100))
{
    dict.refuseOthers({"gap", "viscosity"});
    if (gap_ == 0) dict.fail("gap", "A gap of 0 closes no layer and has no effect. " + remedy);
    if (factor_ == 1)
        dict.fail(
            "viscosity",
            "Fluid with 1 times its own viscosity flows as before: it has no effect. " + remedy);
}

bool closedGaps::face(const facing& a, const facing& b, scalar most)
{
    return a.normal.dot(b.normal) < opposite && a.distance + b.distance < most;
}

// Lists the surfaces of solids, and of walls if there are any solids, that fluid particle i has within the gap
List<closedGaps::facing> closedGaps::facesOf(const fsiCase& c, const solidSurface& surface,
                                             label i) const
{
    const particleCloud& cloud = c.cloud;
    const vector x = cloud.x[i].xyz();
    List<facing> faces;
    forNeighbours<among::others>(c.list, i, [&](pairIndex, label j) {
        const label k = cloud.ownerOf(j);
        if (k < 0 || cloud.isFluid(k)) return;
        const tensor R = j == k ? tensor(tensor::Identity()) : cloud.ruleOf(j).R;
        surface.forSides(k, [&](const vector& S, const vector& e) {
            const vector n = (R * S).normalized();
            const scalar d = n.dot(x - cloud.x[j].xyz() - R * e);
            if (d > -0.5 * cloud.dx && d < gap_ * cloud.dx) faces.push_back({k, n, d});
        });
    });
    if (faces.empty()) return faces;
    for (const nearWall& w : c.walls->wallsNear(x, x, gap_ * cloud.dx))
        faces.push_back({-1, -w.normal, (w.foot - x).norm()});
    return faces;
}

void closedGaps::close(fsiCase& c, const solidSurface& surface) const
{
    particleCloud& cloud = c.cloud;
    List<scalar>& ratio = cloud.scalars[viscosityRatio];
    if (!c.viscosity) ratio.assign(cloud.n(), 1);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
    {
        bool closed = false;
        const List<facing> faces = facesOf(c, surface, i);
        for (const facing& a : faces)
            for (const facing& b : faces)
            {
                if (a.solid < 0 || !face(a, b, gap_ * cloud.dx)) continue;
                closed = true, ratio[a.solid] = factor_;
                if (b.solid >= 0) ratio[b.solid] = factor_;
            }
        if (closed) ratio[i] = factor_ * std::max(ratio[i], scalar(1));
    }
}

}  // namespace ispf
