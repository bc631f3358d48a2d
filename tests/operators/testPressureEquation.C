// SPDX-License-Identifier: GPL-3.0-or-later
#include "periodicBox.H"
#include "sphm.H"

#include "PCG.H"
#include "constantNullSpace.H"
#include "linearSolver.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

Eigen::MatrixXd dense(const csrMatrix& A)
{
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(A.size(), A.size());
    for (label i = 0; i < A.size(); ++i)
    {
        D(i, i) += A.diagonal[i];
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k) D(i, A.column[k]) += A.value[k];
    }
    return D;
}

Eigen::VectorXd asEigen(const List<scalar>& v)
{
    return Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size()));
}

// A channel of disordered particles: periodic in x (one cell), images p -> m p + b beyond y = 0, 1
struct channel
{
    particleCloud cloud;
    std::unique_ptr<smoothingKernel> kernel;
    neighbourList list;
    kernelCorrection B;
    csrMatrix A;

    // m, b for the lower and the upper side.  shearOfImages displaces the images, so that distances are
    // not those of a true reflection, as beside a curved wall
    channel(scalar mLow, scalar bLow, scalar mHigh, scalar bHigh, scalar shearOfImages = 0,
            scalar disorder = 0.2)
    {
        cloud.nDims = 2, cloud.dx = 1.0 / n;
        cloud.zones = {{"fluid", phaseType::fluid, false}};
        std::mt19937 random(3);
        std::uniform_real_distribution<scalar> shift(-disorder, disorder);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                cloud.append(vector(i + 0.5 + shift(random), j + 0.5 + shift(random), 0) / n, 0,
                             vec4{}, cloud.nextId());
        kernel = smoothingKernel::New("WendlandC2", 2, 1.3 * cloud.dx);
        const label same = addRule(1), low = addRule(mLow), high = addRule(mHigh);
        for (const scalar side : {-1.0, 0.0, 1.0})
            for (label i = 0; i < cloud.n(); ++i)
            {
                const vector x = cloud.x[i].xyz() + vector(side, 0, 0);
                if (side != 0) image(i, same, x, 0);
                image(i, low, vector(x[0] + shearOfImages * x[1], -x[1], 0), bLow);
                image(i, high, vector(x[0] + shearOfImages * (1 - x[1]), 2 - x[1], 0), bHigh);
            }
        refresh();
    }

    void refresh()
    {
        list.build(cloud, *kernel);
        B.build(cloud, list);
        sphm::laplacian({cloud, list, B}, List<scalar>(cloud.n(), 1), A);
    }

    // The part of the offsets b of images in the right side; the matrix does not contain it
    List<scalar> ofOffsets() const
    {
        List<scalar> f(cloud.n(), 0);
        for (label i = 0; i < cloud.n(); ++i)
            for (auto k = list.start[i]; k < list.start[i + 1]; ++k)
                if (const label j = list.index[k]; j >= cloud.n())
                    f[i] -= 2 * list.F[k] * cloud.ghostOffset(j)[3];
        return f;
    }

    static constexpr int n = 12;

private:
    label addRule(scalar m)
    {
        Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
        M(3, 3) = m;
        return cloud.addRule(M, tensor::Identity());
    }
    void image(label source, label rule, const vector& x, scalar b)
    {
        const scalar reach = kernel->support();
        if (x[0] > -reach && x[0] < 1 + reach && x[1] > -reach && x[1] < 1 + reach)
            cloud.addImage(source, rule, x, vec4{{0, 0, 0, b}});
    }
};

}  // namespace

TEST_CASE("the pressure matrix is symmetric, also where images are not true reflections")
{
    for (const scalar shear : {0.0, 0.4})
    {
        const channel c(1, 0, -1, 6, shear);
        const Eigen::MatrixXd A = dense(c.A);
        CHECK((A - A.transpose()).cwiseAbs().maxCoeff() < 1e-12 * A.cwiseAbs().maxCoeff());
        CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().minCoeff() > 0);
        CHECK(constantNullSpace::of(c.A).empty());
    }
    const channel closed(1, 0, 1, 0, 0.4);
    CHECK(constantNullSpace::of(closed.A).nSets() == 1);
}

TEST_CASE("the matrix is the pair sum with filled ghosts")
{
    channel c(1, 0, -1, 0);
    List<vec4> phi(c.cloud.n());
    List<scalar> p(c.cloud.n()), Ap(c.cloud.n());
    for (label i = 0; i < c.cloud.n(); ++i)
        p[i] = phi[i][3] = std::sin(3 * c.cloud.x[i][0]) + c.cloud.x[i][1];
    c.cloud.fillGhosts(phi, false);
    c.A.apply(p, Ap);
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        scalar sum = 0;
        for (auto k = c.list.start[i]; k < c.list.start[i + 1]; ++k)
            sum += -2 * c.list.F[k] * (phi[i][3] - phi[c.list.index[k]][3]);
        CHECK(Ap[i] == doctest::Approx(sum).epsilon(1e-9));
    }
}

TEST_CASE("two fixed ends give the straight line between, exactly on a lattice")
{
    for (const scalar disorder : {0.0, 0.2})
    {
        // p = 1 at y = 0 and 3 at y = 1 by odd images: p_g = 2 p_end - p_s
        const channel c(-1, 2, -1, 6, 0, disorder);
        const Eigen::VectorXd p = dense(c.A).ldlt().solve(asEigen(c.ofOffsets()));
        for (label i = 0; i < c.cloud.n(); ++i)
            CHECK(std::abs(p[i] - 1 - 2 * c.cloud.x[i][1]) < (disorder > 0 ? 0.04 : 1e-12));
    }
}

TEST_CASE("particles whose pressure is held are eliminated on both sides")
{
    channel c(1, 0, 1, 0);
    const Eigen::MatrixXd free = dense(c.A);
    for (label i = 0; i < c.cloud.n(); ++i) c.cloud.pFixed[i] = c.cloud.x[i][1] < 0.2;
    c.refresh();
    const Eigen::MatrixXd A = dense(c.A);
    CHECK((A - A.transpose()).cwiseAbs().maxCoeff() < 1e-12 * A.cwiseAbs().maxCoeff());
    CHECK(constantNullSpace::of(c.A).empty());

    const auto given = [&](label i) { return 4 + c.cloud.x[i][0]; };
    Eigen::VectorXd f(c.cloud.n());
    for (label i = 0; i < c.cloud.n(); ++i) f[i] = 1 + std::sin(7 * c.cloud.x[i][1]);
    Eigen::VectorXd right = f;
    for (label j = 0; j < c.cloud.n(); ++j)
        if (c.cloud.pFixed[j]) right -= given(j) * free.col(j);
    for (label i = 0; i < c.cloud.n(); ++i)
        if (c.cloud.pFixed[i]) right[i] = given(i) * c.A.diagonal[i];
    const Eigen::VectorXd p = A.ldlt().solve(right), residual = free * p - f;
    for (label i = 0; i < c.cloud.n(); ++i)
        if (c.cloud.pFixed[i]) CHECK(p[i] == doctest::Approx(given(i)));
        else CHECK(std::abs(residual[i]) < 1e-8);
}

TEST_CASE("fluid whose velocity is given is a wall: no other row sees it")
{
    channel c(1, 0, 1, 0);
    for (label i = 0; i < c.cloud.n(); ++i) c.cloud.uFixed[i] = c.cloud.x[i][1] < 0.2;
    c.refresh();
    const Eigen::MatrixXd A = dense(c.A);
    for (label i = 0; i < c.cloud.n(); ++i)
    {
        CHECK(A(i, i) > 0);
        if (c.cloud.uFixed[i]) CHECK(A.row(i).cwiseAbs().sum() == A(i, i));
        else CHECK(std::abs(A.row(i).sum()) < 1e-12 * A(i, i));
        for (label j = 0; j < c.cloud.n(); ++j)
            if (j != i && c.cloud.uFixed[j]) REQUIRE(A(i, j) == 0);
    }
    CHECK(constantNullSpace::of(c.A).nSets() == 1);
}

TEST_CASE("a closed box is solved up to a constant, by conjugate gradients as by elimination")
{
    channel c(1, 0, 1, 0);
    List<scalar> f(c.cloud.n()), p(c.cloud.n(), 0);
    for (label i = 0; i < c.cloud.n(); ++i) f[i] = 1 + std::cos(M_PI * c.cloud.x[i][1]);
    constantNullSpace::of(c.A).project(f);

    PCG solver({1e-12, 0, 0, 1000}, "p");
    CHECK(solver.solve(c.A, noPreconditioner(), f, p).converged);
    Eigen::MatrixXd pinned = dense(c.A);
    pinned.array() += 1;  // adds the eigenvalue of the constant
    const Eigen::VectorXd exact = pinned.ldlt().solve(asEigen(f));
    const scalar mean = asEigen(p).mean();
    for (label i = 0; i < c.cloud.n(); ++i)
        CHECK(p[i] - mean == doctest::Approx(exact[i]).epsilon(1e-8));
}

TEST_CASE("rigid and mirrored neighbours are absent from the matrix")
{
    channel c(1, 0, -1, 6);
    const Eigen::MatrixXd before = dense(c.A);
    c.cloud.addRigid({0.31, 0.47, 0}, {1, 2, 0});
    c.cloud.addMirror({5, 0}, {0.51, 0.47, 0}, vec4{});
    c.refresh();
    std::int64_t seen = 0;
    for (label i = 0; i < c.cloud.n(); ++i) seen += c.list.start[i + 1] - c.list.wall[i];
    CHECK(seen > 20);
    CHECK((dense(c.A) - before).cwiseAbs().maxCoeff() == 0);
}

TEST_CASE("a lattice whose rows lie on the edges of the multigrid's cells is solved like any other")
{
    for (const int n : {22, 24})
    {
        const periodicBox box(3, n, 0, "cubic", 1);
        csrMatrix A;
        sphm::laplacian(box.stencil(), List<scalar>(box.cloud.n(), 1), A);
        List<vector> points;
        List<scalar> f, p(box.cloud.n(), 0);
        for (label i = 0; i < box.cloud.n(); ++i)
        {
            points.push_back(box.cloud.x[i].xyz());
            f.push_back(std::cos(2 * M_PI * points[i][0]) * std::cos(2 * M_PI * points[i][1]));
        }
        const auto solver = linearSolver::New(
            "p", dictionary::fromString("solver PCG; preconditioner multigrid; tolerance 1e-6;"));
        const auto done = solver->solve({A, true, &points, box.kernel->support()}, f, p);
        CHECK(done.converged);
        CHECK(done.nIterations <= 20);
    }
}
