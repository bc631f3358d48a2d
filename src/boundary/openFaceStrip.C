// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure and velocity of the strip beyond an open face
#include "openFace.H"

#include <cmath>

namespace ispf
{

namespace
{

// How the fluid before the face accelerates along its normal [m/s^2], a field of the particles near it
const word accelerationField = "openAcceleration";
constexpr scalar layers = 3,
                 around = 4;  // [dx] before the surface and along it, over which that is a mean

}  // namespace

void openFace::setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce) const
{
    findFeet(cloud);
    List<scalar>& acceleration = cloud.scalars[accelerationField];
    acceleration.resize(cloud.n(), 0);
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            known_[i].u = cloud.Up[i].xyz();
            const surfaceFoot& f = known_[i].foot;
            if (!f.found || f.depth <= 0) continue;
            const scalar b = bodyForce.empty() ? 0 : bodyForce[cloud.zone[i]].dot(f.normal);
            const scalar in = std::min(known_[i].u.dot(f.normal), scalar(0));
            cloud.pFixed[i] = 1;
            cloud.pGiven[i] =
                given_ - backflow_ * rho * in * in + rho * (b - acceleration[i]) * f.depth;
        }
    });
}

// The fluid before the surface, by feet on it
struct openFace::fluidBefore
{
    const particleCloud& cloud;
    scalar radius;
    pointGrid feet;
    List<label> index;

    fluidBefore(const openFace& face, const particleCloud& c, scalar depth, scalar r)
        : cloud(c), radius(r), feet(r)
    {
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (const surfaceFoot& f = face.known_[i].foot;
                f.found && f.depth <= 0 && f.depth > -depth)
                feet.add(f.foot), index.push_back(i);
    }

    // Mean of value(j) over the fluid of a zone; false if there is none
    template <class Value>
    bool mean(const vector& foot, std::uint8_t zone, Value&& value, vector& result) const
    {
        vector sum = vector::Zero();
        scalar weights = 0;
        feet.within(foot, radius, [&](label k, scalar r) {
            if (cloud.zone[index[k]] != zone) return;
            const scalar w = weight(r / radius);
            sum += w * value(index[k]), weights += w;
        });
        if (weights > 0) result = sum / weights;
        return weights > 0;
    }
};

// The strip takes the mean velocity of 1.5 dx before the surface.  Over a wider reach the flow along the surface
// would run into a wall or away from it: nothing in the strip holds it back
void openFace::followInside(particleCloud& cloud, scalar dt) const
{
    findFeet(cloud);
    const fluidBefore near(*this, cloud, depth_, 1.5 * dx_);
    const fluidBefore region(*this, cloud, layers * dx_, around * dx_);
    List<scalar>& acceleration = cloud.scalars.at(accelerationField);
    const auto velocity = [&](label j) { return cloud.Up[j].xyz(); };
    const auto change = [&](label j) { return vector(cloud.Up[j].xyz() - known_[j].u); };
    parallelFor(
        cloud.n() - cloud.nSolid(),
        [&](label begin, label end) {
            for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
            {
                const surfaceFoot& f = known_[i].foot;
                if (!f.found || f.depth < -dx_) continue;
                vector du, u;
                if (region.mean(f.foot, cloud.zone[i], change, du))
                    acceleration[i] = du.dot(f.normal) / dt;
                if (f.depth > 0 && near.mean(f.foot, cloud.zone[i], velocity, u))
                    cloud.Up[i].setXyz(u);
            }
        },
        256);
}

}  // namespace ispf
