// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallShear.H"

namespace ispf
{

namespace
{

constexpr scalar reach = 3;  // [dx] of the weights (3.17): that of the fit
constexpr int sweeps = 4;    // of (3.18) (doc/constants.md)

// Facets with fluid before them
class coveredFacets
{
public:
    coveredFacets(const List<facet>& facets, const List<fluidAt>& fluid,
                  const List<structureImage>& images, scalar dx)
        : radius_(reach * dx), images_(images), grid_(radius_)
    {
        for (size_t k = 0; k < facets.size(); ++k)
            if (const scalar area = facets[k].area.norm(); fluid[k].covered && area > 0)
            {
                of_.push_back(k), area_.push_back(area), normal_.push_back(facets[k].area / area);
                grid_.add(facets[k].centre);
            }
    }

    label n() const { return grid_.size(); }
    size_t of(label k) const { return of_[k]; }  // index of facet k among all
    scalar area(label k) const { return area_[k]; }
    const vector& normal(label k) const { return normal_[k]; }
    vector tangential(label k, const vector& v) const { return v - v.dot(normal_[k]) * normal_[k]; }

    // A facet receives this share of a force, or of its image (image -1: of the force itself)
    struct part
    {
        label facet, image;
        scalar weight;
    };
    using row = List<part>;  // the parts of one force; their sum is 1, or there are none

    row rowOfFacet(label m) const { return rowOf(grid_[m], normal_[m]); }
    // Of fluid at x, on the plane of a facet that it is before
    row rowOfFluid(const vector& x, label m) const
    {
        return rowOf(x - depth(x, m) * normal_[m], normal_[m]);
    }
    // The nearest of these facets; -1: it is before none
    label before(const vector& x) const
    {
        label nearest = -1;
        scalar least = radius_;
        grid_.within(x, radius_, [&](label k, scalar r) {
            if (r < least && depth(x, k) <= 0) least = r, nearest = k;
        });
        return nearest;
    }
    // Adds the parts of a force along facet m to the facets' forces, each turned as the normal is: |force| is kept
    void spread(const row& parts, label m, const vector& force, List<vector>& forces) const
    {
        for (const part& p : parts)
        {
            const bool own = p.image < 0;
            const vector f = own ? force : vector(images_[p.image].R * force),
                         n = own ? normal_[m] : vector(images_[p.image].R * normal_[m]);
            const vector& to = normal_[p.facet];
            forces[p.facet] += p.weight * (f - f.dot(to) / (1 + n.dot(to)) * (n + to));
        }
    }

private:
    scalar depth(const vector& x, label k) const { return (x - grid_[k]).dot(normal_[k]); }

    // (3.17) at a place x of the surface with the normal n
    row rowOf(const vector& x, const vector& n) const
    {
        row parts;
        scalar sum = 0;
        const auto visit = [&](label image, const vector& at, const vector& normal) {
            grid_.within(at, radius_, [&](label k, scalar r) {
                const scalar q = r / radius_, a = (1 - q) * (1 - q);
                const scalar w = area_[k] * a * a * (1 + 4 * q) * normal_[k].dot(normal);
                if (w > 0) parts.push_back({k, image, w}), sum += w;
            });
        };
        visit(-1, x, n);
        for (label m = 0; m < label(images_.size()); ++m) visit(m, images_[m](x), images_[m].R * n);
        for (part& p : parts) p.weight /= sum;
        return parts;
    }

    scalar radius_;
    const List<structureImage>& images_;
    List<size_t> of_;
    List<vector> normal_;
    List<scalar> area_;
    pointGrid grid_;  // their centres
};

// f(k) for all k < n
template <class F>
auto forAll(label n, F&& f)
{
    List<decltype(f(label()))> all(n);
    parallelFor(n, [&](label begin, label end) {
        for (label k = begin; k < end; ++k) all[k] = f(k);
    });
    return all;
}

}  // namespace

List<vector> wallShear(const loadedBody& body, const List<facet>& facets,
                       const List<fluidAt>& fluid, const fsiCase& c, const pairFriction& friction)
{
    List<vector> tau(facets.size(), vector::Zero());
    if (body.isWall() && !friction.holds(body.name())) return tau;
    const List<structureImage> images = c.walls->images();
    const coveredFacets surface(facets, fluid, images, c.cloud.dx);
    for (label k = 0; k < surface.n(); ++k)
        tau[surface.of(k)] =
            surface.tangential(k, -viscousStress(fluid[surface.of(k)], c) * surface.normal(k));
    const List<pairFriction::share>* shares = friction.sharesOf(body);
    if (!shares) return tau;
    // (3.18)
    const auto before =
        forAll(label(shares->size()), [&](label i) { return surface.before((*shares)[i].x); });
    const auto rowsOfFluid = forAll(label(shares->size()), [&](label i) {
        return before[i] < 0 ? coveredFacets::row() : surface.rowOfFluid((*shares)[i].x, before[i]);
    });
    const auto rows = forAll(surface.n(), [&](label k) { return surface.rowOfFacet(k); });
    List<vector> missing(surface.n(), vector::Zero());
    for (size_t i = 0; i < shares->size(); ++i)
        if (before[i] >= 0)
            surface.spread(rowsOfFluid[i], before[i],
                           surface.tangential(before[i], (*shares)[i].force), missing);
    for (label k = 0; k < surface.n(); ++k)
        surface.spread(rows[k], k, -surface.area(k) * tau[surface.of(k)], missing);
    for (int sweep = 1; sweep < sweeps; ++sweep)
    {
        List<vector> wider(surface.n(), vector::Zero());
        for (label k = 0; k < surface.n(); ++k) surface.spread(rows[k], k, missing[k], wider);
        missing = std::move(wider);
    }
    for (label k = 0; k < surface.n(); ++k) tau[surface.of(k)] += missing[k] / surface.area(k);
    return tau;
}

}  // namespace ispf
