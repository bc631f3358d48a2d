// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall.H"

namespace ispf
{

namespace
{

wallRepresentation representationOf(const dictionary& dict, bool slip)
{
    const word kind = dict.chooseOrDefault("representation", {"particles", "mirror"},
                                           slip ? "mirror" : "particles");
    if (slip && kind == "particles")
        dict.fail("representation",
                  "rigid particles hold the fluid that passes them: a wall with 'slip yes' is a "
                  "mirror. Leave representation away");
    return kind == "mirror" ? wallRepresentation::mirror : wallRepresentation::particles;
}

}  // namespace

wall wall::New(const word& name, const dictionary& dict, const word& caseFolder)
{
    wall w;
    w.name = name;
    w.slip = dict.getOrDefault("slip", false);
    w.representation = representationOf(dict, w.slip);
    w.plane = dict.chooseOrDefault("surface", {"triSurface", "plane"}, "triSurface") == "plane";
    w.motion = wallMotion(dict, caseFolder);
    w.twoSided = dict.getOrDefault("twoSided", false);
    w.clamps = dict.getOrDefault<List<word>>("clamps", {});
    if (!w.clamps.empty())
        w.clampDepth = dict.getInRangeOrDefault("clampDepth", 0.1, 100, w.clampDepth);
    if (w.slip && w.motion.slides())
        dict.fail("slip",
                  "with 'slip yes' a wall that slides in itself does not drag the fluid: remove "
                  "'velocity' and 'rotation', or remove slip");
    if (!w.plane) return w;
    if (w.twoSided)
        dict.fail("twoSided",
                  "a plane has no end and fluid on one side only; use surface triSurface");
    w.point = dict.get<vector>("point", dims::length),
    w.normal = nonZero(dict, "normal").normalized();
    if (!w.motion.slidesWithin(w.normal))
        dict.fail(dict.found("velocity") ? "velocity" : "rotation",
                  "velocity must lie in the plane, and the axis of a rotation along its normal, as "
                  "the surface stays where it is. Let the wall itself move with motion { ... }");
    if (w.motion.turns())
        dict.subDict("motion").fail(
            "rotation", "a plane has no end and cannot turn out of itself; use surface triSurface");
    return w;
}

void wall::setStep(scalar t0, scalar t1)
{
    moveTo(t0), after = motion.frame(t1);
    surfaceVelocity = motion.surfaceVelocity(t0, t1), velocity = motion.velocity(t0, t1);
}

void wall::moveTo(scalar t)
{
    frame = motion.frame(t);
}

}  // namespace ispf
