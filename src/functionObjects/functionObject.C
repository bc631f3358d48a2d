// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObject.H"

namespace ispf
{

std::unique_ptr<functionObject> functionObject::New(const word& name, const dictionary& dict,
                                                    const fsiCase& c)
{
    using maker =
        std::unique_ptr<functionObject> (*)(const word&, const dictionary&, const fsiCase&);
    static const std::map<word, maker> types = {{"cavityVolume", newCavityVolume},
                                                {"lineProfile", newLineProfile},
                                                {"minMax", newMinMax},
                                                {"patchFlux", newPatchFlux},
                                                {"probes", newProbes},
                                                {"surfaceLeaks", newSurfaceLeaks},
                                                {"zoneDiameter", newZoneDiameter}};
    List<word> names;
    for (const auto& t : types) names.push_back(t.first);
    return types.at(dict.choose("type", names))(name, dict, c);
}

word functionObject::folder(const word& time) const
{
    return case_.caseFolder() + "/postProcessing/" + name_ + "/" + time;
}

word functionObject::startFolder() const
{
    return folder(case_.time.timeName(case_.time.startTime()));
}

}  // namespace ispf
