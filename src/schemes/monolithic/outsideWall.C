// SPDX-License-Identifier: GPL-3.0-or-later
#include "outsideWall.H"
#include "surfaceMass.H"

namespace ispf
{

outsideWall::outsideWall(const dictionary& structureProperties, const word& caseFolder)
    : dict_(structureProperties.subOrEmptyDict("outside")),
      given_(structureProperties.found("outside"))
{
    if (!given_) return;
    stiffness_ = dict_.getInRangeOrDefault<scalar>("stiffness", 0, 1e30, 0,
                                                   dims::pressure * dims::perLength);
    damping_ =
        dict_.getInRangeOrDefault<scalar>("damping", 0, 1e30, 0, dims::pressure / dims::velocity);
    if (dict_.found("pressure"))
        pressure_ = Function1::New("pressure", dict_, caseFolder, dims::pressure);
    dict_.refuseOthers({"pressure", "stiffness", "damping"});
    if (dict_.empty())
        structureProperties.fail("outside",
                                 "It has no entry and no effect. Give a pressure, a stiffness or a "
                                 "damping, or leave it away");
}

void outsideWall::find(const fsiCase& c, const solidSurface& surface)
{
    const std::array<scalar, 2> areas = surface.wetAndOpen();
    wet_ = areas[0], open_ = areas[1];
    if (given_ && !(open_ > 0))
        dict_.fail(dict_.keys().front(),
                   "It acts where neither fluid nor wall is before the solid, and there is no such "
                   "place here. Leave it away");
    if (open_ > 0) middle_ = surface.middleOfOpen();
    if (tissue()) mass_ = surfaceMass(surface, *c.structure, c.cloud.uFixed);
}

std::optional<hydrostaticPart::outerPressure> outsideWall::level(scalar before, scalar during) const
{
    if (!(open_ > 0)) return std::nullopt;
    const auto at = [&](scalar t) { return pressure_ ? pressure_->value(t) : 0; };
    return hydrostaticPart::outerPressure{at(before), at(during), middle_};
}

solidSurface::pressureAt outsideWall::pressureAt(scalar t, const hydrostaticPart& hydrostatic) const
{
    if (!acts(hydrostatic)) return nullptr;
    const scalar given = pressure_ ? pressure_->value(t) : 0;
    // the schemes solve for p less its hydrostatic part, (1.9)
    return [given, &hydrostatic](const vector& at) { return given - hydrostatic.at(at); };
}

// Forces of a pressure on the open surface
List<vec4> outsideWall::loadOf(const fsiCase& c, const solidSurface& surface,
                               const solidSurface::pressureAt& p)
{
    List<vec4> Q, f;
    List<tensor> P;
    surface.outsideLoads(p, Q, P);
    c.structure->gradient().forces(P, f);
    forEach(0, label(f.size()), [&](label i) {
        f[i].s -= Q[i].s;
        if (c.cloud.uFixed[i]) f[i] = vec4{};
        f[i][3] = 0;
    });
    return f;
}

void outsideWall::setStep(const fsiCase& c, const solidSurface& surface,
                          const hydrostaticPart& hydrostatic, const start& s)
{
    const particleCloud& cloud = c.cloud;
    force_ = loadOf(c, surface, pressureAt(s.pressures, hydrostatic));
    ofLevel_.clear();
    if (const scalar level = hydrostatic.level(); level != 0)
        ofLevel_ = loadOf(c, surface, [level](const vector&) { return level; });
    if (!tissue()) return;
    const label n = cloud.nSolid();
    List<vec4> way(n), pull(n);
    const List<vec4>& rest = cloud.vectors.at("x0");
    forEach(0, n, [&](label i) { way[i].s = s.x[i].s - rest[i].s; });
    mass_.apply(way, pull);
    // the spring's force at the end of the step is that at its start less tau times its stiffness times u
    resists_ = mass_.withZeros();
    resists_.addScaled(damping_ + s.tau * stiffness_, mass_);
    forEach(0, n, [&](label i) {
        if (cloud.uFixed[i]) return;
        force_[i].s -= stiffness_ * pull[i].s;
        force_[i][3] = 0;
    });
}

scalar outsideWall::workOfLevel(const particleCloud& cloud, scalar tau) const
{
    return tau * sumOf(0, label(ofLevel_.size()), [&](label i) -> scalar {
               return cloud.isFree(i) ? cloud.Up[i].xyz().dot(ofLevel_[i].xyz()) : 0;
           });
}

scalar outsideWall::work(const particleCloud& cloud, scalar tau) const
{
    List<vec4> held(cloud.nSolid());
    if (tissue()) resists_.apply(cloud.Up, held);
    return tau * sumOf(0, cloud.nSolid(), [&](label i) -> scalar {
               if (!cloud.isFree(i)) return 0;
               return cloud.Up[i].xyz().dot(force_[i].xyz() - held[i].xyz());
           });
}

}  // namespace ispf
