// SPDX-License-Identifier: GPL-3.0-or-later
#include "structureModel.H"
#include "largestEigenvalue.H"

namespace ispf
{

std::unique_ptr<structureModel> newSpringNetwork(const dictionary&, const structureReference&);

namespace
{

structureReference checked(const structureReference& ref)
{
    ref.check();
    return ref;
}

}  // namespace

structureModel::structureModel(const structureReference& ref) : ref_(checked(ref)), gradient_(ref_)
{
}

std::unique_ptr<structureModel> structureModel::New(const dictionary& dict,
                                                    const structureReference& ref)
{
    if (dict.empty()) return nullptr;
    const word model = dict.choose("structureModel", {"springNetwork"});
    // one projection serves both media: a density jump would need a variable-density one
    if (dict.found("rho") && std::abs(dict.get<scalar>("rho", dims::density) / ref.rho - 1) > 1e-6)
        dict.fail("rho", "the solid's density must equal the fluid's, " + str(ref.rho) +
                             " kg/m^3: fluid and solid are solved as one medium of one density. "
                             "Leave the entry out, or change the fluid's");
    std::unique_ptr<structureModel> made;
    if (model == "springNetwork") made = newSpringNetwork(dict, ref);
    dict.checkAllRead();
    return made;
}

scalar structureModel::stableTimeStep(const List<vec4>& x, scalar mass) const
{
    blockMatrix3 K = tangentPattern();
    assembleTangent(x, tangentKind::positive, K);
    return 2 / std::sqrt(largestEigenvalue(K) / mass);
}

}  // namespace ispf
