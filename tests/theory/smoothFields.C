// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleScene.H"

#include <cmath>

namespace theory
{

double scene::stream(const vec2& p) const
{
    if (kind == shape::periodic) return std::cos(2 * M_PI * p[0]) * std::cos(2 * M_PI * p[1]);
    if (kind == shape::disc)
    {
        const double off = ((p - vec2(0.5, 0.5)).squaredNorm() - 0.04) / 0.06;
        return (1 - std::exp(-off * off)) * std::sin(2 * M_PI * (p[0] + 0.1)) *
               std::cos(2 * M_PI * p[1]);
    }
    const double m = kind == shape::step ? 2 * M_PI : M_PI;
    return std::pow(std::sin(m * p[0]) * std::sin(m * p[1]), 2);
}

double scene::pressure(const vec2& p) const
{
    if (periodic())
        return std::cos(2 * M_PI * p[0]) * std::cos(2 * M_PI * p[1]) +
               0.5 * std::sin(2 * M_PI * (p[0] + p[1]));
    return std::sin(2 * p[0] + 3 * p[1]) + p[0] * p[1];
}

vec2 gradient(double (scene::*f)(const vec2&) const, const scene& s, const vec2& at)
{
    const vec2 ex(1e-5, 0), ey(0, 1e-5);
    return vec2((s.*f)(at + ex) - (s.*f)(at - ex), (s.*f)(at + ey) - (s.*f)(at - ey)) / 2e-5;
}

vec2 velocity(const scene& s, const vec2& at)
{
    const vec2 g = gradient(&scene::stream, s, at);
    return {g[1], -g[0]};
}

}  // namespace theory
