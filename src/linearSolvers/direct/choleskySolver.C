// SPDX-License-Identifier: GPL-3.0-or-later
#include "choleskySolver.H"

#include "constantNullSpace.H"
#include "messages.H"
#include "oneBlasThread.H"
#include <cholmod.h>

namespace ispf
{

struct choleskySolver::cholmod
{
    cholmod_common common;
    cholmod_factor* factor = nullptr;
    List<SuiteSparse_long> start, row;  // lower triangle by columns
    List<scalar> value;
    constantNullSpace nullSpace;
    cholmod_dense* right = nullptr;
    // cholmod_l_solve2 keeps these from call to call
    cholmod_dense *solution = nullptr, *scratch1 = nullptr, *scratch2 = nullptr;

    cholmod()
    {
        cholmod_l_start(&common);
        common.print = 0;
        common.final_ll = true;  // L L^T: it detects a matrix that is not positive definite
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_METIS;
    }
    ~cholmod()
    {
        releaseFactor();
        cholmod_l_finish(&common);
    }
    void releaseFactor()
    {
        cholmod_l_free_factor(&factor, &common);
        for (cholmod_dense** d : {&right, &solution, &scratch1, &scratch2})
            cholmod_l_free_dense(d, &common);
    }

    label size() const { return label(start.size()) - 1; }
    cholmod_sparse matrix();
    bool setMatrix(const csrMatrix& A);
    void checkStatus(const char* step) const;
    void solve();
};

choleskySolver::choleskySolver() : cholmod_(std::make_unique<cholmod>()) {}
choleskySolver::~choleskySolver() = default;

// Copies the lower triangle; true if the pattern has changed
bool choleskySolver::cholmod::setMatrix(const csrMatrix& A)
{
    const label n = A.size();
    List<SuiteSparse_long> newStart(1, 0), newRow;
    newStart.reserve(n + 1), newRow.reserve(n + A.nEntries() / 2);
    value.clear();
    nullSpace = constantNullSpace::of(A);
    List<scalar> pin(n, 0);
    for (const label i : nullSpace.firstRows()) pin[i] = A.diagonal[i] != 0 ? A.diagonal[i] : 1;
    for (label i = 0; i < n; ++i)
    {
        newRow.push_back(i), value.push_back(A.diagonal[i] + pin[i]);
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
            if (A.column[k] > i) newRow.push_back(A.column[k]), value.push_back(A.value[k]);
        newStart.push_back(SuiteSparse_long(newRow.size()));
    }
    const bool isNew = newStart != start || newRow != row;
    start = std::move(newStart), row = std::move(newRow);
    return isNew;
}

cholmod_sparse choleskySolver::cholmod::matrix()
{
    cholmod_sparse A = {};
    A.nrow = A.ncol = size_t(size());
    A.nzmax = row.size();
    A.p = start.data(), A.i = row.data(), A.x = value.data();
    A.stype = -1;
    A.itype = CHOLMOD_LONG, A.xtype = CHOLMOD_REAL, A.dtype = CHOLMOD_DOUBLE;
    A.packed = true;
    return A;
}

void choleskySolver::cholmod::checkStatus(const char* step) const
{
    if (common.status == CHOLMOD_OK) return;
    const word what = word("choleskySolver: ") + step + " of " + std::to_string(size()) + " rows ";
    if (common.status == CHOLMOD_NOT_POSDEF)
        throw fatalError(what + "failed: the matrix is not positive definite (column " +
                         std::to_string(factor ? factor->minor : 0) +
                         " of the reordered matrix); use luSolver for such a matrix");
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
        throw fatalError(what + "needs more memory than there is; use an iterative solver");
    throw fatalError(what + "failed with CHOLMOD status " + std::to_string(common.status));
}

void choleskySolver::factorise(const csrMatrix& A)
{
    cholmod& c = *cholmod_;
    const oneBlasThread guard;
    const bool newPattern = c.setMatrix(A);
    cholmod_sparse matrix = c.matrix();
    if (newPattern || !c.factor)
    {
        c.releaseFactor();
        c.factor = cholmod_l_analyze(&matrix, &c.common);
        c.checkStatus("the ordering");
        c.right = cholmod_l_zeros(A.size(), 1, CHOLMOD_REAL, &c.common);
    }
    cholmod_l_factorize(&matrix, c.factor, &c.common);
    c.checkStatus("the factorisation");
}

void choleskySolver::cholmod::solve()
{
    const oneBlasThread guard;
    cholmod_l_solve2(CHOLMOD_A, factor, right, nullptr, &solution, nullptr, &scratch1, &scratch2,
                     &common);
    checkStatus("the solution");
}

void choleskySolver::apply(const List<scalar>& r, List<scalar>& z) const
{
    cholmod& c = *cholmod_;
    if (label(r.size()) != c.size())
        throw fatalError("choleskySolver: a right-hand side of " + std::to_string(r.size()) +
                         " for a factor of " + std::to_string(c.size()) + " rows");
    z = r;
    c.nullSpace.project(z);
    std::copy(z.begin(), z.end(), static_cast<scalar*>(c.right->x));
    c.solve();
    const scalar* x = static_cast<const scalar*>(c.solution->x);
    z.assign(x, x + r.size());
    c.nullSpace.project(z);
}

}  // namespace ispf
