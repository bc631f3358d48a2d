// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotion.H"

#include "patchSurface.H"

#include <cmath>

namespace ispf
{

namespace
{

tensor cross(const vector& w)  // w x .
{
    tensor W;
    W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return W;
}

tensor turnBy(scalar angle, const vector& axis)
{
    return Eigen::AngleAxis<scalar>(angle, axis).toRotationMatrix();
}

}  // namespace

void wallMotion::rotation::readAxis(const dictionary& d)
{
    origin = d.get<vector>("origin", dims::length), axis = nonZero(d, "axis").normalized();
}

wallMotion::wallMotion(const dictionary& patch, const word& caseFolder)
{
    readSlide(patch, caseFolder);
    if (const dictionary* motion = patch.findDict("motion")) readMotion(*motion, caseFolder);
}

void wallMotion::readSlide(const dictionary& patch, const word& caseFolder)
{
    if (patch.isDict("velocity"))
    {
        const dictionary& d = patch.subDict("velocity");
        slideDirection_ = nonZero(d, "direction").normalized();
        slideSpeed_ = Function1::New("speed", d, caseFolder, dims::velocity);
    }
    else slideDirection_ = patch.getOrDefault<vector>("velocity", vector::Zero(), dims::velocity);
    if (const dictionary* d = patch.findDict("rotation"))
    {
        spin_.readAxis(*d);
        spin_.rate = Function1::New("omega", *d, caseFolder, dims::frequency);
    }
}

void wallMotion::readMotion(const dictionary& motion, const word& caseFolder)
{
    moves_ = true;
    const bool steady = motion.found("velocity"), given = motion.found("displacement");
    if (const dictionary* d = motion.findDict("rotation"))
    {
        turn_.readAxis(*d);
        if (d->found("omega") == d->found("angle"))
            d->fail(d->found("omega") ? "omega" : "angle",
                    "rotation wants either 'omega' [rad/s] or 'angle' [rad]");
        if (d->found("angle")) turn_.angle = Function1::New("angle", *d, caseFolder, dims::none);
        else turn_.omega = d->get<scalar>("omega", dims::frequency);
    }
    if (steady && given)
        motion.fail("velocity",
                    "motion wants either 'direction' and 'displacement', or 'velocity'");
    if (!steady && !given && !turn_.given())
        motion.fail("displacement",
                    "motion wants 'direction' and 'displacement', 'velocity', or 'rotation'");
    if (steady) direction_ = motion.get<vector>("velocity", dims::velocity);
    if (!given) return;
    direction_ = nonZero(motion, "direction").normalized();
    displacement_ = Function1::New("displacement", motion, caseFolder, dims::length);
}

bool wallMotion::inPlane() const
{
    for (const rotation* r : {&turn_, &spin_})
        if (r->given() && std::abs(r->axis[2]) < 1 - 1e-12) return false;
    return slideDirection_[2] == 0 && (!moves_ || direction_[2] == 0);
}

vector wallMotion::offset(scalar t) const
{
    if (!moves_) return vector::Zero();
    return (displacement_ ? displacement_->value(t) : t) * direction_;
}

bodyFrame wallMotion::frame(scalar t) const
{
    bodyFrame f;
    f.t = offset(t);
    if (!turns()) return f;
    f.turned = true, f.R = turnBy(turn_.angleAt(t), turn_.axis);
    f.t += turn_.origin - f.R * turn_.origin;
    return f;
}

// Chords, not tangents: what follows the surface ends up on it however long the step
affineVelocity wallMotion::surfaceVelocity(scalar t0, scalar t1) const
{
    affineVelocity v;
    if (!moves_) return v;
    v.u = (displacement_ ? displacement_->rate(t0, t1) : 1) * direction_;
    if (!turns()) return v;
    const scalar angle = turn_.angleAt(t1) - turn_.angleAt(t0);
    v.addTurn((turnBy(angle, turn_.axis) - tensor::Identity()) / (t1 - t0),
              turn_.origin + offset(t0));
    return v;
}

affineVelocity wallMotion::velocity(scalar t0, scalar t1) const
{
    affineVelocity v = surfaceVelocity(t0, t1);
    const scalar t = 0.5 * (t0 + t1);
    v.u = slideSpeed_ ? vector(v.u + slideSpeed_->value(t) * slideDirection_)
                      : vector(slideDirection_ + v.u);
    if (spin_.given())
        v.addTurn(cross(spin_.rate->value(t) * spin_.axis), spin_.origin + offset(t0));
    return v;
}

scalar wallMotion::leavesItself(const triSurface& s) const
{
    scalar across[2] = {0, 0}, all[2] = {0, 0};
    for (label t = 0; t < s.size(); ++t)
    {
        const vector area = s.areaVector(t);
        const vector u[2] = {slideDirection_, spin_.axis.cross(vector(s.centre(t) - spin_.origin))};
        for (int k = 0; k < 2; ++k)
            across[k] += std::abs(u[k].dot(area)), all[k] += u[k].norm() * area.norm();
    }
    scalar most = 0;
    for (int k = 0; k < 2; ++k)
        if (all[k] > 0) most = std::max(most, across[k] / all[k]);
    return most;
}

bool wallMotion::slidesWithin(const vector& normal) const
{
    if (std::abs(slideDirection_.dot(normal)) > 1e-9 * slideDirection_.norm()) return false;
    return !spin_.given() || spin_.axis.cross(normal).norm() < 1e-9;
}

}  // namespace ispf
