// SPDX-License-Identifier: GPL-3.0-or-later
#include "remap.H"

#include <cmath>

namespace theory
{

using Eigen::MatrixXd;

std::string name(remapRule r)
{
    const char* names[] = {"none",          "Taylor",         "Taylor, viscous", "upwind exchange",
                           "pair exchange", "pair transport", "limited",         "completed"};
    return names[int(r)];
}

remap::remap(const scene& s, const std::vector<vec2>& shift, double smoothed) : n_(s.size())
{
    for (const vec2& dr : shift)
        share_.push_back(std::min(1.0, smoothed * s.dx / std::max(dr.norm(), 1e-12 * s.dx)));
    for (int i = 0; i < n_; ++i)
        for (const neighbour& q : s.fluid[i])
        {
            if (q.j < i) continue;
            const double Tij = shift[i].dot(s.BFluid[i] * (q.w * q.r)),
                         Tji = -shift[q.j].dot(s.BFluid[q.j] * (q.w * q.r));
            pairs_.push_back({i, q.j, Tij, Tji, (Tij + Tji) / 2, (Tij - Tji) / 2});
        }
    separate(s);
}

// Adds chi_i - chi_j to k_ij, so that no row has a sum
void remap::separate(const scene& s)
{
    entries e;
    field sum = field::Zero(n_);
    for (const pair& p : pairs_)
    {
        sum[p.i] += p.k, sum[p.j] -= p.k;
        e.push_back({p.i, p.j, -1}), e.push_back({p.j, p.i, -1});
        e.push_back({p.i, p.i, 1}), e.push_back({p.j, p.j, 1});
    }
    e.push_back({0, 0, 1e-9});
    graph_.compute(fromEntries(s.size(), s.size(), e));
    const field chi = graph_.solve(-sum);
    for (pair& p : pairs_) p.k += chi[p.i] - chi[p.j];
}

MatrixXd remap::apply(remapRule rule, const MatrixXd& u, double allowed) const
{
    MatrixXd v = u;
    if (rule == remapRule::none) return v;
    if (rule == remapRule::limited) return limited(u, allowed);
    if (rule == remapRule::completed) return completed(u, allowed);
    for (const pair& p : pairs_)
    {
        double here = p.Tij, there = p.Tji;
        if (rule == remapRule::viscous) here *= share_[p.i], there *= share_[p.j];
        if (rule == remapRule::upwind) here = there = (std::abs(p.Tij) + std::abs(p.Tji)) / 2;
        if (rule == remapRule::exchange) here = there = p.c;
        if (rule == remapRule::transport) here = p.c + p.k, there = p.c - p.k;
        v.row(p.i) += here * (u.row(p.j) - u.row(p.i));
        v.row(p.j) += there * (u.row(p.i) - u.row(p.j));
    }
    return v;
}

namespace
{

// low + t added, with the largest t <= 1 that gains no more energy than allowed; |low| <= |u|
MatrixXd withoutGain(const MatrixXd& u, const MatrixXd& low, const MatrixXd& added, double allowed)
{
    const double a = added.squaredNorm(), b = low.cwiseProduct(added).sum(),
                 c = std::min(0.0, low.squaredNorm() - u.squaredNorm() - allowed);
    const double t = a + 2 * b + c <= 0 ? 1 : (-b + std::sqrt(b * b - a * c)) / a;
    return low + std::min(t, 1.0) * added;
}

}  // namespace

// First the doubly stochastic part: max(c, 0), and k upwind.  The rest are antisymmetric pair fluxes; they are
// limited pair by pair (Zalesak 1979), then all by one factor
MatrixXd remap::limited(const MatrixXd& u, double allowed) const
{
    MatrixXd low = u, added = u;
    for (const pair& p : pairs_)
    {
        const double c = std::max(p.c, 0.0) + std::abs(p.k);
        low.row(p.i) += (c + p.k) * (u.row(p.j) - u.row(p.i));
        low.row(p.j) += (c - p.k) * (u.row(p.i) - u.row(p.j));
    }
    for (int axis = 0; axis < u.cols(); ++axis)
    {
        std::vector<double> flux;  // into i
        for (const pair& p : pairs_)
            flux.push_back((std::max(-p.c, 0.0) + std::abs(p.k)) * (u(p.i, axis) - u(p.j, axis)));
        added.col(axis) = limitedColumn(u.col(axis), low.col(axis), flux);
    }
    return withoutGain(u, low, added, allowed);
}

MatrixXd remap::completed(const MatrixXd& u, double allowed) const
{
    MatrixXd low = u, added = u, left = apply(remapRule::taylor, u) - apply(remapRule::exchange, u);
    left.rowwise() -= left.colwise().mean().eval();
    for (const pair& p : pairs_)
    {
        low.row(p.i) += std::max(p.c, 0.0) * (u.row(p.j) - u.row(p.i));
        low.row(p.j) += std::max(p.c, 0.0) * (u.row(p.i) - u.row(p.j));
    }
    for (int axis = 0; axis < u.cols(); ++axis)
    {
        const field eta = graph_.solve(left.col(axis));
        std::vector<double> flux;  // into i
        for (const pair& p : pairs_)
            flux.push_back(std::max(-p.c, 0.0) * (u(p.i, axis) - u(p.j, axis)) + eta[p.i] -
                           eta[p.j]);
        added.col(axis) = limitedColumn(u.col(axis), low.col(axis), flux);
    }
    return withoutGain(u, low, added, allowed);
}

field remap::limitedColumn(const field& u, const field& low, const std::vector<double>& flux) const
{
    field least = u, most = u, in = field::Zero(n_), out = in, sum = in;
    for (size_t q = 0; q < pairs_.size(); ++q)
    {
        const auto [i, j] = std::pair(pairs_[q].i, pairs_[q].j);
        least[i] = std::min(least[i], u[j]), least[j] = std::min(least[j], u[i]);
        most[i] = std::max(most[i], u[j]), most[j] = std::max(most[j], u[i]);
        const int up = flux[q] > 0 ? i : j, down = flux[q] > 0 ? j : i;
        in[up] += std::abs(flux[q]), out[down] += std::abs(flux[q]);
    }
    const auto ratio = [](double room, double wanted) {
        return wanted > room ? std::max(room, 0.0) / wanted : 1.0;
    };
    for (size_t q = 0; q < pairs_.size(); ++q)
    {
        const auto [i, j] = std::pair(pairs_[q].i, pairs_[q].j);
        const int up = flux[q] > 0 ? i : j, down = flux[q] > 0 ? j : i;
        const double part =
            std::min(ratio(most[up] - low[up], in[up]), ratio(low[down] - least[down], out[down]));
        sum[i] += part * flux[q], sum[j] -= part * flux[q];
    }
    return sum;
}

double newExtremum(const scene& s, const MatrixXd& before, const MatrixXd& after)
{
    double beyond = 0;
    for (int axis = 0; axis < before.cols(); ++axis)
        for (int i = 0; i < s.size(); ++i)
        {
            double least = before(i, axis), most = least;
            for (const neighbour& q : s.fluid[i])
                least = std::min(least, before(q.j, axis)),
                most = std::max(most, before(q.j, axis));
            beyond = std::max({beyond, after(i, axis) - most, least - after(i, axis)});
        }
    return beyond / before.cwiseAbs().maxCoeff();
}

}  // namespace theory
