// SPDX-License-Identifier: GPL-3.0-or-later
#include "PBiCGStab.H"
#include "PCG.H"
#include "cellMultigrid.H"
#include "jitteredLattice.H"
#include "execution.H"
#include <doctest/doctest.h>
#include <algorithm>
#include <limits>

using namespace ispf;

namespace
{

constexpr int edge = 31;  // 30k particles

solverControls toSixDigits()
{
    solverControls c;
    c.tolerance = 1e-6;
    c.maxIter = 100;
    return c;
}

multigridOptions options(const jitteredLattice& lattice, const word& cycle)
{
    multigridOptions o;
    o.cellSize = lattice.support;
    o.cycle = cycle;
    return o;
}

label iterations(const jitteredLattice& lattice, const word& cycle)
{
    const cellMultigrid multigrid(lattice.A, lattice.x, options(lattice, cycle));
    CHECK(multigrid.levelSizes().size() > 2);
    // rough and smooth parts in equal measure
    List<scalar> b = randomVector(lattice.A.size(), 3), x(b.size(), 0);
    for (label i = 0; i < lattice.A.size(); ++i)
        b[i] += 3 * std::sin(0.1 * lattice.x[i].sum()) + 3 * std::cos(0.15 * lattice.x[i][2]);
    multigrid.nullSpace().project(b);
    PCG solver(toSixDigits(), "p");
    const solverPerformance done = solver.solve(lattice.A, multigrid, b, x);
    INFO(cycle << ": " << done.line());
    CHECK(done.converged);
    CHECK(relativeResidual(lattice.A, b, x) < 1.1e-6);
    return done.nIterations;
}

scalar topHeld(const vector& x)
{
    return x[2] > edge - 1 ? 0.5 : 0;
}

}  // namespace

TEST_CASE("multigrid: one face held")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    const jitteredLattice lattice(edge, edge, edge, c);
    CHECK(iterations(lattice, "K") <= 12);
    CHECK(iterations(lattice, "V") <= 12);
}

TEST_CASE("multigrid: wider support")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    c.support = 2.6;
    const jitteredLattice lattice(edge, edge, edge, c);
    CHECK(iterations(lattice, "K") <= 11);
    CHECK(iterations(lattice, "V") <= 11);
}

TEST_CASE("multigrid: thin wall without coupling, open at one end")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    // the wall is in the middle of a cell, so that its two sides share cells
    c.joined = [](const vector& a, const vector& b) {
        return (a[0] - 15) * (b[0] - 15) > 0 || std::min(a[2], b[2]) > 20;
    };
    const jitteredLattice lattice(edge, edge, edge, c);
    CHECK(iterations(lattice, "K") <= 13);
    CHECK(iterations(lattice, "V") <= 15);
}

TEST_CASE("multigrid: nothing held, two floating parts")
{
    jitteredLattice::choices c;
    c.joined = [](const vector& a, const vector& b) { return (a[0] - 15) * (b[0] - 15) > 0; };
    const jitteredLattice lattice(edge, edge, edge, c);
    const cellMultigrid multigrid(lattice.A, lattice.x, options(lattice, "V"));
    const constantNullSpace walked = constantNullSpace::of(lattice.A);
    CHECK(multigrid.nullSpace().nSets() == 2);
    CHECK(multigrid.nullSpace().set() == walked.set());
    List<scalar> z(lattice.A.size());
    multigrid.apply(randomVector(lattice.A.size(), 3), z);
    List<scalar> projected(z);
    multigrid.nullSpace().project(projected);
    scalar moved = 0;
    for (size_t i = 0; i < z.size(); ++i) moved = std::max(moved, std::abs(z[i] - projected[i]));
    CHECK(moved < 1e-12 * norm(z));
    CHECK(iterations(lattice, "K") <= 13);
    CHECK(iterations(lattice, "V") <= 14);
}

TEST_CASE("multigrid: held so weakly that single precision does not see it")
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[2] > edge - 1 ? 1e-7 : 0; };
    const jitteredLattice lattice(edge, edge, edge, c);
    CHECK(cellMultigrid(lattice.A, lattice.x, options(lattice, "V")).nullSpace().empty());
    CHECK(iterations(lattice, "K") <= 12);
    CHECK(iterations(lattice, "V") <= 13);
}

TEST_CASE("multigrid: coefficient jumps by 1e4")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    c.coefficient = [](const vector& x) { return (x - vector(15, 14, 13)).norm() < 8 ? 1e4 : 1; };
    const jitteredLattice lattice(edge, edge, edge, c);
    CHECK(iterations(lattice, "K") <= 15);
    CHECK(iterations(lattice, "V") <= 18);
}

TEST_CASE("multigrid: coefficient varies by 1e8, smoothly")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    c.coefficient = [](const vector& x) {
        return std::pow(10, 4 * std::sin(0.3 * x[0]) * std::cos(0.2 * x[1]));
    };
    const jitteredLattice lattice(edge, edge, edge, c);
    CHECK(iterations(lattice, "K") <= 20);
    CHECK(iterations(lattice, "V") <= 20);
}

TEST_CASE("multigrid: periodic box, thin shell, flat, long channel")
{
    jitteredLattice::choices c;
    c.period = 28;
    const jitteredLattice periodic(28, 28, 28, c);
    CHECK(iterations(periodic, "K") <= 12);
    CHECK(iterations(periodic, "V") <= 13);
    c.period = 0;
    c.held = [](const vector& x) { return x[1] < 1 ? 0.5 : 0; };
    CHECK(iterations({130, 130, 1, c}, "K") <= 13);
    CHECK(iterations({6, 600, 6, c}, "K") <= 13);
    c.keep = [](const vector& x) { return std::abs(std::hypot(x[0] - 35, x[1] - 35) - 30) < 2; };
    CHECK(iterations({70, 70, 20, c}, "K") <= 13);
}

TEST_CASE("multigrid: rows without couplings, drops, and a stray point far away")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    // every ninth layer has no couplings: its points are single rows
    c.joined = [](const vector& a, const vector& b) {
        return std::abs(a[2] - 9) > 0.5 && std::abs(b[2] - 9) > 0.5 && (a[2] - 9) * (b[2] - 9) > 0;
    };
    jitteredLattice lattice(edge, edge, edge, c);
    for (scalar& d : lattice.A.diagonal)
        if (d == 0) d = 7;
    const auto stray = std::find(lattice.A.diagonal.begin(), lattice.A.diagonal.end(), 7);
    lattice.x[stray - lattice.A.diagonal.begin()] = vector(1e6, -1e6, 1e6);
    CHECK(iterations(lattice, "K") <= 13);
    multigridOptions o = options(lattice, "V");
    o.omega = 1.2;
    const cellMultigrid multigrid(lattice.A, lattice.x, o);
    CHECK(multigrid.nullSpace().nSets() == 1);  // below the layer
    List<scalar> z(lattice.A.size());
    const List<scalar> r = randomVector(lattice.A.size(), 3);
    multigrid.apply(r, z);
    for (size_t i = 0; i < r.size(); ++i)
        if (lattice.A.diagonal[i] == 7) CHECK(z[i] == doctest::Approx(r[i] / 7).epsilon(1e-6));
}

TEST_CASE("multigrid: small systems are solved exactly, the singular one too")
{
    // a chain with whole numbers: without its pin the coarsest matrix is singular to the last bit
    List<csrMatrix::triplet> entries;
    List<vector> x(20);
    for (label i = 0; i < 20; ++i)
    {
        x[i] = vector(i, 0, 0);
        entries.push_back({i, i, i == 0 || i == 19 ? 1.0 : 2.0});
        if (i > 0) entries.push_back({i, i - 1, -1}), entries.push_back({i - 1, i, -1});
    }
    csrMatrix A = csrMatrix::fromTriplets(20, entries);
    multigridOptions o;
    o.cellSize = 2;
    List<scalar> b = randomVector(20, 3), z(20);
    for (const scalar held : {0, 1})
    {
        A.diagonal[0] += held;
        const cellMultigrid multigrid(A, x, o);
        CHECK(multigrid.nullSpace().nSets() == (held > 0 ? 0 : 1));
        multigrid.nullSpace().project(b);
        multigrid.apply(b, z);
        CHECK(relativeResidual(A, b, z) < 1e-5);
    }
}

TEST_CASE("multigrid: groups never share an aggregate")
{
    const jitteredLattice lattice(12, 12, 12, {});
    List<std::uint8_t> group;
    for (const vector& x : lattice.x) group.push_back(x[0] < 5);
    multigridOptions o = options(lattice, "V");
    o.coarsestSize = 1;
    const List<label> one = cellMultigrid(lattice.A, lattice.x, o).levelSizes();
    const List<label> two = cellMultigrid(lattice.A, lattice.x, o, group).levelSizes();
    CHECK(one[1] == 6 * 6 * 6);
    CHECK(two[1] == 7 * 6 * 6);  // the column of cells around x = 5 is cut in two
    CHECK(one.back() == 1);
    CHECK(two.back() == 2);
}

TEST_CASE("multigrid: the V-cycle is a symmetric linear operator")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    const jitteredLattice lattice(edge, edge, edge, c);
    const label n = lattice.A.size();
    const cellMultigrid V(lattice.A, lattice.x, options(lattice, "V"));
    List<List<scalar>> r, z(2, List<scalar>(n));
    for (int d = 0; d < 2; ++d)
    {
        r.push_back(randomVector(n, 10 + d));
        V.apply(r[d], z[d]);
    }
    CHECK(dot(z[0], r[1]) == doctest::Approx(dot(z[1], r[0])).epsilon(1e-4));
}

TEST_CASE("multigrid: unsymmetric matrix with PBiCGStab")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    jitteredLattice lattice(edge, edge, edge, c);
    csrMatrix& A = lattice.A;
    for (label i = 0; i < A.size(); ++i)
    {
        const scalar scale = 1 + 0.1 * std::sin(scalar(i));
        A.diagonal[i] *= scale;
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k) A.value[k] *= scale;
    }
    const cellMultigrid V(A, lattice.x, options(lattice, "V"));
    const List<scalar> b = randomVector(A.size(), 3);
    List<scalar> x(b.size(), 0);
    const solverPerformance done = PBiCGStab(toSixDigits(), "p").solve(A, V, b, x);
    CHECK(done.converged);
    CHECK(done.nIterations <= 10);
    CHECK(relativeResidual(A, b, x) < 1.1e-6);
}

TEST_CASE("multigrid: one thread and two give the same bits")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    const jitteredLattice lattice(edge, edge, edge, c);
    const List<scalar> b = randomVector(lattice.A.size(), 3);
    const int before = nThreads();
    List<List<scalar>> solutions;
    for (const int threads : {1, 2})
    {
        setThreads(threads);
        const cellMultigrid K(lattice.A, lattice.x, options(lattice, "K"));
        List<scalar> x(b.size(), 0);
        PCG(toSixDigits(), "p").solve(lattice.A, K, b, x);
        solutions.push_back(x);
    }
    setThreads(before);
    CHECK(solutions[0] == solutions[1]);
}

TEST_CASE("multigrid: a rebuilt one is as good as new")
{
    jitteredLattice::choices c;
    c.held = topHeld;
    const jitteredLattice large(edge, edge, edge, c), small(12, 13, 14, {});
    cellMultigrid rebuilt(large.A, large.x, options(large, "K"));
    for (const jitteredLattice* lattice : {&small, &large})
    {
        const List<scalar> r = randomVector(lattice->A.size(), 3);
        List<scalar> z(r.size()), fresh(r.size());
        rebuilt.rebuild(lattice->A, lattice->x);
        rebuilt.apply(r, z);
        cellMultigrid(lattice->A, lattice->x, options(*lattice, "K")).apply(r, fresh);
        CHECK(z == fresh);
    }
}

TEST_CASE("multigrid: wrong input is refused")
{
    const jitteredLattice lattice(5, 5, 5, {});
    multigridOptions o = options(lattice, "V");
    CHECK_THROWS_AS(cellMultigrid(lattice.A, List<vector>(3), o), fatalError);
    CHECK_THROWS_AS(cellMultigrid(lattice.A, lattice.x, o, List<std::uint8_t>(3)), fatalError);
    List<vector> lost(lattice.x);
    lost[7][1] = std::numeric_limits<scalar>::quiet_NaN();
    CHECK_THROWS_AS(cellMultigrid(lattice.A, lost, o), fatalError);
    o.cellSize = 0;
    CHECK_THROWS_AS(cellMultigrid(lattice.A, lattice.x, o), fatalError);
}
