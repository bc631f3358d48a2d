// SPDX-License-Identifier: GPL-3.0-or-later
#include "luSolver.H"

#include "messages.H"
#include "oneBlasThread.H"
#include <algorithm>
#include <umfpack.h>

namespace ispf
{

struct luSolver::umfpack
{
    List<SuiteSparse_long> start, column;  // by rows, sorted, the diagonal included
    List<scalar> value;
    void* symbolic = nullptr;
    void* numeric = nullptr;

    ~umfpack() { release(); }
    void release()
    {
        umfpack_dl_free_symbolic(&symbolic);
        umfpack_dl_free_numeric(&numeric);
    }

    SuiteSparse_long size() const { return SuiteSparse_long(start.size()) - 1; }
    bool setMatrix(const csrMatrix& A);
    void checkStatus(SuiteSparse_long status, const char* step) const;
};

luSolver::luSolver() : umfpack_(std::make_unique<umfpack>()) {}
luSolver::~luSolver() = default;

// True if the pattern has changed
bool luSolver::umfpack::setMatrix(const csrMatrix& A)
{
    List<SuiteSparse_long> newStart(1, 0), newColumn;
    newColumn.reserve(A.size() + A.nEntries());
    value.clear();
    List<std::pair<label, scalar>> row;
    for (label i = 0; i < A.size(); ++i)
    {
        row.assign(1, {i, A.diagonal[i]});
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
            row.emplace_back(A.column[k], A.value[k]);
        std::sort(row.begin(), row.end());
        for (const auto& [j, v] : row) newColumn.push_back(j), value.push_back(v);
        newStart.push_back(SuiteSparse_long(newColumn.size()));
    }
    const bool isNew = newStart != start || newColumn != column;
    start = std::move(newStart), column = std::move(newColumn);
    return isNew;
}

void luSolver::umfpack::checkStatus(SuiteSparse_long status, const char* step) const
{
    if (status == UMFPACK_OK) return;
    const word what = word("luSolver: ") + step + " of " + std::to_string(size()) + " rows ";
    if (status == UMFPACK_WARNING_singular_matrix)
        throw fatalError(what +
                         "failed: the matrix is singular; hold the unknowns that nothing "
                         "determines (a pressure constant, an empty row)");
    if (status == UMFPACK_ERROR_out_of_memory)
        throw fatalError(what + "needs more memory than there is; use an iterative solver");
    throw fatalError(what + "failed with UMFPACK status " + std::to_string(status));
}

void luSolver::factorise(const csrMatrix& A)
{
    umfpack& u = *umfpack_;
    const oneBlasThread guard;
    if (u.setMatrix(A) || !u.symbolic)
    {
        u.release();
        u.checkStatus(umfpack_dl_symbolic(u.size(), u.size(), u.start.data(), u.column.data(),
                                          u.value.data(), &u.symbolic, nullptr, nullptr),
                      "the ordering");
    }
    umfpack_dl_free_numeric(&u.numeric);
    u.checkStatus(umfpack_dl_numeric(u.start.data(), u.column.data(), u.value.data(), u.symbolic,
                                     &u.numeric, nullptr, nullptr),
                  "the factorisation");
}

void luSolver::apply(const List<scalar>& r, List<scalar>& z) const
{
    const umfpack& u = *umfpack_;
    if (SuiteSparse_long(r.size()) != u.size())
        throw fatalError("luSolver: a right-hand side of " + std::to_string(r.size()) +
                         " for a factor of " + std::to_string(u.size()) + " rows");
    const oneBlasThread guard;
    // The columns of UMFPACK are the rows of A, so its transposed system is that of A
    u.checkStatus(umfpack_dl_solve(UMFPACK_Aat, u.start.data(), u.column.data(), u.value.data(),
                                   z.data(), r.data(), u.numeric, nullptr, nullptr),
                  "the solution");
}

}  // namespace ispf
