// SPDX-License-Identifier: GPL-3.0-or-later
#include "monolithicPreconditioner.H"
#include "pairViscosity.H"

#include "forPairs.H"
#include "matrixRows.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Part of an error of the fluid's velocity that the sweeps may leave
constexpr scalar leaves = 0.3;
// Share of C in the diagonal of the solid's S; C acts on rough pressures alone
constexpr scalar ofStabiliser = 0.2;

// Row i of L: sum_j -2 F_ij tau_ij (p_i - p_j).  Images count for their source, rigid neighbours are left out (dp/dn = 0).
// The row of a given pressure has its diagonal alone, and so has that of a particle without an equation for p
class laplacianRows : public matrixRows
{
public:
    explicit laplacianRows(const coupledSystem& system)
        : cloud_(system.fsi().cloud),
          list_(system.fsi().list),
          system_(system),
          rows_(system.rows()),
          tau_(system.tau()),
          free_(system.dt() / system.fsi().rho),
          diagonal_(cloud_.n())
    {
        forEach(0, size(), [&](label i) {
            scalar sum = 0;
            forEntries(i, [&](label, scalar a, bool) { sum += a; });
            diagonal_[i] = sum;
        });
        // rows without neighbours and rows of given pressure: any positive diagonal of the right size
        const scalar largest = *std::max_element(diagonal_.begin(), diagonal_.end());
        for (scalar& d : diagonal_)
            if (!(d > 0)) d = largest;
    }

    label size() const override { return cloud_.n(); }
    scalar diagonalOf(label i) const override { return diagonal_[i]; }
    label most(label i) const override
    {
        return cloud_.pHeld(i) ? 0 : label(list_.mid[i] - list_.own[i]);
    }
    label row(label i, std::int32_t* column, scalar* value) const override
    {
        label n = 0;
        forEntries(i, [&](label j, scalar a, bool same) {
            if (same && !cloud_.pHeld(j)) column[n] = j, value[n++] = -a;
        });
        return n;
    }

private:
    // entry(j, weight, same): same is true if i and j are both fluid or both solid
    template <class Entry>
    void forEntries(label i, const Entry& entry) const
    {
        if (cloud_.pHeld(i)) return;
        forNeighbours<among::connected>(list_, i, [&](pairIndex k, label neighbour) {
            const label j = cloud_.ownerOf(neighbour);
            if (j == i || !rows_.acts(i) || !rows_.acts(j)) return;
            const bool same = k < list_.mid[i];
            // a pair at the end of the kernel would tie the levels of two bodies by next to nothing
            if (same && !cloud_.isFluid(i) && !rows_.stabilises(k)) return;
            entry(j, -2 * list_.F[k] * (same ? free_ * mobility(i, j) : tauBeside(i, j)), same);
        });
    }
    // Mean of beta, (7.15)
    scalar mobility(label i, label j) const
    {
        return 0.5 * (system_.mobility(i) + system_.mobility(j));
    }
    // of a neighbour of the other phase: a solid yields little to the fluid, fluid gives way to a solid
    scalar tauBeside(label i, label j) const
    {
        return cloud_.isFluid(i) ? 2 * free_ * tau_[j] / (free_ + tau_[j]) : free_;
    }

    const particleCloud& cloud_;
    const neighbourList& list_;
    const coupledSystem& system_;
    const coupledRows& rows_;
    const List<scalar>& tau_;
    scalar free_;
    List<scalar> diagonal_;
};

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
    const pairViscosity viscosity(cloud);
    bulk_.resize(cloud.n());
    forEach(0, cloud.n(), [&](label i) { bulk_[i] = c.mu * viscosity.at(i); });
    if (c.structure) stiffen();
    if (system_.tangent())
        solid_.setup(*system_.tangent(), system_.dt(), system_.diagonal(), cloud,
                     c.kernel->support());

    chooseSweeps();
    const laplacianRows L(system_);
    List<vector> position(cloud.n());
    List<std::uint8_t> group(cloud.n());
    forEach(0, cloud.n(), [&](label i) {
        position[i] = cloud.x[i].xyz(), group[i] = std::uint8_t(cloud.phase[i]);
    });
    options_.cellSize = c.kernel->support();
    if (multigrid_) multigrid_->rebuild(L, position, group);
    else multigrid_ = std::make_unique<cellMultigrid>(L, position, options_, group);
}

// Beside a clamp few particles yield to the pressure, and S is small there.  The diagonal of S shows it, section 7.8
void monolithicPreconditioner::stiffen()
{
    const particleCloud& cloud = system_.fsi().cloud;
    List<scalar> S, C;
    system_.rows().solidDiagonals(system_.tau(), S, C);
    const auto [sum, nFree] = sumsOf(0, cloud.nSolid(), [&](label i) -> std::array<scalar, 2> {
        S[i] += ofStabiliser * C[i];
        if (cloud.uFixed[i]) return {};
        return {S[i], 1};
    });
    const scalar mean = sum / std::max<scalar>(nFree, 1);
    const structureModel& structure = *system_.fsi().structure;
    forEach(0, cloud.nSolid(), [&](label i) {
        const scalar modulus = beta_ * structure.shearModulus(i) * system_.dt();
        bulk_[i] = S[i] > 0 ? system_.fsi().mu + modulus * mean / S[i] : 0;
    });
}

// Eigenvalues of A_ii^-1 A lie in [least, 2 - least] in the fluid, by Gershgorin's circles: least is the smallest share of
// inertia and resistance in A_ii.  After m sweeps Chebyshev's
// iteration leaves 1/T_m(1/(1 - least)) of an error, section 7.8
void monolithicPreconditioner::chooseSweeps()
{
    const particleCloud& cloud = system_.fsi().cloud;
    sweeps_ = 1, leastEigenvalue_ = 1;
    if (cloud.n() == cloud.nSolid()) return;
    leastEigenvalue_ = 1 / largestOf(cloud.nSolid(), cloud.n(), [&](label i) {
                           return system_.diagonal()[i] / system_.inertia(i);
                       });
    const scalar reach = std::max(1 - leastEigenvalue_, 1e-9);
    sweeps_ = label(std::ceil(std::acosh(1 / leaves) / std::acosh(1 / reach)));
}

// u = A^-1 f for f/A_ii in u
void monolithicPreconditioner::solveMomentum(List<vec4>& u) const
{
    const particleCloud& cloud = system_.fsi().cloud;
    const label nSolid = cloud.nSolid(), nFluid = cloud.n() - nSolid;
    const List<scalar>& A = system_.diagonal();
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
                const simd4 Au = system_.inertia(i) * u[i].s + system_.viscousFactor() * work_[i].s;
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
            div_[i] = system_.rows().acts(i) ? div_[i] - r[4 * i + 3] / cloud.dx : 0;
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
    system_.outlets().precondition(phi_);
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
