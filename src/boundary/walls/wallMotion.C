// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotion.H"

#include "patchSurface.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

tensor cross(const vector& w)  // the matrix of w x
{
    tensor W;
    W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return W;
}

tensor turnBy(scalar angle, const vector& axis)
{
    return Eigen::AngleAxis<scalar>(angle, axis).toRotationMatrix();
}

class alongDirection : public vectorFunction1
{
public:
    alongDirection(const vector& direction, std::unique_ptr<Function1> size)
        : direction_(direction), size_(std::move(size))
    {
    }
    vector value(scalar t) const override { return size_->value(t) * direction_; }
    List<vector> parts() const override { return {direction_}; }

private:
    vector direction_;
    std::unique_ptr<Function1> size_;
};

class steadily : public vectorFunction1
{
public:
    explicit steadily(const vector& velocity) : velocity_(velocity) {}
    vector value(scalar t) const override { return t * velocity_; }
    List<vector> parts() const override { return {velocity_}; }

private:
    vector velocity_;
};

// The vector function along the entry `direction` of d with this size
std::unique_ptr<vectorFunction1> along(const dictionary& d, std::unique_ptr<Function1> size)
{
    return std::make_unique<alongDirection>(nonZero(d, "direction").normalized(), std::move(size));
}

bool isZero(const vectorFunction1& f)
{
    const List<vector> all = f.parts();
    return std::all_of(all.begin(), all.end(), [](const vector& v) { return v.isZero(0); });
}

bool isAcross(const vectorFunction1* f, const vector& normal)
{
    if (!f) return false;
    const List<vector> all = f->parts();
    return std::any_of(all.begin(), all.end(),
                       [&](const vector& v) { return std::abs(v.dot(normal)) > 1e-9 * v.norm(); });
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
    const dictionary sized = patch.isDict("velocity") ? patch.subDict("velocity") : dictionary();
    if (sized.found("speed"))
        slide_ = along(sized, Function1::New("speed", sized, caseFolder, dims::velocity));
    else if (patch.found("velocity"))
        slide_ = vectorFunction1::New("velocity", patch, caseFolder, dims::velocity);
    if (slide_ && isZero(*slide_)) slide_ = nullptr;
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
    if (steady)
        displacement_ = std::make_shared<steadily>(motion.get<vector>("velocity", dims::velocity));
    if (!given) return;
    if (motion.found("direction"))
        displacement_ =
            along(motion, Function1::New("displacement", motion, caseFolder, dims::length));
    else displacement_ = vectorFunction1::New("displacement", motion, caseFolder, dims::length);
}

bool wallMotion::inPlane() const
{
    for (const rotation* r : {&turn_, &spin_})
        if (r->given() && std::abs(r->axis[2]) < 1 - 1e-12) return false;
    return !isAcross(slide_.get(), vector::UnitZ()) &&
           !isAcross(displacement_.get(), vector::UnitZ());
}

vector wallMotion::offset(scalar t) const
{
    return displacement_ ? displacement_->value(t) : vector(vector::Zero());
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

// Uses chords, not tangents: a point that follows the surface ends up on it, however long the step is
affineVelocity wallMotion::surfaceVelocity(scalar t0, scalar t1) const
{
    affineVelocity v;
    if (!moves_) return v;
    if (displacement_) v.u = displacement_->rate(t0, t1);
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
    if (slide_) v.u += slide_->value(t);
    if (spin_.given())
        v.addTurn(cross(spin_.rate->value(t) * spin_.axis), spin_.origin + offset(t0));
    return v;
}

scalar wallMotion::leavesItself(const triSurface& s) const
{
    const auto share = [&](const auto& velocity) {
        scalar across = 0, all = 0;
        for (label t = 0; t < s.size(); ++t)
        {
            const vector area = s.areaVector(t), u = velocity(s.centre(t));
            across += std::abs(u.dot(area)), all += u.norm() * area.norm();
        }
        return all > 0 ? across / all : 0;
    };
    scalar most =
        share([&](const vector& x) { return vector(spin_.axis.cross(x - spin_.origin)); });
    if (slide_)
        for (const vector& u : slide_->parts())
            most = std::max(most, share([&](const vector&) { return u; }));
    return most;
}

bool wallMotion::movesAlong(const vector& direction) const
{
    const vector n = direction.normalized();
    return isAcross(displacement_.get(), n) || (turns() && turn_.axis.cross(n).norm() > 1e-9);
}

bool wallMotion::slidesWithin(const vector& normal) const
{
    return !isAcross(slide_.get(), normal) &&
           (!spin_.given() || spin_.axis.cross(normal).norm() < 1e-9);
}

}  // namespace ispf
