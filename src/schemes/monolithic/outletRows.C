// SPDX-License-Identifier: GPL-3.0-or-later
#include "outletRows.H"

namespace ispf
{

void outletRows::setup(const particleCloud& cloud, const List<outletLink>& links, scalar s)
{
    strips_.clear(), s_ = s;
    unknown_.assign(links.empty() ? 0 : cloud.n(), 0);
    for (const outletLink& link : links)
    {
        strip own{link, s / (1 + link.slope * link.area * s), {}};
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (const label k = cloud.stripOf(i); k >= link.first && k < link.end && cloud.pHeld(i))
                own.particles.push_back(i), unknown_[i] = 1;
        strips_.push_back(std::move(own));
    }
}

scalar outletRows::flow(const particleCloud& cloud, const strip& of, const List<scalar>& continuity)
{
    scalar sum = 0;
    for (const label i : of.particles) sum -= cloud.volume() * continuity[i];
    return sum;
}

// In the places of the strip: p_i becomes s (p_i - <p>) + w (<p> - R q), with the mean <p> of the strip
void outletRows::replace(const strip& of, scalar q, List<scalar>& rows) const
{
    scalar mean = 0;
    for (const label i : of.particles) mean += rows[4 * i + 3] / scalar(of.particles.size());
    for (const label i : of.particles)
        rows[4 * i + 3] = s_ * (rows[4 * i + 3] - mean) + of.weight * (mean - of.link.slope * q);
}

void outletRows::apply(const particleCloud& cloud, const List<scalar>& continuity,
                       List<scalar>& y) const
{
    for (const strip& own : strips_) replace(own, flow(cloud, own, continuity), y);
}

void outletRows::rightHandSide(const particleCloud& cloud, const List<scalar>& known,
                               List<scalar>& b) const
{
    for (const strip& own : strips_) replace(own, own.link.flow - flow(cloud, own, known), b);
}

void outletRows::precondition(List<vec4>& phi) const
{
    for (const strip& own : strips_)
        for (const label i : own.particles) phi[i][3] /= s_;
}

}  // namespace ispf
