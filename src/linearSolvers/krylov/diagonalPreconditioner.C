// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagonalPreconditioner.H"

#include "messages.H"
#include "execution.H"

namespace ispf
{

namespace
{

ISPF_HOT void multiplyRange(label n, const scalar* a, const scalar* b, scalar* product)
{
    for (label i = 0; i < n; ++i) product[i] = a[i] * b[i];
}

}  // namespace

diagonalPreconditioner::diagonalPreconditioner(const csrMatrix& A) : inverse_(A.diagonal)
{
    for (label i = 0; i < A.size(); ++i)
    {
        if (inverse_[i] == 0)
            throw fatalError("diagonalPreconditioner: the diagonal of row " + std::to_string(i) +
                             " is zero; choose preconditioner none");
        inverse_[i] = 1 / inverse_[i];
    }
}

void diagonalPreconditioner::apply(const List<scalar>& r, List<scalar>& z) const
{
    parallelFor(
        label(r.size()),
        [&](label i, label e) { multiplyRange(e - i, &inverse_[i], &r[i], &z[i]); }, 8192);
}

}  // namespace ispf
