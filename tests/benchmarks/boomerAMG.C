// SPDX-License-Identifier: GPL-3.0-or-later
#include "boomerAMG.H"

#include "messages.H"
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>

namespace ispf
{

namespace
{

void check(HYPRE_Int error, const char* what)
{
    if (error == 0) return;
    char text[256];
    HYPRE_DescribeError(error, text);
    throw fatalError(word("hypre: ") + what + ": " + text);
}

// The rows of A in hypre's own layout, which has the diagonal among the entries
HYPRE_IJMatrix copied(const csrMatrix& A)
{
    const HYPRE_BigInt last = HYPRE_BigInt(A.size()) - 1;
    List<HYPRE_Int> length(A.size());
    for (label i = 0; i < A.size(); ++i)
        length[i] = HYPRE_Int(A.rowStart[i + 1] - A.rowStart[i]) + 1;
    HYPRE_IJMatrix copy = nullptr;
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, last, 0, last, &copy);
    HYPRE_IJMatrixSetObjectType(copy, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(copy, length.data());
    HYPRE_IJMatrixInitialize(copy);
    List<HYPRE_BigInt> columns;
    List<scalar> values;
    for (label i = 0; i < A.size(); ++i)
    {
        const label begin = A.rowStart[i], end = A.rowStart[i + 1];
        const HYPRE_BigInt row = HYPRE_BigInt(i);
        columns.assign(A.column.begin() + begin, A.column.begin() + end);
        values.assign(A.value.begin() + begin, A.value.begin() + end);
        columns.push_back(row), values.push_back(A.diagonal[i]);
        HYPRE_IJMatrixSetValues(copy, 1, &length[i], &row, columns.data(), values.data());
    }
    check(HYPRE_IJMatrixAssemble(copy), "the matrix");
    return copy;
}

HYPRE_IJVector zeroVector(label n)
{
    HYPRE_IJVector v = nullptr;
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, HYPRE_BigInt(n) - 1, &v);
    HYPRE_IJVectorSetObjectType(v, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(v);
    HYPRE_IJVectorAssemble(v);
    return v;
}

}  // namespace

boomerAMG::boomerAMG(const csrMatrix& A, const options& chosen)
    : A_(copied(A)), r_(zeroVector(A.size())), z_(zeroVector(A.size()))
{
    HYPRE_IJMatrixGetObject(A_, reinterpret_cast<void**>(&parA_));
    HYPRE_IJVectorGetObject(r_, reinterpret_cast<void**>(&parR_));
    HYPRE_IJVectorGetObject(z_, reinterpret_cast<void**>(&parZ_));
    HYPRE_BoomerAMGCreate(&solver_);
    HYPRE_BoomerAMGSetStrongThreshold(solver_, chosen.strongThreshold);
    HYPRE_BoomerAMGSetAggNumLevels(solver_, chosen.aggressiveLevels);
    HYPRE_BoomerAMGSetMaxIter(solver_, 1);
    HYPRE_BoomerAMGSetTol(solver_, 0);
    check(HYPRE_BoomerAMGSetup(solver_, parA_, parR_, parZ_), "set-up");
}

boomerAMG::~boomerAMG()
{
    HYPRE_BoomerAMGDestroy(solver_);
    HYPRE_IJVectorDestroy(z_);
    HYPRE_IJVectorDestroy(r_);
    HYPRE_IJMatrixDestroy(A_);
}

void boomerAMG::apply(const List<scalar>& r, List<scalar>& z) const
{
    const HYPRE_Int n = HYPRE_Int(r.size());
    std::fill(z.begin(), z.end(), 0.0);
    HYPRE_IJVectorSetValues(r_, n, nullptr, r.data());
    HYPRE_IJVectorSetValues(z_, n, nullptr, z.data());
    check(HYPRE_BoomerAMGSolve(solver_, parA_, parR_, parZ_), "a cycle");
    HYPRE_IJVectorGetValues(z_, n, nullptr, z.data());
}

}  // namespace ispf
