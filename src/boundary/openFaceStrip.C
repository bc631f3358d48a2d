// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure and velocity of the strip beyond an open face
#include "openFace.H"

#include <array>
#include <cmath>
#include <map>

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

// Weighted mean over the fluid of one zone, or over all where there is none of it (other zones may lie behind a wall)
template <class T>
class weightedMean
{
public:
    void add(const T& value, scalar w, bool own) { sum_[own] += w * value, weight_[own] += w; }
    void get(T& mean) const  // leaves it as it is where there is no fluid
    {
        const bool own = weight_[1] > 0;
        if (weight_[own] > 0) mean = sum_[own] / weight_[own];
    }

private:
    T sum_[2] = {T::Zero(), T::Zero()};
    scalar weight_[2] = {0, 0};
};

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

// The velocity close before the surface, by feet on it
struct openFace::velocityBefore
{
    const particleCloud& cloud;
    scalar radius;
    pointGrid feet;
    List<label> index;

    velocityBefore(const openFace& face, const particleCloud& c)
        : cloud(c), radius(1.5 * face.dx_), feet(radius)
    {
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (const surfaceFoot& f = face.known_[i].foot;
                f.found && f.depth <= 0 && f.depth > -face.depth_)
                feet.add(f.foot), index.push_back(i);
    }

    void mean(const vector& foot, std::uint8_t zone, vector& u) const
    {
        weightedMean<vector> sum;
        feet.within(foot, radius, [&](label k, scalar r) {
            const label j = index[k];
            sum.add(cloud.Up[j].xyz(), weight(r / radius), cloud.zone[j] == zone);
        });
        sum.get(u);
    }
};

// What tells the slope of the pressure, summed over the fluid whose feet share a square of dx
struct openFace::slopeBefore
{
    // 1, d, d^2, p, p d where deep enough to be fitted, d depth in dx;  acceleration [m/s^2]
    using sums = Eigen::Matrix<scalar, 8, 1>;
    struct bin
    {
        scalar n = 0;
        vector foot = vector::Zero();
        sums value = sums::Zero();
        std::uint8_t zone = 0;
    };

    scalar dx, rho;
    List<bin> bins;
    pointGrid feet;

    slopeBefore(const openFace& face, const particleCloud& cloud, scalar density, scalar dt)
        : dx(face.dx_), rho(density), feet(around * dx)
    {
        std::map<std::array<int, 4>, bin> squares;
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        {
            const auto& [x, f, u] = face.known_[i];
            if (!f.found || f.depth > 0 || f.depth < -before * dx) continue;
            const auto cell = [&](int k) { return int(std::floor(f.foot[k] / dx)); };
            bin& b = squares[{cell(0), cell(1), cell(2), cloud.zone[i]}];
            b.n += 1, b.foot += f.foot, b.zone = cloud.zone[i];
            const scalar d = f.depth / dx, p = cloud.Up[i][3];
            if (d < -from) b.value.head<5>() += sums{{1, d, d * d, p, p * d, 0, 0, 0}}.head<5>();
            b.value.tail<3>() += (cloud.Up[i].xyz() - u) / dt;
        }
        for (auto& [cell, b] : squares) feet.add(b.foot / b.n), bins.push_back(b);
    }

    // Least squares over the depth, or -rho a_n where the fluid is too thin for that.  rhoB: of the body force
    scalar at(const surfaceFoot& f, std::uint8_t zone, scalar rhoB) const
    {
        const scalar radius = around * dx;
        weightedMean<sums> sum;
        feet.within(f.foot, radius, [&](label k, scalar r) {
            const bin& b = bins[k];
            sum.add(b.value / b.n, b.n * weight(r / radius), b.zone == zone);
        });
        sums m = sums::Zero();
        sum.get(m);
        const scalar inertia = -rho * m.tail<3>().dot(f.normal);
        if (m[0] <= 0) return inertia;
        m.head<5>() /= scalar(m[0]);
        const scalar spread = m[2] - m[1] * m[1];
        return spread > 0.4 ? (m[4] - m[3] * m[1]) / spread / dx - rhoB
                            : inertia;  // of 3 layers 0.67
    }
};

// The strip takes the mean velocity of 1.5 dx before the surface.  Over a wider reach the flow along the surface
// would run into a wall or away from it: nothing in the strip holds it back
void openFace::followInside(particleCloud& cloud, scalar rho, const List<vector>& bodyForce,
                            scalar dt) const
{
    findFeet(cloud);
    const velocityBefore velocity(*this, cloud);
    const slopeBefore slope(*this, cloud, rho, dt);
    List<scalar>& carried = cloud.scalars.at(slopeField);
    parallelFor(
        cloud.n() - cloud.nSolid(),
        [&](label begin, label end) {
            for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
            {
                const surfaceFoot& f = known_[i].foot;
                if (!f.found || f.depth < -dx_) continue;
                const std::uint8_t zone = cloud.zone[i];
                carried[i] = slope.at(f, zone, rho * along(f.normal, bodyForce, zone));
                if (f.depth <= 0) continue;
                vector u = cloud.Up[i].xyz();
                velocity.mean(f.foot, zone, u);
                cloud.Up[i].setXyz(u);
            }
        },
        256);
}

}  // namespace ispf
