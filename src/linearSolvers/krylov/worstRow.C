// SPDX-License-Identifier: GPL-3.0-or-later
#include "worstRow.H"

#include <cmath>

namespace ispf
{

label worstRow(const linearOperator& A, const List<scalar>& b, const List<scalar>& x)
{
    List<scalar> Ax(b.size());
    A.apply(x, Ax);
    label worst = 0;
    scalar most = -1;
    for (label i = 0; i < label(b.size()); ++i)
    {
        const scalar r = std::abs(b[i] - Ax[i]);
        // a row that is not finite spoils the rows of its neighbours, so the right-hand side is tested first
        if (!std::isfinite(b[i])) return i;
        if (most < HUGE_VAL && !(r <= most)) worst = i, most = std::isfinite(r) ? r : HUGE_VAL;
    }
    return worst;
}

}  // namespace ispf
