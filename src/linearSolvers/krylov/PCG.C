// SPDX-License-Identifier: GPL-3.0-or-later
#include "PCG.H"

#include "execution.H"

namespace ispf
{

namespace
{

// x += alpha p, r -= alpha q; returns r.r
ISPF_HOT scalar advanceRange(label n, scalar alpha, const scalar* p, const scalar* q, scalar* x,
                             scalar* r)
{
    for (label i = 0; i < n; ++i)
    {
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
    }
    return dotRange(r, r, n);
}

}  // namespace

scalar PCG::advance(scalar alpha, List<scalar>& x)
{
    const auto sums = blockSums(label(x.size()), 1, [&](label i, label e, scalar* sum) {
        sum[0] = advanceRange(e - i, alpha, &p_[i], &q_[i], &x[i], &r_[i]);
    });
    return std::sqrt(sums[0]);
}

solverPerformance PCG::solve(const linearOperator& A, const preconditioner& M,
                             const List<scalar>& b, List<scalar>& x)
{
    const label n = A.size();
    for (List<scalar>* v : {&r_, &z_, &p_, &q_}) v->resize(n);

    residual(A, b, x, r_);
    scalar rNorm = norm(r_);
    convergence state(controls_, M.name() + "PCG", fieldName_, norm(b), rNorm);

    scalar zr = 0, alpha = 0;
    for (label k = 0; !state.stop(k, rNorm); ++k)
    {
        M.apply(r_, z_);
        const auto sums = blockSums(n, 2, [&](label i, label e, scalar* sum) {
            sum[0] = dotRange(&z_[i], &r_[i], e - i);
            sum[1] = dotRange(&z_[i], &q_[i], e - i);
        });
        // Polak-Ribiere: z.(r - rOld) = -alpha z.q, so rOld is not needed
        if (k == 0) p_ = z_;
        else scaleAndAdd(z_, -alpha * sums[1] / zr, p_);
        zr = sums[0];

        A.apply(p_, q_);
        const scalar pq = dot(p_, q_);
        if (!(pq > 0 && zr > 0))
        {
            state.fail(std::isfinite(pq + zr) ? solverStatus::breakdown : solverStatus::notFinite);
            break;
        }
        alpha = zr / pq;
        rNorm = advance(alpha, x);
    }
    return state.result();
}

}  // namespace ispf
