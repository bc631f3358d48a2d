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
    const particleCloud& cloud;
    const scalar* c;  // laplacianScale

    ISPF_INLINE std::int64_t first(label i) const { return list.start[i]; }
    ISPF_INLINE std::int64_t mid(label i) const { return list.mid[i]; }
    ISPF_INLINE std::int64_t last(label i) const { return list.start[i + 1]; }
};

// What rigid particles add: their velocity is met on the wall, before them
ISPF_INLINE simd4 wallShare(const view& v, label i)
{
    simd4 sum = {};
    for (std::int64_t k = v.mid(i); k < v.last(i); ++k)
    {
        const label j = v.list.index[k];
        if (v.cloud.phase[j] == phaseType::rigid)
            sum += v.list.F[k] * (v.cloud.wallFactor(i, j) - 1) * (v.phi[j].s - v.phi[i].s);
    }
    return sum;
}

// What images count more or less than in continuity
ISPF_INLINE simd4 imageShare(const view& v, label i)
{
    simd4 sum = {};
    for (std::int64_t k = v.first(i); k < v.last(i); ++k)
        if (const label j = v.list.index[k]; j >= v.cloud.n() && v.cloud.ghostSource(j) >= 0)
            sum += (v.cloud.friction(i, j) * sphc::viscousF(v.cloud, v.list, k) - v.list.F[k]) *
                   (v.phi[j].s - v.phi[i].s);
    return sum;
}

ISPF_HOT void firstRange(const view& v, label begin, label end, vec4* gp, vec4* lap, vec4* gs)
{
    for (label i = begin; i < end; ++i)
    {
        pairSums sums;
        sums.add(v.list, v.x, v.phi, i, v.first(i), v.mid(i));
        const vector gradient = v.B.same[i] * sums.gradient(3);
        gs[i] = vec4::from(gradient, v.phi[i].s[3]);
        sums.add(v.list, v.x, v.phi, i, v.mid(i), v.last(i));
        gp[i] = vec4::from(gradient, sums.divergence(v.B.all[i]));
        lap[i].s = v.c[i] * (sums.lap + wallShare(v, i));
        if (v.cloud.weighsImages()) lap[i].s += v.c[i] * imageShare(v, i);
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

// Fluid alone.  D meets the same sums of tau G p in u = u* - tau G p: what is left for p is the symmetric
// Laplacian.  Beyond a wall p goes on linearly.
ISPF_HOT void secondFluidRange(const view& v, scalar tau, label begin, label end, const vec4* gs,
                               scalar* cp)
{
    for (label i = begin; i < end; ++i)
    {
        pairSums sums;
        sums.add(v.list, v.x, gs, i, v.first(i), v.mid(i));
        simd4 beyond = {};
        for (std::int64_t k = v.mid(i); k < v.last(i); ++k)
            beyond += v.list.F[k] * (v.x[i].s - v.x[v.list.index[k]].s);
        beyond *= gs[i].s;
        cp[i] = tau * (2 * (beyond[0] + beyond[1] + beyond[2] - sums.lap[3]) -
                       sums.divergence(v.B.all[i]));
    }
}

// Fluid alone: p goes on with the gradient g beyond the strip's end
ISPF_HOT void givenFluidRange(const view& v, scalar tau, label begin, label end, const vec4* g,
                              scalar* cp)
{
    for (label i = begin; i < end; ++i)
    {
        pairSums sums;
        sums.add(v.list, v.x, g, i, v.first(i), v.mid(i));
        simd4 here = {};
        for (std::int64_t k = v.first(i); k < v.mid(i); ++k)
            here += v.list.F[k] * (v.x[i].s - v.x[v.list.index[k]].s);
        here *= g[i].s;
        cp[i] = -tau * (2 * (here[0] + here[1] + here[2]) + sums.divergence(v.B.all[i]));
    }
}

ISPF_HOT void viscousRange(const view& v, label begin, label end, vec4* out)
{
    for (label i = begin; i < end; ++i)
    {
        simd4 sum = {};
        for (std::int64_t k = v.first(i); k < v.last(i); ++k)
            if (const label j = v.list.index[k]; v.cloud.ownerOf(j) >= 0)  // else zero
                sum += v.cloud.friction(i, j) * sphc::viscousF(v.cloud, v.list, k) * v.phi[j].s;
        out[i].s = v.c[i] * sum;
    }
}

ISPF_HOT void divergenceRange(const view& v, label begin, label end, scalar* div)
{
    for (label i = begin; i < end; ++i)
    {
        pairSums sums;
        sums.add(v.list, v.x, v.phi, i, v.first(i), v.last(i));
        div[i] = sums.divergence(v.B.all[i]);
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
        gp[i] = vec4::from(v.B.same[i] * vector(g[0], g[1], g[2]));
    }
}

}  // namespace

void monolithicRows::setup(const particleCloud& cloud, const neighbourList& list,
                           const kernelCorrection& B)
{
    cloud_ = &cloud, list_ = &list, B_ = &B;
    sumF_.resize(cloud.n());
    scale_ = sphc::laplacianScale({cloud, list, B});
    for (label i = 0; i < cloud.n(); ++i)
        if (cloud.pFixed[i]) scale_[i] = 1;  // a strip ends: its support is truncated
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            scalar sum = 0;
            for (std::int64_t k = list.start[i]; k < list.start[i + 1]; ++k)
                sum += cloud.friction(i, list.index[k]) * sphc::viscousF(cloud, list, k);
            sumF_[i] = scale_[i] * sum;
        }
    });
}

void monolithicRows::setSolid(const volumeConstraint* volume, const solidSurface* surface)
{
    volume_ = volume, surface_ = surface;
}

void monolithicRows::setTau(const List<scalar>& tau, scalar fluidTau)
{
    fluidTau_ = fluidTau;
    if (!volume_) return;
    pairTau_.resize(list_->index.size());
    parallelFor(cloud_->n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            for (std::int64_t k = list_->start[i]; k < list_->mid[i]; ++k)
            {
                const scalar a = tau[i], b = tau[cloud_->ownerOf(list_->index[k])];
                pairTau_[k] = 2 * a * b / (a + b);
            }
    });
}

// Rows of the solid: what the constraint's pressure and the fluid's load make of {.., p}
void monolithicRows::solidGradient(const List<vec4>& phi, List<vec4>& gp) const
{
    if (!volume_) return;
    surface_->loads(phi, load_, stress_);
    volume_->addStress(phi, stress_);
    volume_->gradient().forces(stress_, force_);
    const scalar perVolume = 1 / cloud_->volume();
    for (label i = 0; i < cloud_->nSolid(); ++i)
        gp[i] = vec4::from(perVolume * (load_[i].xyz() - force_[i].xyz()));
}

template <class Put>
void monolithicRows::solidDivergence(const List<vec4>& phi, Put&& put) const
{
    if (!volume_) return;
    volume_->rate(phi, rate_);
    for (label i = 0; i < cloud_->nSolid(); ++i) put(i, rate_[i]);
}

void monolithicRows::firstPass(const List<vec4>& phi, List<vec4>& gp, List<vec4>& lap,
                               List<vec4>& gs) const
{
    const label n = cloud_->n();
    gp.resize(n), lap.resize(n), gs.resize(cloud_->nAll());
    const view v{*list_, *B_, cloud_->x.data(), phi.data(), *cloud_, scale_.data()};
    parallelFor(n,
                [&](label b, label e) { firstRange(v, b, e, gp.data(), lap.data(), gs.data()); });
    solidGradient(phi, gp);
    solidDivergence(phi, [&](label i, scalar div) { gp[i][3] = div; });
}

void monolithicRows::secondPass(const List<vec4>& gs, List<scalar>& cp) const
{
    cp.resize(cloud_->n());
    const view v{*list_, *B_, cloud_->x.data(), gs.data(), *cloud_, scale_.data()};
    parallelFor(cloud_->n(), [&](label b, label e) {
        if (volume_) secondRange(v, pairTau_.data(), b, e, gs.data(), cp.data());
        else secondFluidRange(v, fluidTau_, b, e, gs.data(), cp.data());
    });
}

void monolithicRows::givenPart(const List<vec4>& g, List<scalar>& cp) const
{
    if (volume_) return secondPass(g, cp);
    cp.resize(cloud_->n());
    const view v{*list_, *B_, cloud_->x.data(), g.data(), *cloud_, scale_.data()};
    parallelFor(cloud_->n(), [&](label b, label e) {
        givenFluidRange(v, fluidTau_, b, e, g.data(), cp.data());
    });
}

void monolithicRows::viscousNeighbours(const List<vec4>& phi, List<vec4>& sum) const
{
    sum.resize(cloud_->n());
    const view v{*list_, *B_, cloud_->x.data(), phi.data(), *cloud_, scale_.data()};
    parallelFor(cloud_->n(), [&](label b, label e) { viscousRange(v, b, e, sum.data()); });
}

void monolithicRows::divergence(const List<vec4>& phi, List<scalar>& div) const
{
    div.resize(cloud_->n());
    const view v{*list_, *B_, cloud_->x.data(), phi.data(), *cloud_, scale_.data()};
    parallelFor(cloud_->n(), [&](label b, label e) { divergenceRange(v, b, e, div.data()); });
    solidDivergence(phi, [&](label i, scalar d) { div[i] = d; });
}

void monolithicRows::pressureGradient(const List<vec4>& phi, List<vec4>& gp) const
{
    gp.resize(cloud_->n());
    const view v{*list_, *B_, cloud_->x.data(), phi.data(), *cloud_, scale_.data()};
    parallelFor(cloud_->n(), [&](label b, label e) { gradientRange(v, b, e, gp.data()); });
    solidGradient(phi, gp);
}

}  // namespace ispf
