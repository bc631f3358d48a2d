// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphc.H"
#include "pairSums.H"

#include <algorithm>

namespace ispf
{

namespace
{

constexpr simd4 withoutPressure = {1, 1, 1, 0};
constexpr scalar singular = 0.02;  // determinant of a correction moment

// Neighbours of other phases
ISPF_INLINE void addOthers(pairSums& sums, const stencil& s, const vec4* phi, label i)
{
    for (std::int64_t k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
    {
        const label j = s.list.index[k];
        const simd4 g = s.list.F[k] * (s.cloud.x[i].s - s.cloud.x[j].s);
        simd4 e = phi[j].s - phi[i].s;
        if (s.cloud.phase[j] == phaseType::rigid) e *= withoutPressure;
        sums.gx += e * g[0], sums.gy += e * g[1], sums.gz += e * g[2];
        sums.lap += s.list.F[k] * e;
    }
}

ISPF_INLINE pairSums rowSums(const stencil& s, const vec4* phi, label i, pairFilter filter)
{
    pairSums sums;
    sums.add(s.list, s.cloud.x.data(), phi, i, s.list.start[i], s.list.mid[i]);
    if (filter == pairFilter::all) addOthers(sums, s, phi, i);
    return sums;
}

ISPF_HOT void divRange(const stencil& s, const vec4* phi, const tensor* B, pairFilter filter,
                       label begin, label end, scalar* result)
{
    const tensor one = tensor::Identity();
    for (label i = begin; i < end; ++i)
        result[i] = rowSums(s, phi, i, filter).divergence(B ? B[i] : one);
}

// c: laplacianScale.  A wall pair takes the row's own.
ISPF_HOT void laplacianRange(const stencil& s, const vec4* phi, const scalar* c, pairFilter filter,
                             label begin, label end, vec4* result)
{
    const label* index = s.list.index.data();
    for (label i = begin; i < end; ++i)
    {
        const simd4 own = phi[i].s;
        simd4 sum = {};
        for (std::int64_t k = s.list.start[i]; k < s.list.mid[i]; ++k)
            sum += s.cloud.friction(i, index[k]) * sphc::viscousF(s.cloud, s.list, k) *
                   (c[i] + c[index[k]]) * (own - phi[index[k]].s);
        const std::int64_t last = filter == pairFilter::all ? s.list.start[i + 1] : s.list.mid[i];
        for (std::int64_t k = s.list.mid[i]; k < last; ++k)
        {
            const label j = index[k];
            const bool rigid = s.cloud.phase[j] == phaseType::rigid;
            sum += s.cloud.friction(i, j) * sphc::viscousF(s.cloud, s.list, k) *
                   (c[i] + (rigid ? c[i] : c[j])) * (own - phi[j].s);
        }
        result[i].s = sum;
    }
}

struct others
{
    bool rigid = false, deforming = false;
};

others otherPhases(const stencil& s, label i)
{
    others o;
    for (std::int64_t k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
        (s.cloud.phase[s.list.index[k]] == phaseType::rigid ? o.rigid : o.deforming) = true;
    return o;
}

// Correction from the neighbours that carry a pressure.  Only a row that sees solids and walls at
// once has it neither in B.all nor in B.same.
tensor pressureCorrection(const stencil& s, label i)
{
    const others o = otherPhases(s, i);
    if (!o.rigid) return s.B.all[i];
    if (!o.deforming) return s.B.same[i];
    tensor m = vector(0, 0, s.cloud.nDims == 2 ? 1 : 0).asDiagonal();
    for (std::int64_t k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
    {
        const label j = s.list.index[k];
        if (s.cloud.phase[j] == phaseType::rigid) continue;
        const vector d = s.cloud.x[i].xyz() - s.cloud.x[j].xyz();
        m -= s.list.F[k] * d * d.transpose();
    }
    return m.determinant() > singular ? tensor(m.inverse()) : s.B.same[i];
}

// The correction as it would be if images behind curved walls had the volume of what they are images of
tensor viscousCorrection(const stencil& s, label i)
{
    tensor m = vector(0, 0, s.cloud.nDims == 2 ? 1 : 0).asDiagonal();
    bool stretched = false;
    for (std::int64_t k = s.list.start[i]; k < s.list.start[i + 1]; ++k)
    {
        const vector d = s.cloud.x[i].xyz() - s.cloud.x[s.list.index[k]].xyz();
        const scalar F = sphc::viscousF(s.cloud, s.list, k);
        stretched = stretched || F != s.list.F[k];
        m -= F * d * d.transpose();
    }
    return stretched && m.determinant() > singular ? tensor(m.inverse()) : s.B.all[i];
}

// sum g_ij over all neighbours
vector surfaceVector(const stencil& s, label i, pairFilter filter)
{
    const std::int64_t end = filter == pairFilter::all ? s.list.start[i + 1] : s.list.mid[i];
    simd4 sum = {};
    for (std::int64_t k = s.list.start[i]; k < end; ++k)
        sum += s.list.F[k] * (s.cloud.x[i].s - s.cloud.x[s.list.index[k]].s);
    return {sum[0], sum[1], sum[2]};
}

ISPF_HOT void gradRange(const stencil& s, const vec4* phi, pairFilter filter, label begin,
                        label end, vec4* result)
{
    for (label i = begin; i < end; ++i)
        result[i] = vec4::from(rowSums(s, phi, i, filter).gradient(3));
}

void correct(const stencil& s, pairFilter filter, label begin, label end, vec4* grad)
{
    for (label i = begin; i < end; ++i)
        grad[i].setXyz((filter == pairFilter::all ? pressureCorrection(s, i) : s.B.same[i]) *
                       grad[i].xyz());
}

void symmetrise(const stencil& s, const vec4* phi, pairFilter filter, label begin, label end,
                vec4* grad)
{
    for (label i = begin; i < end; ++i)
        grad[i].setXyz(grad[i].xyz() + 2 * phi[i][3] * surfaceVector(s, i, filter));
}

}  // namespace

List<scalar> sphc::div(const stencil& s, const List<vec4>& phi, divergenceScheme scheme,
                       pairFilter filter)
{
    const List<tensor>& B = filter == pairFilter::all ? s.B.all : s.B.same;
    const tensor* correction = scheme == divergenceScheme::corrected ? B.data() : nullptr;
    List<scalar> result(s.cloud.n());
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        divRange(s, phi.data(), correction, filter, begin, end, result.data());
    });
    return result;
}

namespace
{

bool seesRigid(const stencil& s, label i)
{
    for (std::int64_t k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
        if (s.cloud.phase[s.list.index[k]] == phaseType::rigid) return true;
    return false;
}

// grad u of the row's own phase, row: component
tensor ownGradient(const stencil& s, const vec4* u, label i)
{
    const pairSums sums = rowSums(s, u, i, pairFilter::samePhase);
    tensor grad;
    for (int a = 0; a < 3; ++a) grad.row(a) = (s.B.same[i] * sums.gradient(a)).transpose();
    return grad;
}

// sum_j B_i : e_j (x) g_ij with e_j of change whole, of u without what sticks
scalar reflectionAt(const stencil& s, const vec4* change, const vec4* u, const tensor& B, label i)
{
    const tensor grad = ownGradient(s, u, i);
    scalar sum = 0;
    for (std::int64_t k = s.list.mid[i]; k < s.list.start[i + 1]; ++k)
    {
        const label j = s.list.index[k];
        if (s.cloud.phase[j] != phaseType::rigid) continue;
        const vector way = s.cloud.x[i].xyz() - s.cloud.x[j].xyz();
        const vec4& depth = s.cloud.ghostDepth(j);
        vector e = u[j].xyz() - u[i].xyz(), changeI = change[i].xyz();
        if (depth[3] > 0)
        {
            const vector n = depth.xyz();
            const scalar d = std::max(n.dot(way) - depth[3], 0.0),
                         along = grad.trace() - n.dot(grad * n);
            e = (n.dot(e) - 0.5 * d * along) * n;
            changeI = n.dot(changeI) * n;
        }
        e += change[j].xyz() - changeI;
        sum += s.list.F[k] * e.dot(B * way);
    }
    return sum;
}

}  // namespace

List<scalar> sphc::wallReflection(const stencil& s, const List<vec4>& change, const List<vec4>& u,
                                  divergenceScheme scheme)
{
    List<scalar> result(s.cloud.n(), 0);
    if (!s.cloud.hasRigid()) return result;
    const tensor one = tensor::Identity();
    const bool corrected = scheme == divergenceScheme::corrected;
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            if (seesRigid(s, i))
                result[i] =
                    reflectionAt(s, change.data(), u.data(), corrected ? s.B.all[i] : one, i);
    });
    return result;
}

List<vec4> sphc::grad(const stencil& s, const List<vec4>& phi, gradientScheme scheme,
                      pairFilter filter)
{
    List<vec4> result(s.cloud.n());
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        gradRange(s, phi.data(), filter, begin, end, result.data());
        if (scheme == gradientScheme::correctedDifference)
            correct(s, filter, begin, end, result.data());
        if (scheme == gradientScheme::symmetric)
            symmetrise(s, phi.data(), filter, begin, end, result.data());
    });
    return result;
}

List<scalar> sphc::gradSquaredTrace(const stencil& s, const List<vec4>& phi)
{
    List<scalar> result(s.cloud.n());
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const pairSums sums = rowSums(s, phi.data(), i, pairFilter::all);
            tensor gradU;
            for (int a = 0; a < 3; ++a) gradU.row(a) = (s.B.all[i] * sums.gradient(a)).transpose();
            result[i] = (gradU * gradU).trace();
        }
    });
    return result;
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
        if (cloud.ghostSource(g) >= 0) c[g] = c[cloud.ghostSource(g)];
    return c;
}

List<vec4> sphc::laplacian(const stencil& s, const List<vec4>& phi, pairFilter filter)
{
    return laplacian(s, phi, laplacianScale(s), filter);
}

List<vec4> sphc::laplacian(const stencil& s, const List<vec4>& phi, const List<scalar>& c,
                           pairFilter filter)
{
    List<vec4> result(s.cloud.n());
    parallelFor(s.cloud.n(), [&](label begin, label end) {
        laplacianRange(s, phi.data(), c.data(), filter, begin, end, result.data());
    });
    return result;
}

}  // namespace ispf
