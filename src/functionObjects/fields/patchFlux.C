// SPDX-License-Identifier: GPL-3.0-or-later
// Volume flow through a patch or a surface, of the whole body [m3/s; m2/s in two dimensions]:
//
//     outflow { type patchFlux; patch outside; }      // a patch of constant/boundary
//     nozzle  { type patchFlux; surface nozzleExit; zones (chamber); }   // any surface in the fluid
//
// patch: the flow that the boundary itself counts.  For a moving wall it is the swept volume; for an open face the flux that
//     balances the divergence (doc/theory (4.4); with DLN the mean over the step).  The fluxes of all patches sum to the
//     sources.  Columns: `flux` in the last step and `volume` since the case began, positive out of the fluid; numbers of
//     particles `created` and `deleted` in the modelled part of an open face.  For a cyclic patch: the fluid that passes,
//     positive along the separation.  Walls at rest and symmetry planes have zero.
// surface: the integral of U.n over constant/triSurface/<surface>.stl, with U fitted to the particles at the middle of its
//     facets (facets.H).  Positive along their normals; in two dimensions per metre along z.  `covered` is the share of the
//     area with particles near enough; the rest does not count.
#include "functionObject.H"

#include "dataFile.H"
#include "facets.H"
#include "fieldSampler.H"
#include "trackedSurface.H"
#include <cmath>

namespace ispf
{

namespace
{

class balancedFlux : public functionObject
{
public:
    balancedFlux(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          patch_(dict.get<word>("patch")),
          file_(table("patchFlux.dat",
                      ofWhole({"Volume through patch " + patch_ +
                               ", out positive; of a cyclic patch along its separation"},
                              "created and deleted of the modelled part, flux and volume "),
                      {"flux", "volume", "created", "deleted"}, 9))
    {
        List<word> names;
        for (const patchBalance& b : c.walls->balance()) names.push_back(b.name);
        if (std::find(names.begin(), names.end(), patch_) == names.end())
            dict.fail("patch", "There is no patch '" + patch_ + "'. " + validWords("patch", names));
    }

    void write() override
    {
        const scalar whole = case_.walls->symmetryFactor();
        for (const patchBalance& b : case_.walls->balance())
            if (b.name == patch_)
                file_.begin(case_.time.value())
                    << whole * b.flux << whole * (b.volume - b.swept) << b.created << b.deleted;
        file_.endRow();
    }

private:
    word patch_;
    dataFile file_;
};

class sampledFlux : public functionObject
{
public:
    sampledFlux(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          facets_(facetsOf(readSurface(dict.get<word>("surface"), c, dict.where("surface")),
                           c.cloud.dx, c.cloud.nDims)),
          U_(c.cloud, "U", dict.where()),
          sampler_(dict, c),
          file_(table("patchFlux.dat",
                      ofWhole({"Flow through the surface " + dict.get<word>("surface") +
                               ", along its normals"}),
                      {"flux", "covered"}, 9))
    {
        for (const facet& f : facets_) centres_.push_back(f.centre), area_ += f.area.norm();
        if (!(area_ > 0)) dict.fail("surface", "This surface has no area.");
    }

    void write() override
    {
        sampler_.update(centres_);
        scalar flux = 0, covered = 0;
        for (size_t k = 0; k < facets_.size(); ++k)
        {
            const vector U = sampler_.sampleVector(U_, label(k)), &area = facets_[k].area;
            if (std::isnan(U[0])) continue;
            flux += U.dot(area), covered += area.norm();
        }
        file_.begin(case_.time.value()) << flux * case_.walls->symmetryFactor() << covered / area_;
        file_.endRow();
    }

private:
    List<facet> facets_;
    List<vector> centres_;
    scalar area_ = 0;
    particleField U_;
    fieldSampler sampler_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newPatchFlux(const word& name, const dictionary& dict,
                                             const fsiCase& c)
{
    const bool patch = dict.found("patch");
    if (patch == dict.found("surface"))
        throw fatalError("patchFlux wants either a patch or a surface.", dict.where());
    if (patch) return std::make_unique<balancedFlux>(name, dict, c);
    return std::make_unique<sampledFlux>(name, dict, c);
}

}  // namespace ispf
