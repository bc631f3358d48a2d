// SPDX-License-Identifier: GPL-3.0-or-later
#include "projectionViscosity.H"

#include "PBiCGStab.H"
#include "PCG.H"

namespace ispf
{

namespace
{

List<vec4> unpacked(const List<scalar>& x)
{
    List<vec4> u(x.size() / 4);
    for (size_t i = 0; i < u.size(); ++i) u[i].s = simd4{x[4 * i], x[4 * i + 1], x[4 * i + 2], 0};
    return u;
}

// Unknowns {u, v, w, 0} per particle; prescribed velocities have identity rows and enter as zero
class viscousOperator : public linearOperator
{
public:
    viscousOperator(const stencil& s, const List<scalar>& scale, scalar dtNu)
        : s_(s), scale_(scale), dtNu_(dtNu)
    {
    }
    label size() const override { return 4 * s_.cloud.n(); }

    void apply(const List<scalar>& x, List<scalar>& y) const override
    {
        List<vec4> u = unpacked(x);
        s_.cloud.fillGhosts(u, true);
        const List<vec4> lap = sphc::laplacian(s_, u, scale_);
        parallelFor(s_.cloud.n(), [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                for (int c = 0; c < 4; ++c)
                    y[4 * i + c] =
                        x[4 * i + c] - (c < 3 && !s_.cloud.uFixed[i] ? dtNu_ * lap[i][c] : 0);
        });
    }

private:
    const stencil& s_;
    const List<scalar>& scale_;
    scalar dtNu_;
};

class viscousDiagonal : public preconditioner
{
public:
    viscousDiagonal(const stencil& s, scalar dtNu) : inverse_(s.cloud.n())
    {
        parallelFor(s.cloud.n(), [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                scalar sum = 0;
                for (auto k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
                    sum +=
                        s.cloud.friction(i, s.list.index[k]) * sphc::viscousF(s.cloud, s.list, k);
                inverse_[i] = s.cloud.uFixed[i] ? 1 : 1 / (1 - 2 * dtNu * sum);
            }
        });
    }
    void apply(const List<scalar>& r, List<scalar>& z) const override
    {
        for (size_t k = 0; k < r.size(); ++k) z[k] = inverse_[k / 4] * r[k];
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
    controls.tolerance = 1e-8, controls.maxIter = 200;
    if (!solverU.empty()) controls = solverControls::fromDict(solverU);
    if (method == "PCG") solver_ = std::make_unique<PCG>(controls, "U");
    else solver_ = std::make_unique<PBiCGStab>(controls, "U");
}

void projectionViscosity::solve(particleCloud& cloud, const stencil& s, const List<vec4>& dtA,
                                const List<vec4>& atWalls, scalar dtNu)
{
    const label n = cloud.n();
    // what walls and images bring by their offsets, and what prescribed velocities bring
    List<vec4> given(n);
    for (label i = 0; i < n; ++i)
        if (cloud.uFixed[i]) given[i] = vec4::from(cloud.Up[i].xyz());
    cloud.fillGhosts(given, false);
    const List<scalar> scale = sphc::laplacianScale(s);
    const List<vec4> fromGiven = sphc::laplacian(s, given, scale),
                     fromWalls = sphc::laplacianAtWalls(s, atWalls, scale);

    List<scalar> b(4 * n, 0), x(4 * n, 0);
    for (label i = 0; i < n; ++i)
    {
        if (cloud.uFixed[i]) continue;
        for (int c = 0; c < 3; ++c)
        {
            x[4 * i + c] = cloud.Up[i][c];
            b[4 * i + c] = cloud.Up[i][c] + dtA[i][c] + dtNu * (fromGiven[i][c] + fromWalls[i][c]);
        }
    }
    const solverPerformance result =
        solver_->solve(viscousOperator(s, scale, dtNu), viscousDiagonal(s, dtNu), b, x);
    result.print();
    if (!result.converged && !(result.finalResidual < 1e-3))
        throw fatalError("The viscous predictor did not converge: " + result.line() +
                         "; take solver PBiCGStab in solvers.U of system/sphSolution, or a smaller "
                         "deltaT");
    for (label i = 0; i < n; ++i)
        if (!cloud.uFixed[i]) cloud.Up[i].setXyz({x[4 * i], x[4 * i + 1], x[4 * i + 2]});
}

}  // namespace ispf
