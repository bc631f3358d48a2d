// SPDX-License-Identifier: GPL-3.0-or-later
#include "largestEigenvalue.H"
#include "execution.H"

namespace ispf
{

namespace
{

scalar product(const List<vec4>& a, const List<vec4>& b)
{
    return parallelSum(label(a.size()), [&](label begin, label end) {
        scalar sum = 0;
        for (label i = begin; i < end; ++i)
        {
            const simd4 c = a[i].s * b[i].s;
            sum += c[0] + c[1] + c[2];
        }
        return sum;
    });
}

}  // namespace

scalar largestEigenvalue(const blockMatrix3& K, int products)
{
    const label n = K.size();
    List<vec4> v(n), before(n, vec4{}), Kv(n);
    for (label i = 0; i < n; ++i)
        v[i].s =
            simd4{std::sin(12.9898 * i), std::sin(78.233 * i + 1), std::sin(37.719 * i + 2), 0};
    scalar beta = std::sqrt(product(v, v));
    for (vec4& a : v) a.s /= beta;
    List<scalar> diagonal, beside;
    beta = 0;
    for (int step = 0; step < std::min(products, 3 * n); ++step)
    {
        K.apply(v, Kv);
        const scalar alpha = product(v, Kv);
        for (label i = 0; i < n; ++i) Kv[i].s -= alpha * v[i].s + beta * before[i].s;
        diagonal.push_back(alpha);
        beta = std::sqrt(product(Kv, Kv));
        // the subspace is invariant: it contains the eigenvalue
        if (!(beta > 1e-12 * alpha)) break;
        beside.push_back(beta);
        for (label i = 0; i < n; ++i) before[i] = v[i], v[i].s = Kv[i].s / beta;
    }
    const Eigen::Index m = Eigen::Index(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> T;
    T.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), m),
                             Eigen::Map<Eigen::VectorXd>(beside.data(), m - 1),
                             Eigen::EigenvaluesOnly);
    return T.eigenvalues().maxCoeff();
}

}  // namespace ispf
