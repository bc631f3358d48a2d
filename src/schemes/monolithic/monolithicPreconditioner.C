// SPDX-License-Identifier: GPL-3.0-or-later
#include "monolithicPreconditioner.H"

#include "execution.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Part of an error of the fluid's velocity that the sweeps may leave
constexpr scalar leaves = 0.3;

}  // namespace

monolithicPreconditioner::entries::entries(const dictionary& dict)
    : beta(dict.getInRangeOrDefault("beta", 0, 10, 1))
{
    // One V-cycle costs FGMRES least
    multigrid.cycle = "V", multigrid.omega = 1.2;
    multigrid.read(dict.subOrEmptyDict("multigrid"));
}

monolithicPreconditioner::monolithicPreconditioner(const coupledSystem& system, const entries& e)
    : system_(system), options_(e.multigrid), beta_(e.beta)
{
}

void monolithicPreconditioner::setup()
{
    const fsiCase& c = system_.fsi();
    const particleCloud& cloud = c.cloud;
    bulk_.assign(cloud.n(), c.mu);
    if (c.structure)
        for (label i = 0; i < cloud.nSolid(); ++i)
            bulk_[i] += beta_ * c.structure->shearModulus() * system_.dt();
    if (system_.tangent())
        solid_.setup(*system_.tangent(), system_.dt(), system_.diagonal(), cloud,
                     c.kernel->support());

    chooseSweeps();
    const csrMatrix L = laplacian();
    List<vector> position(cloud.n());
    List<std::uint8_t> group(cloud.n());
    for (label i = 0; i < cloud.n(); ++i)
        position[i] = cloud.x[i].xyz(), group[i] = std::uint8_t(cloud.phase[i]);
    options_.cellSize = c.kernel->support();
    if (multigrid_) multigrid_->rebuild(L, position, group);
    else multigrid_ = std::make_unique<cellMultigrid>(L, position, options_, group);
}

// Eigenvalues of A_ii^-1 A lie in [least, 2 - least] in the fluid, by Gershgorin's circles.  After m sweeps Chebyshev's
// iteration leaves 1/T_m(1/(1 - least)) of an error, section 7.8
void monolithicPreconditioner::chooseSweeps()
{
    const particleCloud& cloud = system_.fsi().cloud;
    const auto first = system_.diagonal().begin() + cloud.nSolid();
    const scalar largest = maxOf(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        return *std::max_element(first + begin, first + end);
    });
    leastEigenvalue_ = system_.fsi().rho * cloud.volume() / system_.dt() / largest;
    const scalar reach = std::max(1 - leastEigenvalue_, 1e-9);
    sweeps_ = label(std::ceil(std::acosh(1 / leaves) / std::acosh(1 / reach)));
}

csrMatrix monolithicPreconditioner::laplacian() const
{
    const fsiCase& c = system_.fsi();
    const particleCloud& cloud = c.cloud;
    const label n = cloud.n();
    const scalar free = system_.dt() / c.rho;
    // a neighbour of the other phase: a solid yields little to the fluid, fluid gives way to a solid
    const auto tauBeside = [&](label i, label j) {
        return cloud.isFluid(i) ? 2 * free * system_.tau()[j] / (free + system_.tau()[j]) : free;
    };

    // Row i: sum_j -2 F_ij tau_ij (p_i - p_j).  Images count for their source, rigid neighbours are left out
    // (dp/dn = 0).  The row of a given pressure has its diagonal alone
    const auto row = [&](label i, auto&& entry) {
        scalar d = 0;
        if (cloud.pHeld(i)) return d;
        forNeighbours<among::connected>(c.list, i, [&](pairIndex k, label neighbour) {
            const label j = cloud.ownerOf(neighbour);
            if (j == i) return;
            const bool same = k < c.list.mid[i];
            const scalar a = -2 * c.list.F[k] * (same ? free : tauBeside(i, j));
            d += a;
            if (same && !cloud.pHeld(j)) entry(j, -a);
        });
        return d;
    };
    csrMatrix L;
    L.rowStart.assign(n + 1, 0), L.diagonal.resize(n);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            L.diagonal[i] = row(i, [&](label, scalar) { ++L.rowStart[i + 1]; });
    });
    for (label i = 0; i < n; ++i) L.rowStart[i + 1] += L.rowStart[i];
    L.column.resize(L.rowStart[n]), L.value.resize(L.rowStart[n]);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            label k = L.rowStart[i];
            row(i, [&](label j, scalar a) { L.column[k] = j, L.value[k++] = a; });
        }
    });
    // rows without neighbours and rows of given pressure: any positive diagonal of the right size
    const scalar largest = *std::max_element(L.diagonal.begin(), L.diagonal.end());
    for (scalar& d : L.diagonal)
        if (!(d > 0)) d = largest;
    return L;
}

// u = A^-1 f for f/A_ii in u
void monolithicPreconditioner::solveMomentum(List<vec4>& u) const
{
    const particleCloud& cloud = system_.fsi().cloud;
    const label nSolid = cloud.nSolid(), nFluid = cloud.n() - nSolid;
    const List<scalar>& A = system_.diagonal();
    const scalar inertia = system_.fsi().rho * cloud.volume() / system_.dt();
    if (system_.tangent()) solid_.solve(A, cloud, u);

    const scalar reach = 1 - leastEigenvalue_;
    scalar omega = 2;
    f_.assign(u.begin() + nSolid, u.begin() + cloud.n());
    before_.assign(nFluid, vec4{});
    // the first sweep, from zero on, is u = f/A_ii
    for (label sweep = 1; sweep < sweeps_; ++sweep)
    {
        omega = 1 / (1 - 0.25 * reach * reach * omega);
        cloud.fillGhosts(u, true);
        system_.rows().viscous().apply(u, work_, nSolid);
        parallelFor(nFluid, [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                const label i = nSolid + k;
                const simd4 Au = inertia * u[i].s + system_.viscousFactor() * work_[i].s;
                const simd4 next = u[i].s + f_[k].s - Au / A[i];
                const simd4 improved = before_[k].s + omega * (next - before_[k].s);
                before_[k] = u[i];
                u[i].s = improved;
                u[i][3] = 0;
            }
        });
    }
}

void monolithicPreconditioner::apply(const List<scalar>& r, List<scalar>& z) const
{
    const particleCloud& cloud = system_.fsi().cloud;
    const label n = cloud.n();
    u_.resize(cloud.nAll());
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            u_[i].s = simd4{r[4 * i], r[4 * i + 1], r[4 * i + 2], 0};
    });
    solveMomentum(u_);
    cloud.fillGhosts(u_, true);
    system_.rows().divergence(u_, div_);
    b_.resize(n), s_.resize(n);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            div_[i] -= r[4 * i + 3] / cloud.dx;
            b_[i] = cloud.pHeld(i) ? 0 : -div_[i];
        }
    });
    multigrid_->apply(b_, s_);

    phi_.resize(cloud.nAll());
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const scalar p = s_[i] - bulk_[i] * div_[i];
            phi_[i].s = simd4{0, 0, 0, cloud.pHeld(i) ? r[4 * i + 3] : p};
        }
    });
    cloud.fillGhosts(phi_, true);
    system_.rows().gradient(phi_, du_);
    du_.resize(cloud.nAll());
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i) du_[i].s *= cloud.uFixed[i] ? 0 : system_.tau()[i];
    });
    solveMomentum(du_);
    z.resize(4 * n);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            for (int a = 0; a < 3; ++a) z[4 * i + a] = u_[i][a] - du_[i][a];
            z[4 * i + 3] = phi_[i][3];
        }
    });
}

}  // namespace ispf
