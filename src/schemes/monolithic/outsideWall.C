// SPDX-License-Identifier: GPL-3.0-or-later
#include "outsideWall.H"

namespace ispf
{

std::unique_ptr<outsideWall> outsideWall::New(const dictionary& structureProperties,
                                              const word& caseFolder)
{
    if (!structureProperties.found("outside")) return nullptr;
    return std::make_unique<outsideWall>(structureProperties.subDict("outside"), caseFolder);
}

outsideWall::outsideWall(const dictionary& dict, const word& caseFolder)
    : stiffness_(dict.getInRangeOrDefault<scalar>("stiffness", 0, 1e30, 0)),
      damping_(dict.getInRangeOrDefault<scalar>("damping", 0, 1e30, 0))
{
    if (dict.found("pressure"))
        pressure_ = Function1::New("pressure", dict, caseFolder, dims::pressure);
    dict.refuseOthers({"pressure", "stiffness", "damping"});
}

solidSurface::pressureAt outsideWall::pressureAt(scalar t, const hydrostaticPart& hydrostatic) const
{
    const scalar given = pressure_ ? pressure_->value(t) : 0;
    // the schemes solve for p less its hydrostatic part, (1.9)
    return [given, &hydrostatic](const vector& at) { return given - hydrostatic.at(at); };
}

void outsideWall::setStep(const fsiCase& c, const solidSurface& surface,
                          const hydrostaticPart& hydrostatic, const start& s)
{
    const particleCloud& cloud = c.cloud;
    List<vec4> Q;
    List<tensor> P;
    surface.outsideLoads(pressureAt(s.pressures, hydrostatic), Q, P);
    c.structure->gradient().forces(P, force_);
    const List<vec4>& rest = cloud.vectors.at("x0");
    resists_.assign(cloud.nSolid(), 0);
    forEach(0, cloud.nSolid(), [&](label i) {
        const scalar area = surface.outsideArea(i);
        force_[i].s -= Q[i].s + area * stiffness_ * (s.x[i].s - rest[i].s);
        if (cloud.uFixed[i]) force_[i] = vec4{};
        // the spring's force at the end of the step is that at its start less tau times its stiffness times u
        else resists_[i] = area * (damping_ + s.tau * stiffness_);
        force_[i][3] = 0;
    });
}

scalar outsideWall::work(const particleCloud& cloud, scalar tau) const
{
    return tau * sumOf(0, cloud.nSolid(), [&](label i) -> scalar {
               if (!cloud.isFree(i)) return 0;
               const vector u = cloud.Up[i].xyz();
               return u.dot(force_[i].xyz()) - resists_[i] * u.squaredNorm();
           });
}

}  // namespace ispf
