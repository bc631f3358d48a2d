// SPDX-License-Identifier: GPL-3.0-or-later
#include "leavingWalls.H"

#include <algorithm>

namespace ispf
{

void leavingWalls::find(const patchSetting& s)
{
    for (const wallSet::body& b : s.walls.bodies())
        for (const auto& p : s.all)
        {
            if (!p->pair()) continue;
            const wall& w = b.carrier(s.walls);
            const vector n = p->pair()->separation.normalized();
            if (!w.motion.movesAlong(n)) continue;
            const bool endless = w.plane && w.normal.cross(n).norm() > 1e-9;
            List<vector> nodes = w.plane ? List<vector>{w.point} : b.surface->mesh()->nodes;
            std::erase_if(nodes,
                          [&](const vector& X) { return s.group.beyond(X) > 0.01 * s.cloud.dx; });
            walls_.push_back({&w, p->pair(), endless, std::move(nodes),
                              s.patches.subDict(w.name).where("motion")});
        }
}

void leavingWalls::check(scalar t, scalar dx) const
{
    for (const leavingWall& one : walls_)
    {
        const bodyFrame frame = one.of->motion.frame(t);
        const bool reaches =
            one.endless || std::any_of(one.nodes.begin(), one.nodes.end(), [&](const vector& X) {
                return one.pair->depth(frame.toSpace(X)) < 0.5 * dx;
            });
        if (reaches)
            throw fatalError(
                "Wall " + one.of->name + " moves across the cyclic patch " + one.pair->name +
                    ", and at time " + str(t) +
                    " s its surface reaches one of the planes: a wall that leaves at one plane "
                    "does not enter at the other. If the surface slides or turns in itself, give "
                    "the wall a 'velocity' or 'rotation' instead of 'motion'; else keep it between "
                    "the planes",
                one.where);
    }
}

}  // namespace ispf
