// SPDX-License-Identifier: GPL-3.0-or-later
// The structure models that there are.  A new one adds its lines here
#include "structureModel.H"

namespace ispf
{

std::unique_ptr<structureModel> newSpringNetwork(const dictionary&, const structureReference&);
std::unique_ptr<structureModel> newTotalLagrangian(const dictionary&, const structureReference&);

std::unique_ptr<structureModel> structureModel::New(const dictionary& dict,
                                                    const structureReference& ref)
{
    if (dict.empty()) return nullptr;
    const word model = dict.choose("structureModel", {"springNetwork", "totalLagrangian"});
    // one projection serves both media: a density jump would need a variable-density one
    if (dict.found("rho") && std::abs(dict.get<scalar>("rho", dims::density) / ref.rho - 1) > 1e-6)
        dict.fail("rho", "the solid's density must equal the fluid's, " + str(ref.rho) +
                             " kg/m^3: fluid and solid are solved as one medium of one density. "
                             "Leave the entry out, or change the fluid's");
    std::unique_ptr<structureModel> made;
    if (model == "springNetwork") made = newSpringNetwork(dict, ref);
    else made = newTotalLagrangian(dict, ref);
    // the coupling reads and checks them
    for (const char* entry : {"outside", "contact", "prestress"})
        dict.subOrEmptyDict(entry).markAllRead();
    dict.checkAllRead();
    return made;
}

}  // namespace ispf
