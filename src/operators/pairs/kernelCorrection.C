// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernelCorrection.H"

namespace ispf
{

namespace
{

// Adds sum g (x_j - x_i)^T = -sum F d d^T over the neighbours in `row`, d = x_i - x_j
ISPF_HOT void moment(const particleCloud& cloud, const neighbourList& list, label i, pairRange row,
                     tensor& m)
{
    simd4 cx = {}, cy = {}, cz = {};
    forNeighbours(list, row, [&](pairIndex k, label j) {
        const simd4 d = cloud.x[i].s - cloud.x[j].s, fd = -list.F[k] * d;
        cx += fd * d[0], cy += fd * d[1], cz += fd * d[2];
    });
    for (int a = 0; a < 3; ++a) m(a, 0) += cx[a], m(a, 1) += cy[a], m(a, 2) += cz[a];
}

// M^-1 with the eigenvalues of M raised to `least`.  Few neighbours are left beside edges and thin plates: there
// the plain inverse would enlarge the errors of few differences
tensor boundedInverse(const tensor& M, scalar least, char& bounded)
{
    if (M.determinant() > 0.25) return M.inverse();  // no eigenvalue near zero: all are about 1
    const Eigen::SelfAdjointEigenSolver<tensor> e(M);
    bounded = e.eigenvalues()[0] < least;
    return e.eigenvectors() * e.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
           e.eigenvectors().transpose();
}

}  // namespace

void kernelCorrection::build(const particleCloud& cloud, const neighbourList& list,
                             scalar leastEigenvalue)
{
    const label n = cloud.n();
    all.resize(n), same.resize(n);
    List<char> poorAll(n, 0), poorSame(n, 0);
    const tensor start = vector(0, 0, cloud.nDims == 2 ? 1 : 0).asDiagonal();
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            tensor m = start;
            moment(cloud, list, i, rowOf<among::same>(list, i), m);
            same[i] = boundedInverse(m, leastEigenvalue, poorSame[i]);
            moment(cloud, list, i, rowOf<among::others>(list, i), m);
            all[i] = boundedInverse(m, leastEigenvalue, poorAll[i]);
        }
    });
    countPairs(list.nPairs(), sizeof(label) + sizeof(scalar));
    nPoorAll = nPoorSame = 0;
    for (label i = 0; i < n; ++i) nPoorAll += poorAll[i], nPoorSame += poorSame[i];
}

tensor kernelCorrection::inverse(const tensor& moment, scalar leastEigenvalue)
{
    char bounded = 0;
    return boundedInverse(moment, leastEigenvalue, bounded);
}

tensor kernelCorrection::of(const particleCloud& cloud, const neighbourList& list, label i,
                            pairRange row, scalar leastEigenvalue)
{
    tensor m = vector(0, 0, cloud.nDims == 2 ? 1 : 0).asDiagonal();
    moment(cloud, list, i, row, m);
    return inverse(m, leastEigenvalue);
}

List<tensor> kernelCorrection::from(const particleCloud& cloud, const neighbourList& list,
                                    const List<std::int64_t>& end, scalar leastEigenvalue)
{
    List<tensor> B(cloud.n());
    parallelFor(cloud.n(), [&](label from, label to) {
        for (label i = from; i < to; ++i)
            B[i] = of(cloud, list, i, {list.start[i], end[i]}, leastEigenvalue);
    });
    return B;
}

medium medium::fluid(const particleCloud& cloud, const neighbourList& list,
                     const kernelCorrection& B)
{
    return {cloud.nSolid(), &list.mid, B.same};
}

medium medium::all(const particleCloud& cloud, const neighbourList& list, const kernelCorrection& B)
{
    if (cloud.nSolid() == 0) return fluid(cloud, list, B);
    return {0, &list.wall, kernelCorrection::from(cloud, list, list.wall)};
}

}  // namespace ispf
