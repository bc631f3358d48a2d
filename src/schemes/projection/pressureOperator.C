// SPDX-License-Identifier: GPL-3.0-or-later
#include "pressureOperator.H"

namespace ispf
{

void pressureOperator::setup(const particleCloud& cloud, const adjointPair& pair,
                             const csrMatrix& compact, const List<scalar>& mobility)
{
    cloud_ = &cloud, pair_ = &pair, compact_ = &compact, mobility_ = &mobility;
    phi_.assign(cloud.nAll(), vec4{}), g_.assign(cloud.nAll(), vec4{});
    m_.assign(cloud.nAll(), vec4{}), direct_.assign(cloud.n(), 0);
}

void pressureOperator::gradient(const List<scalar>& p, List<vec4>& g) const
{
    const particleCloud& cloud = *cloud_;
    phi_.resize(cloud.nAll()), g.resize(cloud.nAll());
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) phi_[i].s = simd4{0, 0, 0, p[i]};
    });
    cloud.fillGradientGhosts(phi_);
    pair_->gradient(phi_, g);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) g[i][3] = p[i];
    });
    cloud.fillGradientGhosts(g);
}

void pressureOperator::rows(List<scalar>& y) const
{
    const particleCloud& cloud = *cloud_;
    pair_->remainder(g_, m_, direct_);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const scalar yields = mobility_->empty() ? 1 : (*mobility_)[i];
            if (!cloud.uFixed[i]) m_[i].s += g_[i].s * simd4{yields, yields, yields, 0};
        }
    });
    cloud.fillGradientGhosts(m_);
    pair_->divergence(m_, y);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i) y[i] = direct_[i] - y[i];
    });
}

void pressureOperator::apply(const List<scalar>& p, List<scalar>& y) const
{
    const particleCloud& cloud = *cloud_;
    List<scalar> q(p);
    forEach(0, cloud.n(), [&](label i) {
        if (cloud.pHeld(i)) q[i] = 0;
    });
    gradient(q, g_);
    rows(y);
    forEach(0, cloud.n(), [&](label i) {
        if (cloud.pHeld(i)) y[i] = compact_->diagonal[i] * p[i];
    });
}

void pressureOperator::rightHandSide(const List<scalar>& f, scalar level, List<scalar>& b) const
{
    const particleCloud& cloud = *cloud_;
    const label n = cloud.n();
    List<scalar> given(n, 0);
    bool any = false;
    for (label i = 0; i < n; ++i)
        if (cloud.pHeld(i)) given[i] = cloud.heldPressure(i) - level, any = any || given[i] != 0;
    b.assign(n, 0);
    if (any)
    {
        gradient(given, g_);
        rows(b);
    }
    for (label i = 0; i < n; ++i)
        b[i] = cloud.pHeld(i) ? compact_->diagonal[i] * given[i] : f[i] - b[i];
}

}  // namespace ispf
