// SPDX-License-Identifier: GPL-3.0-or-later
#include "choleskySolver.H"
#include "constantNullSpace.H"
#include "jitteredLattice.H"
#include "luSolver.H"
#include "messages.H"
#include <doctest/doctest.h>

using namespace ispf;

TEST_CASE("csrMatrix: triplets, operator, checks")
{
    const csrMatrix A =
        csrMatrix::fromTriplets(3, {{2, 0, 1.0}, {0, 1, 2.0}, {0, 1, 3.0}, {1, 1, 4.0}});
    A.check();
    List<scalar> y(3);
    A.apply({1, 10, 100}, y);
    CHECK(y == List<scalar>{50, 40, 1});
    const csrMatrix same = csrMatrix::fromOperator(A);
    CHECK(same.column == A.column);
    CHECK(same.value == A.value);
    CHECK(same.diagonal == A.diagonal);
    CHECK_THROWS_AS(csrMatrix::fromTriplets(3, {{3, 0, 1.0}}), fatalError);
    csrMatrix bad(A);
    bad.column[0] = 0;
    CHECK_THROWS_AS(bad.check(), fatalError);
}

TEST_CASE("Cholesky and LU solve to round-off, again after new values")
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[2] < 1 ? 0.5 : 0; };
    jitteredLattice lattice(9, 9, 9, c);
    const List<scalar> b = randomVector(lattice.A.size(), 1);
    List<scalar> x(b.size());
    choleskySolver cholesky;
    luSolver lu;
    for (int round = 0; round < 2; ++round)
    {
        cholesky.factorise(lattice.A);
        cholesky.apply(b, x);
        CHECK(relativeResidual(lattice.A, b, x) < 1e-12);
        csrMatrix skew(lattice.A);
        for (label k = 0; k < skew.nEntries(); ++k) skew.value[k] *= k % 2 ? 1.2 : 0.6;
        lu.factorise(skew);
        lu.apply(b, x);
        CHECK(relativeResidual(skew, b, x) < 1e-12);
        for (scalar& d : lattice.A.diagonal) d *= 1.5;
    }
    const jitteredLattice other(8, 9, 10, c);
    x.resize(other.A.size());
    const List<scalar> right = randomVector(other.A.size(), 1);
    cholesky.factorise(other.A);
    cholesky.apply(right, x);
    CHECK(relativeResidual(other.A, right, x) < 1e-12);
    for (scalar& d : lattice.A.diagonal) d = -d;
    CHECK_THROWS_AS(cholesky.factorise(lattice.A), fatalError);
    CHECK_THROWS_AS(lu.factorise(csrMatrix::fromTriplets(2, {{0, 0, 1.0}})), fatalError);
}

TEST_CASE("a floating part is solved with zero mean")
{
    jitteredLattice::choices c;
    c.held = [](const vector& x) { return x[0] < 1 ? 0.5 : 0; };
    c.joined = [](const vector& a, const vector& b) { return (a[0] - 5) * (b[0] - 5) > 0; };
    const jitteredLattice lattice(10, 8, 8, c);
    const constantNullSpace floating = constantNullSpace::of(lattice.A);
    REQUIRE(floating.nSets() == 1);
    for (label i = 0; i < lattice.A.size(); ++i)
        CHECK((floating.set()[i] == 0) == (lattice.x[i][0] > 5));
    List<scalar> b = randomVector(lattice.A.size(), 1), x(b.size());
    floating.project(b);
    choleskySolver cholesky;
    cholesky.factorise(lattice.A);
    cholesky.apply(b, x);
    CHECK(relativeResidual(lattice.A, b, x) < 1e-11);
    List<scalar> projected(x);
    floating.project(projected);
    for (size_t i = 0; i < x.size(); ++i)
        CHECK(projected[i] == doctest::Approx(x[i]).epsilon(1e-9));
}

TEST_CASE("a chain of whole numbers that nothing holds is pinned")
{
    const csrMatrix chain = csrMatrix::fromTriplets(
        3, {{0, 0, 1}, {0, 1, -1}, {1, 0, -1}, {1, 1, 2}, {1, 2, -1}, {2, 1, -1}, {2, 2, 1}});
    choleskySolver cholesky;
    cholesky.factorise(chain);
    List<scalar> x(3);
    cholesky.apply({1, 0, -1}, x);
    CHECK(x[0] == doctest::Approx(1));
    CHECK(x[1] == doctest::Approx(0));
    CHECK(x[2] == doctest::Approx(-1));
}
