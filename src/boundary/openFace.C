// SPDX-License-Identifier: GPL-3.0-or-later
#include "openFace.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Two unit vectors across n; in two dimensions one in the plane
List<vector> tangents(const vector& n, int nDims)
{
    if (nDims == 2) return {vector(-n[1], n[0], 0).normalized()};
    const vector across =
        n.cross(std::abs(n[0]) < 0.7 ? vector::UnitX() : vector::UnitY()).normalized();
    return {across, n.cross(across)};
}

std::uint8_t zoneNear(const particleCloud& cloud, const pointGrid& fluid, const vector& x,
                      scalar radius)
{
    scalar least = radius;
    label nearest = -1;
    fluid.within(x, radius, [&](label k, scalar r) {
        if (r < least) least = r, nearest = k;
    });
    return nearest < 0 ? std::uint8_t(255) : cloud.zone[cloud.nSolid() + nearest];
}

}  // namespace

openFace::openFace(const word& name, const dictionary& dict, const word& caseFolder,
                   const imageGroup& group, const particleCloud& cloud)
    : name_(name),
      where_(dict.where("type")),
      dx_(cloud.dx),
      radius_(2.5 * cloud.dx),
      stripWidth_(
          dict.getInRangeOrDefault("stripWidth", 0.9 * cloud.dx, 10 * cloud.dx, 1.5 * cloud.dx)),
      p_(Function1::New("p", dict, caseFolder)),
      siteFeet_(radius_)
{
    const scalar reach = stripWidth_ + 2.5 * dx_;
    if (dict.chooseOrDefault("surface", {"triSurface", "plane"}, "triSurface") == "plane")
        surface_ =
            patchSurface::plane(dict.get<vector>("point"), dict.get<vector>("normal"), reach);
    else surface_ = patchSurface::triangles(readPatch(caseFolder, name, dict), group, reach);
}

scalar openFace::weight(scalar r) const
{
    const scalar q = r / radius_, a = 1 - q * q;
    return q < 1 ? a * a : 0;
}

// The strip ends where the cells of the sites do: twice their mean depth, corrected for a surface
// that grows with depth as 1 + 2 kappa d
void openFace::setDepth(const List<surfaceFoot>& feet)
{
    scalar sum = 0;
    for (const surfaceFoot& f : feet) sum += f.depth;
    const scalar mean = sum / scalar(feet.size()), kappa = surface_->curvature();
    depth_ = 2 * mean;
    for (int k = 0; k < 10; ++k)
    {
        const scalar q = std::clamp(kappa * depth_, -0.25, 1.0);
        depth_ = 2 * mean * (1 + q) / (1 + 4 * q / 3);
    }
}

void openFace::addSpot(const vector& x, const vector& foot, std::uint8_t zone)
{
    scalar full = 0;
    siteFeet_.within(foot, radius_, [&](label, scalar r) { full += weight(r); });
    spots_.push_back({x, foot, full, zone});
}

void openFace::setSites(const List<vector>& sites, const particleCloud& cloud, const place& allowed)
{
    List<surfaceFoot> feet;
    List<vector> kept;
    for (const vector& x : sites)
    {
        const surfaceFoot f = surface_->find(x);
        if (!f.found || f.depth < 0 || f.depth > stripWidth_ + 0.5 * dx_) continue;
        feet.push_back(f), kept.push_back(x), siteFeet_.add(f.foot);
    }
    if (feet.empty())
        throw fatalError("Open patch " + name_ + " has no site within " + str(stripWidth_ / dx_) +
                             " dx beyond its surface, of " + std::to_string(sites.size()) +
                             " in constant/openSites.hdf. Its normals must point out of the fluid",
                         where_);
    setDepth(feet);

    pointGrid fluid(2 * dx_), taken(dx_);
    for (label i = cloud.nSolid(); i < cloud.n(); ++i) fluid.add(cloud.x[i].xyz());
    for (size_t k = 0; k < feet.size(); ++k)
    {
        const std::uint8_t zone = zoneNear(cloud, fluid, kept[k], 2 * dx_);
        if (zone == 255)
            throw fatalError("Open patch " + name_ +
                                 ": no fluid particle within 2 dx of the site (" + str(kept[k][0]) +
                                 " " + str(kept[k][1]) + " " + str(kept[k][2]) +
                                 "). The strip beyond the surface must be full at the start",
                             where_);
        addSpot(kept[k], feet[k].foot, zone);
        // places at the outer end of the strip, half a spacing apart
        const List<vector> along = tangents(feet[k].normal, cloud.nDims);
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < (cloud.nDims == 3 ? 2 : 1); ++b)
            {
                vector foot = feet[k].foot + 0.5 * a * dx_ * along[0];
                if (b) foot += 0.5 * dx_ * along[1];
                const surfaceFoot f = surface_->find(foot + 0.5 * depth_ * feet[k].normal);
                const vector x = f.foot + 0.999 * depth_ * f.normal;
                if (!f.found || f.depth < 0.25 * depth_ || taken.nearest(x, 0.3 * dx_) < 0.3 * dx_)
                    continue;
                taken.add(x);
                if (allowed(x)) addSpot(x, f.foot, zone);
            }
    }
}

void openFace::setFlags(particleCloud& cloud) const
{
    parallelFor(cloud.n() - cloud.nSolid(), [&](label begin, label end) {
        for (label i = cloud.nSolid() + begin; i < cloud.nSolid() + end; ++i)
        {
            const vector x = cloud.x[i].xyz();
            if (surface_->surelyFar(x)) continue;
            const surfaceFoot f = surface_->find(x);
            if (!f.found || f.depth <= 0) continue;
            cloud.pFixed[i] = 1, cloud.pGiven[i] = given_;
        }
    });
}

bool openFace::near(const vector& x) const
{
    if (surface_->surelyFar(x)) return false;
    const surfaceFoot f = surface_->find(x);
    return f.found && f.depth > -1.3 * dx_;
}

}  // namespace ispf
