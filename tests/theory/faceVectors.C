// SPDX-License-Identifier: GPL-3.0-or-later
// a_ij = (B_i + B_j)/2 g_ij + w_ij (psi_i - psi_j) is antisymmetric for all B and psi
#include "operatorPair.H"

#include <cmath>

namespace theory
{

namespace
{

using vec3 = Eigen::Vector3d;
using mat3 = Eigen::Matrix3d;

field withoutMean(const field& v)
{
    return v.array() - v.mean();
}

// Solves sum_j w_ij (psi_i - psi_j) = r by conjugate gradients; r and psi have zero mean
field solveGraph(const scene& s, const field& right, double tolerance)
{
    const matrix A = 0.5 * compactLaplacian(s);
    const field diagonal = A.diagonal();
    field psi = field::Zero(right.size()), r = withoutMean(right), z = r.cwiseQuotient(diagonal),
          p = z;
    double rz = r.dot(z);
    const double first = r.norm();
    for (int k = 0; k < 2000 && r.norm() > tolerance * first; ++k)
    {
        const field q = A * p;
        const double step = rz / p.dot(q);
        psi += step * p, r -= step * q;
        z = r.cwiseQuotient(diagonal);
        const double next = r.dot(z);
        p = z + next / rz * p, rz = next;
    }
    return withoutMean(psi);
}

}  // namespace

faceVectors::faceVectors(const scene& s, const faceOptions& o)
    : s_(s), B_(s.BAll), psi_(Eigen::MatrixXd::Zero(s.size(), 2))
{
    if (!o.closed) return;
    if (o.leastSquares > 0)
    {
        fit(o.leastSquares, o.iterations);
        close(o.tolerance);
        return;
    }
    for (int pass = 0; pass < o.passes; ++pass)
    {
        for (int k = 0; k < o.sweeps; ++k) sweep();
        close(o.tolerance);
    }
}

vec2 faceVectors::face(int i, const neighbour& q) const
{
    return q.w * (0.5 * (B_[i] + B_[q.j]) * q.r + (psi_.row(i) - psi_.row(q.j)).transpose());
}

vec2 faceVectors::opening(int i) const
{
    vec2 sum = s_.b(i);
    for (const neighbour& q : s_.fluid[i]) sum += face(i, q);
    return sum;
}

mat2 faceVectors::moment(int i) const
{
    mat2 sum = s_.T(i);
    for (const neighbour& q : s_.fluid[i]) sum += face(i, q) * q.r.transpose();
    return sum;
}

// B_i += (I - M_i) B_same,i
void faceVectors::sweep()
{
    std::vector<mat2> next(B_);
    for (int i = 0; i < s_.size(); ++i) next[i] += (mat2::Identity() - moment(i)) * s_.BFluid[i];
    B_ = next;
}

void faceVectors::close(double tolerance)
{
    Eigen::MatrixXd right(s_.size(), 2);
    for (int i = 0; i < s_.size(); ++i) right.row(i) = -opening(i).transpose();
    for (int c = 0; c < 2; ++c) psi_.col(c) += solveGraph(s_, right.col(c), tolerance);
}

// Finds psi and B together: the least sum_ij a_ij^2/w_ij with the closure; the moments are met as far as
// penalty |B - B_0|^2 allows.  Each component c of a has three unknowns per particle: psi_c and row c of B
void faceVectors::fit(double penalty, int iterations)
{
    const int n = s_.size();
    const auto flux = [](const field& z, int i, const neighbour& q) {
        const vec3 zi = z.segment<3>(3 * i), zj = z.segment<3>(3 * q.j);
        return q.w * (zi[0] - zj[0] + 0.5 * (zi + zj).tail<2>().dot(q.r));
    };
    const auto apply = [&](const field& z) {
        field sum(3 * n);
        for (int i = 0; i < n; ++i)
        {
            vec3 row(0, penalty * z[3 * i + 1], penalty * z[3 * i + 2]);
            for (const neighbour& q : s_.fluid[i])
                row += flux(z, i, q) * vec3(1, 0.5 * q.r[0], 0.5 * q.r[1]);
            sum.segment<3>(3 * i) = row;
        }
        return sum;
    };
    std::vector<mat3> inverse(n);
    for (int i = 0; i < n; ++i)
    {
        mat3 m = mat3::Zero();
        m.diagonal().tail<2>().setConstant(penalty);
        for (const neighbour& q : s_.fluid[i])
        {
            const vec3 v(1, 0.5 * q.r[0], 0.5 * q.r[1]);
            m += q.w * v * v.transpose();
        }
        inverse[i] = m.inverse();
    }
    const auto precondition = [&](const field& r) {
        field z(3 * n);
        for (int i = 0; i < n; ++i) z.segment<3>(3 * i) = inverse[i] * r.segment<3>(3 * i);
        return z;
    };
    for (int c = 0; c < 2; ++c)
    {
        field r(3 * n);
        for (int i = 0; i < n; ++i)
        {
            r[3 * i] = -opening(i)[c];
            r.segment<2>(3 * i + 1) = 0.5 * (mat2::Identity() - moment(i)).row(c).transpose();
        }
        field z = field::Zero(3 * n), y = precondition(r), p = y;
        double ry = r.dot(y);
        for (int k = 0; k < iterations; ++k)
        {
            const field q = apply(p);
            const double step = ry / p.dot(q);
            z += step * p, r -= step * q;
            y = precondition(r);
            const double next = r.dot(y);
            p = y + next / ry * p, ry = next;
        }
        for (int i = 0; i < n; ++i)
        {
            psi_(i, c) += z[3 * i];
            B_[i].row(c) += z.segment<2>(3 * i + 1).transpose();
        }
    }
}

double faceVectors::closure() const
{
    double sum = 0;
    for (int i = 0; i < s_.size(); ++i) sum += opening(i).squaredNorm();
    return s_.dx * std::sqrt(sum / s_.size());
}

double faceVectors::linear() const
{
    double sum = 0;
    for (int i = 0; i < s_.size(); ++i) sum += (moment(i) - mat2::Identity()).squaredNorm();
    return std::sqrt(sum / s_.size());
}

}  // namespace theory
