// SPDX-License-Identifier: GPL-3.0-or-later
#include "krylovSolver.H"

#include "execution.H"

namespace ispf
{

void residual(const linearOperator& A, const List<scalar>& b, const List<scalar>& x,
              List<scalar>& r)
{
    A.apply(x, r);
    scaleAndAdd(b, -1, r);
}

}  // namespace ispf
