// SPDX-License-Identifier: GPL-3.0-or-later
#include "FGMRES.H"

#include "execution.H"

namespace ispf
{

namespace
{

// A restart has stagnated if it reduces the residual by a factor above this
constexpr scalar leastGain = 0.99;
// If the remaining overlap with the basis exceeds this, w is made orthogonal a second time
constexpr scalar overlapAllowed = 1e-10;
// The space is exhausted if less than this share of w remains
constexpr scalar exhausted = 1e-14;

ISPF_HOT void subtractRange(label n, scalar h, const scalar* v, scalar* w)
{
    for (label i = 0; i < n; ++i) w[i] -= h * v[i];
}

ISPF_HOT void multiplyRange(label n, scalar factor, const scalar* a, scalar* product)
{
    for (label i = 0; i < n; ++i) product[i] = factor * a[i];
}

ISPF_HOT void multiplyRange(label n, const scalar* a, const scalar* b, scalar* product)
{
    for (label i = 0; i < n; ++i) product[i] = a[i] * b[i];
}

ISPF_HOT void divideRange(label n, const scalar* a, const scalar* b, scalar* ratio)
{
    for (label i = 0; i < n; ++i) ratio[i] = a[i] / b[i];
}

void scaleBy(const List<scalar>& scale, List<scalar>& w)
{
    if (scale.empty()) return;
    parallelFor(
        label(w.size()), [&](label i, label e) { multiplyRange(e - i, &scale[i], &w[i], &w[i]); },
        8192);
}

}  // namespace

FGMRES::FGMRES(const solverControls& controls, const word& fieldName, label restart)
    : krylovSolver(controls, fieldName), restart_(restart)
{
    if (restart_ < 1) throw fatalError("FGMRES: restart must be at least 1");
}

// w = scale (b - A x); returns its norm
scalar FGMRES::scaledResidual(const linearOperator& A, const List<scalar>& b, const List<scalar>& x)
{
    residual(A, b, x, w_);
    scaleBy(scale_, w_);
    return norm(w_);
}

// v_[k] = w_ / length; allocates memory as the basis grows
static void append(List<List<scalar>>& v, label k, const List<scalar>& w, scalar length)
{
    if (label(v.size()) <= k) v.emplace_back();
    v[k].resize(w.size());
    parallelFor(
        label(w.size()),
        [&](label i, label e) { multiplyRange(e - i, 1 / length, &w[i], &v[k][i]); }, 8192);
}

void FGMRES::startBasis(scalar rNorm)
{
    append(v_, 0, w_, rNorm);
    g_.assign(1, rNorm);
    h_.clear(), cos_.clear(), sin_.clear();
    trouble_ = solverStatus::converged;
}

// Subtracts from w its part in the span of v_[0..k], whose coefficients go to h; returns the new |w|
scalar FGMRES::orthogonalise(label k, List<scalar>& h)
{
    const label n = label(w_.size()), m = k + 1;
    // Subtracts `known` from w; returns the dot products of the result with the basis and with itself
    const auto sweep = [&](const List<scalar>& known) {
        return blockSums(n, m + 1, [&](label i, label e, scalar* sums) {
            for (size_t j = 0; j < known.size(); ++j)
                subtractRange(e - i, known[j], &v_[j][i], &w_[i]);
            for (label j = 0; j < m; ++j) sums[j] = dotRange(&v_[j][i], &w_[i], e - i);
            sums[m] = dotRange(&w_[i], &w_[i], e - i);
        });
    };
    h = sweep({});
    const scalar before = std::sqrt(h[m]);
    h.resize(m);
    List<scalar> left = sweep(h);
    scalar length = std::sqrt(left[m]);
    left.resize(m);
    if (Eigen::Map<const Eigen::VectorXd>(left.data(), m).norm() > overlapAllowed * length)
    {
        for (label j = 0; j < m; ++j) h[j] += left[j];
        length = std::sqrt(sweep(left)[m]);
    }
    return length > exhausted * before ? length : length == length ? 0 : length;
}

// Rotates column k of the Hessenberg matrix, whose subdiagonal is `next`; returns the new |r|
scalar FGMRES::rotate(label k, scalar next)
{
    List<scalar>& h = h_[k];
    for (label j = 0; j < k; ++j)
    {
        const scalar upper = cos_[j] * h[j] + sin_[j] * h[j + 1];
        h[j + 1] = cos_[j] * h[j + 1] - sin_[j] * h[j];
        h[j] = upper;
    }
    const scalar length = std::hypot(h[k], next);
    cos_.push_back(length > 0 ? h[k] / length : 1);
    sin_.push_back(length > 0 ? next / length : 0);
    h[k] = length;
    g_.push_back(-sin_[k] * g_[k]);
    g_[k] *= cos_[k];
    return std::abs(g_[k + 1]);
}

// Adds one column to the basis.  False if the column must not enter the solution; trouble_ then has the reason
bool FGMRES::extend(const linearOperator& A, const preconditioner& M, label k)
{
    const label n = A.size();
    if (label(z_.size()) <= k) z_.emplace_back();
    z_[k].resize(n);
    if (scale_.empty()) M.apply(v_[k], z_[k]);
    else
    {
        parallelFor(
            n, [&](label i, label e) { divideRange(e - i, &v_[k][i], &scale_[i], &w_[i]); }, 8192);
        M.apply(w_, z_[k]);
    }
    A.apply(z_[k], w_);
    scaleBy(scale_, w_);

    h_.emplace_back();
    const scalar next = orthogonalise(k, h_[k]);
    if (!std::isfinite(next)) return trouble_ = solverStatus::notFinite, false;
    const scalar largest = Eigen::Map<const Eigen::VectorXd>(h_[k].data(), k + 1).norm();
    rotate(k, next);
    // no new direction and a zero on the diagonal: A M^-1 is singular on this space
    if (next == 0 && h_[k][k] <= exhausted * largest)
        return trouble_ = solverStatus::breakdown, false;
    if (next > 0) append(v_, k + 1, w_, next);
    return true;
}

// x += Z y, with y from the triangular system of the first nColumns
void FGMRES::correct(label nColumns, List<scalar>& x) const
{
    List<scalar> y(g_.begin(), g_.begin() + nColumns);
    for (label j = nColumns - 1; j >= 0; --j)
    {
        y[j] /= h_[j][j];
        for (label i = 0; i < j; ++i) y[i] -= h_[j][i] * y[j];
    }
    parallelFor(label(x.size()), [&](label i, label e) {
        for (label j = 0; j < nColumns; ++j) subtractRange(e - i, -y[j], &z_[j][i], &x[i]);
    });
}

solverPerformance FGMRES::solve(const linearOperator& A, const preconditioner& M,
                                const List<scalar>& b, List<scalar>& x)
{
    const label n = A.size();
    if (!scale_.empty() && label(scale_.size()) != n)
        throw fatalError("FGMRES: " + std::to_string(scale_.size()) + " scale factors for " +
                         std::to_string(n) + " rows");
    w_ = b;
    scaleBy(scale_, w_);
    const scalar bNorm = norm(w_);
    scalar rNorm = scaledResidual(A, b, x);
    convergence state(controls_, M.name() + "FGMRES", fieldName_, bNorm, rNorm);

    label total = 0;
    while (!state.stop(total, rNorm))
    {
        startBasis(rNorm);
        label k = 0;
        bool more = true;
        while (more && k < restart_ && extend(A, M, k))
        {
            const scalar estimate = std::abs(g_[++k]);
            ++total;
            more = !state.stop(total, estimate);
        }
        correct(k, x);
        const scalar last = rNorm;
        rNorm = scaledResidual(A, b, x);
        if (trouble_ == solverStatus::converged && rNorm > leastGain * last)
            trouble_ = solverStatus::stagnated;
        if (trouble_ != solverStatus::converged)
        {
            if (!state.stop(total, rNorm)) state.fail(trouble_);
            break;
        }
    }
    return state.result();
}

}  // namespace ispf
