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

}  // namespace

void kernelCorrection::build(const particleCloud& cloud, const neighbourList& list,
                             scalar leastEigenvalue)
{
    const label n = cloud.n();
    all.resize(n), same.resize(n);
    const tensor start = vector(0, 0, cloud.nDims == 2 ? 1 : 0).asDiagonal();
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            tensor m = start;
            moment(cloud, list, i, rowOf<among::same>(list, i), m);
            same[i] = inverse(m, leastEigenvalue);
            moment(cloud, list, i, rowOf<among::others>(list, i), m);
            all[i] = inverse(m, leastEigenvalue);
        }
    });
    countPairs(list.nPairs(), sizeof(label) + sizeof(scalar));
}

tensor kernelCorrection::inverse(const tensor& moment, scalar leastEigenvalue)
{
    if (moment.determinant() > 0.25) return moment.inverse();  // all eigenvalues are about 1
    const Eigen::SelfAdjointEigenSolver<tensor> e(moment);
    return e.eigenvectors() *
           e.eigenvalues().cwiseMax(leastEigenvalue).cwiseInverse().asDiagonal() *
           e.eigenvectors().transpose();
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
