// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdf5Support.H"

#include <hdf5.h>

namespace ispf
{

void silenceHdf5()
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

word hdf5Reason()
{
    word reason = "unknown reason";
    const auto takeFirst = [](unsigned n, const H5E_error2_t* entry, void* result) -> herr_t {
        if (n == 0 && entry->desc) *static_cast<word*>(result) = entry->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, takeFirst, &reason);
    return reason;
}

}  // namespace ispf
