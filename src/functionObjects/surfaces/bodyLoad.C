// SPDX-License-Identifier: GPL-3.0-or-later
#include "bodyLoad.H"

namespace ispf
{

void bodyLoad::add(const bodyLoad& other)
{
    pressure += other.pressure, viscous += other.viscous;
    pressureMoment += other.pressureMoment, viscousMoment += other.viscousMoment;
    area += other.area, covered += other.covered;
}

bodyLoad loadOn(const loadedBody& body, const pairFriction& friction,
                const loadReference& reference)
{
    bodyLoad sum;
    if (!body.isWall() || friction.holds(body.name()))
    {
        const auto& [force, moment] =
            body.isWall() ? friction.onWall(body.name()) : friction.onZone(body.name());
        sum.viscous = force, sum.viscousMoment = moment - reference.centre.cross(force);
    }
    for (const loadedBody::side& s : body.sides())
        for (size_t k = 0; k < s.facets.size(); ++k)
        {
            const facet& f = s.facets[k];
            sum.area += f.area.norm();
            if (!s.fluid[k].covered) continue;
            sum.covered += f.area.norm();
            const vector p = (s.fluid[k].p - reference.p) * f.area;
            const vector arm = f.centre - reference.centre;
            sum.pressure += p, sum.pressureMoment += arm.cross(p);
        }
    return sum;
}

}  // namespace ispf
