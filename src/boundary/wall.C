// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall.H"

namespace ispf
{

wallMotion::wallMotion(const dictionary& patch, const word& caseFolder)
{
    slide_ = patch.getOrDefault<vector>("velocity", vector::Zero(), dims::velocity);
    const dictionary* motion = patch.findDict("motion");
    if (!motion) return;
    moves_ = true;
    const bool steady = motion->found("velocity");
    if (steady == motion->found("displacement"))
        motion->fail(steady ? "velocity" : "displacement",
                     "motion wants either 'direction' and 'displacement', or 'velocity'");
    direction_ = steady ? motion->get<vector>("velocity", dims::velocity)
                        : nonZero(*motion, "direction").normalized();
    if (steady) return;
    displacement_ = Function1::New("displacement", *motion, caseFolder, dims::length);
}

vector wallMotion::offset(scalar t) const
{
    if (!moves_) return vector::Zero();
    return (displacement_ ? displacement_->value(t) : t) * direction_;
}

vector wallMotion::velocity(scalar t0, scalar t1) const
{
    if (!moves_) return slide_;
    return slide_ + (displacement_ ? displacement_->rate(t0, t1) : 1) * direction_;
}

wall wall::New(const word& name, const dictionary& dict, const word& caseFolder)
{
    wall w;
    w.name = name;
    const word kind = dict.chooseOrDefault("representation", {"particles", "mirror"}, "particles");
    w.representation =
        kind == "mirror" ? wallRepresentation::mirror : wallRepresentation::particles;
    w.plane = dict.chooseOrDefault("surface", {"triSurface", "plane"}, "triSurface") == "plane";
    w.motion = wallMotion(dict, caseFolder);
    w.twoSided = dict.getOrDefault("twoSided", false);
    if (!w.plane) return w;
    if (w.twoSided)
        dict.fail("twoSided",
                  "a plane has no end and fluid on one side only; use surface triSurface");
    w.point = dict.get<vector>("point", dims::length),
    w.normal = nonZero(dict, "normal").normalized();
    if (std::abs(w.motion.slide().dot(w.normal)) > 1e-9 * w.motion.slide().norm())
        dict.fail("velocity",
                  "velocity must lie in the plane, as the surface stays where it is. "
                  "Let the wall itself move with motion { velocity ...; }");
    return w;
}

void wall::setStep(scalar t0, scalar t1)
{
    moveTo(t0);
    velocity = motion.velocity(t0, t1);
}

void wall::moveTo(scalar t)
{
    offset = motion.offset(t), standsAt = t;
}

}  // namespace ispf
