// SPDX-License-Identifier: GPL-3.0-or-later
#include "timeScheme.H"

#include <cmath>

namespace ispf
{

namespace
{

const scalar delta = 2 / std::sqrt(5.0);

// Fields of the particles: mean velocity of the last step [m/s]; during a step x_b - x^n [m]
const word lastWay = "way_0", aheadOfStep = "ahead";

const vec4* fieldOf(const particleCloud& cloud, const word& name)
{
    const auto found = cloud.vectors.find(name);
    return found == cloud.vectors.end() ? nullptr : found->second.data();
}

}  // namespace

timeScheme::timeScheme(const fsiCase& c)
    : c_(c), DLN_(c.schemes.chooseOrDefault("ddtScheme", {"Euler", "DLN"}, "Euler") == "DLN")
{
    if (DLN_ && c.structure && c.coupling != "monolithic")
        c.schemes.fail(
            "ddtScheme",
            "Coupling projection takes springs explicitly, DLN does not: with a structure "
            "take Euler, or coupling monolithic");
    keeps_ = DLN_;
}

// Coefficients of Dahlquist, Liniger & Nevanlinna for the steps dt_ and before [s]
void timeScheme::setCoefficients(scalar before)
{
    const scalar e = (dt_ - before) / (dt_ + before), s = 1 / (1 + e * delta);
    const scalar d = (1 - delta * delta) * s * s;
    a2_ = (delta + 1) / 2, a1_ = -delta, a0_ = (delta - 1) / 2;
    b2_ = (1 + d + e * e * delta * d + delta) / 4;
    b1_ = (1 - d) / 2;
    b0_ = (1 + d - e * e * delta * d - delta) / 4;
    newest_ = (1 + delta) / 4, oldest_ = (1 - delta) / 4;
    l1_ = -std::sqrt(delta * (1 - delta * delta) / 2) * s;
    l2_ = -(1 - e) / 2 * l1_, l0_ = -(1 + e) / 2 * l1_;
    tau_ = (a2_ * dt_ - a0_ * before) * b2_ / a2_;
    to_ = b2_ * dt_ - b0_ * before;
}

void timeScheme::start(particleCloud& cloud, scalar t, scalar dt)
{
    t_ = t, dt_ = tau_ = dt, to_ = before_ = 0;
    a2_ = 1, a1_ = -1, a0_ = 0, b2_ = 1, b1_ = b0_ = 0;
    newest_ = 0.5, oldest_ = 0, l2_ = M_SQRT1_2, l1_ = -M_SQRT1_2, l0_ = 0;
    if (!DLN_) return;
    const auto known = cloud.state.find(entries::levelBefore);
    if (!known || !fieldOf(cloud, levelBefore) || !fieldOf(cloud, lastWay)) return;
    before_ = *known;
    setCoefficients(before_);
    List<vec4>& way = cloud.vectors[aheadOfStep];
    way.assign(cloud.n(), vec4{});
    const vec4 *before = fieldOf(cloud, levelBefore), *last = fieldOf(cloud, lastWay);
    forEach(0, cloud.n(), [&](label i) {
        if (i < cloud.nSolid() && !cloud.uFixed[i])
        {
            const vector mean = (cloud.Up[i].xyz() + before[i].xyz()) / 2;
            way[i] = vec4::from(tau_ * mean - ofLevelBefore() * before_ * last[i].xyz());
        }
        else way[i] = vec4::from(to_ * cloud.Up[i].xyz());
        cloud.x[i].s += way[i].s;
    });
}

List<vec4> timeScheme::startPlaces(const particleCloud& cloud) const
{
    List<vec4> x(cloud.x.begin(), cloud.x.begin() + cloud.n());
    if (const vec4* ahead = to_ > 0 ? fieldOf(cloud, aheadOfStep) : nullptr)
        forEach(0, cloud.n(), [&](label i) { x[i].s -= ahead[i].s; });
    return x;
}

// x^{n-1} = x^n - dt^{n-1} w with the mean velocity w of the last step
List<vec4> timeScheme::elasticStart(const particleCloud& cloud) const
{
    List<vec4> x = startPlaces(cloud);
    x.resize(cloud.nSolid());
    if (!(to_ > 0)) return x;
    const vec4* way = fieldOf(cloud, lastWay);
    for (label i = 0; i < cloud.nSolid(); ++i)
        x[i].s -= ofLevelBefore() * before_ * vec4::from(way[i].xyz()).s;
    return x;
}

stepTimes timeScheme::times() const
{
    const scalar at = t_ + to_;
    return {t_, t_ + dt_, at, to_ > 0 ? at : t_ + dt_};
}

void timeScheme::begin(particleCloud& cloud)
{
    const label n = cloud.n();
    now_.assign(cloud.Up.begin(), cloud.Up.begin() + n);
    if (!(to_ > 0)) return;
    const vec4* before = fieldOf(cloud, levelBefore);
    const scalar ofNow = b1_ - b2_ / a2_ * a1_, ofBefore = ofLevelBefore();
    for (label i = 0; i < n; ++i)
        if (cloud.isFree(i)) cloud.Up[i].setXyz(ofNow * now_[i].xyz() + ofBefore * before[i].xyz());
}

void timeScheme::end(particleCloud& cloud, energyLedger& energy)
{
    const label n = cloud.n();
    const bool second = to_ > 0;
    const vec4* before = second ? fieldOf(cloud, levelBefore) : nullptr;
    // k w = (k_b u_b + a0 k_before w_before)/a2, the mean velocity of this step
    if (DLN_)
    {
        List<vec4>& way = cloud.vectors[lastWay];
        way.resize(n, vec4{});
        const scalar ofStep = tau_ * weight() / (a2_ * dt_), ofLast = a0_ * before_ / (a2_ * dt_);
        for (label i = 0; i < n; ++i)
            way[i] = vec4::from(cloud.isFree(i) && second
                                    ? vector(ofStep * cloud.Up[i].xyz() + ofLast * way[i].xyz())
                                    : cloud.Up[i].xyz());
    }
    const auto [taken, gained] = sumsOf(0, n, [&](label i) -> std::array<scalar, 2> {
        if (!cloud.isFree(i)) return {};
        const vector un = now_[i].xyz(), u0 = second ? before[i].xyz() : un;
        const vector u = (cloud.Up[i].xyz() - b1_ * un - b0_ * u0) / b2_;
        cloud.Up[i].setXyz(u);
        // energy that the scheme takes; gain of the kinetic energy less that of the bounded energy (both per mass)
        return {(l2_ * u + l1_ * un + l0_ * u0).squaredNorm(),
                0.5 * (u.squaredNorm() - un.squaredNorm()) - stored(u, un) + stored(un, u0)};
    });
    energy[energyLedger::step] += c_.rho * cloud.volume() * (gained - taken);
    if (!keeps_) return;
    cloud.vectors[levelBefore] = now_;
    cloud.state.set(entries::levelBefore, dt_);
}

// Velocity with which particle i moves over the whole step
simd4 timeScheme::mover(const particleCloud& cloud, label i, bool mean) const
{
    if (const vec4* way = DLN_ ? fieldOf(cloud, lastWay) : nullptr) return way[i].s;
    return mean ? 0.5 * (now_[i].s + cloud.Up[i].s) : cloud.Up[i].s;
}

scalar timeScheme::errorOfWay(const particleCloud& cloud, label i, bool mean) const
{
    const vec4 e{mover(cloud, i, mean) - 0.5 * (now_[i].s + cloud.Up[i].s)};
    return dt_ * e.xyz().norm();
}

void timeScheme::move(particleCloud& cloud, bool mean) const
{
    const vec4* ahead = to_ > 0 ? fieldOf(cloud, aheadOfStep) : nullptr;
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const simd4 u = mover(cloud, i, mean);
            cloud.x[i].s += dt_ * simd4{u[0], u[1], u[2], 0};
            if (ahead) cloud.x[i].s -= ahead[i].s;
        }
    });
    if (ahead) cloud.vectors.erase(aheadOfStep);
}

}  // namespace ispf
