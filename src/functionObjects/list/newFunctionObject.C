// SPDX-License-Identifier: GPL-3.0-or-later
// The list of function objects.  A new one adds its two lines here
#include "functionObject.H"

namespace ispf
{

using made = std::unique_ptr<functionObject>;

made newCavityVolume(const word&, const dictionary&, const fsiCase&);
made newEnergy(const word&, const dictionary&, const fsiCase&);
made newErrorNorm(const word&, const dictionary&, const fsiCase&);
made newForces(const word&, const dictionary&, const fsiCase&);
made newLineProfile(const word&, const dictionary&, const fsiCase&);
made newMaterialProbes(const word&, const dictionary&, const fsiCase&);
made newMinMax(const word&, const dictionary&, const fsiCase&);
made newMomentum(const word&, const dictionary&, const fsiCase&);
made newPatchFlux(const word&, const dictionary&, const fsiCase&);
made newPlaneMap(const word&, const dictionary&, const fsiCase&);
made newProbes(const word&, const dictionary&, const fsiCase&);
made newResidenceTime(const word&, const dictionary&, const fsiCase&);
made newSolidStress(const word&, const dictionary&, const fsiCase&);
made newSurfaceFieldValue(const word&, const dictionary&, const fsiCase&);
made newSurfaceLeaks(const word&, const dictionary&, const fsiCase&);
made newSurfaceSample(const word&, const dictionary&, const fsiCase&);
made newVolFieldValue(const word&, const dictionary&, const fsiCase&);
made newWallShearStress(const word&, const dictionary&, const fsiCase&);
made newZoneDiameter(const word&, const dictionary&, const fsiCase&);

std::unique_ptr<functionObject> functionObject::New(const word& name, const dictionary& dict,
                                                    const fsiCase& c)
{
    using maker = made (*)(const word&, const dictionary&, const fsiCase&);
    static const std::map<word, maker> types = {{"cavityVolume", newCavityVolume},
                                                {"energy", newEnergy},
                                                {"errorNorm", newErrorNorm},
                                                {"forces", newForces},
                                                {"lineProfile", newLineProfile},
                                                {"materialProbes", newMaterialProbes},
                                                {"minMax", newMinMax},
                                                {"momentum", newMomentum},
                                                {"patchFlux", newPatchFlux},
                                                {"planeMap", newPlaneMap},
                                                {"probes", newProbes},
                                                {"residenceTime", newResidenceTime},
                                                {"solidStress", newSolidStress},
                                                {"surfaceFieldValue", newSurfaceFieldValue},
                                                {"surfaceLeaks", newSurfaceLeaks},
                                                {"surfaceSample", newSurfaceSample},
                                                {"volFieldValue", newVolFieldValue},
                                                {"wallShearStress", newWallShearStress},
                                                {"zoneDiameter", newZoneDiameter}};
    List<word> names;
    for (const auto& t : types) names.push_back(t.first);
    return types.at(dict.choose("type", names))(name, dict, c);
}

}  // namespace ispf
