// SPDX-License-Identifier: GPL-3.0-or-later
// The tutorial's tube for small displacements, by another method: rings of a staggered grid in r and z, fluid and solid in one
// system with one pressure, the midpoint rule.  u stands on the faces, p in the middle of the rings.  With B u the rates of
// strain, D u = div u, x' = u, weights W = r dr dz, eta the viscosity in the fluid, G the shear modulus in the solid:
//
//     M u' = - B^T W eta B u - B^T W G B x + D^T W p + inlet,   D u + p'/lambda = 0
//
// 1/lambda = 0 if Poisson's ratio is 1/2.  The solid is clamped at both ends, the outer side is free.
// Usage: solve E nu rhoSolid dt dx; writes t [ms], radial displacement half way along [mm], given, kinetic, elastic,
// lost to viscosity [uJ], p [Pa] at six places
#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

using matrix = Eigen::SparseMatrix<double>;
using vec = Eigen::VectorXd;
using entry = Eigen::Triplet<double>;
using terms = std::vector<std::pair<int, double>>;

constexpr double L = 50e-3, R = 5e-3, Ro = 6e-3, rhoFluid = 1000, mu = 3e-3, pi = M_PI;

double inletPressure(double t)
{
    return t < 3e-3 ? 1333.2 : t < 3.1e-3 ? 1333.2 * (3.1e-3 - t) / 1e-4 : 0;
}

struct rings
{
    double d;
    int nr = int(std::lround(Ro / d)), nf = int(std::lround(R / d)), nz = int(std::lround(L / d));
    int nRadial = (nr + 1) * nz, n = nRadial + nr * (nz + 1);

    explicit rings(double spacing) : d(spacing) {}
    int radial(int i, int j) const { return i * nz + j; }
    int axial(int i, int j) const { return nRadial + i * (nz + 1) + j; }
    double weight(int i) const { return (i + 0.5) * d * d * d; }
    bool fixed(int k) const  // on the axis, or of the clamped ends
    {
        if (k < nRadial) return k < nz;
        const int i = (k - nRadial) / (nz + 1), j = (k - nRadial) % (nz + 1);
        return i >= nf && (j == 0 || j == nz);
    }
};

// Rows of B with the weights of viscosity and stiffness
class strains
{
public:
    explicit strains(const rings& g) : g_(g)
    {
        for (int i = 0; i < g.nr; ++i)
            for (int j = 0; j < g.nz; ++j) normal(i, j);
        for (int i = 1; i < g.nr; ++i)
            for (int j = 0; j <= g.nz; ++j) shear(i, j);
        for (int j : {0, g.nz - 1})  // the clamp at the rim
            add({{g.radial(g.nr, j), 2 / g.d}}, g.nr * g.d * g.d * g.d / 4, 1);
    }
    matrix stiffness(double viscosity, double modulus) const
    {
        matrix B(int(fluid_.size()), g_.n);
        B.setFromTriplets(entries_.begin(), entries_.end());
        vec w(B.rows());
        for (int k = 0; k < w.size(); ++k) w[k] = viscosity * fluid_[k] + modulus * solid_[k];
        return B.transpose() * w.asDiagonal() * B;
    }

private:
    void add(const terms& row, double weight, double solidShare)
    {
        for (const auto& [k, x] : row)
            if (!g_.fixed(k)) entries_.emplace_back(int(fluid_.size()), k, x);
        fluid_.push_back(weight * (1 - solidShare)), solid_.push_back(weight * solidShare);
    }
    void normal(int i, int j)
    {
        const double d = g_.d, r = (i + 0.5) * d, w = 2 * g_.weight(i);
        const int in = g_.radial(i, j), out = g_.radial(i + 1, j), share = i >= g_.nf;
        add({{out, 1 / d}, {in, -1 / d}}, w, share);
        add({{out, 0.5 / r}, {in, 0.5 / r}}, w, share);
        add({{g_.axial(i, j + 1), 1 / d}, {g_.axial(i, j), -1 / d}}, w, share);
    }
    void shear(int i, int j)
    {
        const double d = g_.d, w = i * d * d * d, share = i < g_.nf ? 0 : i == g_.nf ? 0.5 : 1;
        if (j > 0 && j < g_.nz)
            add({{g_.radial(i, j), 1 / d},
                 {g_.radial(i, j - 1), -1 / d},
                 {g_.axial(i, j), 1 / d},
                 {g_.axial(i - 1, j), -1 / d}},
                w, share);
        else if (i >= g_.nf)
            add({{g_.radial(i, j ? g_.nz - 1 : 0), (j ? -2 : 2) / d}}, w / 2, share);
    }

    const rings& g_;
    std::vector<entry> entries_;
    std::vector<double> fluid_, solid_;
};

matrix divergence(const rings& g)
{
    std::vector<entry> entries;
    for (int i = 0; i < g.nr; ++i)
        for (int j = 0; j < g.nz; ++j)
        {
            const double r = (i + 0.5) * g.d;
            for (const auto& [k, x] : terms{{g.radial(i + 1, j), 1 / g.d + 0.5 / r},
                                            {g.radial(i, j), -1 / g.d + 0.5 / r},
                                            {g.axial(i, j + 1), 1 / g.d},
                                            {g.axial(i, j), -1 / g.d}})
                if (!g.fixed(k)) entries.emplace_back(i * g.nz + j, k, x * g.weight(i));
        }
    matrix D(g.nr * g.nz, g.n);
    D.setFromTriplets(entries.begin(), entries.end());
    return D;
}

vec masses(const rings& g, double rhoSolid)
{
    vec M = vec::Zero(g.n);
    for (int i = 0; i < g.nr; ++i)
        for (int j = 0; j < g.nz; ++j)
            for (int k : {g.radial(i, j), g.radial(i + 1, j), g.axial(i, j), g.axial(i, j + 1)})
                M[k] += (i < g.nf ? rhoFluid : rhoSolid) * g.weight(i) / 2;
    return M;
}

// Unknowns of a step: the mean velocities and pressures
class tube
{
public:
    tube(const rings& g, double E, double nu, double rhoSolid, double dt)
        : g_(g),
          dt_(dt),
          compliance_((1 + nu) * (1 - 2 * nu) / (E * nu)),
          D_(divergence(g)),
          M_(masses(g, rhoSolid))
    {
        const strains B(g);
        viscous_ = B.stiffness(mu, 0), elastic_ = B.stiffness(0, E / (2 * (1 + nu)));
        C_ = vec::Zero(D_.rows());
        for (int i = g.nf; i < g.nr; ++i)
            C_.segment(i * g.nz, g.nz).setConstant(g.weight(i) * compliance_);
        u_ = x_ = vec::Zero(g.n), p_ = pMean_ = vec::Zero(D_.rows());
        factorise();
    }
    bool isFactorised() const { return solver_.info() == Eigen::Success; }

    void step(double pIn)
    {
        vec inlet = vec::Zero(g_.n), right(g_.n + D_.rows());
        for (int i = 0; i < g_.nf; ++i) inlet[g_.axial(i, 0)] = pIn * (i + 0.5) * g_.d * g_.d;
        vec f = 2 / dt_ * M_.cwiseProduct(u_) - elastic_ * x_ + inlet;
        for (int k = 0; k < g_.n; ++k)
            if (g_.fixed(k)) f[k] = 0;
        right << f, scale * 2 / dt_ * C_.cwiseProduct(p_);
        const vec both = solver_.solve(right), mean = both.head(g_.n);
        pMean_ = scale * both.tail(D_.rows());
        given_ += dt_ * mean.dot(inlet), lost_ += dt_ * mean.dot(viscous_ * mean);
        x_ += dt_ * mean, u_ = 2 * mean - u_;
        p_ = compliance_ > 0 ? vec(2 * pMean_ - p_) : pMean_;
    }
    void print(double t) const
    {
        const double middle =
            (x_[g_.radial(g_.nf, g_.nz / 2)] + x_[g_.radial(g_.nf, g_.nz / 2 - 1)]) / 2;
        std::printf("%g %g %g %g %g %g", 1e3 * t, 1e3 * middle, 2e6 * pi * given_,
                    1e6 * pi * u_.dot(M_.cwiseProduct(u_)), 1e6 * pi * x_.dot(elastic_ * x_),
                    2e6 * pi * lost_);
        for (double z : {5e-3, 7.5e-3, 10e-3, 12.5e-3, 15e-3, 20e-3})
        {
            const int j = int(std::lround(z / g_.d));
            std::printf(" %g", (pMean_[j] + pMean_[j - 1]) / 2);
        }
        std::printf("\n");
    }

private:
    static constexpr double scale = 1e3;  // of p, for the pivots

    void factorise()
    {
        const matrix A = viscous_ + dt_ / 2 * elastic_;
        std::vector<entry> entries;
        for (int k = 0; k < g_.n; ++k)
        {
            for (matrix::InnerIterator it(A, k); it; ++it)
                entries.emplace_back(int(it.row()), k, it.value());
            for (matrix::InnerIterator it(D_, k); it; ++it)
            {
                const int row = g_.n + int(it.row());
                entries.emplace_back(k, row, -scale * it.value()),
                    entries.emplace_back(row, k, scale * it.value());
            }
            entries.emplace_back(k, k, 2 * M_[k] / dt_);
        }
        for (int k = 0; k < C_.size(); ++k)
            entries.emplace_back(g_.n + k, g_.n + k, scale * scale * 2 * C_[k] / dt_);
        matrix S(g_.n + D_.rows(), g_.n + D_.rows());
        S.setFromTriplets(entries.begin(), entries.end());
        solver_.compute(S);
    }

    const rings& g_;
    double dt_, compliance_, given_ = 0, lost_ = 0;
    matrix viscous_, elastic_, D_;
    vec M_, C_, u_, x_, p_, pMean_;
    Eigen::SparseLU<matrix> solver_;
};

int main(int argc, char** argv)
{
    if (argc != 6) return std::fprintf(stderr, "Usage: solve E nu rhoSolid dt dx\n"), 1;
    const double dt = std::atof(argv[4]);
    const rings g(std::atof(argv[5]));
    tube t(g, std::atof(argv[1]), std::atof(argv[2]), std::atof(argv[3]), dt);
    if (!t.isFactorised()) return std::fprintf(stderr, "no factors\n"), 1;
    for (int n = 0; n < std::lround(20e-3 / dt); ++n)
    {
        t.step((inletPressure(n * dt) + inletPressure((n + 1) * dt)) / 2);
        t.print((n + 1) * dt);
    }
}
