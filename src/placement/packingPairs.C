// SPDX-License-Identifier: GPL-3.0-or-later
#include "packingPairs.H"

namespace ispf
{

void packingPairs::refresh(const List<packedParticle>& particles)
{
    if (!stillGood(particles)) build(particles);
    for (size_t i = 0; i < particles.size(); ++i) x_[i] = particles[i].x;
    for (size_t k = 0; k < images_.size(); ++k)
        x_[particles.size() + k] =
            geometry_.symmetryPlanes()[images_[k].plane].mirror(x_[images_[k].source]);
}

bool packingPairs::stillGood(const List<packedParticle>& particles) const
{
    if (xAtBuild_.size() != particles.size()) return false;
    const scalar far = 0.25 * margin_ * margin_;
    // only zone particles must be exact: the others just drift
    for (size_t i = 0; i < particles.size(); ++i)
        if (particles[i].where == packedParticle::place::zone &&
            (particles[i].x - xAtBuild_[i]).squaredNorm() > far)
            return false;
    return true;
}

void packingPairs::build(const List<packedParticle>& particles)
{
    const scalar reach = support_ + margin_;
    x_.clear(), images_.clear(), xAtBuild_.clear();
    for (const packedParticle& p : particles) x_.push_back(p.x);
    xAtBuild_ = x_;
    for (size_t p = 0; p < geometry_.symmetryPlanes().size(); ++p)
        for (size_t i = 0, n = x_.size(); i < n; ++i)
            if (geometry_.symmetryPlanes()[p].distance(x_[i]) > -reach)
            {
                x_.push_back(geometry_.symmetryPlanes()[p].mirror(x_[i]));
                images_.push_back({label(i), label(p)});
            }
    const cellList cells(x_, 0.5 * reach);
    const label n = label(particles.size());
    start_.assign(n + 1, 0);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
            cells.near(x_[i], reach, [&](label j, scalar) { start_[i + 1] += j != i; });
    });
    for (label i = 0; i < n; ++i) start_[i + 1] += start_[i];
    // one entry more, so that the address of an empty last row exists
    index_.resize(start_[n] + 1);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            std::int64_t k = start_[i];
            cells.near(x_[i], reach, [&](label j, scalar) {
                if (j != i) index_[k++] = j;
            });
        }
    });
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
