// SPDX-License-Identifier: GPL-3.0-or-later
#include "monolithicRows.H"

namespace ispf
{

namespace
{

// Raw views for the hot loops
struct view
{
    const neighbourList& list;
    const kernelCorrection& B;
    const vec4* x;
    const vec4* phi;
    label nSolid;
    const std::int64_t* loadStart;
    const vec4* load;

    ISPF_INLINE std::int64_t first(label i) const { return list.start[i]; }
    ISPF_INLINE std::int64_t mid(label i) const { return list.mid[i]; }
    ISPF_INLINE std::int64_t last(label i) const { return list.start[i + 1]; }
};

view viewOf(const particleCloud& cloud, const neighbourList& list, const kernelCorrection& B,
            const List<vec4>& phi, const List<std::int64_t>& loadStart, const List<vec4>& load)
{
    return {list, B, cloud.x.data(), phi.data(), cloud.nSolid(), loadStart.data(), load.data()};
}

// Momentum gradient of p from the same-phase sums: the fluid's is corrected, the solid's carries the load
ISPF_INLINE vector momentumGradient(const view& v, label i, const vector& raw,
                                    const vector& corrected)
{
    if (i >= v.nSolid) return corrected;
    simd4 load = {};
    const vec4* c = v.load + v.loadStart[i];
    const scalar pi = v.phi[i].s[3];
    for (std::int64_t k = v.mid(i); k < v.last(i); ++k, ++c)
        load += (v.phi[v.list.index[k]].s[3] - pi) * c->s;
    return raw + vector(load[0], load[1], load[2]);
}

ISPF_HOT void firstRange(const view& v, label begin, label end, vec4* gp, vec4* lap, vec4* gs)
{
    for (label i = begin; i < end; ++i)
    {
        pairSums sums;
        sums.add(v.list, v.x, v.phi, i, v.first(i), v.mid(i));
        const vector raw = sums.gradient(3), corrected = v.B.same[i] * raw;
        const scalar solidDivergence = sums.divergence(v.B.same[i]);
        gs[i] = vec4::from(corrected, v.phi[i].s[3]);
        sums.add(v.list, v.x, v.phi, i, v.mid(i), v.last(i));
        gp[i] = vec4::from(momentumGradient(v, i, raw, corrected),
                           i < v.nSolid ? solidDivergence : sums.divergence(v.B.all[i]));
        lap[i].s = sums.lap;
    }
}

ISPF_HOT void secondRange(const view& v, const scalar* tau, label begin, label end, const vec4* gs,
                          scalar* cp)
{
    for (label i = begin; i < end; ++i)
    {
        const simd4 gi = gs[i].s, xi = v.x[i].s, three = {1, 1, 1, 0};
        simd4 sum = {};
        for (std::int64_t k = v.first(i); k < v.mid(i); ++k)
        {
            const label j = v.list.index[k];
            const simd4 gj = gs[j].s;
            const scalar f = v.list.F[k] * tau[k];
            // lanes 0-2: -F tau (g_i + g_j) . x_ij; lane 3: 2 F tau (p_i - p_j)
            const simd4 d = (v.x[j].s - xi) * three;
            const simd4 dp = {0, 0, 0, 2 * (gi[3] - gj[3])};
            sum += f * ((gi + gj) * d + dp);
        }
        cp[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
}

ISPF_HOT void viscousRange(const view& v, label begin, label end, vec4* out)
{
    for (label i = begin; i < end; ++i)
    {
        simd4 sum = {};
        for (std::int64_t k = v.first(i); k < v.last(i); ++k)
            sum += v.list.F[k] * v.phi[v.list.index[k]].s;
        out[i].s = sum;
    }
}

ISPF_HOT void divergenceRange(const view& v, label begin, label end, scalar* div)
{
    for (label i = begin; i < end; ++i)
    {
        pairSums sums;
        const bool solid = i < v.nSolid;
        sums.add(v.list, v.x, v.phi, i, v.first(i), solid ? v.mid(i) : v.last(i));
        div[i] = sums.divergence(solid ? v.B.same[i] : v.B.all[i]);
    }
}

ISPF_HOT void gradientRange(const view& v, label begin, label end, vec4* gp)
{
    for (label i = begin; i < end; ++i)
    {
        const simd4 xi = v.x[i].s;
        const scalar pi = v.phi[i].s[3];
        simd4 g = {};
        for (std::int64_t k = v.first(i); k < v.mid(i); ++k)
        {
            const label j = v.list.index[k];
            g += (v.list.F[k] * (v.phi[j].s[3] - pi)) * (xi - v.x[j].s);
        }
        const vector raw(g[0], g[1], g[2]);
        gp[i] = vec4::from(momentumGradient(v, i, raw, v.B.same[i] * raw));
    }
}

}  // namespace

void monolithicRows::setup(const particleCloud& cloud, const neighbourList& list,
                           const kernelCorrection& B)
{
    cloud_ = &cloud, list_ = &list, B_ = &B;
    sumF_.resize(cloud.n());
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            scalar sum = 0;
            for (std::int64_t k = list.start[i]; k < list.start[i + 1]; ++k) sum += list.F[k];
            sumF_[i] = sum;
        }
    });
}

void monolithicRows::setLoads(List<std::int64_t> start, List<vec4> c)
{
    loadStart_ = std::move(start), load_ = std::move(c);
}

void monolithicRows::setTau(const List<scalar>& tau)
{
    pairTau_.resize(list_->index.size());
    const auto tauOf = [&](label j) {
        if (j < cloud_->n()) return tau[j];
        return tau[cloud_->ghostSource(j)];
    };
    parallelFor(cloud_->n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            for (std::int64_t k = list_->start[i]; k < list_->mid[i]; ++k)
            {
                const scalar a = tau[i], b = tauOf(list_->index[k]);
                pairTau_[k] = 2 * a * b / (a + b);
            }
    });
}

void monolithicRows::firstPass(const List<vec4>& phi, List<vec4>& gp, List<vec4>& lap,
                               List<vec4>& gs) const
{
    const label n = cloud_->n();
    gp.resize(n), lap.resize(n), gs.resize(cloud_->nAll());
    const view v = viewOf(*cloud_, *list_, *B_, phi, loadStart_, load_);
    parallelFor(n,
                [&](label b, label e) { firstRange(v, b, e, gp.data(), lap.data(), gs.data()); });
}

void monolithicRows::secondPass(const List<vec4>& gs, List<scalar>& cp) const
{
    cp.resize(cloud_->n());
    const view v = viewOf(*cloud_, *list_, *B_, gs, loadStart_, load_);
    parallelFor(cloud_->n(), [&](label b, label e) {
        secondRange(v, pairTau_.data(), b, e, gs.data(), cp.data());
    });
}

void monolithicRows::viscousNeighbours(const List<vec4>& phi, List<vec4>& sum) const
{
    sum.resize(cloud_->n());
    const view v = viewOf(*cloud_, *list_, *B_, phi, loadStart_, load_);
    parallelFor(cloud_->n(), [&](label b, label e) { viscousRange(v, b, e, sum.data()); });
}

void monolithicRows::divergence(const List<vec4>& phi, List<scalar>& div) const
{
    div.resize(cloud_->n());
    const view v = viewOf(*cloud_, *list_, *B_, phi, loadStart_, load_);
    parallelFor(cloud_->n(), [&](label b, label e) { divergenceRange(v, b, e, div.data()); });
}

void monolithicRows::pressureGradient(const List<vec4>& phi, List<vec4>& gp) const
{
    gp.resize(cloud_->n());
    const view v = viewOf(*cloud_, *list_, *B_, phi, loadStart_, load_);
    parallelFor(cloud_->n(), [&](label b, label e) { gradientRange(v, b, e, gp.data()); });
}

}  // namespace ispf
