// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceFit.H"

#include <array>
#include <cmath>

namespace ispf
{

namespace
{

// [dx] largest distance of the nearest particle of a covered facet
constexpr scalar farthest = 1.5;
// [dx] a particle further beyond the facet's plane is on the other side
constexpr scalar behind = 0.1;
// a column of the fit is dependent if less than this share remains beside the others
constexpr scalar dependent = 1e-3;

// Monomials up to the second or the first order: 1, x, y (z), x^2, xy, ...
template <int nColumns>
Eigen::Matrix<scalar, nColumns, 1> monomials(const vector& d)
{
    constexpr int nDims = nColumns == 3 || nColumns == 6 ? 2 : 3;
    Eigen::Matrix<scalar, nColumns, 1> m;
    int n = 0;
    m[n++] = 1;
    for (int a = 0; a < nDims; ++a) m[n++] = d[a];
    if constexpr (nColumns > nDims + 1)
        for (int a = 0; a < nDims; ++a)
            for (int b = a; b < nDims; ++b) m[n++] = d[a] * d[b];
    return m;
}

// Solves A x = b for symmetric A, the largest pivot first; false if a pivot vanishes against the first
template <int n>
bool eliminate(Eigen::Matrix<scalar, n, n>& A, Eigen::Matrix<scalar, n, 4>& b)
{
    std::array<bool, n> done{};
    scalar first = 0;
    for (int k = 0; k < n; ++k)
    {
        int p = -1;
        for (int q = 0; q < n; ++q)
            if (!done[q] && (p < 0 || A(q, q) > A(p, p))) p = q;
        first = std::max(first, A(p, p));
        if (!(A(p, p) > dependent * dependent * first)) return false;
        done[p] = true;
        b.row(p) /= A(p, p), A.row(p) /= A(p, p);
        for (int q = 0; q < n; ++q)
            if (const scalar factor = A(q, p); q != p)
                b.row(q) -= factor * b.row(p), A.row(q) -= factor * A.row(p);
    }
    return true;
}

}  // namespace

surfaceFit::surfaceFit(const fsiCase& c, const List<char>& zones, const List<facet>& facets)
    : nDims_(c.cloud.nDims), dx_(c.cloud.dx), grid_(reach * c.cloud.dx)
{
    boundBox box;
    for (const facet& f : facets) box.add(f.centre);
    const auto add = [&](const vector& x, const vec4& Up) {
        if (box.distSqr(x) < reach * reach * dx_ * dx_) grid_.add(x), Up_.push_back(Up);
    };
    const List<structureImage> images = c.walls->images();
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        if (!zones[c.cloud.zone[i]]) continue;
        add(c.cloud.x[i].xyz(), c.cloud.Up[i]);
        for (const structureImage& map : images)
            add(map(c.cloud.x[i].xyz()), vec4::from(map.R * c.cloud.Up[i].xyz(), c.cloud.Up[i][3]));
    }
}

List<fluidAt> surfaceFit::of(const List<facet>& facets, const List<vector>& wallVelocity) const
{
    List<fluidAt> result(facets.size());
    parallelFor(
        label(facets.size()),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
                result[k] = fit(facets[k], wallVelocity.empty() ? nullptr : &wallVelocity[k]);
        },
        16);
    return result;
}

fluidAt surfaceFit::fit(const facet& f, const vector* wallVelocity) const
{
    const vector n = f.area.normalized();
    List<neighbour> near;
    scalar nearest = reach * dx_;
    grid_.within(f.centre, reach * dx_, [&](label k, scalar r) {
        const vector d = grid_[k] - f.centre;
        if (d.dot(n) > behind * dx_) return;
        const scalar q = r / (reach * dx_), a = 1 - q;
        near.push_back({k, d / (reach * dx_), a * a * a * a * (1 + 4 * q)});
        nearest = std::min(nearest, r);
    });
    fluidAt result;
    result.covered =
        nearest < farthest * dx_ &&
        (nDims_ == 2
             ? solve<6>(near, wallVelocity, result) || solve<3>(near, wallVelocity, result)
             : solve<10>(near, wallVelocity, result) || solve<4>(near, wallVelocity, result));
    return result;
}

// False if the particles do not determine all coefficients
template <int nColumns>
bool surfaceFit::solve(const List<neighbour>& near, const vector* wallVelocity,
                       fluidAt& result) const
{
    Eigen::Matrix<scalar, nColumns, nColumns> A = Eigen::Matrix<scalar, nColumns, nColumns>::Zero();
    Eigen::Matrix<scalar, nColumns, 4> c = Eigen::Matrix<scalar, nColumns, 4>::Zero();
    for (const neighbour& j : near)
    {
        const Eigen::Matrix<scalar, nColumns, 1> m = monomials<nColumns>(j.d), mw = j.weight * m;
        const vec4& up = Up_[j.k];
        A.noalias() += mw * m.transpose();
        c.noalias() += mw * Eigen::RowVector4d(up[0], up[1], up[2], up[3]);
    }
    if (label(near.size()) < nColumns) return false;
    const auto all = A;
    const auto sums = c;
    if (!eliminate<nColumns>(A, c)) return false;
    result.U = c.row(0).template head<3>().transpose(), result.p = c(0, 3);
    Eigen::Matrix<scalar, nColumns - 1, 4> slopes = c.template bottomRows<nColumns - 1>();
    if (wallVelocity)
    {
        // the constant is known: its column moves to the right side, and its row is left out
        result.U = *wallVelocity;
        const Eigen::RowVector4d known(result.U[0], result.U[1], result.U[2], 0);
        Eigen::Matrix<scalar, nColumns - 1, nColumns - 1> rest =
            all.template bottomRightCorner<nColumns - 1, nColumns - 1>();
        slopes = sums.template bottomRows<nColumns - 1>() -
                 all.col(0).template tail<nColumns - 1>() * known;
        if (!eliminate<nColumns - 1>(rest, slopes)) return false;
    }
    for (int a = 0; a < 3; ++a)
        for (int d = 0; d < nDims_; ++d) result.gradU(a, d) = slopes(d, a) / (reach * dx_);
    return true;
}

}  // namespace ispf
