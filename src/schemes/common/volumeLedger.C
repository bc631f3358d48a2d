// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumeLedger.H"
#include "densityFeedback.H"
#include "enclosedFluid.H"

#include <array>
#include <ostream>

namespace ispf
{

namespace
{

const List<word> titles = {"swept",        "cavity", "openNet",    "wall",         "control",
                           "wallFeedback", "defect", "wallDefect", "fluidFeedback"};

}  // namespace

namespace entries
{

// Volume put in by the control [m^nDims], its source [1/s], and the first volume of the solid [m^nDims]
const stateEntry<std::array<scalar, 3>> volumeControl{"volumeLedger"};

}  // namespace entries

volumeLedger::volumeLedger(fsiCase& c)
    : c_(c),
      file_(c.caseFolder() + "/postProcessing/volumeLedger/" + c.time.timeName(c.time.startTime()) +
                "/volumeLedger.dat",
            {"Volumes of the whole body [m^" + std::to_string(c.cloud.nDims) +
             "] since the start; control and what follows: put in"},
            titles)
{
    const dictionary dict = c.solution.subOrEmptyDict("volumeLedger");
    if (!dict.empty())
    {
        cavity_ =
            std::make_unique<trackedSurface>(dict.get<word>("cavity"), c, dict.where("cavity"));
        zone_ = c.cloud.zoneIndex(dict.get<word>("zone"), dict.where("zone"));
        if (c.cloud.zones[zone_].phase != phaseType::fluid)
            dict.fail("zone", "Zone " + c.cloud.zones[zone_].name + " is not fluid");
        relaxation_ = dict.getInRangeOrDefault("relaxation", 0, 1, 0);
        cavity0_ = cavity_->restVolume();
    }
    wall0_ = wallVolume();
    if (cavity_ || c.structure)  // the state keeps it over a restart
    {
        const auto kept = c.cloud.state.get(entries::volumeControl, {0, 0, wall0_});
        controlled_ = kept[0], source_ = kept[1], wall0_ = kept[2];
        c.cloud.state.set(entries::volumeControl, kept);
    }
    c.source.assign(c.cloud.zones.size(), 0);
    if (zone_ >= 0) c.source[zone_] = source_;
}

scalar volumeLedger::swept() const
{
    scalar sum = 0;
    for (const patchBalance& b : c_.walls->balance()) sum += b.swept;
    return sum * c_.walls->symmetryFactor();
}

scalar volumeLedger::wallVolume() const
{
    if (!c_.structure) return 0;
    List<tensor> F;
    c_.structure->deformationGradient(c_.cloud.x, F);
    scalar sum = 0;
    for (const tensor& f : F) sum += f.determinant();
    return sum * c_.cloud.volume() * c_.walls->symmetryFactor();
}

// Volume that a source has put into the whole body
scalar volumeLedger::booked(const stateEntry<scalar>& entry) const
{
    return c_.cloud.state.get(entry, 0) * c_.walls->symmetryFactor();
}

scalar volumeLedger::wallFeedback() const
{
    return booked(entries::solidFeedback);
}

void volumeLedger::update(scalar dt)
{
    if (!cavity_) return;
    cavity_->update(c_.cloud.x);
    if (relaxation_ == 0) return;
    // books the source of the ending step, then sets the next one: q = - r (V - V_target) / (V_fluid dt)
    label n = 0;
    for (label i = c_.cloud.nSolid(); i < c_.cloud.n(); ++i)
        n += c_.cloud.zone[i] == zone_ && !c_.cloud.beyondOpen(i);
    const scalar fluid = n * c_.cloud.volume() * c_.walls->symmetryFactor();
    controlled_ += source_ * fluid * dt;
    if (std::abs(controlled_) > 0.1 * fluid)
        throw fatalError(
            "Time " + c_.time.timeName() + " s: the volume control has put " + str(controlled_) +
            " m^3 into zone " + c_.cloud.zones[zone_].name + " of " + str(fluid) +
            " m^3: its cavity " + cavity_->name() +
            " does not follow what the walls sweep. See whether the surface encloses that zone and "
            "is fine enough, or set relaxation 0 in volumeLedger of system/sphSolution");
    source_ = fluid > 0 ? -relaxation_ * (cavityChange() - swept()) / (fluid * dt) : 0;
    c_.source[zone_] = source_;
    c_.cloud.state.set(entries::volumeControl, {controlled_, source_, wall0_});
}

void volumeLedger::writeLine()
{
    scalar open = 0;
    for (const patchBalance& b : c_.walls->balance()) open += b.created - b.deleted;
    open *= c_.cloud.volume() * c_.walls->symmetryFactor();
    file_.begin(c_.time.value());
    const scalar wall = wallVolume() - wall0_, feedback = wallFeedback();
    for (const scalar v : {swept(), cavityChange(), open, wall, controlled_, feedback,
                           enclosedFluid::added(c_.cloud) * c_.walls->symmetryFactor(),
                           booked(entries::solidDefect), booked(entries::fluidFeedback)})
        file_ << v;
    file_.endRow();
    const auto inMm = [&](scalar v) {
        return c_.cloud.nDims == 2 ? str(v * 1e6) + " mm2" : str(v * 1e9) + " mm3";
    };
    info() << "volume ledger: swept " << inMm(swept());
    if (cavity_) info() << ", cavity " << inMm(cavityChange()) << ", control " << inMm(controlled_);
    if (c_.structure) info() << ", wall " << inMm(wall) << ", feedback " << inMm(feedback);
    if (c_.walls->hasOpen() && c_.cloud.state.find(entries::fluidFeedback))
        info() << ", into drained fluid " << inMm(booked(entries::fluidFeedback));
    info() << "\n";
}

}  // namespace ispf
