// SPDX-License-Identifier: GPL-3.0-or-later
#include "PBiCGStab.H"

#include "execution.H"

namespace ispf
{

namespace
{

ISPF_HOT void directionRange(label n, scalar beta, scalar omega, const scalar* r, const scalar* v,
                             scalar* p)
{
    for (label i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
}

ISPF_HOT void combineRange(label n, const scalar* a, scalar factor, const scalar* b, scalar* sum)
{
    for (label i = 0; i < n; ++i) sum[i] = a[i] + factor * b[i];
}

}  // namespace

// p = r + beta (p - omega v)
void PBiCGStab::direction(scalar beta, scalar omega)
{
    parallelFor(label(p_.size()), [&](label i, label e) {
        directionRange(e - i, beta, omega, &r_[i], &v_[i], &p_[i]);
    });
}

// s = r - alpha v; returns |s|
scalar PBiCGStab::halfStep(scalar alpha)
{
    const auto sums = blockSums(label(s_.size()), 1, [&](label i, label e, scalar* sum) {
        combineRange(e - i, &r_[i], -alpha, &v_[i], &s_[i]);
        sum[0] = dotRange(&s_[i], &s_[i], e - i);
    });
    return std::sqrt(sums[0]);
}

// x += alpha y + omega z, r = s - omega t; returns |r|
scalar PBiCGStab::advance(scalar alpha, scalar omega, List<scalar>& x)
{
    const auto sums = blockSums(label(x.size()), 1, [&](label i, label e, scalar* sum) {
        combineRange(e - i, &x[i], alpha, &y_[i], &x[i]);
        combineRange(e - i, &x[i], omega, &z_[i], &x[i]);
        combineRange(e - i, &s_[i], -omega, &t_[i], &r_[i]);
        sum[0] = dotRange(&r_[i], &r_[i], e - i);
    });
    return std::sqrt(sums[0]);
}

solverPerformance PBiCGStab::solve(const linearOperator& A, const preconditioner& M,
                                   const List<scalar>& b, List<scalar>& x)
{
    const label n = A.size();
    for (List<scalar>* v : {&r_, &rShadow_, &p_, &v_, &s_, &t_, &y_, &z_}) v->resize(n);

    residual(A, b, x, r_);
    rShadow_ = r_;
    p_ = r_;
    scalar rNorm = norm(r_);
    convergence state(controls_, M.name() + "PBiCGStab", fieldName_, norm(b), rNorm);

    scalar rho = rNorm * rNorm;
    for (label k = 0; !state.stop(k, rNorm); ++k)
    {
        M.apply(p_, y_);
        A.apply(y_, v_);
        const scalar alpha = rho / dot(rShadow_, v_);
        const scalar sNorm = halfStep(alpha);
        M.apply(s_, z_);
        A.apply(z_, t_);
        const auto sums = blockSums(n, 2, [&](label i, label e, scalar* sum) {
            sum[0] = dotRange(&t_[i], &s_[i], e - i);
            sum[1] = dotRange(&t_[i], &t_[i], e - i);
        });
        // s = 0: the half step has already reached the solution
        const scalar omega = sNorm > 0 && sums[1] > 0 ? sums[0] / sums[1] : 0;
        rNorm = advance(alpha, omega, x);
        if (state.stop(k + 1, rNorm)) break;

        const scalar rhoNew = dot(rShadow_, r_);
        const scalar beta = rhoNew / rho * (alpha / omega);
        if (rhoNew == 0 || !std::isfinite(beta))
        {
            state.fail(solverStatus::breakdown);
            break;
        }
        rho = rhoNew;
        direction(beta, omega);
    }
    return state.result();
}

}  // namespace ispf
