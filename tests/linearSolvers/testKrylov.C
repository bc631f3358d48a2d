// SPDX-License-Identifier: GPL-3.0-or-later
#include "FGMRES.H"
#include "PBiCGStab.H"
#include "PCG.H"
#include "diagonalPreconditioner.H"
#include "incompleteFactor.H"
#include "jitteredLattice.H"
#include "luSolver.H"
#include "execution.H"
#include <doctest/doctest.h>
#include <limits>

using namespace ispf;

namespace
{

solverControls controls(scalar tolerance, label maxIter = 500)
{
    solverControls c;
    c.tolerance = tolerance;
    c.maxIter = maxIter;
    return c;
}

jitteredLattice heldLattice(int n)
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[2] < 1 ? 0.5 : 0; };
    return {n, n, n, c};
}

// Unequally scaled rows and an antisymmetric part: a matrix far from symmetric
csrMatrix unsymmetric(const csrMatrix& symmetric)
{
    csrMatrix A(symmetric);
    for (label i = 0; i < A.size(); ++i)
    {
        const scalar scale = 1 + 0.5 * std::sin(scalar(i));
        A.diagonal[i] *= scale;
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
            A.value[k] *= scale * (A.column[k] > i ? 1.3 : 0.7);
    }
    return A;
}

List<scalar> denseSolution(const csrMatrix& A, const List<scalar>& b)
{
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(A.size(), A.size());
    for (label i = 0; i < A.size(); ++i)
    {
        dense(i, i) = A.diagonal[i];
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
            dense(i, A.column[k]) += A.value[k];
    }
    const Eigen::VectorXd x =
        dense.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()));
    return {x.data(), x.data() + x.size()};
}

scalar relativeDifference(const List<scalar>& a, const List<scalar>& b)
{
    const Eigen::Map<const Eigen::VectorXd> x(a.data(), a.size()), y(b.data(), b.size());
    return (x - y).norm() / y.norm();
}

// A preconditioner that is different at each application
class fickle : public preconditioner
{
public:
    fickle(const csrMatrix& A, scalar mood) : diagonal_(A), mood_(mood) {}
    void apply(const List<scalar>& r, List<scalar>& z) const override
    {
        diagonal_.apply(r, z);
        ++count_;
        for (size_t i = 0; i < z.size(); ++i) z[i] *= 1 + mood_ * std::sin(scalar(i * count_));
    }
    word name() const override { return "fickle"; }

private:
    diagonalPreconditioner diagonal_;
    scalar mood_;
    mutable size_t count_ = 0;
};

}  // namespace

TEST_CASE("every Krylov method agrees with the dense solution")
{
    const jitteredLattice lattice = heldLattice(8);
    const csrMatrix skew = unsymmetric(lattice.A);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    const List<scalar> exact = denseSolution(lattice.A, b), exactSkew = denseSolution(skew, b);

    PCG pcg(controls(1e-11), "p");
    PBiCGStab bicg(controls(1e-11), "p");
    FGMRES gmres(controls(1e-11), "p", 40);
    const auto check = [&](krylovSolver& solver, const csrMatrix& A, const preconditioner& M,
                           const List<scalar>& reference) {
        List<scalar> x(b.size(), 0);
        const solverPerformance done = solver.solve(A, M, b, x);
        INFO(done.line());
        CHECK(done.converged);
        CHECK(done.nIterations > 3);
        CHECK(relativeDifference(x, reference) < 1e-9);
    };
    const noPreconditioner none;
    const diagonalPreconditioner diagonal(lattice.A), diagonalSkew(skew);
    const incompleteFactor DIC(lattice.A, "DIC"), DILU(skew, "DILU");
    for (const preconditioner* M : {(const preconditioner*)&none, (const preconditioner*)&diagonal,
                                    (const preconditioner*)&DIC})
    {
        check(pcg, lattice.A, *M, exact);
        check(bicg, lattice.A, *M, exact);
        check(gmres, lattice.A, *M, exact);
    }
    for (const preconditioner* M :
         {(const preconditioner*)&none, (const preconditioner*)&diagonalSkew,
          (const preconditioner*)&DILU})
    {
        check(bicg, skew, *M, exactSkew);
        check(gmres, skew, *M, exactSkew);
    }
}

TEST_CASE("DIC saves iterations, and small blocks cost some")
{
    const jitteredLattice lattice = heldLattice(14);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    const auto count = [&](const preconditioner& M) {
        List<scalar> x(b.size(), 0);
        return PCG(controls(1e-8), "p").solve(lattice.A, M, b, x).nIterations;
    };
    const label diagonal = count(diagonalPreconditioner(lattice.A));
    const label blocks = count(incompleteFactor(lattice.A, "DIC", 200));
    const label whole = count(incompleteFactor(lattice.A, "DIC"));
    CHECK(whole < blocks);
    CHECK(blocks < diagonal);
    CHECK(2 * whole < diagonal);
}

TEST_CASE("DIC and DILU are exact on a chain")
{
    List<csrMatrix::triplet> entries;
    const label n = 50;
    for (label i = 0; i < n; ++i)
    {
        entries.push_back({i, i, 2 + 0.1 * i});
        if (i > 0)
            entries.push_back({i, i - 1, -1}), entries.push_back({i - 1, i, -0.5 - 0.01 * i});
    }
    const csrMatrix A = csrMatrix::fromTriplets(n, entries);
    const List<scalar> b = randomVector(n, 1);
    List<scalar> z(n);
    incompleteFactor(A, "DILU").apply(b, z);
    CHECK(relativeDifference(z, denseSolution(A, b)) < 1e-13);
}

TEST_CASE("flexible methods bear a preconditioner that varies")
{
    const jitteredLattice lattice = heldLattice(10);
    const csrMatrix skew = unsymmetric(lattice.A);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    List<scalar> x(b.size(), 0);
    // the plain method (Fletcher-Reeves) does not converge in 500 iterations
    CHECK(PCG(controls(1e-8), "p").solve(lattice.A, fickle(lattice.A, 0.3), b, x).converged);
    CHECK(relativeResidual(lattice.A, b, x) < 2e-8);
    x.assign(b.size(), 0);
    const auto done = FGMRES(controls(1e-8), "p", 30).solve(skew, fickle(skew, 0.5), b, x);
    CHECK(done.converged);
    CHECK(done.nIterations > 30);  // restarted at least once
    CHECK(relativeResidual(skew, b, x) == doctest::Approx(done.finalResidual).epsilon(1e-6));
}

TEST_CASE("an exact preconditioner needs one iteration")
{
    const jitteredLattice lattice = heldLattice(9);
    const csrMatrix skew = unsymmetric(lattice.A);
    luSolver lu;
    lu.factorise(skew);
    const List<scalar> b = randomVector(skew.size(), 1);
    List<scalar> x(b.size(), 0);
    CHECK(FGMRES(controls(1e-10), "p").solve(skew, lu, b, x).nIterations == 1);
    x.assign(b.size(), 0);
    CHECK(PBiCGStab(controls(1e-10), "p").solve(skew, lu, b, x).nIterations == 1);
}

TEST_CASE("FGMRES: scaled residual")
{
    // the same system in other units, row by row
    const jitteredLattice lattice = heldLattice(8);
    const label n = lattice.A.size();
    csrMatrix A(lattice.A);
    List<scalar> b = randomVector(n, 1), scale(n);
    const List<scalar> exact = denseSolution(lattice.A, b);
    for (label i = 0; i < n; ++i)
    {
        const scalar unit = i % 2 ? 1e6 : 1;
        scale[i] = 1 / unit;
        b[i] *= unit, A.diagonal[i] *= unit;
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k) A.value[k] *= unit;
    }
    FGMRES solver(controls(1e-10), "p", 200);
    solver.setScale(scale);
    List<scalar> x(n, 0);
    const auto scaled = solver.solve(A, diagonalPreconditioner(A), b, x);
    CHECK(scaled.converged);
    CHECK(relativeDifference(x, exact) < 1e-8);

    x.assign(n, 0);
    const List<scalar> b0 = randomVector(n, 1);
    const auto plain = FGMRES(controls(1e-10), "p", 200)
                           .solve(lattice.A, diagonalPreconditioner(lattice.A), b0, x);
    CHECK(scaled.nIterations == plain.nIterations);
}

TEST_CASE("tolerances: relative to the start, absolute floor, warm start, zero right-hand side")
{
    const jitteredLattice lattice = heldLattice(8);
    const diagonalPreconditioner M(lattice.A);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    solverControls c = controls(0);
    c.relTol = 0.1;
    List<scalar> x(b.size(), 0);
    auto done = PCG(c, "p").solve(lattice.A, M, b, x);
    CHECK(done.finalResidual <= 0.1);
    CHECK(done.finalResidual > 0.001);

    c = controls(0);
    c.absTol = 0.5;
    done = FGMRES(c, "p").solve(lattice.A, M, b, x);
    CHECK(done.converged);
    CHECK(done.finalResidual * done.normFactor <= 0.5);
    CHECK(FGMRES(c, "p").solve(lattice.A, M, b, x).nIterations == 0);

    const List<scalar> zero(b.size(), 0);
    done = PCG(controls(1e-8), "p").solve(lattice.A, M, zero, x);
    CHECK(done.converged);
    CHECK(done.initialResidual == 1);
    CHECK(norm(x) < 1e-5);
    x = zero;
    CHECK(PCG(controls(1e-8), "p").solve(lattice.A, M, zero, x).nIterations == 0);
}

TEST_CASE("what goes wrong is told")
{
    const jitteredLattice lattice = heldLattice(6);
    const noPreconditioner none;
    List<scalar> b = randomVector(lattice.A.size(), 1), x(b.size(), 0);

    csrMatrix indefinite(lattice.A);
    for (scalar& d : indefinite.diagonal) d = -d;
    CHECK(PCG(controls(1e-8), "p").solve(indefinite, none, b, x).status == solverStatus::breakdown);

    // Rows without entries and a right-hand side there: no solution
    csrMatrix singular = csrMatrix::fromTriplets(
        lattice.A.size(), {{0, 0, 1.0}, {1, 1, 2.0}, {2, 2, 3.0}, {3, 3, 4.0}});
    x.assign(b.size(), 0);
    const auto done = FGMRES(controls(1e-8), "p").solve(singular, none, b, x);
    CHECK_FALSE(done.converged);
    CHECK(done.status != solverStatus::maxIter);
    CHECK(std::isfinite(norm(x)));

    b[3] = std::numeric_limits<scalar>::quiet_NaN();
    x.assign(b.size(), 0);
    for (const auto status : {PCG(controls(1e-8), "p").solve(lattice.A, none, b, x).status,
                              PBiCGStab(controls(1e-8), "p").solve(lattice.A, none, b, x).status,
                              FGMRES(controls(1e-8), "p").solve(lattice.A, none, b, x).status})
        CHECK(status == solverStatus::notFinite);

    const auto line = PCG(controls(1e-8, 2), "p")
                          .solve(lattice.A, incompleteFactor(lattice.A, "DIC"),
                                 randomVector(lattice.A.size(), 1), x = List<scalar>(b.size(), 0))
                          .line();
    CHECK(line.rfind("DICPCG:  Solving for p, Initial residual = 1, Final residual = ", 0) == 0);
    CHECK(line.find(", No Iterations 2") != word::npos);
}

TEST_CASE("FGMRES: nearly parallel vectors are made orthogonal a second time")
{
    // One row is far larger than the others: almost all of each product lies along it, that is, already in the
    // basis
    const label n = 80;
    List<csrMatrix::triplet> entries = {{0, 0, 1e10}};
    for (label i = 1; i < n; ++i) entries.push_back({i, i, scalar(i)});
    const csrMatrix A = csrMatrix::fromTriplets(n, entries);
    const List<scalar> b = randomVector(n, 1);
    List<scalar> x(n, 0);
    const auto done = FGMRES(controls(1e-12, 100), "p", 100).solve(A, noPreconditioner(), b, x);
    CHECK(done.converged);  // made orthogonal once only, it ends at 1e-4
}

TEST_CASE("what goes wrong inside FGMRES")
{
    jitteredLattice::choices floating;
    const jitteredLattice lattice(6, 6, 6, floating);
    const noPreconditioner none;
    // nothing fixes the constant, and b contains it
    List<scalar> b(lattice.A.size(), 1), x(b.size(), 0);
    b[0] = 2;
    CHECK(FGMRES(controls(1e-8), "p", 10).solve(lattice.A, none, b, x).status ==
          solverStatus::stagnated);

    class failing : public noPreconditioner
    {
    public:
        void apply(const List<scalar>& r, List<scalar>& z) const override
        {
            z = r;
            if (++count_ == 4) z[0] = std::numeric_limits<scalar>::quiet_NaN();
        }

    private:
        mutable label count_ = 0;
    };
    const jitteredLattice held = heldLattice(6);
    x.assign(b.size(), 0);
    const auto done = FGMRES(controls(1e-8), "p").solve(held.A, failing(), b, x);
    CHECK(done.status == solverStatus::notFinite);
    CHECK(done.nIterations == 3);
    CHECK(relativeResidual(held.A, b, x) == doctest::Approx(done.finalResidual).epsilon(1e-9));
}

TEST_CASE("one thread and two give the same bits")
{
    const jitteredLattice lattice = heldLattice(24);
    const csrMatrix skew = unsymmetric(lattice.A);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    const int before = nThreads();
    List<List<scalar>> solutions;
    for (const int threads : {1, 2})
    {
        setThreads(threads);
        List<scalar> x(b.size(), 0);
        PCG(controls(1e-6), "p").solve(lattice.A, incompleteFactor(lattice.A, "DIC", 1000), b, x);
        PBiCGStab(controls(1e-8), "p").solve(skew, incompleteFactor(skew, "DILU", 1000), b, x);
        FGMRES(controls(1e-10), "p").solve(skew, diagonalPreconditioner(skew), b, x);
        solutions.push_back(x);
    }
    setThreads(before);
    CHECK(solutions[0] == solutions[1]);
}
