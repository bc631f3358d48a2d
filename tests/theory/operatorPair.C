// SPDX-License-Identifier: GPL-3.0-or-later
#include "operatorPair.H"

namespace theory
{

namespace
{

perAxis zeros(int rows, int columns)
{
    return {matrix(rows, columns), matrix(rows, columns)};
}

// Adds the entries of sum_j c (q_j - q_i), with a vector c
void addDifference(std::array<entries, 2>& e, int i, int j, const vec2& c)
{
    for (int axis = 0; axis < 2; ++axis)
        e[axis].push_back({i, j, c[axis]}), e[axis].push_back({i, i, -c[axis]});
}

operatorPair empty(const scene& s)
{
    const int n = s.size(), facets = int(s.facets.size()), others = int(s.others.size());
    return {zeros(n, n),      zeros(n, n),      zeros(n, facets),
            zeros(n, others), zeros(facets, n), zeros(others, n)};
}

// D over all neighbours
void correctedDivergence(const scene& s, operatorPair& pair)
{
    std::array<entries, 2> D, others;
    for (int i = 0; i < s.size(); ++i)
    {
        for (const neighbour& q : s.fluid[i]) addDifference(D, i, q.j, s.BAll[i] * (q.w * q.r));
        for (const neighbour& q : s.beside[i])
        {
            const vec2 c = s.BAll[i] * (q.w * q.r);
            for (int axis = 0; axis < 2; ++axis)
            {
                D[axis].push_back({i, i, -c[axis]});
                others[axis].push_back({i, q.j, c[axis]});
            }
        }
    }
    for (int axis = 0; axis < 2; ++axis)
    {
        pair.D[axis] = fromEntries(s.size(), s.size(), D[axis]);
        pair.DOthers[axis] = fromEntries(s.size(), int(s.others.size()), others[axis]);
    }
}

}  // namespace

field operatorPair::divergence(const field& u, const field& v, const motion& m) const
{
    field sum = D[0] * u + D[1] * v;
    for (int axis = 0; axis < 2; ++axis)
    {
        for (int k = 0; k < DFacets[axis].cols(); ++k)
            sum += DFacets[axis].col(k) * m.facets[k][axis];
        for (int k = 0; k < DOthers[axis].cols(); ++k)
            sum += DOthers[axis].col(k) * m.others[k][axis];
    }
    return sum;
}

matrix operatorPair::GtG() const
{
    return matrix(G[0].transpose()) * G[0] + matrix(G[1].transpose()) * G[1];
}

operatorPair oneSidedPair(const scene& s)
{
    operatorPair pair = empty(s);
    correctedDivergence(s, pair);
    std::array<entries, 2> G, load;
    for (int i = 0; i < s.size(); ++i)
    {
        for (const neighbour& q : s.fluid[i]) addDifference(G, i, q.j, s.BFluid[i] * (q.w * q.r));
        for (const share& f : s.shares[i])
            for (int axis = 0; axis < 2; ++axis)
                load[axis].push_back({f.k, i, f.weight * s.facets[f.k].S[axis]});
    }
    for (int axis = 0; axis < 2; ++axis)
    {
        pair.G[axis] = fromEntries(s.size(), s.size(), G[axis]);
        pair.onFacets[axis] = fromEntries(int(s.facets.size()), s.size(), load[axis]);
    }
    return pair;
}

operatorPair plainAdjoint(const scene& s)
{
    operatorPair pair = empty(s);
    correctedDivergence(s, pair);
    for (int axis = 0; axis < 2; ++axis)
    {
        pair.G[axis] = -matrix(pair.D[axis].transpose());
        pair.onOthers[axis] = s.V * matrix(pair.DOthers[axis].transpose());
    }
    return pair;
}

// G p_i = sum a_ij (p_j - p_i) + sum_k w_ki S_k (p at the wall - p_i)/V, and its transpose D.  The force on
// facet k is S_k times the mean of p at the wall; the facet's velocity enters D with the same weights
operatorPair faceVectors::pair(bool linearAtWall) const
{
    const scene& s = s_;
    operatorPair pair = empty(s);
    std::array<entries, 2> G, load;
    for (int i = 0; i < s.size(); ++i)
    {
        for (const neighbour& q : s.fluid[i]) addDifference(G, i, q.j, face(i, q));
        for (const share& f : s.shares[i])
        {
            const vec2 S = f.weight * s.facets[f.k].S;
            for (int axis = 0; axis < 2; ++axis) load[axis].push_back({f.k, i, S[axis]});
            if (!linearAtWall) continue;
            for (const neighbour& q : s.fluid[i])
            {
                const double slope = f.r.dot(s.BFluid[i] * (q.w * q.r));
                addDifference(G, i, q.j, S * slope / s.V);
                for (int axis = 0; axis < 2; ++axis)
                {
                    load[axis].push_back({f.k, q.j, S[axis] * slope});
                    load[axis].push_back({f.k, i, -S[axis] * slope});
                }
            }
        }
    }
    for (int axis = 0; axis < 2; ++axis)
    {
        pair.G[axis] = fromEntries(s.size(), s.size(), G[axis]);
        pair.D[axis] = -matrix(pair.G[axis].transpose());
        pair.onFacets[axis] = fromEntries(int(s.facets.size()), s.size(), load[axis]);
        pair.DFacets[axis] = matrix(pair.onFacets[axis].transpose()) / s.V;
    }
    return pair;
}

matrix compactLaplacian(const scene& s)
{
    entries e;
    for (int i = 0; i < s.size(); ++i)
        for (const neighbour& q : s.fluid[i])
            e.push_back({i, q.j, -2 * q.w}), e.push_back({i, i, 2 * q.w});
    return fromEntries(s.size(), s.size(), e);
}

}  // namespace theory
