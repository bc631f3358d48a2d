// SPDX-License-Identifier: GPL-3.0-or-later
#include "capturedLog.H"
#include "cellMultigrid.H"
#include "constantNullSpace.H"
#include "jitteredLattice.H"
#include "linearSolver.H"
#include "execution.H"
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

dictionary entries(const word& text)
{
    return dictionary::fromString(text, "sphSolution");
}

word messageOf(const std::function<void()>& body)
{
    try
    {
        body();
    }
    catch (const fatalError& error)
    {
        return error.what();
    }
    return "";
}

const List<word> iterative = {"PCG", "PBiCGStab", "FGMRES"};
const List<word> preconditioners = {"multigrid", "DIC", "DILU", "diagonal", "none"};

}  // namespace

TEST_CASE("every combination of words solves a symmetric system, a floating part included")
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[0] < 1 ? 0.5 : 0; };
    c.joined = [](const vector& a, const vector& b) { return (a[0] - 5) * (b[0] - 5) > 0; };
    const jitteredLattice lattice(12, 10, 10, c);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    const constantNullSpace floating = constantNullSpace::of(lattice.A);
    List<scalar> compatible(b);
    floating.project(compatible);
    const linearSystem system{lattice.A, true, &lattice.x, lattice.support};

    List<scalar> exact(b.size(), 0);
    linearSolver::New("p", entries("solver direct;"))->solve(system, b, exact);
    CHECK(relativeResidual(lattice.A, compatible, exact) < 1e-11);
    for (const word& solver : iterative)
        for (const word& preconditioner : preconditioners)
        {
            const auto chosen =
                linearSolver::New("p", entries("solver " + solver + "; preconditioner " +
                                               preconditioner + "; tolerance 1e-9; maxIter 500;"));
            List<scalar> x(b.size(), 1);
            const solverPerformance done = chosen->solve(system, b, x);
            INFO(done.line());
            CHECK(done.converged);
            CHECK(done.solverName == (preconditioner == "none" ? "" : preconditioner) + solver);
            scalar difference = 0;
            for (size_t i = 0; i < x.size(); ++i)
                difference = std::max(difference, std::abs(x[i] - exact[i]));
            CHECK(difference < 1e-5);
        }
}

TEST_CASE("CPU times are in the log where profiling is asked for, and only there")
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[0] < 1 ? 0.5 : 0; };
    const jitteredLattice lattice(10, 10, 10, c);
    const linearSystem system{lattice.A, true, &lattice.x, lattice.support};
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    for (const word solver : {"solver PCG; preconditioner multigrid;", "solver direct;"})
        for (const bool asked : {false, true})
        {
            capturedLog log;
            List<scalar> x(b.size(), 0);
            const solverPerformance done =
                linearSolver::New("p", entries(solver + (asked ? "profiling yes;" : "")))
                    ->solve(system, b, x);
            done.print();
            CHECK(log.contains("Solving for p"));
            CHECK(log.contains("CPU time for p, set-up = ") == asked);
            CHECK((done.setupCpu >= 0 && done.solveCpu >= 0) == asked);
        }
}

TEST_CASE("unsymmetric systems: the methods that can, and the refusal of those that cannot")
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[0] < 1 ? 0.5 : 0; };
    jitteredLattice lattice(10, 10, 10, c);
    for (label k = 0; k < lattice.A.nEntries(); ++k) lattice.A.value[k] *= k % 2 ? 1.1 : 0.9;
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    const linearSystem system{lattice.A, false, &lattice.x, lattice.support};
    for (const char* text : {"solver direct;", "solver PBiCGStab; preconditioner DILU;",
                             "solver PBiCGStab; preconditioner multigrid;",
                             "solver FGMRES; preconditioner multigrid; cycle K; restart 30;"})
    {
        List<scalar> x(b.size(), 0);
        CHECK(linearSolver::New("p", entries(text))->solve(system, b, x).converged);
        CHECK(relativeResidual(lattice.A, b, x) < 1.1e-6);
    }
    List<scalar> x(b.size(), 0);
    for (const char* text :
         {"solver PCG; preconditioner none;", "solver FGMRES; preconditioner DIC;"})
        CHECK(messageOf([&] {
                  linearSolver::New("p", entries(text))->solve(system, b, x);
              }).find("symmetric") != word::npos);
}

TEST_CASE("a wrong word lists the valid ones; keys of other choices are passed over")
{
    word text = messageOf([] { linearSolver::New("p", entries("solver PCGG;")); });
    for (const word& valid : iterative) CHECK(text.find(valid) != word::npos);
    CHECK(text.find("direct") != word::npos);
    text = messageOf([] { linearSolver::New("p", entries("solver PCG; preconditioner ILU;")); });
    for (const word& valid : preconditioners) CHECK(text.find(valid) != word::npos);
    text = messageOf([] {
        linearSolver::New("p", entries("solver PBiCGStab; preconditioner multigrid; cycle K;"));
    });
    CHECK(text.find("cycle V") != word::npos);

    const dictionary d = entries("solver direct; preconditioner DIC; tolerance 1e-6; cycle K;");
    linearSolver::New("p", d);
    d.checkAllRead();
    const dictionary wrong = entries("solver direct; tolerence 1e-6;");
    linearSolver::New("p", wrong);
    CHECK_THROWS_AS(wrong.checkAllRead(), fatalError);
}
