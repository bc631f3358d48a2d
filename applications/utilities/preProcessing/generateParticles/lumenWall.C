// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumenWall.H"

#include "boundaryLoops.H"
#include "vesselWall.H"

namespace ispf
{

namespace
{

constexpr scalar thickest = 1e3;  // [dx]: more comes from a wrong unit

}  // namespace

lumenWall::lumenWall(const dictionary& zone, const std::set<word>& openPatches, scalar dx,
                     int nDims, scalar surfaceSize)
    : zone_(zone),
      openings_(openPatches),
      listed_(zone.found("openings")),
      dx_(dx),
      surfaceSize_(surfaceSize),
      nDims_(nDims)
{
    if (!zone.found("thickness")) return;
    thickness_ = zone.getInRange("thickness", dx, thickest * dx, dims::length);
    beyond_ = zone.getInRangeOrDefault("beyond", 0, thickest * dx, 0, dims::length);
    if (const word phase = zone.get<word>("phase"); phase != "solid" && phase != "clamped")
        zone.fail("thickness",
                  "An entry 'thickness' makes the wall of a vessel: its zone must have "
                  "the phase solid or clamped, not " +
                      phase);
    if (!listed_) return;
    const auto names = zone.get<List<word>>("openings");
    openings_ = std::set<word>(names.begin(), names.end());
}

triSurface lumenWall::faceSurface(const cadFace& face)
{
    triSurface s = face.surface;
    groups_.insert(face.groups.begin(), face.groups.end());
    if (asked() && listed_)
        for (const word& group : face.groups)
            if (openings_.count(group)) s.patchNames = {group};
    return s;
}

// fatalError for a name in `openings` that no face has
void lumenWall::checkNames(const triSurface& lumen) const
{
    std::set<word> known = groups_;
    known.insert(lumen.patchNames.begin(), lumen.patchNames.end());
    known.erase("");
    for (const word& name : openings_)
        if (!known.count(name))
            zone_.fail("openings", "No face of the lumen is in a group, a patch or a cap '" + name +
                                       "'. " +
                                       validWords("name", List<word>(known.begin(), known.end())));
}

triSurface lumenWall::around(const triSurface& lumen, const List<word>& caps) const
{
    std::set<word> openings = openings_;
    if (listed_) checkNames(lumen);
    else openings.insert(caps.begin(), caps.end());
    try
    {
        const vesselWall wall =
            makeVesselWall(lumen, [&](const word& patch) { return openings.count(patch) > 0; },
                           {thickness_, surfaceSize_, dx_, nDims_ == 2, beyond_});
        info() << "    wall        " << str(thickness_, 3) << " m = " << str(thickness_ / dx_, 3)
               << " dx thick around the lumen, " << wall.surface.size() << " facets";
        for (const vesselOpening& o : wall.openings)
            info() << ", open at " << o.patch << " " << place(o.centre, 1e-6 * dx_) << " m";
        if (beyond_ > 0) info() << ", " << str(beyond_, 3) << " m beyond them";
        info() << std::endl;
        return wall.surface;
    }
    catch (const fatalError& error)
    {
        zone_.fail("thickness", error.what());
    }
}

}  // namespace ispf
