// SPDX-License-Identifier: GPL-3.0-or-later
#include "blockSums.H"

#include <algorithm>

namespace ispf
{

namespace
{

constexpr label blockSize = 2048;  // 16 kB a vector: a block of the result stays in level 1

ISPF_HOT void scaleAndAddRange(const scalar* x, scalar a, scalar* y, label n)
{
    for (label i = 0; i < n; ++i) y[i] = x[i] + a * y[i];
}

}  // namespace

List<scalar> blockSums(label n, label nSums, const std::function<void(label, label, scalar*)>& body)
{
    const label nBlocks = (n + blockSize - 1) / blockSize;
    List<scalar> partial(size_t(nBlocks) * nSums), sums(nSums, 0);
    parallelFor(
        nBlocks,
        [&](label first, label last) {
            for (label b = first; b < last; ++b)
                body(b * blockSize, std::min(n, (b + 1) * blockSize), &partial[size_t(b) * nSums]);
        },
        4);
    for (label b = 0; b < nBlocks; ++b)
        for (label k = 0; k < nSums; ++k) sums[k] += partial[size_t(b) * nSums + k];
    return sums;
}

ISPF_HOT scalar dotRange(const scalar* a, const scalar* b, label n)
{
    scalar s[8] = {};
    label i = 0;
    for (; i + 8 <= n; i += 8)
        for (int k = 0; k < 8; ++k) s[k] += a[i + k] * b[i + k];
    for (; i < n; ++i) s[0] += a[i] * b[i];
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

void scaleAndAdd(const List<scalar>& x, scalar a, List<scalar>& y)
{
    parallelFor(
        label(y.size()),
        [&](label begin, label end) { scaleAndAddRange(&x[begin], a, &y[begin], end - begin); },
        8192);
}

}  // namespace ispf
