// SPDX-License-Identifier: GPL-3.0-or-later
#include "projectionViscosity.H"

#include "worstRow.H"

#include "PBiCGStab.H"
#include "PCG.H"

namespace ispf
{

namespace
{

List<vec4> unpacked(const List<scalar>& x)
{
    List<vec4> u(x.size() / 4);
    forEach(0, label(u.size()), [&](label i) {
        u[i].s = simd4{x[4 * i], x[4 * i + 1], x[4 * i + 2], 0};
    });
    return u;
}

// Unknowns {u, v, w, 0} per particle.  Prescribed velocities have identity rows and enter the products as zero
class viscousOperator : public linearOperator
{
public:
    viscousOperator(const particleCloud& cloud, const projectionViscosity::laplacian& lap,
                    scalar dtNu)
        : cloud_(cloud), laplacian_(lap), dtNu_(dtNu)
    {
    }
    label size() const override { return 4 * cloud_.n(); }

    void apply(const List<scalar>& x, List<scalar>& y) const override
    {
        u_ = unpacked(x);
        forEach(0, cloud_.n(), [&](label i) {
            if (cloud_.uFixed[i]) u_[i] = vec4{};
        });
        cloud_.fillGhosts(u_, true);
        laplacian_.of(u_, lap_);
        parallelFor(cloud_.n(), [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                const bool solved = !cloud_.uFixed[i];
                const scalar own = solved ? laplacian_.own(i) : 1;
                for (int c = 0; c < 4; ++c)
                    y[4 * i + c] = own * x[4 * i + c] - (c < 3 && solved ? dtNu_ * lap_[i][c] : 0);
            }
        });
    }

private:
    const particleCloud& cloud_;
    const projectionViscosity::laplacian& laplacian_;
    scalar dtNu_;
    mutable List<vec4> u_, lap_;
};

class viscousDiagonal : public preconditioner
{
public:
    viscousDiagonal(const particleCloud& cloud, const projectionViscosity::laplacian& lap,
                    scalar dtNu)
        : inverse_(cloud.n())
    {
        for (label i = 0; i < cloud.n(); ++i)
            inverse_[i] = cloud.uFixed[i] ? 1 : 1 / (lap.own(i) - dtNu * lap.diagonal[i]);
    }
    void apply(const List<scalar>& r, List<scalar>& z) const override
    {
        forEach(0, label(r.size()), [&](label k) { z[k] = inverse_[k / 4] * r[k]; });
    }
    word name() const override { return "diagonal"; }

private:
    List<scalar> inverse_;
};

}  // namespace

projectionViscosity::projectionViscosity(const dictionary& solverU)
{
    const word method = solverU.chooseOrDefault("solver", {"PCG", "PBiCGStab"}, "PCG");
    solverControls controls;
    controls.tolerance = 1e-8;
    controls = solverControls::fromDict(solverU, controls);
    if (method == "PCG") solver_ = std::make_unique<PCG>(controls, "U");
    else solver_ = std::make_unique<PBiCGStab>(controls, "U");
}

void projectionViscosity::solve(particleCloud& cloud, const laplacian& lap, const List<vec4>& added,
                                scalar dtNu)
{
    const label n = cloud.n();
    // contribution of walls and images through their offsets, and of prescribed velocities
    List<vec4> given(n);
    for (label i = 0; i < n; ++i)
        if (cloud.uFixed[i]) given[i] = vec4::from(cloud.Up[i].xyz());
    cloud.fillGhosts(given, false);
    List<vec4> fromGiven;
    lap.of(given, fromGiven);

    List<scalar> b(4 * n, 0), x(4 * n, 0);
    for (label i = 0; i < n; ++i)
    {
        if (cloud.uFixed[i]) continue;
        for (int c = 0; c < 3; ++c)
        {
            x[4 * i + c] = cloud.Up[i][c];
            b[4 * i + c] = cloud.Up[i][c] + added[i][c] + dtNu * fromGiven[i][c];
        }
    }
    const viscousOperator rows(cloud, lap, dtNu);
    const solverPerformance result = solver_->solve(rows, viscousDiagonal(cloud, lap, dtNu), b, x);
    result.print();
    if (!result.converged && !(result.finalResidual < 1e-3))
        throw notConverged(
            "The viscous predictor did not converge, worst at " +
            cloud.describe(worstRow(rows, b, x) / 4) + ": " + result.line() +
            ". Take solver PBiCGStab in solvers.U of system/sphSolution, or a smaller deltaT, and "
            "see whether a load or a motion jumps; the last written time is intact");
    for (label i = 0; i < n; ++i)
        if (!cloud.uFixed[i]) cloud.Up[i].setXyz({x[4 * i], x[4 * i + 1], x[4 * i + 2]});
}

}  // namespace ispf
