// SPDX-License-Identifier: GPL-3.0-or-later
#include "packingPairs.H"

#include "smoothingKernel.H"

namespace ispf
{

namespace
{

constexpr label lanes = 8;  // number of partial sums that run side by side

// Separations of the pairs of one row, with zeros up to full lanes
struct rowBuffer
{
    explicit rowBuffer(label longest)
    {
        for (List<scalar>* list : {&x, &y, &z, &f}) list->resize(longest + lanes);
    }
    List<scalar> x, y, z, f;
};

// Sets the separations x, y, z of row i, and returns its length
ISPF_INLINE label gather(const packingRows& rows, label i, scalar* x, scalar* y, scalar* z)
{
    const simd4 own = rows.x[i].s;
    label n = 0;
    forNeighbours<among::all>(rows, i, [&](pairIndex, label j) {
        const simd4 d = own - rows.x[j].s;
        x[n] = d[0], y[n] = d[1], z[n] = d[2], ++n;
    });
    return n;
}

ISPF_INLINE scalar total(const scalar* s)
{
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

ISPF_HOT void sumRange(const packingRows& rows, packingKernel kernel, label begin, label end,
                       rowBuffer& work, scalar* result)
{
    scalar *x = work.x.data(), *y = work.y.data(), *z = work.z.data(), *f = work.f.data();
    for (label i = begin; i < end; ++i)
    {
        const label n = gather(rows, i, x, y, z);
        for (label k = 0; k < n; ++k)
            f[k] = kernel.W(std::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]));
        for (label k = n; k % lanes != 0; ++k) f[k] = 0;
        scalar s[lanes] = {};
        for (label k = 0; k < n; k += lanes)
            for (label l = 0; l < lanes; ++l) s[l] += f[k + l];
        result[i - begin] = kernel.W0 + total(s);
    }
}

ISPF_HOT void repulsionRange(const packingRows& rows, packingKernel a, packingKernel b, label begin,
                             label end, rowBuffer& work, vector* result)
{
    scalar *x = work.x.data(), *y = work.y.data(), *z = work.z.data(), *f = work.f.data();
    for (label i = begin; i < end; ++i)
    {
        const label n = gather(rows, i, x, y, z);
        for (label k = 0; k < n; ++k)
        {
            const scalar r = std::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]);
            f[k] = a.F(r) + b.F(r);
        }
        for (label k = n; k % lanes != 0; ++k) x[k] = y[k] = z[k] = f[k] = 0;
        scalar u[lanes] = {}, v[lanes] = {}, w[lanes] = {};
        for (label k = 0; k < n; k += lanes)
            for (label l = 0; l < lanes; ++l)
            {
                u[l] += f[k + l] * x[k + l];
                v[l] += f[k + l] * y[k + l];
                w[l] += f[k + l] * z[k + l];
            }
        result[i - begin] = {total(u), total(v), total(w)};
    }
}

}  // namespace

packingKernel::packingKernel(int nDims, scalar support, scalar factor) : perSupport(1 / support)
{
    const auto kernel = smoothingKernel::New("WendlandC2", nDims, support / 2);
    const scalar here = 0;
    W0 = factor * kernel->W(0);
    kernel->F(&here, &F0, 1);
    F0 *= factor;
}

packingKernel packingKernel::shares(const zoneGeometry& geometry, scalar support)
{
    const scalar dx = geometry.dx();
    const auto kernel = smoothingKernel::New("WendlandC2", geometry.nDims(), support / 2);
    return {geometry.nDims(), support, std::pow(dx, geometry.nDims()) / kernel->latticeSum(dx)};
}

void packingPairs::sums(const packingKernel& kernel, label begin, label end, scalar* sum) const
{
    rowBuffer work(rows_.longest);
    sumRange(rows_, kernel, begin, end, work, sum);
}

void packingPairs::repulsion(const packingKernel& a, const packingKernel& b, label begin, label end,
                             vector* sum) const
{
    rowBuffer work(rows_.longest);
    repulsionRange(rows_, a, b, begin, end, work, sum);
}

bool packingPairs::refresh(const List<packedParticle>& particles)
{
    const bool anew = !stillGood(particles);
    if (anew) build(particles);
    for (size_t i = 0; i < particles.size(); ++i) rows_.x[i].setXyz(particles[i].x);
    for (size_t k = 0; k < images_.size(); ++k)
        rows_.x[particles.size() + k].setXyz(
            geometry_.symmetryPlanes()[images_[k].plane].mirror(rows_.x[images_[k].source].xyz()));
    return anew;
}

bool packingPairs::stillGood(const List<packedParticle>& particles) const
{
    if (xAtBuild_.size() != particles.size()) return false;
    // only zone particles must be exact: the others just drift
    for (size_t i = 0; i < particles.size(); ++i)
        if (particles[i].where == packedParticle::place::zone &&
            (particles[i].x - xAtBuild_[i]).squaredNorm() > margin_ * margin_)
            return false;
    return true;
}

void packingPairs::build(const List<packedParticle>& particles)
{
    const scalar reach = support_ + margin_;
    List<vector> x;
    images_.clear();
    for (const packedParticle& p : particles) x.push_back(p.x);
    xAtBuild_ = x;
    for (size_t p = 0; p < geometry_.symmetryPlanes().size(); ++p)
        for (size_t i = 0, n = x.size(); i < n; ++i)
            if (geometry_.symmetryPlanes()[p].distance(x[i]) > -reach)
            {
                x.push_back(geometry_.symmetryPlanes()[p].mirror(x[i]));
                images_.push_back({label(i), label(p)});
            }
    const cellList cells(x, 0.5 * reach);
    const label n = label(particles.size());
    rows_.start.assign(n + 1, 0);
    const auto parts = parallelParts(n, [&](label begin, label end) {
        List<label> index;
        for (label i = begin; i < end; ++i)
        {
            const size_t before = index.size();
            cells.near(x[i], reach, [&](label j, scalar) {
                if (j != i) index.push_back(j);
            });
            rows_.start[i + 1] = std::int64_t(index.size() - before);
        }
        return index;
    });
    rows_.longest = label(*std::max_element(rows_.start.begin(), rows_.start.end()));
    for (label i = 0; i < n; ++i) rows_.start[i + 1] += rows_.start[i];
    rows_.index.clear();
    rows_.index.reserve(rows_.start[n]);
    for (const List<label>& part : parts)
        rows_.index.insert(rows_.index.end(), part.begin(), part.end());
    rows_.x.assign(x.size(), vec4{});
}

List<vector> withImagePoints(const List<packedParticle>& particles, const zoneGeometry& geometry,
                             scalar support)
{
    List<vector> x;
    for (const packedParticle& p : particles) x.push_back(p.x);
    for (const halfSpace& plane : geometry.symmetryPlanes())
        for (size_t i = 0, n = x.size(); i < n; ++i)
            if (plane.distance(x[i]) > -support) x.push_back(plane.mirror(x[i]));
    return x;
}

}  // namespace ispf
