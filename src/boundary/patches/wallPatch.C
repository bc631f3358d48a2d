// SPDX-License-Identifier: GPL-3.0-or-later
// type wall: a wall of the wallSet.  Here is what a wall does alone: it clamps solids
#include "patch.H"

namespace ispf
{

namespace
{

class wallPatch : public patch
{
public:
    wallPatch(const word& name, const patchSetting& s)
        : patch(name), walls_(s.walls), index_(label(s.walls.walls().size()))
    {
        wall w = wall::New(name, s.patches.subDict(name), s.caseFolder);
        w.index = label(s.all.size());
        s.walls.add(std::move(w));
    }

    bool passesFlux() const override { return at().motion.moves(); }
    void clamp(particleCloud& cloud, const List<vec4>& x0, const dictionary& dict) override;
    void setFlags(particleCloud& cloud, scalar, const List<vector>&) const override
    {
        for (const label i : clamped_)
            cloud.Up[i].setXyz(at().surfaceVelocity.at(cloud.x[i].xyz()));
    }

private:
    const wall& at() const { return walls_.walls()[index_]; }

    const wallSet& walls_;
    label index_;          // of the wall in the set
    List<label> clamped_;  // solid particles
};

void wallPatch::clamp(particleCloud& cloud, const List<vec4>& x0, const dictionary& dict)
{
    for (const word& zoneName : at().clamps)
    {
        const fileLocation where = dict.where("clamps");
        const label zone = cloud.zoneIndex(zoneName, where);
        if (at().motion.slides())
            throw fatalError("Wall " + name() +
                                 " slides or turns in itself: what it clamps would tear. Let "
                                 "it move by 'motion', or clamp to a wall that stands",
                             where);
        if (cloud.zones[zone].phase != phaseType::solid)
            throw fatalError("Zone " + zoneName + " is fluid: a wall clamps solids only", where);
        const size_t before = clamped_.size();
        for (label i = 0; i < cloud.nSolid(); ++i)
            if (cloud.zone[i] == zone &&
                walls_.distance(index_, x0[i].xyz()) < at().clampDepth * cloud.dx)
                cloud.uFixed[i] = 1, clamped_.push_back(i);
        if (clamped_.size() == before)
            throw fatalError("No particle of zone " + zoneName + " rests within " +
                                 str(at().clampDepth) + " dx of wall " + name() +
                                 ": there is nothing to clamp. Do they touch?",
                             where);
    }
}

}  // namespace

std::unique_ptr<patch> newWallPatch(const word& name, const patchSetting& s)
{
    return std::make_unique<wallPatch>(name, s);
}

}  // namespace ispf
