// SPDX-License-Identifier: GPL-3.0-or-later
#include "blockMatrix3.H"
#include "choleskySolver.H"
#include "constantNullSpace.H"
#include "jitteredLattice.H"
#include "luSolver.H"
#include "messages.H"
#include "execution.H"
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// Springs along the pairs of the lattice; each particle is held a little
blockMatrix3 springs(const jitteredLattice& lattice)
{
    blockMatrix3 K;
    K.rowStart = lattice.A.rowStart;
    K.column = lattice.A.column;
    K.diagonal.assign(lattice.A.size(), 0.01 * tensor::Identity());
    for (label i = 0; i < lattice.A.size(); ++i)
        for (label k = K.rowStart[i]; k < K.rowStart[i + 1]; ++k)
        {
            const vector n = (lattice.x[i] - lattice.x[K.column[k]]).normalized();
            K.value.push_back(lattice.A.value[k] * n * n.transpose());
            K.diagonal[i] -= K.value.back();
        }
    return K;
}

// One particle has a link to its own image beyond a symmetry plane: its row has a block in its own column
blockMatrix3 withOwnImage(blockMatrix3 K, label i)
{
    K.column.insert(K.column.begin() + K.rowStart[i], i);
    K.value.insert(K.value.begin() + K.rowStart[i], vector(0.5, -0.2, -0.2).asDiagonal());
    K.diagonal[i] += 0.5 * tensor::Identity();
    for (label k = i; k < K.size(); ++k) ++K.rowStart[k + 1];
    return K;
}

class asOperator : public linearOperator
{
public:
    explicit asOperator(const blockMatrix3& K) : K_(K) {}
    label size() const override { return 3 * K_.size(); }
    void apply(const List<scalar>& x, List<scalar>& y) const override
    {
        List<vec4> u(K_.size()), f(K_.size());
        for (label i = 0; i < K_.size(); ++i) u[i].setXyz({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
        K_.apply(u, f);
        for (label i = 0; i < size(); ++i) y[i] = f[i / 3][i % 3];
    }

private:
    const blockMatrix3& K_;
};

}  // namespace

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

TEST_CASE("3x3 blocks: product, expansion, Cholesky")
{
    const jitteredLattice lattice(7, 7, 7, {});
    const blockMatrix3 K = withOwnImage(springs(lattice), 5);
    const csrMatrix expanded = K.expanded();
    expanded.check();
    const csrMatrix probed = csrMatrix::fromOperator(asOperator(K));
    const List<scalar> v = randomVector(expanded.size(), 2);
    List<scalar> a(v.size()), b(v.size());
    expanded.apply(v, a);
    probed.apply(v, b);
    for (size_t i = 0; i < v.size(); ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-12));

    const csrMatrix third = K.thirdOfTrace();
    third.check();
    CHECK(third.diagonal[5] ==
          doctest::Approx((expanded.diagonal[15] + expanded.diagonal[16] + expanded.diagonal[17]) /
                          3));

    List<vec4> force(K.size()), u(K.size()), back(K.size());
    for (label i = 0; i < K.size(); ++i) force[i].setXyz({v[3 * i], v[3 * i + 1], v[3 * i + 2]});
    choleskySolver cholesky;
    cholesky.factorise(K);
    cholesky.apply(force, u);
    K.apply(u, back);
    for (label i = 0; i < K.size(); ++i) CHECK((back[i].xyz() - force[i].xyz()).norm() < 1e-4);
}

// A long bar: its elimination tree has parts, and above them supernodes wider than a block
TEST_CASE(
    "the block factor in single precision: close to the exact solution, on any number of threads")
{
    const jitteredLattice lattice(9, 10, 40, {});
    const blockMatrix3 K = springs(lattice);
    const List<scalar> v = randomVector(3 * K.size(), 2);
    List<scalar> exact(v.size());
    luSolver lu;
    lu.factorise(K.expanded());
    lu.apply(v, exact);
    List<vec4> force(K.size());
    for (label i = 0; i < K.size(); ++i) force[i].setXyz({v[3 * i], v[3 * i + 1], v[3 * i + 2]});

    const int before = nThreads();
    List<vec4> u[2];
    for (const int t : {0, 1})
    {
        setThreads(t + 1);
        choleskySolver cholesky;
        cholesky.factorise(K);
        u[t].resize(K.size());
        cholesky.apply(force, u[t]);
    }
    setThreads(before);
    scalar error = 0, size = 0;
    label different = 0;
    for (label i = 0; i < K.size(); ++i)
    {
        const vector x(exact[3 * i], exact[3 * i + 1], exact[3 * i + 2]);
        error += (u[0][i].xyz() - x).squaredNorm(), size += x.squaredNorm();
        different += u[0][i].xyz() != u[1][i].xyz();
    }
    CHECK(std::sqrt(error / size) < 1e-5);
    CHECK(different == 0);
}
