// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceFit.H"

#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar farthest = 1.5;  // [dx] the nearest particle of a facet that is covered
constexpr scalar behind =
    0.1;  // [dx] a particle further beyond the facet's plane is on the other side
constexpr scalar dependent = 1e-3;  // a column of the fit that hardly differs from the others

// Monomials of the order and below: 1, x, y (z), x^2, xy, ...
Eigen::RowVectorXd monomials(const vector& d, int nDims, int order)
{
    Eigen::RowVectorXd m(order == 2 ? (nDims + 1) * (nDims + 2) / 2 : nDims + 1);
    int n = 0;
    m[n++] = 1;
    for (int a = 0; a < nDims; ++a) m[n++] = d[a];
    for (int a = 0; order == 2 && a < nDims; ++a)
        for (int b = a; b < nDims; ++b) m[n++] = d[a] * d[b];
    return m;
}

}  // namespace

surfaceFit::surfaceFit(const fsiCase& c, const List<char>& zones)
    : nDims_(c.cloud.nDims), dx_(c.cloud.dx), grid_(reach * c.cloud.dx)
{
    const List<structureImage> images = c.walls->images();
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        if (!zones[c.cloud.zone[i]]) continue;
        grid_.add(c.cloud.x[i].xyz()), Up_.push_back(c.cloud.Up[i]);
        for (const structureImage& map : images)
        {
            grid_.add(map(c.cloud.x[i].xyz()));
            Up_.push_back(vec4::from(map.R * c.cloud.Up[i].xyz(), c.cloud.Up[i][3]));
        }
    }
}

List<fluidAt> surfaceFit::at(const List<facet>& facets) const
{
    List<fluidAt> result(facets.size());
    parallelFor(
        label(facets.size()),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k) result[k] = fit(facets[k]);
        },
        16);
    return result;
}

fluidAt surfaceFit::fit(const facet& f) const
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
    result.covered = nearest < farthest * dx_ && (solve(near, 2, result) || solve(near, 1, result));
    return result;
}

// False where the particles do not determine all coefficients
bool surfaceFit::solve(const List<neighbour>& near, int order, fluidAt& result) const
{
    const Eigen::Index rows = Eigen::Index(near.size());
    const Eigen::Index columns = monomials(vector::Zero(), nDims_, order).size();
    if (rows < columns) return false;
    Eigen::MatrixXd A(rows, columns), b(rows, 4);
    for (Eigen::Index r = 0; r < rows; ++r)
    {
        const scalar w = std::sqrt(near[r].weight);
        const vec4& up = Up_[near[r].k];
        A.row(r) = w * monomials(near[r].d, nDims_, order);
        b.row(r) = w * Eigen::RowVector4d(up[0], up[1], up[2], up[3]);
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
    qr.setThreshold(dependent);
    if (qr.rank() < columns) return false;
    const Eigen::MatrixXd c = qr.solve(b);
    for (int a = 0; a < 3; ++a)
    {
        result.U[a] = c(0, a);
        for (int d = 0; d < nDims_; ++d) result.gradU(a, d) = c(1 + d, a) / (reach * dx_);
    }
    result.p = c(0, 3);
    return true;
}

}  // namespace ispf
