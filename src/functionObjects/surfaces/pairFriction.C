// SPDX-License-Identifier: GPL-3.0-or-later
#include "pairFriction.H"
#include "pairViscosity.H"

#include "pointGrid.H"
#include "sphc.H"
#include "surfaceSearch.H"

namespace ispf
{

namespace
{

// True for a rigid particle, or an image whose velocity is not mirrored like its position
bool standsForWall(const particleCloud& cloud, label g)
{
    if (g < cloud.n()) return false;
    if (cloud.ownerOf(g) < 0) return true;
    const ghostRule& rule = cloud.ruleOf(g);
    return (rule.M.topLeftCorner<3, 3>() - rule.R).cwiseAbs().maxCoeff() > 0.5;
}

bool isSolid(const particleCloud& cloud, label j)
{
    const label owner = cloud.ownerOf(j);
    return owner >= 0 && !cloud.isFluid(owner);
}

// Marks solids, and fluid that has a neighbour of a body
List<char> besideBodies(const particleCloud& cloud, scalar support)
{
    pointGrid bodies(support);
    for (label j = 0; j < cloud.nAll(); ++j)
        if (isSolid(cloud, j) || standsForWall(cloud, j)) bodies.add(cloud.x[j].xyz());
    List<char> beside(cloud.n(), 1);
    parallelFor(cloud.n(), [&](label begin, label end) {
        for (label i = std::max(begin, cloud.nSolid()); i < end; ++i)
            beside[i] = bodies.any(cloud.x[i].xyz(), support);
    });
    return beside;
}

// Finds the body to which a neighbour of the fluid belongs
class bodyFinder
{
public:
    bodyFinder(const fsiCase& c, const particleCloud& cloud)
        : cloud_(cloud), walls_(c.walls->noSlipWalls())
    {
        for (const word& w : walls_)
        {
            if (walls_.size() == 1) continue;
            triSurface s = c.walls->surfaceOf(w, c.cloud);
            s.weld(1e-4 * cloud.dx);
            surfaces_.emplace_back(std::move(s));
        }
    }

    const List<word>& walls() const { return walls_; }
    label n() const { return label(walls_.size() + cloud_.zones.size()); }

    // Index of the wall, or number of walls plus zone; -1: no body
    label of(label i, label j) const
    {
        if (isSolid(cloud_, j)) return label(walls_.size()) + cloud_.zone[cloud_.ownerOf(j)];
        if (!standsForWall(cloud_, j) || walls_.empty()) return -1;
        const vector at = 0.5 * (cloud_.x[i].xyz() + cloud_.x[j].xyz());
        label nearest = 0;
        scalar distance = std::numeric_limits<scalar>::max();
        for (label w = 0; w < label(surfaces_.size()); ++w)
            if (const surfacePoint p = surfaces_[w].nearest(at, distance); p.found)
                nearest = w, distance = p.distance;
        return nearest;
    }

private:
    const particleCloud& cloud_;
    List<word> walls_;
    List<surfaceSearch> surfaces_;
};

// Adds up the load on each body from one fluid particle
class pairSum
{
public:
    pairSum(const fsiCase& c, const presentState& s)
        : case_(c),
          state_(s),
          bodies_(c, s.cloud),
          turn_(bodies_.n(), tensor::Zero()),
          scale_(sphc::laplacianScale({s.cloud, s.list, s.B})),
          viscosity_(s.cloud)
    {
        for (size_t w = 0; w < bodies_.walls().size(); ++w)
            turn_[w] = pairFriction::turnOf(bodies_.walls()[w], c);
    }

    const bodyFinder& bodies() const { return bodies_; }

    void add(label i, List<pairFriction::load>& loads) const
    {
        const particleCloud& cloud = state_.cloud;
        const neighbourList& list = state_.list;
        forNeighbours<among::all>(list, i, [&](pairIndex k, label j) {
            const label body = bodies_.of(i, j);
            if (body < 0) return;
            const bool rigid = cloud.ownerOf(j) < 0;
            const scalar both = rigid ? 2 * scale_[i] : scale_[i] + scale_[j];
            const vector xi = cloud.x[i].xyz(), xj = cloud.x[j].xyz();
            const scalar counts = cloud.friction(i, j);
            const scalar mu = case_.mu * viscosity_.of(i, j);
            const vector u = counts * (cloud.Up[i].xyz() - cloud.Up[j].xyz()) -
                             (rigid ? cloud.frictionOfRow(i) : counts) * (turn_[body] * (xi - xj));
            loads[body].add(0.5 * (xi + xj),
                            -mu * cloud.volume() * both * sphc::viscousF(cloud, list, k) * u);
        });
    }

private:
    const fsiCase& case_;
    const presentState& state_;
    bodyFinder bodies_;
    List<tensor> turn_;
    List<scalar> scale_;
    pairViscosity viscosity_;
};

}  // namespace

pairFriction::pairFriction(const fsiCase& c)
    : pairFriction(c, presentState(c, [&](const particleCloud& cloud) {
                       return besideBodies(cloud, c.kernel->support());
                   }))
{
}

pairFriction::pairFriction(const fsiCase& c, const presentState& s)
{
    const particleCloud& cloud = s.cloud;
    const pairSum pairs(c, s);
    const label nBodies = pairs.bodies().n();
    constexpr label block = 4096;  // summed in their order: the same for any number of threads
    List<List<sum>> perBlock((cloud.n() + block - 1) / block, List<sum>(nBodies));
    parallelFor(
        label(perBlock.size()),
        [&](label begin, label end) {
            List<load> one(nBodies);
            for (label b = begin; b < end; ++b)
                for (label i = std::max(b * block, cloud.nSolid());
                     i < std::min((b + 1) * block, cloud.n()); ++i)
                {
                    if (cloud.beyondOpen(i)) continue;
                    pairs.add(i, one);
                    for (label k = 0; k < nBodies; ++k)
                        if (!one[k].force.isZero(0))
                        {
                            perBlock[b][k].total.add(one[k]);
                            perBlock[b][k].shares.push_back({cloud.x[i].xyz(), one[k].force});
                            one[k] = {};
                        }
                }
        },
        1);
    const List<word>& walls = pairs.bodies().walls();
    for (label k = 0; k < nBodies; ++k)
    {
        const label zone = k - label(walls.size());
        sum& body = zone < 0 ? walls_[walls[k]] : zones_[cloud.zones[zone].name];
        for (const List<sum>& part : perBlock)
        {
            body.total.add(part[k].total);
            body.shares.insert(body.shares.end(), part[k].shares.begin(), part[k].shares.end());
        }
    }
}

const List<pairFriction::share>* pairFriction::sharesOf(const loadedBody& body) const
{
    const auto& bodies = body.isWall() ? walls_ : zones_;
    const auto found = bodies.find(body.name());
    return found != bodies.end() ? &found->second.shares : nullptr;
}

tensor pairFriction::turnOf(const word& wall, const fsiCase& c)
{
    const auto velocity = [&](const vector& x) { return c.walls->wallVelocity(wall, x); };
    tensor W;
    for (int a = 0; a < 3; ++a) W.col(a) = velocity(vector::Unit(a)) - velocity(vector::Zero());
    return W;
}

}  // namespace ispf
