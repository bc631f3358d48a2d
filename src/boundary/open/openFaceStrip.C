// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure and velocity of the strip beyond an open face
#include "openFace.H"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace ispf
{

namespace
{

// Field of the particles near the face: slope of the pressure before the face along its normal, less that of the body
// force [Pa/m]
const word slopeField = "openSlope";
// [dx] The acceleration is a mean over `layers` before the surface, the friction a mean from the depth `from` on; both
// within the radius `around` along the surface.  Nearer to the surface the velocity bends into that of the strip, which is
// uniform along normals and has only its own friction
constexpr scalar layers = 3, from = 2.5, around = 4;

// Weighted mean over the fluid of one zone; over all zones if there is none of it (other zones may lie behind a wall)
template <class T>
class weightedMean
{
public:
    void add(const T& value, scalar w, bool own) { sum_[own] += w * value, weight_[own] += w; }
    void get(T& mean) const  // leaves `mean` unchanged where there is no fluid
    {
        const bool own = weight_[1] > 0;
        if (weight_[own] > 0) mean = sum_[own] / weight_[own];
    }

private:
    T sum_[2] = {T::Zero(), T::Zero()};
    scalar weight_[2] = {0, 0};
};

}  // namespace

void openFace::setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce,
                        label number) const
{
    findFeet(cloud);
    List<scalar>& slope = cloud.scalars[slopeField];
    slope.resize(cloud.n(), 0);
    if (inflow_) return setVelocity(cloud, number);
    given_ = p_->begin({step_.start, step_.end, rho / area()}, cloud.state.get(outletState(), {}));
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            known_[i].u = cloud.Up[i].xyz();
            const surfaceFoot& f = known_[i].foot;
            if (!f.found || f.depth <= 0) continue;
            const scalar b = bodyForce.empty() ? 0 : bodyForce[cloud.zone[i]].dot(f.normal);
            const scalar in = std::min(known_[i].u.dot(f.normal), scalar(0));
            cloud.pFixed[i] = 1;
            cloud.pGiven[i] = given_ - backflow_ * rho * in * in + (rho * b + slope[i]) * f.depth;
        }
    });
}

void openFace::setVelocity(particleCloud& cloud, label number) const
{
    List<vec4>& velocity = cloud.vectors[givenVelocity];
    velocity.resize(cloud.n(), vec4{});
    developed_ = inflow_->develop(cloud.state.get(profileState(), {}));
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            known_[i].u = cloud.Up[i].xyz();
            const surfaceFoot& f = known_[i].foot;
            if (!f.found) continue;
            velocity[i] = vec4::from(inflow_->velocity(f.foot, f.normal), number);
            if (f.depth > 0) cloud.uFixed[i] = 1, cloud.Up[i].setXyz(velocity[i].xyz());
        }
    });
    if (!mesh_.empty()) cloud.entering[number] = inflow_->mean() * mesh_.area();
    checkFilled(cloud);
    flux_ = 0;
    for (const scalar q : givenFlux(cloud)) flux_ -= q;
}

// Only the share of the strip's samples over which no moving wall has passed counts in the area of a face
void openFace::setStrip(particleCloud& cloud, const movingWalls& walls) const
{
    firstStrip_ = label(cloud.stripArea.size());
    const List<char> over = passedOver(walls);
    const scalar open = 1 - scalar(std::count(over.begin(), over.end(), 1)) / scalar(over.size());
    for (const auto& [zone, area] : areas_) cloud.stripArea.push_back(open * area);
    cloud.stripIntake.resize(cloud.stripArea.size(), 0);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (const surfaceFoot& f = known_[i].foot; f.found && f.depth > 0)
            if (const auto found = areas_.find(zoneOf(cloud, i)); found != areas_.end())
                cloud.strip[i] = firstStrip_ + label(std::distance(areas_.begin(), found));
}

word openFace::widthInWords(int nDims) const
{
    if (mesh_.empty()) return "";
    const scalar wide = nDims == 3 ? std::sqrt(4 / M_PI * mesh_.area()) : mesh_.area();
    return "; the face is " + str(wide / dx_, 3) + " dx wide";
}

// fatalError if the velocity is not zero and the strip is empty: nothing would enter or leave, without a message
void openFace::checkFilled(const particleCloud& cloud) const
{
    if (inflow_->mean() == 0) return;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (const surfaceFoot& f = known_[i].foot; f.found && f.depth > 0) return;
    throw fatalError("Open patch " + name_ + ": no fluid is left in the strip of " +
                         str(depth_ / dx_) + " dx beyond it, so that nothing can pass" +
                         widthInWords(cloud.nDims) +
                         ". Does a wall reach across the strip? Prolong the vessel before the "
                         "opening, or take a smaller dx",
                     where_);
}

void openFace::keepAlongNormals(particleCloud& cloud) const
{
    if (!inflow_ || !betweenWalls_) return;
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            const auto& [from, f, u] = known_[i];
            if (!f.found || f.depth <= 0) continue;
            const vector moved = cloud.x[i].xyz() - from;
            cloud.x[i].setXyz(from + moved.dot(f.normal) * f.normal);
        }
    });
}

List<scalar> openFace::givenFlux(const particleCloud& cloud) const
{
    List<scalar> perZone(cloud.zones.size(), 0);
    scalar all = 0;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (const surfaceFoot& f = known_[i].foot; f.found && f.depth > 0)
        {
            const scalar q = -cloud.volume() / depth_ * cloud.Up[i].xyz().dot(f.normal);
            perZone[cloud.zone[i]] += q, all += q;
        }
    // the sum over the strip is known, whatever the number of its particles
    for (scalar& q : perZone)
        if (!mesh_.empty() && all != 0) q *= inflow_->mean() * mesh_.area() / all;
    return perZone;
}

// Velocity or pressure of the fluid just before the surface, as a mean by feet, plus the mean of its errors (twicing,
// Tukey 1977, Exploratory Data Analysis).  The mean alone is too fast beside walls: the strip would carry 1 to 2 %
// more than the fluid before it, so that one thins out and the other thickens
struct openFace::valueBefore
{
    const particleCloud& cloud;
    scalar radius;
    pointGrid feet;
    List<label> index;
    List<std::uint8_t> zone;
    List<vector> value;

    template <class ValueOf>
    valueBefore(const openFace& face, const particleCloud& c, const ValueOf& valueOf)
        : cloud(c), radius(1.5 * face.dx_), feet(radius)
    {
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (const surfaceFoot& f = face.known_[i].foot;
                f.found && f.depth <= 0 && f.depth > -face.depth_)
            {
                feet.add(f.foot), index.push_back(i), value.push_back(valueOf(i));
                zone.push_back(face.zoneOf(cloud, i));
            }
        List<vector> twice(value.size());
        parallelFor(
            label(value.size()),
            [&](label begin, label end) {
                for (label k = begin; k < end; ++k)
                {
                    vector once = value[k];
                    mean(face.known_[index[k]].foot.foot, zone[k], once);
                    twice[k] = 2 * value[k] - once;
                }
            },
            256);
        value = std::move(twice);
    }

    void mean(const vector& foot, std::uint8_t of, vector& u) const
    {
        weightedMean<vector> sum;
        feet.within(foot, radius, [&](label k, scalar r) {
            sum.add(value[k], weight(r / radius), zone[k] == of);
        });
        sum.get(u);
    }
};

// Data for the slope of the pressure, summed over the fluid whose feet share a square of dx
struct openFace::slopeBefore
{
    // [0]: weight, [1..3]: acceleration near the face; [4]: weight, [5..7]: friction farther inside
    using sums = Eigen::Matrix<scalar, 8, 1>;
    struct bin
    {
        scalar n = 0;
        vector foot = vector::Zero();
        sums value = sums::Zero();
        std::uint8_t zone = 0;
    };

    scalar radius, rho;
    bool accelerates;
    List<bin> bins;
    pointGrid feet;

    slopeBefore(const openFace& face, const particleCloud& cloud, const List<vec4>& friction,
                scalar density, scalar dt)
        : radius(around * face.dx_), rho(density), accelerates(!face.inflow_), feet(radius)
    {
        const scalar dx = face.dx_;
        std::map<std::array<int, 4>, bin> squares;
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        {
            const auto& [x, f, u] = face.known_[i];
            if (!f.found || f.depth > 0 || f.depth < -before * dx) continue;
            const auto cell = [&](int k) { return int(std::floor(f.foot[k] / dx)); };
            const std::uint8_t zone = face.zoneOf(cloud, i);
            bin& b = squares[{cell(0), cell(1), cell(2), zone}];
            b.n += 1, b.foot += f.foot, b.zone = zone;
            const auto add = [&](int k, const vector& v) {
                b.value[k] += 1, b.value.segment<3>(k + 1) += v;
            };
            if (f.depth > -layers * dx) add(0, (cloud.Up[i].xyz() - u) / dt);
            if (f.depth < -from * dx) add(4, friction[i].xyz());
        }
        for (auto& [cell, b] : squares) feet.add(b.foot / b.n), bins.push_back(b);
    }

    // friction_n - rho a_n.  Where the velocity is given, friction alone: the pressure must follow the acceleration, else
    // the strip would run after the fluid before it
    scalar at(const surfaceFoot& f, std::uint8_t zone) const
    {
        weightedMean<sums> sum;
        feet.within(f.foot, radius, [&](label k, scalar r) {
            const bin& at = bins[k];
            sum.add(at.value / at.n, at.n * weight(r / radius), at.zone == zone);
        });
        sums m = sums::Zero();
        sum.get(m);
        const auto mean = [&](int k) {
            return m[k] > 0 ? m.segment<3>(k + 1).dot(f.normal) / m[k] : 0;
        };
        return accelerates ? mean(4) - rho * mean(0) : mean(4);
    }
};

// Carries the slope of the pressure on to the strip.  Where p is given, the strip takes the velocity before the surface,
// averaged over 1.5 dx along it.  With a wider mean the flow along the surface would run into a wall or away from it:
// nothing in the strip holds it back.  Where the velocity is given, the strip takes p before the surface, without effect
void openFace::followInside(particleCloud& cloud, const List<vec4>& friction, scalar rho,
                            scalar dt) const
{
    findFeet(cloud);
    std::optional<valueBefore> velocity, pressure;
    if (!inflow_)
    {
        velocity.emplace(*this, cloud, [&](label i) { return cloud.Up[i].xyz(); });
        flux_ = outflow(cloud);
        given_ = p_->with(images_ * flux_);  // for new particles of the strip
    }
    else pressure.emplace(*this, cloud, [&](label i) { return vector(cloud.Up[i][3], 0, 0); });
    const slopeBefore slope(*this, cloud, friction, rho, dt);
    List<scalar>& carried = cloud.scalars.at(slopeField);
    parallelFor(
        cloud.n() - cloud.nSolid(),
        [&](label begin, label end) {
            for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
            {
                const surfaceFoot& f = known_[i].foot;
                if (!f.found || f.depth < -(inflow_ ? depth_ : dx_)) continue;
                const std::uint8_t zone = zoneOf(cloud, i);
                carried[i] = slope.at(f, zone);
                if (f.depth <= 0) continue;
                if (pressure)
                {
                    vector p(cloud.Up[i][3], 0, 0);
                    pressure->mean(f.foot, zone, p);
                    cloud.Up[i][3] = p[0];
                }
                if (!velocity) continue;
                vector u = cloud.Up[i].xyz();
                velocity->mean(f.foot, zone, u);
                cloud.Up[i].setXyz(u);
            }
        },
        256);
}

}  // namespace ispf
