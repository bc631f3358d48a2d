// SPDX-License-Identifier: GPL-3.0-or-later
// The tutorial's tube for small displacements, by another method: rings of a staggered grid in r and z, fluid and solid in one
// system with one pressure, the midpoint rule.  u stands on the faces, p in the middle of the rings.  With B u the rates of
// strain, D u = div u, x' = u, weights W = r dr dz, eta the viscosity in the fluid, G the shear modulus in the solid:
//
//     M u' = - B^T W eta B u - B^T W G B x + D^T W p + inlet,   D u + p'/lambda = 0
//
// 1/lambda = 0 if Poisson's ratio is 1/2.  The solid is clamped at both ends, the outer side is free.
// Usage: solve E nu rhoSolid dt dx < /dev/null; writes t [ms], radial displacement half way along [mm], given, kinetic, elastic,
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

int main(int argc, char** argv)
{
    if (argc != 6) return std::fprintf(stderr, "Usage: solve E nu rhoSolid dt dx\n"), 1;
    const double E = std::atof(argv[1]), nu = std::atof(argv[2]), dt = std::atof(argv[4]);
    const rings g(std::atof(argv[5]));
    const double G = E / (2 * (1 + nu)), compliance = (1 + nu) * (1 - 2 * nu) / (E * nu);
    const strains B(g);
    const matrix viscous = B.stiffness(mu, 0), elastic = B.stiffness(0, G), D = divergence(g);
    const vec M = masses(g, std::atof(argv[3]));
    vec C = vec::Zero(D.rows());
    for (int i = g.nf; i < g.nr; ++i)
        C.segment(i * g.nz, g.nz).setConstant(g.weight(i) * compliance);

    const double scale = 1e3;  // of p, for the pivots
    const matrix A = viscous + dt / 2 * elastic;
    std::vector<entry> entries;
    for (int k = 0; k < g.n; ++k)
    {
        for (matrix::InnerIterator it(A, k); it; ++it)
            entries.emplace_back(int(it.row()), k, it.value());
        for (matrix::InnerIterator it(D, k); it; ++it)
            entries.emplace_back(k, g.n + int(it.row()), -scale * it.value()),
                entries.emplace_back(g.n + int(it.row()), k, scale * it.value());
        entries.emplace_back(k, k, 2 * M[k] / dt);
    }
    for (int k = 0; k < C.size(); ++k)
        entries.emplace_back(g.n + k, g.n + k, scale * scale * 2 * C[k] / dt);
    matrix S(g.n + D.rows(), g.n + D.rows());
    S.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<matrix> solver(S);
    if (solver.info() != Eigen::Success) return std::fprintf(stderr, "no factors\n"), 1;

    vec u = vec::Zero(g.n), x = u, p = vec::Zero(D.rows());
    double given = 0, lost = 0;
    for (int step = 0; step < std::lround(20e-3 / dt); ++step)
    {
        const double pIn = (inletPressure(step * dt) + inletPressure((step + 1) * dt)) / 2;
        vec f = 2 / dt * M.cwiseProduct(u) - elastic * x, inlet = vec::Zero(g.n), right(S.rows());
        for (int i = 0; i < g.nf; ++i) inlet[g.axial(i, 0)] = pIn * (i + 0.5) * g.d * g.d;
        f += inlet;
        for (int k = 0; k < g.n; ++k)
            if (g.fixed(k)) f[k] = 0;
        right << f, scale * 2 / dt * C.cwiseProduct(p);
        const vec both = solver.solve(right), mean = both.head(g.n),
                  pMean = scale * both.tail(D.rows());
        given += 2 * pi * dt * mean.dot(inlet), lost += 2 * pi * dt * mean.dot(viscous * mean);
        x += dt * mean, u = 2 * mean - u;
        p = compliance > 0 ? vec(2 * pMean - p) : pMean;
        std::printf("%g %g %g %g %g %g", 1e3 * (step + 1) * dt,
                    5e2 * (x[g.radial(g.nf, g.nz / 2)] + x[g.radial(g.nf, g.nz / 2 - 1)]),
                    1e6 * given, 1e6 * pi * u.dot(M.cwiseProduct(u)), 1e6 * pi * x.dot(elastic * x),
                    1e6 * lost);
        for (double z : {5e-3, 7.5e-3, 10e-3, 12.5e-3, 15e-3, 20e-3})
        {
            const int j = int(std::lround(z / g.d));
            std::printf(" %g", (pMean[j] + pMean[j - 1]) / 2);
        }
        std::printf("\n");
    }
}
