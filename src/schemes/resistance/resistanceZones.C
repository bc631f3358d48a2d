// SPDX-License-Identifier: GPL-3.0-or-later
#include "resistanceZones.H"

#include "pairViscosity.H"

#include <algorithm>
#include <ostream>

namespace ispf
{

namespace
{

scalar DarcyOf(const dictionary& dict)
{
    if (dict.found("d") && dict.found("permeability"))
        dict.fail("permeability", "d is one over the permeability: give one of both");
    if (dict.found("permeability"))
        return 1 / dict.getInRange("permeability", 1e-30, 1e30, dims::area);
    return dict.getInRangeOrDefault("d", 0, 1e30, 0, dims::none / dims::area);
}

}  // namespace

std::unique_ptr<resistanceZones> resistanceZones::New(fsiCase& c)
{
    const dictionary dict =
        dictionary::fromFileIfPresent(c.time.constantFile("porosityProperties"));
    if (!dict.empty()) return std::make_unique<resistanceZones>(c, dict);
    c.cloud.scalars.erase(thrombusField);
    return nullptr;
}

resistanceZones::resistanceZones(fsiCase& c, const dictionary& dict) : c_(c)
{
    const thrombus* clot = nullptr;
    for (const word& name : dict.dictKeys())
    {
        const dictionary& own = dict.subDict(name);
        zones_.push_back(made(name, own));
        checkEffect(zones_.back(), own);
        if (!zones_.back().clot) continue;
        if (clot)
            own.fail("type", "A case has one thrombus at most: one field of the particles has it");
        clot = zones_.back().clot.get();
    }
    dict.checkAllRead();
    if (clot) clot->begin(c.cloud);
    else c.cloud.scalars.erase(thrombusField);
    info() << "resistance: " << join(dict.dictKeys()) << std::endl;
}

resistanceZones::zone resistanceZones::made(const word& name, const dictionary& dict) const
{
    const bool grows = dict.choose("type", {"DarcyForchheimer", "thrombus"}) == "thrombus";
    zone z;
    z.name = name;
    if (!grows || dict.found("shape") || dict.found("file"))
        z.within = region::New(dict, c_.cloud.dx, c_.cloud.nDims, c_.caseFolder());
    z.d = DarcyOf(dict);
    z.f = dict.getInRangeOrDefault("f", 0, 1e30, 0, dims::perLength);
    if (grows) z.clot = std::make_unique<thrombus>(dict);
    return z;
}

void resistanceZones::checkEffect(const zone& z, const dictionary& dict) const
{
    if (z.d * c_.mu == 0 && z.f == 0)
        throw fatalError("Zone " + z.name +
                             " resists nothing. Give it d (or permeability), or f; d needs a "
                             "fluid with a viscosity",
                         dict.where());
    const particleCloud& cloud = c_.cloud;
    for (label i = cloud.nSolid(); i < cloud.n(); ++i)
        if (z.share(cloud.x[i].xyz()) > 0) return;
    throw fatalError("No fluid particle is in zone " + z.name + ". Is its place right, in metres?",
                     dict.where());
}

bool resistanceZones::needsSpeed() const
{
    return std::any_of(zones_.begin(), zones_.end(), [](const zone& z) { return z.f > 0; });
}

void resistanceZones::setStep(const List<vec4>* before)
{
    const particleCloud& cloud = c_.cloud;
    const pairViscosity viscosity(cloud);
    const auto speed = [&](label i) {
        const scalar now = cloud.Up[i].xyz().norm();
        return before ? 0.5 * (now + (*before)[i].xyz().norm()) : now;
    };
    chi_.assign(cloud.n(), 0);
    for (const zone& z : zones_)
    {
        const List<scalar>* state = z.clot ? &cloud.scalars.at(thrombusField) : nullptr;
        // not in parallel: a formula has its variables in itself
        for (label i = cloud.nSolid(); i < cloud.n(); ++i)
            if (const scalar w = z.share(cloud.x[i].xyz()); w > 0)
                chi_[i] += w * (state ? (*state)[i] : 1) *
                           (viscosity.at(i) * c_.mu * z.d + 0.5 * c_.rho * z.f * speed(i));
    }
}

void resistanceZones::grow(scalar dt)
{
    for (const zone& z : zones_)
        if (z.clot) z.clot->grow(c_.cloud, {c_.cloud, c_.list, c_.correction}, dt);
}

}  // namespace ispf
