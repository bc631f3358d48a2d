// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupledRows.H"

namespace ispf
{

namespace
{

// The pairs of C
struct solidPairs
{
    const neighbourList& list;
    const List<scalar>&tau, &share;

    // r_ij F_ij of (7.23), and 0 for pairs that C has not: the solid does not go on between them, or one has no equation for p
    scalar weight(pairIndex k) const
    {
        if (!(tau[k] > 0)) return 0;
        return share.empty() ? list.F[k] : share[k] * list.F[k];
    }
};

// B_i of the solid's own gradient, over the pairs of C
void ownInverses(const particleCloud& cloud, const solidPairs& pairs, List<tensor>& B)
{
    const tensor start = vector(0, 0, cloud.nDims == 2 ? 1 : 0).asDiagonal();
    B.resize(cloud.nSolid());
    forEach(0, cloud.nSolid(), [&](label i) {
        tensor M = start;
        forNeighbours<among::same>(pairs.list, i, [&](pairIndex k, label j) {
            const vector d = cloud.x[i].xyz() - cloud.x[j].xyz();
            M -= pairs.weight(k) * d * d.transpose();
        });
        B[i] = kernelCorrection::inverse(M);
    });
}

// Writes the solid's own gradient of p to gs, for the stabiliser
void ownGradient(const particleCloud& cloud, const solidPairs& pairs, const List<tensor>& B,
                 List<vec4>& gs)
{
    forEach(0, cloud.nSolid(), [&](label i) {
        const simd4 g =
            sumNeighbours<among::same>(pairs.list, i, simd4{}, [&](pairIndex k, label j) {
                const scalar dp = gs[j].s[3] - gs[i].s[3];
                return (pairs.weight(k) * dp) * (cloud.x[i].s - cloud.x[j].s);
            });
        gs[i].setXyz(B[i] * vector(g[0], g[1], g[2]));
    });
}

ISPF_HOT void solidStabiliserRange(const neighbourList& list, const vec4* x, const scalar* tau,
                                   label begin, label end, const vec4* gs, scalar* cp)
{
    for (label i = begin; i < end; ++i)
    {
        const simd4 gi = gs[i].s, xi = x[i].s, three = {1, 1, 1, 0};
        const simd4 sum = sumNeighbours<among::same>(list, i, simd4{}, [&](pairIndex k, label j) {
            const simd4 gj = gs[j].s;
            const scalar f = list.F[k] * tau[k];
            // lanes 0-2: -F tau (g_i + g_j) . x_ij; lane 3: 2 F tau (p_i - p_j)
            const simd4 d = (x[j].s - xi) * three;
            const simd4 dp = {0, 0, 0, 2 * (gi[3] - gj[3])};
            return f * ((gi + gj) * d + dp);
        });
        cp[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
}

}  // namespace

void coupledRows::setup(particleCloud& cloud, const neighbourList& list, const kernelCorrection& B,
                        const smoothingKernel& kernel, const volumeConstraint* volume,
                        const solidSurface* surface)
{
    cloud_ = &cloud, list_ = &list, volume_ = volume, surface_ = surface;
    List<vec4> b;
    List<tensor> moment;
    if (surface) surface->shares(b, moment);
    pair_.setup(cloud, list, kernel, medium::fluid(cloud, list, B), b, moment);
    viscous_.setup({cloud, list, B});
}

void coupledRows::setTau(const List<scalar>& tau, scalar fluidTau, const List<scalar>& moduli,
                         const solidBodies* bodies)
{
    fluidTau_ = fluidTau;
    const label nSolid = cloud_->nSolid();
    if (nSolid == 0) return;
    pairTau_.resize(list_->start[nSolid]);
    pairShare_.resize(moduli.empty() ? 0 : pairTau_.size());
    forPairs<among::same>(*list_, 0, nSolid, [&](label i, pairIndex k, label j) {
        const label source = cloud_->ownerOf(j);
        const scalar a = tau[i], b = tau[source];
        const bool counts = acts(i) && acts(source) && bodies->between(i, j).one;
        pairTau_[k] = counts ? 2 * a * b / (a + b) : 0;
        if (moduli.empty()) return;
        const scalar G = moduli[i], H = moduli[source];
        pairShare_[k] = 4 * G * H / ((G + H) * (G + H));
        pairTau_[k] *= pairShare_[k];
    });
    ownInverses(*cloud_, {*list_, pairTau_, pairShare_}, ownB_);
}

void coupledRows::gradient(const List<vec4>& phi, List<vec4>& gp) const
{
    gp.resize(cloud_->n());
    pair_.gradient(phi, gp);
    solidGradient(phi, gp);
}

// gp of the solid's particles for phi = {.., p}: forces of the constraint's pressure and of the fluid's load, per volume
void coupledRows::solidGradient(const List<vec4>& phi, List<vec4>& gp) const
{
    if (!volume_) return;
    surface_->loads(phi, load_, stress_);
    volume_->addStress(phi, stress_);
    volume_->gradient().forces(stress_, force_);
    const scalar perVolume = 1 / cloud_->volume();
    forEach(0, cloud_->nSolid(),
            [&](label i) { gp[i] = vec4::from(perVolume * (load_[i].xyz() - force_[i].xyz())); });
}

void coupledRows::divergence(const List<vec4>& phi, List<scalar>& div) const
{
    div.resize(cloud_->n());
    pair_.divergence(phi, div);
    if (!volume_) return;
    volume_->rate(phi, rate_, dF_);
    forEach(0, cloud_->nSolid(), [&](label i) { div[i] = rate_[i]; });
    surface_->addFlux(phi, dF_, div);
}

void coupledRows::solidStabiliser(List<vec4>& gs, List<scalar>& cp) const
{
    cp.resize(cloud_->n());
    if (!volume_) return;
    ownGradient(*cloud_, {*list_, pairTau_, pairShare_}, ownB_, gs);
    cloud_->fillGradientGhosts(gs);
    parallelFor(cloud_->nSolid(), [&](label begin, label end) {
        solidStabiliserRange(*list_, cloud_->x.data(), pairTau_.data(), begin, end, gs.data(),
                             cp.data());
    });
}

void coupledRows::solidDiagonals(const List<scalar>& tau, List<scalar>& DG, List<scalar>& C) const
{
    volume_->diagonal(tau, DG);
    C.resize(DG.size());
    forEach(0, cloud_->nSolid(), [&](label i) {
        C[i] = sumNeighbours<among::same>(*list_, i, scalar(0), [&](pairIndex k, label) {
            return -2 * list_->F[k] * pairTau_[k];
        });
    });
}

void coupledRows::continuity(const List<vec4>& phi, List<vec4>& gs, List<scalar>& rows) const
{
    const label n = cloud_->n(), nSolid = cloud_->nSolid();
    m_.resize(n), direct_.resize(n);
    pair_.remainder(gs, m_, direct_);
    parallelFor(n, [&](label begin, label end) {
        const simd4 inSpace = {1, 1, 1, 0};
        for (label i = begin; i < end; ++i)
            m_[i].s = i < nSolid ? phi[i].s : (phi[i].s - fluidTau_ * m_[i].s) * inSpace;
    });
    cloud_->fillGhosts(m_, true);
    divergence(m_, rows);
    parallelFor(n - nSolid, [&](label begin, label end) {
        for (label i = nSolid + begin; i < nSolid + end; ++i) rows[i] += fluidTau_ * direct_[i];
    });
    if (!volume_) return;
    solidStabiliser(gs, direct_);
    forEach(0, nSolid, [&](label i) { rows[i] = acts(i) ? rows[i] - direct_[i] : 0; });
}

}  // namespace ispf
