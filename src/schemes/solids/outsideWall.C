// SPDX-License-Identifier: GPL-3.0-or-later
#include "outsideWall.H"
#include "surfaceMass.H"

namespace ispf
{

outsideWall::outsideWall(const dictionary& structureProperties, const word& caseFolder)
    : entry_(structureProperties, caseFolder)
{
}

void outsideWall::find(const fsiCase& c, const solidSurface& surface)
{
    const std::array<scalar, 2> areas = surface.wetAndOpen();
    wet_ = areas[0], open_ = areas[1];
    if (entry_.given() && !(open_ > 0))
        entry_.fail(
            "It acts where neither fluid nor wall is before the solid, and there is no such "
            "place here. Leave it away");
    if (open_ > 0) middle_ = surface.middleOfOpen();
    if (entry_.tissue()) mass_ = surfaceMass(surface, *c.structure, c.cloud.uFixed);
}

std::optional<hydrostaticPart::outerPressure> outsideWall::level(scalar before, scalar during) const
{
    if (!(open_ > 0)) return std::nullopt;
    return hydrostaticPart::outerPressure{entry_.pressure(before), entry_.pressure(during),
                                          middle_};
}

solidSurface::pressureAt outsideWall::pressureAt(scalar t, const hydrostaticPart& hydrostatic) const
{
    if (!acts(hydrostatic)) return nullptr;
    const scalar given = entry_.pressure(t);
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
    if (!entry_.tissue()) return;
    const label n = cloud.nSolid();
    List<vec4> way(n), pull(n);
    const List<vec4>& rest = cloud.vectors.at("x0");
    forEach(0, n, [&](label i) { way[i].s = s.x[i].s - rest[i].s; });
    mass_.apply(way, pull);
    // the spring's force at the end of the step is that at its start less tau times its stiffness times u
    resists_ = mass_.withZeros();
    resists_.addScaled(entry_.damping() + s.tau * entry_.stiffness(), mass_);
    forEach(0, n, [&](label i) {
        if (cloud.uFixed[i]) return;
        force_[i].s -= entry_.stiffness() * pull[i].s;
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
    if (entry_.tissue()) resists_.apply(cloud.Up, held);
    return tau * sumOf(0, cloud.nSolid(), [&](label i) -> scalar {
               if (!cloud.isFree(i)) return 0;
               return cloud.Up[i].xyz().dot(force_[i].xyz() - held[i].xyz());
           });
}

}  // namespace ispf
