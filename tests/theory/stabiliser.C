// SPDX-License-Identifier: GPL-3.0-or-later
#include "stabiliser.H"

namespace theory
{

namespace
{

// s_i, the largest eigenvalue of sum_j c c^T/w_ij: |G p|_i^2 <= s_i sum_j w_ij (p_j - p_i)^2 (Cauchy-Schwarz)
field steepness(const scene& s, const operatorPair& pair)
{
    field steep(s.size());
    const Eigen::SparseMatrix<double, Eigen::RowMajor> x = pair.G[0], y = pair.G[1];
    for (int i = 0; i < s.size(); ++i)
    {
        mat2 sum = mat2::Zero();
        for (const neighbour& q : s.fluid[i])
        {
            const vec2 c(x.coeff(i, q.j), y.coeff(i, q.j));
            sum += c * c.transpose() / q.w;
        }
        steep[i] = Eigen::SelfAdjointEigenSolver<mat2>(sum).eigenvalues()[1];
    }
    return steep;
}

matrix boundedLaplacian(const scene& s, const operatorPair& pair)
{
    const field steep = steepness(s, pair);
    entries e;
    for (int i = 0; i < s.size(); ++i)
        for (const neighbour& q : s.fluid[i])
        {
            const double c = 2 * q.w * std::max({1.0, steep[i], steep[q.j]});
            e.push_back({i, q.j, -c}), e.push_back({i, i, c});
        }
    return fromEntries(s.size(), s.size(), e);
}

// Counts every pair once, so that its weight is 2 w_ij
matrix remainderSquared(const scene& s, const operatorPair& pair)
{
    int pairs = 0;
    entries difference, way[2], weight;
    for (int i = 0; i < s.size(); ++i)
        for (const neighbour& q : s.fluid[i])
        {
            if (q.j < i) continue;
            difference.push_back({pairs, i, 1}), difference.push_back({pairs, q.j, -1});
            for (int axis = 0; axis < 2; ++axis)
                for (const int at : {i, q.j}) way[axis].push_back({pairs, at, 0.5 * q.r[axis]});
            weight.push_back({pairs, pairs, 2 * q.w});
            ++pairs;
        }
    matrix J = fromEntries(pairs, s.size(), difference);
    for (int axis = 0; axis < 2; ++axis)
        J += fromEntries(pairs, s.size(), way[axis]) * pair.G[axis];
    return matrix(J.transpose()) * (fromEntries(pairs, pairs, weight) * J);
}

}  // namespace

std::string name(stabiliser c)
{
    const char* names[] = {"classic", "bounded", "half", "remainder", "quarter"};
    return names[int(c)];
}

matrix pressureOperator(const scene& s, const operatorPair& pair, stabiliser c)
{
    switch (c)
    {
        case stabiliser::bounded:
            return boundedLaplacian(s, pair);
        case stabiliser::half:
            return 0.5 * (compactLaplacian(s) + pair.GtG());
        case stabiliser::remainder:
            return pair.GtG() + remainderSquared(s, pair);
        case stabiliser::quarter:
            return pair.GtG() + 0.25 * remainderSquared(s, pair);
        default:
            return compactLaplacian(s);
    }
}

}  // namespace theory
