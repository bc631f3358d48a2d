// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphc.H"
#include "pairSums.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar singular = 0.02;  // least determinant of a correction's moment matrix

// The correction that i would have if images behind curved walls had the volume of their sources
tensor viscousCorrection(const stencil& s, label i)
{
    tensor m = vector(0, 0, s.cloud.nDims == 2 ? 1 : 0).asDiagonal();
    bool stretched = false;
    forNeighbours<among::all>(s.list, i, [&](pairIndex k, label j) {
        const vector d = s.cloud.x[i].xyz() - s.cloud.x[j].xyz();
        const scalar F = sphc::viscousF(s.cloud, s.list, k);
        stretched = stretched || F != s.list.F[k];
        m -= F * d * d.transpose();
    });
    return stretched && m.determinant() > singular ? tensor(m.inverse()) : s.B.all[i];
}

// value(grad u) per owned particle; factor(i, j) of phi_j - phi_i
template <class Factor, class Value>
List<scalar> fromGradient(const stencil& s, const List<vec4>& phi, const Factor& factor,
                          const Value& value)
{
    List<scalar> result(s.cloud.n());
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            pairSums sums;
            sums.add(s.list, s.cloud.x.data(), phi.data(), i, rowOf<among::all>(s.list, i),
                     [&](label j) { return factor(i, j); });
            tensor gradU;
            for (int a = 0; a < 3; ++a) gradU.row(a) = (s.B.all[i] * sums.gradient(a)).transpose();
            result[i] = value(gradU);
        }
    });
    return result;
}

}  // namespace

List<scalar> sphc::gradSquaredTrace(const stencil& s, const List<vec4>& phi)
{
    return fromGradient(
        s, phi, [](label, label) { return 1.; },
        [](const tensor& gradU) { return (gradU * gradU).trace(); });
}

List<scalar> sphc::shearRate(const stencil& s, const List<vec4>& phi)
{
    return fromGradient(
        s, phi, [&](label i, label j) { return s.cloud.goesOn(i, j); },
        [](const tensor& gradU) { return std::sqrt(0.5) * (gradU + gradU.transpose()).norm(); });
}

List<scalar> sphc::laplacianScale(const stencil& s)
{
    const particleCloud& cloud = s.cloud;
    const scalar flat = cloud.nDims == 2 ? 1 : 0;
    List<scalar> c(cloud.nAll(), 1);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const tensor& B = s.B.all[i];
            const scalar trace = cloud.stretched() ? viscousCorrection(s, i).trace() : B.trace();
            c[i] = std::clamp((trace - flat) / cloud.nDims, 0.9, 1.1);
        }
    });
    for (label g = cloud.n(); g < cloud.nAll(); ++g)
        c[g] = cloud.ghostSource(g) >= 0 ? c[cloud.ghostSource(g)] : 0;
    return c;
}

}  // namespace ispf
