// SPDX-License-Identifier: GPL-3.0-or-later
#include "measures.H"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <random>

namespace theory
{

namespace
{

double norm(const field& a, const field& b)
{
    return std::sqrt(a.squaredNorm() + b.squaredNorm());
}
field withoutMean(const field& v)
{
    return v.array() - v.mean();
}

// Every solid particle has its own random velocity, the walls have a common one
motion randomMotion(const scene& s, std::mt19937& random)
{
    std::normal_distribution<double> normal;
    motion m;
    const vec2 wall(normal(random), normal(random));
    for (size_t k = 0; k < s.others.size(); ++k)
        m.others.push_back(int(k) < s.nWalls ? wall : vec2(normal(random), normal(random)));
    for (const facet& f : s.facets) m.facets.push_back(f.owner < 0 ? wall : m.others[f.owner]);
    return m;
}

struct fields
{
    field p, u, v, px, py;  // smooth, with the gradient of p
};

fields smooth(const scene& s)
{
    const int n = s.size();
    fields f{field(n), field(n), field(n), field(n), field(n)};
    for (int i = 0; i < n; ++i)
    {
        const vec2 u = velocity(s, s.x[i]), g = gradient(&scene::pressure, s, s.x[i]);
        f.p[i] = s.pressure(s.x[i]);
        f.u[i] = u[0], f.v[i] = u[1], f.px[i] = g[0], f.py[i] = g[1];
    }
    return f;
}

Eigen::MatrixXd symmetric(const matrix& a)
{
    const Eigen::MatrixXd full(a);
    return 0.5 * (full + full.transpose());
}

field eigenvalues(const matrix& a)
{
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric(a), Eigen::EigenvaluesOnly)
        .eigenvalues();
}

}  // namespace

balances balancesOf(const scene& s, const operatorPair& pair, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto any = [&] {
        return field(field::NullaryExpr(s.size(), [&] { return normal(random); }));
    };
    const field u = any(), v = any(), p = any(), one = field::Ones(s.size());
    const motion m = randomMotion(s, random);
    const field Du = pair.divergence(u, v, m);
    balances b{};
    double given = 0, size = 0, flux = 0, momentum = 0, scale = 0;
    for (int axis = 0; axis < 2; ++axis)
    {
        const field Gp = pair.G[axis] * p, G1 = pair.G[axis] * one;
        const field onFacets = pair.onFacets[axis] * p, onOthers = pair.onOthers[axis] * p;
        const field of1 = pair.onFacets[axis] * one;
        for (size_t k = 0; k < s.facets.size(); ++k)
        {
            given += onFacets[k] * m.facets[k][axis];
            flux += s.facets[k].S[axis] * m.facets[k][axis];
            b.uniformLoad = std::max(b.uniformLoad, std::abs(of1[k] - s.facets[k].S[axis]) / s.dx);
        }
        for (size_t k = 0; k < s.others.size(); ++k) given += onOthers[k] * m.others[k][axis];
        given -= s.V * (axis ? v : u).dot(Gp);
        size += s.V * (axis ? v : u).cwiseProduct(Gp).cwiseAbs().sum();
        momentum += std::abs(s.V * Gp.sum() - onFacets.sum() - onOthers.sum());
        scale += s.V * Gp.cwiseAbs().sum();
        b.uniformForce = std::max(b.uniformForce, s.dx * G1.cwiseAbs().maxCoeff());
    }
    b.adjointness =
        std::abs(given - s.V * p.dot(Du)) / (size + s.V * p.cwiseProduct(Du).cwiseAbs().sum());
    b.momentum = momentum / scale;
    b.flux = std::abs(s.V * Du.sum() - flux) / (s.V * Du.cwiseAbs().sum());
    return b;
}

errors errorsOf(const scene& s, const operatorPair& pair)
{
    const fields f = smooth(s);
    const field ex = pair.G[0] * f.p - f.px, ey = pair.G[1] * f.p - f.py;
    double error = 0, all = 0;
    for (int i = 0; i < s.size(); ++i)
        if (!s.shares[i].empty())
        {
            error += ex[i] * ex[i] + ey[i] * ey[i];
            all += f.px[i] * f.px[i] + f.py[i] * f.py[i];
        }
    const field Du = pair.D[0] * f.u + pair.D[1] * f.v;
    return {norm(ex, ey) / norm(f.px, f.py), all > 0 ? std::sqrt(error / all) : 0,
            Du.norm() / (2 * M_PI * norm(f.u, f.v))};
}

projectionErrors project(const scene& s, const operatorPair& pair, const matrix& M)
{
    const fields f = smooth(s);
    const field right = withoutMean(-(pair.D[0] * (f.u + f.px) + pair.D[1] * (f.v + f.py)));
    matrix A = M;
    A.coeffRef(0, 0) += 1e-8 * A.coeff(1, 1);
    const Eigen::SimplicialLDLT<matrix> solver(A);
    const field q = withoutMean(solver.solve(right)), p = withoutMean(f.p);
    const field eu = f.px - pair.G[0] * q, ev = f.py - pair.G[1] * q;
    const field Gx = pair.G[0] * p, Gy = pair.G[1] * p;
    const double loss = p.dot(M * p + pair.D[0] * Gx + pair.D[1] * Gy);
    return {(q - p).norm() / p.norm(), norm(eu, ev) / norm(f.u, f.v),
            loss / (f.px.squaredNorm() + f.py.squaredNorm())};
}

spectrum spectrumOf(const scene& s, const operatorPair& pair, const matrix& M)
{
    const matrix L = compactLaplacian(s);
    const double most = eigenvalues(L).maxCoeff(), shift = 1e-7 * L.coeff(0, 0);
    const matrix C = M + pair.D[0] * pair.G[0] + pair.D[1] * pair.G[1];
    const Eigen::MatrixXd one = shift * Eigen::MatrixXd::Identity(s.size(), s.size());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> against(
        symmetric(M) + one, symmetric(L) + one, Eigen::EigenvaluesOnly);
    return {eigenvalues(C).minCoeff() / most,
            eigenvalues(matrix(2 * M - pair.GtG())).minCoeff() / most,
            against.eigenvalues().minCoeff(), against.eigenvalues().maxCoeff()};
}

}  // namespace theory
