// SPDX-License-Identifier: GPL-3.0-or-later
#include "followWeights.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

using matrix = Eigen::MatrixXd;
using row = Eigen::RowVectorXd;

// Modes with singular values below this share of the largest are left out: linear modes that the particles do not span (one
// layer), quadratic modes that would amplify noise (two layers)
constexpr scalar linearCut = 1e-6, quadraticCut = 0.02;

// Columns: functions at the particles.  atPoint: their values at the point, and below these their three derivatives
struct basis
{
    matrix columns;
    matrix atPoint;

    void removeFrom(basis& other) const
    {
        const matrix share = columns.transpose() * other.columns;
        other.columns -= columns * share;
        other.atPoint -= atPoint * share;
    }
};

// Orthonormal modes of b with singular values above cut times `greatest`.  The squares of the singular values are
// eigenvalues of at most six normal equations; their rounding is far below cut^2
basis orthonormal(const basis& b, scalar cut, scalar greatest)
{
    using square = Eigen::Matrix<scalar, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
    const Eigen::SelfAdjointEigenSolver<square> squares(square(b.columns.transpose() * b.columns));
    const auto& s2 = squares.eigenvalues();  // ascending
    Eigen::Index n = 0;
    while (n < s2.size() && s2[s2.size() - 1 - n] > cut * cut * greatest * greatest) ++n;
    const matrix modes =
        squares.eigenvectors().rightCols(n) * s2.tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
    return {b.columns * modes, b.atPoint * modes};
}

}  // namespace

List<scalar> followWeights(const List<vector>& r, List<vector>* slopes)
{
    const Eigen::Index n = Eigen::Index(r.size());
    Eigen::VectorXd root(n);  // square root of the fit's weight
    for (Eigen::Index j = 0; j < n; ++j) root[j] = std::max(0.0, 1 - r[j].norm());
    if (!(root.norm() > 0)) return {};

    basis one{root, matrix::Zero(4, 1)}, linear{matrix(n, 3), matrix::Zero(4, 3)};
    basis quadratic{matrix(n, 6), matrix::Zero(4, 6)};
    one.atPoint(0) = 1, linear.atPoint.bottomRows(3).setIdentity();
    for (Eigen::Index j = 0; j < n; ++j)
    {
        const vector& x = r[j];
        linear.columns.row(j) = root[j] * x.transpose();
        // Kelvin's components: which modes are left out does not depend on the direction of the axes
        quadratic.columns.row(j) =
            root[j] * row{{x[0] * x[0], x[1] * x[1], x[2] * x[2], std::sqrt(2.0) * x[0] * x[1],
                           std::sqrt(2.0) * x[1] * x[2], std::sqrt(2.0) * x[2] * x[0]}};
    }
    const scalar scale = root.norm();
    one = {one.columns / scale, one.atPoint / scale};
    one.removeFrom(linear), one.removeFrom(quadratic);
    linear = orthonormal(linear, linearCut, scale);
    linear.removeFrom(quadratic);
    quadratic = orthonormal(quadratic, quadraticCut, scale);

    matrix w = one.columns * one.atPoint.transpose() + linear.columns * linear.atPoint.transpose() +
               quadratic.columns * quadratic.atPoint.transpose();
    w.array().colwise() *= root.array();
    if (slopes)
        for (Eigen::Index j = 0; j < n; ++j) slopes->push_back(w.row(j).tail(3).transpose());
    return List<scalar>(w.data(), w.data() + n);
}

}  // namespace ispf
