// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure and velocity of the strip beyond an open face
#include "openFace.H"

#include <cmath>

namespace ispf
{

namespace
{

// Slope of the pressure before the face, along its normal, less that of the body force [Pa/m]: a field of the
// particles near the face
const word slopeField = "openSlope";
// [dx] Where it is taken begins so far before the surface, and reaches so far along it.  Nearer, the velocity is
// bent into the strip's, which is uniform along normals: a pressure of its own, which must not be carried on
constexpr scalar from = 2.5, around = 4;

scalar along(const vector& normal, const List<vector>& bodyForce, std::uint8_t zone)
{
    return bodyForce.empty() ? 0 : bodyForce[zone].dot(normal);
}

}  // namespace

void openFace::setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce) const
{
    findFeet(cloud);
    List<scalar>& slope = cloud.scalars[slopeField];
    slope.resize(cloud.n(), 0);
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            known_[i].u = cloud.Up[i].xyz();
            const surfaceFoot& f = known_[i].foot;
            if (!f.found || f.depth <= 0) continue;
            const scalar b = along(f.normal, bodyForce, cloud.zone[i]);
            const scalar in = std::min(known_[i].u.dot(f.normal), scalar(0));
            cloud.pFixed[i] = 1;
            cloud.pGiven[i] = given_ - backflow_ * rho * in * in + (rho * b + slope[i]) * f.depth;
        }
    });
}

// The fluid before the surface, by feet on it
struct openFace::fluidBefore
{
    const openFace& face;
    const particleCloud& cloud;
    scalar radius;
    pointGrid feet;
    List<label> index;

    fluidBefore(const openFace& of, const particleCloud& c, scalar depth, scalar r)
        : face(of), cloud(c), radius(r), feet(r)
    {
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (const surfaceFoot& f = face.known_[i].foot;
                f.found && f.depth <= 0 && f.depth > -depth)
                feet.add(f.foot), index.push_back(i);
    }

    // Mean of value(j), a vector, over the fluid of a zone; false if there is none
    template <class Value, class Result>
    bool mean(const vector& foot, std::uint8_t zone, Value&& value, Result& result) const
    {
        Result sum = Result::Zero();
        scalar weights = 0;
        feet.within(foot, radius, [&](label k, scalar r) {
            if (cloud.zone[index[k]] != zone) return;
            const scalar w = weight(r / radius);
            sum += w * value(index[k]), weights += w;
        });
        if (weights > 0) result = sum / weights;
        return weights > 0;
    }

    // Of the pressure over the depth, by least squares; false where the fluid is too thin to tell
    bool slope(const vector& foot, std::uint8_t zone, scalar& result) const
    {
        using moments = Eigen::Matrix<scalar, 5, 1>;
        const scalar dx = face.dx_;
        moments m;
        const auto value = [&](label j) -> moments {
            const scalar d = face.known_[j].foot.depth / dx, p = cloud.Up[j][3];
            return d > -from ? moments(moments::Zero()) : moments{{1, d, d * d, p, p * d}};
        };
        if (!mean(foot, zone, value, m) || m[0] <= 0) return false;
        m /= m[0];
        const scalar spread = m[2] - m[1] * m[1];
        result = (m[4] - m[3] * m[1]) / spread / dx;
        return spread > 0.4;  // of three layers 0.67
    }
};

// The strip takes the mean velocity of 1.5 dx before the surface.  Over a wider reach the flow along the surface
// would run into a wall or away from it: nothing in the strip holds it back
void openFace::followInside(particleCloud& cloud, scalar rho, const List<vector>& bodyForce,
                            scalar dt) const
{
    findFeet(cloud);
    const fluidBefore near(*this, cloud, depth_, 1.5 * dx_);
    const fluidBefore region(*this, cloud, before * dx_, around * dx_);
    List<scalar>& slope = cloud.scalars.at(slopeField);
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
                scalar fitted;
                if (region.slope(f.foot, cloud.zone[i], fitted))
                    slope[i] = fitted - rho * along(f.normal, bodyForce, cloud.zone[i]);
                else if (region.mean(f.foot, cloud.zone[i], change, du))
                    slope[i] = -rho * du.dot(f.normal) / dt;
                if (f.depth > 0 && near.mean(f.foot, cloud.zone[i], velocity, u))
                    cloud.Up[i].setXyz(u);
            }
        },
        256);
}

}  // namespace ispf
