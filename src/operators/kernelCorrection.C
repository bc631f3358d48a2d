// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernelCorrection.H"

namespace ispf
{

namespace
{

// Adds sum g (x_j - x_i)^T = -sum F d d^T over [from, to), d = x_i - x_j
ISPF_HOT void moment(const particleCloud& cloud, const neighbourList& list, label i, std::int64_t from,
                     std::int64_t to, tensor& m)
{
    simd4 cx = {}, cy = {}, cz = {};
    for (std::int64_t k = from; k < to; ++k)
    {
        const simd4 d = cloud.x[i].s - cloud.x[list.index[k]].s, fd = -list.F[k] * d;
        cx += fd * d[0], cy += fd * d[1], cz += fd * d[2];
    }
    for (int a = 0; a < 3; ++a) m(a, 0) += cx[a], m(a, 1) += cy[a], m(a, 2) += cz[a];
}

}  // namespace

void kernelCorrection::build(const particleCloud& cloud, const neighbourList& list, scalar minDetAll,
                             scalar minDetSame)
{
    const label n = cloud.n();
    all.resize(n), same.resize(n);
    List<char> poor(n, 0);
    const tensor start = vector(0, 0, cloud.nDims == 2 ? 1 : 0).asDiagonal();
    parallelFor(n,
                [&](label begin, label end)
                {
                    for (label i = begin; i < end; ++i)
                    {
                        tensor m = start;
                        moment(cloud, list, i, list.start[i], list.mid[i], m);
                        const bool poorSame = !(m.determinant() > minDetSame);
                        same[i] = poorSame ? tensor(tensor::Zero()) : tensor(m.inverse());
                        moment(cloud, list, i, list.mid[i], list.start[i + 1], m);
                        const bool poorAll = !(m.determinant() > minDetAll);
                        all[i] = poorAll ? tensor(tensor::Identity()) : tensor(m.inverse());
                        poor[i] = char(poorAll + 2 * poorSame);
                    }
                });
    nPoorAll = nPoorSame = 0;
    for (const char p : poor) nPoorAll += p & 1, nPoorSame += p >> 1;
}

}  // namespace ispf
