// SPDX-License-Identifier: GPL-3.0-or-later
#include "sharedRims.H"

#include "pointGrid.H"

#include <algorithm>

namespace ispf
{

namespace
{

// An open face that gives the velocity, with the sites of its strip
struct givingFace
{
    const openFace& face;
    List<vector> strip;
};

bool meets(const givingFace& g, const wallSet& walls, label w, scalar dx)
{
    const bodyFrame& frame = walls.walls()[w].frame;
    return std::any_of(g.strip.begin(), g.strip.end(),
                       [&](const vector& x) { return walls.distance(w, frame.toBody(x)) < dx; });
}

// True if the two faces meet and give velocities of different directions there
bool clash(const givingFace& g, const givingFace& other, scalar dx)
{
    pointGrid grid(2 * dx);
    for (const vector& x : other.strip) grid.add(x);
    return std::any_of(g.strip.begin(), g.strip.end(), [&](const vector& x) {
        const label near = grid.nearestIndex(x, 2 * dx);
        return near >= 0 && (g.face.givenDirection(x).normalized() -
                             other.face.givenDirection(grid[near]).normalized())
                                    .norm() > 0.1;
    });
}

}  // namespace

void sharedRims::find(const patchSetting& s)
{
    const scalar dx = s.cloud.dx;
    const auto whereOf = [&](const word& name) { return s.patches.subDict(name).where("type"); };
    List<givingFace> given;
    for (const auto& p : s.all)
        if (const openFace* face = p->face(); face && face->givesVelocity())
            given.push_back({*face, s.sites().positions(p->name(), whereOf(p->name()))});
    for (size_t k = 0; k < given.size(); ++k)
    {
        const word& name = given[k].face.name();
        for (label w = 0; w < label(s.walls.walls().size()); ++w)
            if (const wall& at = s.walls.walls()[w];
                at.motion.moves() && meets(given[k], s.walls, w, dx))
                s.patches.subDict(name).fail(
                    "type", "Wall " + at.name + " moves, and ends at the face " + name +
                                ", where the velocity is given: the wall would run into fluid "
                                "that enters. Give the pressure there; or, if the surface of the "
                                "wall stays in place, give the wall a 'velocity' or 'rotation'");
        for (size_t m = k + 1; m < given.size(); ++m)
            if (clash(given[k], given[m], dx))
                rims_.push_back({&given[k].face, &given[m].face, whereOf(name)});
    }
}

void sharedRims::check(scalar time) const
{
    for (const rim& r : rims_)
        if (r.face->bringsIn() && r.other->bringsIn())
            throw fatalError("The faces " + r.face->name() + " and " + r.other->name() +
                                 " meet, and at time " + str(time) +
                                 " s both bring fluid in, which runs into each other there. Give "
                                 "both one 'direction', one of them the pressure, or leave a "
                                 "piece of wall between them",
                             r.where);
}

}  // namespace ispf
