// SPDX-License-Identifier: GPL-3.0-or-later
#include "inflow.H"

#include "patchSurface.H"
#include "token.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

bool inflow::given(const dictionary& dict)
{
    const bool p = dict.found("p"), rate = dict.found("flowRate"),
               velocity = dict.found("velocity");
    if (p + rate + velocity != 1)
        dict.fail(
            velocity ? "velocity"
            : rate   ? "flowRate"
                     : "p",
            "An open patch wants exactly one of 'p' [Pa], 'velocity' [m/s] and 'flowRate' [m3/s]");
    return !p;
}

inflow::inflow(const dictionary& dict, const word& caseFolder, const place& at)
    : face_(at.face), normal_(at.normal)
{
    const bool isRate = dict.found("flowRate");
    const word key = isRate ? "flowRate" : "velocity";
    if (isRate && face_.empty())
        dict.fail(key,
                  "The area of a plane that symmetry planes, cyclic patches or plane walls do not "
                  "bound on all sides is not known; give a velocity, or 'surface triSurface'");
    if (isRate) perRate_ = 1 / (face_.area() * at.images);
    const bool isVector = !isRate && readVelocity(dict, caseFolder);
    if (isRate) rate_ = Function1::New(key, dict, caseFolder, at.rateDimensions);
    if (dict.found("direction"))
    {
        if (isVector) dict.fail("direction", "the velocity's vector has a direction already");
        direction_ = nonZero(dict, "direction");
    }
    if (!direction_.isZero(0)) setDirection(dict, isVector ? key : "direction", at.normal);
    setProfile(dict, caseFolder, at);
}

// True if the velocity is a vector: whatever is not a number over time is read as a vector.  Its largest part gives the
// direction
bool inflow::readVelocity(const dictionary& dict, const word& caseFolder)
{
    try
    {
        rate_ = Function1::New("velocity", dict, caseFolder, dims::velocity);
        return false;
    }
    catch (const fatalError& asNumber)
    {
        try
        {
            velocity_ = vectorFunction1::New("velocity", dict, caseFolder, dims::velocity);
        }
        catch (const fatalError& asVector)
        {
            if (word(asVector.what()) == asNumber.what()) throw asNumber;
            throw fatalError(
                word(asNumber.what()) + "\nNor is it a vector over time: " + asVector.what(),
                asNumber.location());
        }
    }
    const List<vector> parts = velocity_->parts();
    for (const vector& v : parts)
        if (v.norm() > direction_.norm()) direction_ = v;
    for (const vector& v : parts)
        if (v.cross(direction_).norm() > 1e-9 * direction_.squaredNorm())
            dict.fail("velocity",
                      "The direction of the velocity changes over time. At an open face it must "
                      "be constant: new particles are placed along it");
    return true;
}

// Scales the direction to a normal component of one into the fluid
void inflow::setDirection(const dictionary& dict, const word& key, const vector& normal)
{
    const scalar in = -direction_.dot(normal);
    if (std::abs(in) < 0.05 * direction_.norm() || (!velocity_ && in < 0))
        dict.fail(key,
                  "points along the face or, as a direction, out of the fluid. The face's outward "
                  "normal is (" +
                      str(normal[0], 3) + " " + str(normal[1], 3) + " " + str(normal[2], 3) + ")");
    direction_ /= in, slant_ = most_ = direction_.norm();
}

void inflow::setProfile(const dictionary& dict, const word& caseFolder, const place& at)
{
    if (!dict.found("profile")) return;
    const bool isTable = dict.isDict("profile") || dict.tokenList("profile").size() > 1;
    const word name =
        isTable ? "table" : dict.choose("profile", {"flat", "parabolic", "Womersley", "table"});
    if (name == "flat") return;
    if (face_.empty())
        dict.fail("profile",
                  "The rim of a plane that other planes do not bound on all sides is not known; "
                  "take 'surface triSurface', or profile flat");
    const List<char> held = face_.heldNodes(at.isHeld);
    if (std::find(held.begin(), held.end(), 1) == held.end())
        dict.fail(
            "profile",
            "No wall holds the fluid at the rim of this face: leave the profile away, it is flat");
    if (name == "parabolic" || name == "Womersley") parabolic(held);
    else tabulated(*Function1::New("profile", dict, caseFolder, dims::none), held);
    const scalar mean = face_.mean(profile_);
    if (!(mean > 0))
        dict.fail("profile", name != "table"
                                 ? "The face's triangles are too coarse to hold a profile"
                                 : "The mean of the profile over the face must be positive");
    for (scalar& w : profile_) w /= mean;
    if (name == "Womersley")
    {
        if (!(at.nu > 0))
            dict.fail("profile", "Womersley's profile needs a fluid with a viscosity");
        developing_ = std::make_unique<developingProfile>(face_, held, at.nu, profile_);
    }
    most_ *= *std::max_element(profile_.begin(), profile_.end());
}

// -lap w = 1; natural condition where no wall holds the fluid
void inflow::parabolic(const List<char>& held)
{
    const faceElements elements(face_, held);
    const Eigen::VectorXd w = elements.factorised(0)->solve(elements.lumped);
    profile_.assign(w.data(), w.data() + w.size());
}

void inflow::tabulated(const Function1& profile, const List<char>& held)
{
    const triSurface& s = face_.surface();
    profile_.assign(s.nodes.size(), std::numeric_limits<scalar>::max());
    for (size_t i = 0; i < s.nodes.size(); ++i)
        for (size_t k = 0; k < s.nodes.size(); ++k)
            if (held[k]) profile_[i] = std::min(profile_[i], (s.nodes[i] - s.nodes[k]).norm());
    const scalar most = *std::max_element(profile_.begin(), profile_.end());
    for (scalar& d : profile_) d = profile.value(1 - d / most);
}

void inflow::setStep(scalar t0, scalar t1)
{
    const scalar t = 0.5 * (t0 + t1);
    mean_ = rate_ ? perRate_ * rate_->value(t) : -velocity_->value(t).dot(normal_);
    start_ = t0, end_ = t1;
}

// kept and the result: time of the profile, then its values.  Function objects ask after the step has been accepted
List<scalar> inflow::develop(const List<scalar>& kept)
{
    if (!developing_) return {};
    const bool over = !kept.empty() && kept[0] > 0.5 * (start_ + end_);
    List<scalar> now = {end_};
    const List<scalar> before(kept.begin() + (kept.empty() ? 0 : 1), kept.end());
    const List<scalar>& w = developing_->advance(before, over ? 0 : end_ - start_, mean_);
    now.insert(now.end(), w.begin(), w.end());
    return now;
}

vector inflow::velocity(const vector& foot, const vector& normal) const
{
    const scalar u = developing_
                         ? face_.interpolate(developing_->values(), foot)
                         : mean_ * (profile_.empty() ? 1 : face_.interpolate(profile_, foot));
    return u * direction(normal);
}

}  // namespace ispf
