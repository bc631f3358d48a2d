// SPDX-License-Identifier: GPL-3.0-or-later
#include "timeScheme.H"

#include <cmath>

namespace theory
{

std::string name(timeScheme s)
{
    const char* names[] = {"backward Euler", "midpoint", "BDF2", "DLN 2/3", "DLN 2/sqrt 5"};
    return names[int(s)];
}

coefficients::coefficients(timeScheme s, double step, double stepBefore)
{
    const double r = step / stepBefore;
    k = step;
    switch (s)
    {
        case timeScheme::backwardEuler:
            alpha = {0, -1, 1}, beta = {0, 0, 1}, lambda = {0, -M_SQRT1_2, M_SQRT1_2};
            newest = 0.5, mixed = oldest = 0;
            break;
        case timeScheme::BDF2:
            alpha = {r * r / (1 + r), -(1 + r), (1 + 2 * r) / (1 + r)};
            beta = {0, 0, 1}, lambda = {0.5, -1, 0.5};
            newest = 1.25, mixed = -1, oldest = 0.25;
            break;
        case timeScheme::midpoint:
            setDLN(1, step, stepBefore);
            break;
        case timeScheme::DLN23:
            setDLN(2.0 / 3, step, stepBefore);
            break;
        case timeScheme::DLN25:
            setDLN(2 / std::sqrt(5.0), step, stepBefore);
            break;
    }
}

// Dahlquist, Liniger and Nevanlinna 1983: G-stable for every sequence of steps
void coefficients::setDLN(double delta, double step, double stepBefore)
{
    const double e = (step - stepBefore) / (step + stepBefore), q = 1 / std::pow(1 + e * delta, 2);
    const double d = (1 - delta * delta) * q;
    alpha = {(delta - 1) / 2, -delta, (delta + 1) / 2};
    beta = {(1 + d - e * e * delta * d - delta) / 4, (1 - d) / 2,
            (1 + d + e * e * delta * d + delta) / 4};
    const double l = -std::sqrt(delta * (1 - delta * delta) / 2) / (1 + e * delta);
    lambda = {-(1 + e) / 2 * l, l, -(1 - e) / 2 * l};
    k = alpha[2] * step - alpha[0] * stepBefore;
    newest = (1 + delta) / 4, mixed = 0, oldest = (1 - delta) / 4;
}

double coefficients::energy(const state& a, const state& b) const
{
    return newest * a.squaredNorm() + mixed * a.dot(b) + oldest * b.squaredNorm();
}

state coefficients::sum(const three& c, const state& y0, const state& y1, const state& y2) const
{
    return c[0] * y0 + c[1] * y1 + c[2] * y2;
}

state coefficients::next(const operation& A, const state& y0, const state& y1) const
{
    const operation one = operation::Identity(A.rows(), A.cols());
    return (alpha[2] * one - k * beta[2] * A)
        .partialPivLu()
        .solve(k * (A * (beta[1] * y1 + beta[0] * y0)) - alpha[1] * y1 - alpha[0] * y0);
}

state coefficients::byBackwardEuler(const operation& A, const state& y0, const state& y1) const
{
    const double ratio = beta[2] / alpha[2];
    const state before = (beta[1] - ratio * alpha[1]) * y1 + (beta[0] - ratio * alpha[0]) * y0;
    const operation one = operation::Identity(A.rows(), A.cols());
    const state between = (one - k * ratio * A).partialPivLu().solve(before);
    return (between - beta[1] * y1 - beta[0] * y0) / beta[2];
}

}  // namespace theory
