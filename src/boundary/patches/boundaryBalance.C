// SPDX-License-Identifier: GPL-3.0-or-later
// The balances of the patches, and their log
#include "boundaryContent.H"

#include <ostream>

namespace ispf
{

List<scalar> patchBalance::state() const
{
    return {swept, scalar(created), scalar(deleted), scalar(pushed), volume, flux};
}

void patchBalance::restore(const List<scalar>& s)
{
    if (s.size() < 4) return;
    swept = s[0], created = label(s[1]), deleted = label(s[2]), pushed = label(s[3]);
    if (s.size() == 6) volume = s[4], flux = s[5];
}

const List<patchBalance>& boundary::balance() const
{
    return content_->balance;
}

void boundary::printBalance(const particleCloud& cloud) const
{
    const List<std::unique_ptr<patch>>& patches = content_->patches;
    word fluxes, cyclic;
    scalar sum = 0;
    label created = 0, deleted = 0, pushed = 0;
    const word unit = "[m" + std::to_string(cloud.nDims) + "/s, ";
    for (size_t k = 0; k < patches.size(); ++k)
    {
        const patchBalance& b = content_->balance[k];
        created += b.created, deleted += b.deleted, pushed += b.pushed;
        const scalar flux = symmetryFactor() * b.flux;  // of the whole body, as in the ledger
        if (patches[k]->passesFlux())
            fluxes += (fluxes.empty() ? "" : ", ") + b.name + " " + str(flux), sum += flux;
        // cyclic pairs are not in the sum: what leaves at one plane enters at the other
        if (patches[k]->pair())
            cyclic += (cyclic.empty() ? unit + "along the separation]: " : ", ") + b.name + " " +
                      str(flux);
    }
    if (!fluxes.empty()) fluxes = unit + "out]: " + fluxes + ", sum " + str(sum);
    if (!fluxes.empty() && !cyclic.empty()) fluxes += "; ";
    if (!(fluxes + cyclic).empty()) info() << "patch flux " << fluxes << cyclic << "\n";
    const auto strays = cloud.state.find(entries::strays);
    if (created + deleted + pushed > 0 || hasOpen() || strays)
        info() << "particles: " << cloud.n() << "; so far created " << created << ", deleted "
               << deleted << ", put back " << pushed << " off walls and planes; strays "
               << label(strays.value_or(0)) << " without neighbours"
               << "\n";
}

void boundary::restoreBalance(const List<patchBalance>& balance)
{
    content_->balance = balance;
}

}  // namespace ispf
