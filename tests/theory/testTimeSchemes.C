// SPDX-License-Identifier: GPL-3.0-or-later
#include "timeScheme.H"
#include "textTable.H"

#include <doctest/doctest.h>

#include <complex>
#include <random>

using namespace theory;

namespace
{

using complex = std::complex<double>;
std::mt19937 source(7);

double normal()
{
    static std::normal_distribution<double> n;
    return n(source);
}
double uniform(double from, double to)
{
    return std::uniform_real_distribution<double>(from, to)(source);
}
state anyState(int n)
{
    return state::NullaryExpr(n, [] { return normal(); });
}

// A random matrix whose skew part acts as an adjoint pair on u and p; its symmetric part, >= 0, is viscosity and stabiliser
operation anySkew(int n)
{
    const operation a = operation::NullaryExpr(n, n, [] { return normal(); });
    return a - a.transpose();
}
operation anyLoss(int n)
{
    const operation a = operation::NullaryExpr(n, n / 2, [] { return normal(); });
    return a * a.transpose();
}

// Largest |E2 - E1 + k <y, R y> + |sum lambda y|^2|/E1; every step has its own operators, as with moving particles
double defect(timeScheme s, double most)
{
    const int n = 12;
    double worst = 0, before = 0.1;
    state y0 = anyState(n), y1 = anyState(n);
    for (int step = 0; step < 200; ++step)
    {
        const double k = 0.1 * uniform(1 / most, most);
        const operation R = anyLoss(n);
        const coefficients c(s, k, before);
        const state y2 = c.next(anySkew(n) - R, y0, y1), mid = c.sum(c.beta, y0, y1, y2);
        const double left = c.energy(y2, y1) - c.energy(y1, y0) + c.k * mid.dot(R * mid) +
                            c.sum(c.lambda, y0, y1, y2).squaredNorm();
        worst = std::max(worst, std::abs(left) / c.energy(y1, y0));
        y0 = y1, y1 = y2, before = k;
        if (y1.norm() < 1e-3) y0 *= 1e3, y1 *= 1e3;
    }
    return worst;
}

// Error for y' = A(t) y, an oscillator of changing frequency with a little loss; steps between 1/most and most
double error(timeScheme s, int steps, double most)
{
    double sum = 0;
    for (int seed = 0; seed < 10; ++seed)
    {
        source.seed(seed);
        std::vector<double> k(steps);
        double all = 0;
        for (double& part : k) all += part = uniform(1 / most, most);
        const auto exact = [](double t) {
            const complex y = std::exp(complex(-0.1 * t, t + 0.5 * (1 - std::cos(t))));
            return state(Eigen::Vector2d(y.real(), y.imag()));
        };
        double t0 = 0, t1 = k[0] * 4 / all;
        state y0 = exact(0), y1 = exact(t1);
        for (int j = 1; j < steps; ++j)
        {
            const double t2 = t1 + k[j] * 4 / all;
            const coefficients c(s, t2 - t1, t1 - t0);
            const double t = c.beta[0] * t0 + c.beta[1] * t1 + c.beta[2] * t2,
                         w = 1 + 0.5 * std::sin(t);
            operation A(2, 2);
            A << -0.1, -w, w, -0.1;
            const state y2 = c.next(A, y0, y1);
            y0 = y1, y1 = y2, t0 = t1, t1 = t2;
        }
        sum += (y1 - exact(t1)).norm();
    }
    return sum / 10;
}

double order(timeScheme s, double most)
{
    return std::log2(error(s, 100, most) / error(s, 200, most));
}

// Roots of (alpha2 - z beta2) x^2 + (alpha1 - z beta1) x + alpha0 - z beta0 for equal steps: the root next to
// exp(z), and the larger root for z = - infinity
complex root(timeScheme s, const complex& z)
{
    const coefficients c(s, 1, 1);
    const double k = c.k;
    const complex a = c.alpha[2] - k * z * c.beta[2], b = c.alpha[1] - k * z * c.beta[1],
                  d = std::sqrt(b * b - 4.0 * a * (c.alpha[0] - k * z * c.beta[0]));
    const complex x = (-b + d) / (2.0 * a), y = (-b - d) / (2.0 * a);
    if (std::abs(z) > 1e3) return std::abs(x) > std::abs(y) ? x : y;
    return std::abs(x - std::exp(z)) < std::abs(y - std::exp(z)) ? x : y;
}
double dampingPerPeriod(timeScheme s, double wk)
{
    return 1 - std::pow(std::abs(root(s, complex(0, wk))), 2 * M_PI / wk);
}
double lagPerPeriod(timeScheme s, double wk)
{
    return 1 - std::arg(root(s, complex(0, wk))) / wk;
}

// Largest growth of E in two steps that are repeated: with step ratios 1 : r and 1/r : 1, and each step with its own
// frequency, as when particles move between the steps
double growth(timeScheme s, double r)
{
    double worst = 0;
    const coefficients up(s, r, 1), down(s, 1, r);
    const auto step = [](const coefficients& c, double w) {
        Eigen::Matrix2cd m = Eigen::Matrix2cd::Zero();
        const complex z(0, w * c.k);
        const complex a = c.alpha[2] - z * c.beta[2];
        m(0, 0) = -(c.alpha[1] - z * c.beta[1]) / a, m(0, 1) = -(c.alpha[0] - z * c.beta[0]) / a;
        m(1, 0) = 1;
        return m;
    };
    for (int a = 0; a < 60; ++a)
        for (int b = 0; b < 60; ++b)
            for (const int sign : {-1, 1})
            {
                const Eigen::Matrix2cd both =
                    step(down, sign * 0.01 * std::pow(1.2, b)) * step(up, 0.01 * std::pow(1.2, a));
                worst = std::max(worst, both.eigenvalues().cwiseAbs().maxCoeff());
            }
    return worst;
}

// Largest relative gain of E by a doubly stochastic map, on both levels or on the newer one
double gain(timeScheme s, bool both)
{
    source.seed(3);
    const int n = 10;
    const coefficients c(s, 1, 1);
    double worst = -1;
    for (int trial = 0; trial < 4000; ++trial)
    {
        operation S = operation::Identity(n, n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < i; ++j)
            {
                const double t = uniform(0, 1.0 / n);
                S(i, j) += t, S(j, i) += t, S(i, i) -= t, S(j, j) -= t;
            }
        const state y1 = anyState(n), y0 = uniform(0, 4) * y1 + 0.3 * anyState(n);
        const double E = c.energy(y1, y0);
        worst = std::max(worst, c.energy(S * y1, both ? state(S * y0) : y0) / E - 1);
    }
    return worst;
}

}  // namespace

TEST_CASE("table of candidates: time step")
{
    textTable table;
    table.add(
        "\nTime: defect of the energy balance with equal steps and with ratios up to 4, order, "
        "damping and lag "
        "per period\nat w dt = 0.1 and 0.3, root at - infinity, growth by two steps of ratio 1 : "
        "2, gain where a "
        "remap acts on both levels or the newer\n%-15s %7s %7s %5s %5s | %8s %8s %8s %8s | %6s %6s "
        "| %7s %7s\n",
        "scheme", "equal", "vary", "order", "vary", "damp 0.1", "damp 0.3", "lag 0.1", "lag 0.3",
        "root", "growth", "both", "newer");
    for (const timeScheme s : timeSchemes)
    {
        CAPTURE(name(s));
        const bool isBDF2 = s == timeScheme::BDF2, first = s == timeScheme::backwardEuler;
        const double equal = defect(s, 1), vary = defect(s, 2), p = order(s, 1), q = order(s, 2);
        const double grown = growth(s, 2), both = gain(s, true), newer = gain(s, false);
        table.add(
            "%-15s %7.0e %7.0e %5.2f %5.2f | %8.5f %8.5f %8.5f %8.5f | %6.3f %6.3f | %7.3f %7.3f\n",
            name(s).c_str(), equal, vary, p, q, dampingPerPeriod(s, 0.1), dampingPerPeriod(s, 0.3),
            lagPerPeriod(s, 0.1), lagPerPeriod(s, 0.3), std::abs(root(s, -1e9)), grown, both,
            newer);
        CHECK(equal < 1e-12);
        CHECK(p == doctest::Approx(first ? 1 : 2).epsilon(0.1));
        CHECK(q == doctest::Approx(first ? 1 : 2).epsilon(0.1));
        CHECK(both < 1e-12);
        if (isBDF2) CHECK((vary > 1e-2 && grown > 1.01 && newer > 0.1));
        else CHECK((vary < 1e-12 && grown < 1 + 1e-12 && newer < 1e-12));
    }
}

TEST_CASE("DLN is backward Euler with a linear combination before and one after")
{
    for (const timeScheme s : timeSchemes)
        for (const double ratio : {0.3, 1.0, 2.5})
        {
            const coefficients c(s, 0.1 * ratio, 0.1);
            const operation A = anySkew(8) - anyLoss(8);
            const state y0 = anyState(8), y1 = anyState(8);
            CHECK((c.next(A, y0, y1) - c.byBackwardEuler(A, y0, y1)).norm() < 1e-12);
        }
}
