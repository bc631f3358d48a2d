// SPDX-License-Identifier: GPL-3.0-or-later
// Energies and powers of the free particles before open faces, of the whole body
// [J], [W], in two dimensions per metre:
//
//     balance { type energy; }
//
//     kinetic       sum 1/2 rho V u^2
//     elastic       of the structure
//     potential     - sum rho V b.x, b the body force of each zone
//     dissipation   power that viscosity takes, (2.14).  Pairs with images count half, the other half belongs to the image.
//                   On turning walls less mu int u.W n dA, W the gradient of their velocity: then it is 2 mu int D:D dV
//     wallPower     power that moving walls add: minus the load on them, see bodyLoad.H, times their velocity in the
//                   last step
//     openPower     power through open faces: - int (p + 1/2 rho u^2 - rho b.x) u.n - u.tau.n dA, by surfaceFit
//     dissipated, wallWork, openWork    their integrals since the case began, by the trapezoidal rule over the steps
//                   in which the function object executes
//
// These values are measured on the present state.  The terms of the energy ledger follow, walls to leftOver, as
// summed over the steps (energyLedger.H): kinetic + elastic + potential is its value at the start plus their sum.
#include "functionObject.H"

#include "bodyLoad.H"
#include "energyLedger.H"
#include "viscousPairs.H"

namespace ispf
{

namespace
{

// Power of the viscosity of fluid and solid that the step solves, for the particles before open faces [W]
scalar dissipationOf(const fsiCase& c, const presentState& s)
{
    viscousPairs viscous;
    viscous.setup({s.cloud, s.list, s.B});
    const scalar ofFluid = -c.mu * s.cloud.volume() * viscous.powerOf(s.cloud.Up).dissipated;
    if (!c.structure || !c.structure->damps()) return ofFluid;
    blockMatrix3 D = c.structure->tangentPattern().withZeros();
    c.structure->assembleDamping(c.cloud.x, D);
    const List<vec4> u(c.cloud.Up.begin(), c.cloud.Up.begin() + c.cloud.nSolid());
    List<vec4> Du(u.size());
    D.apply(u, Du);
    return ofFluid +
           sumOf(0, c.cloud.nSolid(), [&](label i) { return u[i].xyz().dot(Du[i].xyz()); });
}

List<word> titles()
{
    List<word> all = {"kinetic",    "elastic",  "potential", "dissipation", "wallPower",
                      "dissipated", "wallWork", "openPower", "openWork"};
    all.insert(all.end(), energyLedger::titles.begin() + energyLedger::nStores,
               energyLedger::titles.end());
    return all;
}

class energy : public functionObject
{
public:
    energy(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          file_(table("energy.dat",
                      ofWhole({"Energies [J], powers [W] and their integrals [J]" +
                               word(c.cloud.nDims == 2 ? ", per metre" : "")}),
                      titles(), 9))
    {
        for (const word& w : c.walls->movingWalls())
            walls_.push_back(loadedBody::wall(w, c, dict.where()));
        for (const word& face : c.walls->openFaces())
        {
            openFaces_.push_back(loadedBody::openFace(face, c));
            if (!c.walls->openSurface(face).empty()) continue;
            measuresAll_ = false;
            warning("function object " + name + ": the extent of open face " + face +
                    " is not known, a plane that nothing bounds: openPower and openWork are "
                    "nan. Take surface triSurface");
        }
    }

    void execute() override { advance(); }

    void write() override
    {
        advance();
        const auto [kinetic, potential] = mechanical();
        const scalar whole = case_.walls->symmetryFactor();
        file_.begin(case_.time.value())
            << whole * kinetic
            << (case_.structure ? whole * case_.structure->energy(case_.cloud.x) : 0)
            << whole * potential << now_.dissipation << now_.wallPower << dissipated_ << wallWork_
            << (measuresAll_ ? now_.openPower : nan) << (measuresAll_ ? openWork_ : nan);
        for (const scalar put : energyLedger::sums(case_)) file_ << whole * put;
        file_.endRow();
    }

    bool sumsOverTime() const override { return true; }

    List<scalar> state() const override
    {
        return {time_,     now_.dissipation, now_.wallPower, dissipated_,
                wallWork_, now_.openPower,   openWork_};
    }
    void restore(const List<scalar>& s) override
    {
        if (s.size() != 7) return;
        time_ = s[0], now_ = {s[1], s[2], s[5]}, known_ = true;
        dissipated_ = s[3], wallWork_ = s[4], openWork_ = s[6];
    }

private:
    struct powers
    {
        scalar dissipation = 0, wallPower = 0, openPower = 0;
    };

    std::pair<scalar, scalar> mechanical() const
    {
        const particleCloud& cloud = case_.cloud;
        particleCloud flagged = cloud;
        flagged.clearGhosts();
        const List<vector> b = case_.bodyForceAt(case_.time.value());
        case_.walls->setFlags(flagged, case_.rho, b);
        const scalar mass = case_.rho * cloud.volume();
        scalar kinetic = 0, potential = 0;
        for (label i = 0; i < cloud.n(); ++i)
        {
            if (!flagged.isFree(i)) continue;
            kinetic += 0.5 * mass * cloud.Up[i].xyz().squaredNorm();
            if (!b.empty()) potential -= mass * b[cloud.zone[i]].dot(cloud.x[i].xyz());
        }
        return {kinetic, potential};
    }

    powers measure() const
    {
        const presentState s(case_);
        powers p;
        p.dissipation = dissipationOf(case_, s);
        if (!walls_.empty())
        {
            const pairFriction friction(case_, s);
            for (const loadedBody& wall : walls_) addWall(wall, friction, p);
        }
        p.openPower = openPower();
        const scalar whole = case_.walls->symmetryFactor();
        return {whole * p.dissipation, whole * p.wallPower, whole * p.openPower};
    }

    // Adds the power of a rigid wall.  The pair sum gives mu int |grad u|^2 dV.  Where a wall turns, the heat is less by
    // mu int u.W n dA, W the gradient of the wall's velocity
    void addWall(const loadedBody& wall, const pairFriction& friction, powers& p) const
    {
        const auto velocity = [&](const vector& x) {
            return case_.walls->wallVelocity(wall.name(), x);
        };
        const bodyLoad load = loadOn(wall, friction);
        const tensor W = pairFriction::turnOf(wall.name(), case_);
        const vector omega(W(2, 1), W(0, 2), W(1, 0));
        p.wallPower -= velocity(vector::Zero()).dot(load.total()) + omega.dot(load.totalMoment());
        if (omega.isZero()) return;
        for (const loadedBody::side& side : wall.sides())
            for (const facet& f : side.facets)
                p.dissipation -= case_.mu * velocity(f.centre).dot(W * f.area);
    }

    scalar openPower() const
    {
        const vector b = fluidForce();
        scalar power = 0;
        for (const loadedBody& face : openFaces_)
            for (const loadedBody::side& side : face.sides())
                for (size_t k = 0; k < side.facets.size(); ++k)
                {
                    const auto& [centre, area] = side.facets[k];
                    const fluidAt& f = side.fluid[k];
                    if (!f.covered) continue;
                    const scalar head = f.p + case_.rho * (0.5 * f.U.squaredNorm() - b.dot(centre));
                    power -= head * f.U.dot(area) - f.U.dot(viscousStress(f, case_) * area);
                }
        return power;
    }

    // Body force on the fluid [m/s^2]
    vector fluidForce() const
    {
        const List<vector> b = case_.bodyForceAt(case_.time.value());
        for (size_t zone = 0; zone < b.size(); ++zone)
            if (case_.cloud.zones[zone].phase == phaseType::fluid) return b[zone];
        return vector::Zero();
    }

    void advance()
    {
        const scalar t = case_.time.value();
        if (known_ && t == time_) return;
        const powers next = measure();
        if (known_ && t > time_)
        {
            dissipated_ += 0.5 * (t - time_) * (now_.dissipation + next.dissipation);
            wallWork_ += 0.5 * (t - time_) * (now_.wallPower + next.wallPower);
            openWork_ += 0.5 * (t - time_) * (now_.openPower + next.openPower);
        }
        now_ = next, time_ = t, known_ = true;
    }

    dataFile file_;
    static constexpr scalar nan = std::numeric_limits<scalar>::quiet_NaN();
    List<loadedBody> walls_, openFaces_;
    bool measuresAll_ = true;
    powers now_;
    scalar time_ = 0, dissipated_ = 0, wallWork_ = 0, openWork_ = 0;
    bool known_ = false;
};

}  // namespace

std::unique_ptr<functionObject> newEnergy(const word& name, const dictionary& dict,
                                          const fsiCase& c)
{
    return std::make_unique<energy>(name, dict, c);
}

}  // namespace ispf
