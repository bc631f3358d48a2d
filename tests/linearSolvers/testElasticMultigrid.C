// SPDX-License-Identifier: GPL-3.0-or-later
// The multigrid of 3x3 blocks on spring lattices that bend: iterations of PCG do not depend on size and stiffness
#include "PCG.H"
#include "elasticMultigrid.H"
#include "execution.H"
#include "jitteredLattice.H"
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// Springs along the pairs of the lattice
blockMatrix3 springs(const jitteredLattice& lattice)
{
    blockMatrix3 K;
    K.rowStart = lattice.A.rowStart;
    K.column = lattice.A.column;
    K.diagonal.assign(lattice.A.size(), tensor::Zero());
    for (label i = 0; i < lattice.A.size(); ++i)
        for (label k = K.rowStart[i]; k < K.rowStart[i + 1]; ++k)
        {
            const vector n = (lattice.x[i] - lattice.x[K.column[k]]).normalized();
            K.value.push_back(lattice.A.value[k] * n * n.transpose());
            K.diagonal[i] -= K.value.back();
        }
    return K;
}

// {x, y, z} of each node side by side
List<vec4> asNodes(const List<scalar>& x)
{
    List<vec4> u(x.size() / 3);
    for (size_t i = 0; i < u.size(); ++i) u[i].setXyz({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    return u;
}

class springMatrix : public linearOperator
{
public:
    explicit springMatrix(const elasticSystem& s) : s_(s) {}
    label size() const override { return 3 * s_.K.size(); }
    void apply(const List<scalar>& x, List<scalar>& y) const override
    {
        List<vec4> u = asNodes(x), f(u.size());
        for (size_t i = 0; i < u.size(); ++i)
            if (s_.held[i]) u[i] = vec4{};
        s_.K.apply(u, f);
        for (label i = 0; i < size(); ++i)
        {
            const label node = i / 3, c = i % 3;
            y[i] = s_.held[node] ? (s_.factor * s_.K.diagonal[node].row(c) *
                                    vector(x[3 * node], x[3 * node + 1], x[3 * node + 2]))(0) +
                                       s_.added[node] * x[i]
                                 : s_.factor * f[node][c] + s_.added[node] * x[i];
        }
    }

private:
    const elasticSystem& s_;
};

class cycle : public preconditioner
{
public:
    cycle(const elasticSystem& s, scalar cellSize) { multigrid_.rebuild(s, cellSize); }
    void apply(const List<scalar>& r, List<scalar>& z) const override
    {
        List<vec4> u;
        multigrid_.apply(asNodes(r), u);
        for (size_t i = 0; i < z.size(); ++i) z[i] = u[i / 3][i % 3];
    }
    word name() const override { return "elastic"; }
    const elasticMultigrid& multigrid() const { return multigrid_; }

private:
    elasticMultigrid multigrid_;
};

// A plate of nx x ny x nz nodes, clamped along x < 1; mass per node beside springs of stiffness 1
struct plate
{
    jitteredLattice lattice;
    blockMatrix3 K;
    elasticSystem system;

    plate(int nx, int ny, int nz, scalar factor, scalar mass = 1e-3, bool clamped = true)
        : lattice(nx, ny, nz, {}),
          K(springs(lattice)),
          system{K, factor, List<scalar>(K.size(), mass), List<char>(K.size(), 0), lattice.x}
    {
        for (label i = 0; clamped && i < K.size(); ++i) system.held[i] = lattice.x[i][0] < 1;
    }
    label iterations() const
    {
        const springMatrix A(system);
        const cycle M(system, lattice.support);
        const List<scalar> b = randomVector(A.size(), 3);
        List<scalar> x(b.size(), 0);
        solverControls controls;
        controls.tolerance = 0, controls.relTol = 1e-6, controls.maxIter = 500;
        const solverPerformance done = PCG(controls, "u").solve(A, M, b, x);
        CHECK(done.converged);
        CHECK(relativeResidual(A, b, x) < 2e-6);
        return done.nIterations;
    }
};

}  // namespace

TEST_CASE("3x3 blocks: the product is the sum of the springs' forces")
{
    const jitteredLattice lattice(7, 6, 5, {});
    const blockMatrix3 K = springs(lattice);
    const List<vec4> u = asNodes(randomVector(3 * K.size(), 2));
    List<vec4> f(K.size());
    K.apply(u, f);
    for (label i = 0; i < K.size(); ++i)
    {
        vector sum = vector::Zero();
        for (label k = K.rowStart[i]; k < K.rowStart[i + 1]; ++k)
        {
            const label j = K.column[k];
            const vector n = (lattice.x[i] - lattice.x[j]).normalized();
            sum -= lattice.A.value[k] * n.dot(u[i].xyz() - u[j].xyz()) * n;
        }
        CHECK((f[i].xyz() - sum).norm() < 1e-12 * (1 + sum.norm()));
    }
}

TEST_CASE(
    "elastic multigrid: iterations depend neither on the size nor on the stiffness of a plate")
{
    const label small = plate(24, 24, 4, 1).iterations(), large = plate(60, 60, 4, 1).iterations();
    const label stiff = plate(24, 24, 4, 1e6).iterations(),
                light = plate(24, 24, 4, 1, 1e3).iterations();
    MESSAGE("iterations: " << small << ", larger " << large << ", stiffer " << stiff << ", softer "
                           << light);
    CHECK(small <= 10);
    CHECK(large <= small + 1);
    CHECK(stiff <= small + 2);
    CHECK(light <= small);
}

TEST_CASE("elastic multigrid: also a solid of fewer nodes than the coarsest level may have")
{
    const plate p(3, 3, 10, 1);
    CHECK(p.K.size() <= 100);
    CHECK(p.iterations() <= 10);
}

TEST_CASE("elastic multigrid: a bar of 1 to 40, that is held at one end or floats")
{
    CHECK(plate(4, 4, 160, 1).iterations() <= 10);
    CHECK(plate(4, 4, 160, 1, 1e-3, false).iterations() <= 11);
}

TEST_CASE("elastic multigrid: the cycle is symmetric and positive, and the same on two threads")
{
    const plate p(12, 12, 6, 1);
    const int before = nThreads();
    List<List<scalar>> r, z;
    for (int d = 0; d < 2; ++d) r.push_back(randomVector(3 * p.K.size(), 10 + d));
    for (const int threads : {1, 2})
    {
        setThreads(threads);
        const cycle M(p.system, p.lattice.support);
        CHECK(M.multigrid().levelSizes().size() > 1);
        for (int d = 0; d < 2; ++d) z.emplace_back(r[d].size()), M.apply(r[d], z.back());
    }
    setThreads(before);
    CHECK(dot(z[0], r[1]) == doctest::Approx(dot(z[1], r[0])).epsilon(1e-4));
    CHECK(dot(z[0], r[0]) > 0);
    CHECK(dot(z[1], r[1]) > 0);
    CHECK(z[0] == z[2]);
    CHECK(z[1] == z[3]);
}

// Nodes on a line: springs hold no direction across it, and an aggregate no turn about it
TEST_CASE("elastic multigrid: a chain, whose directions across are held by nothing but mass")
{
    const plate p(1, 1, 600, 1);
    CHECK(p.iterations() <= 5);
}
