// SPDX-License-Identifier: GPL-3.0-or-later
#include "thrombus.H"

#include <algorithm>

namespace ispf
{

thrombus::thrombus(const dictionary& dict)
    : where_(dict.where()),
      residenceTime_(dict.getInRange("residenceTime", 0, 1e30, dims::time)),
      shearRate_(dict.getInRange("shearRate", 0, 1e30, dims::frequency)),
      growthTime_(dict.getInRange("growthTime", 1e-30, 1e30, dims::time))
{
}

void thrombus::begin(particleCloud& cloud) const
{
    cloud.scalars[thrombusField].resize(size_t(cloud.n()), 0);
}

void thrombus::grow(particleCloud& cloud, const stencil& s, scalar dt) const
{
    const auto age = cloud.scalars.find(residenceTimeField);
    if (age == cloud.scalars.end())
        throw fatalError(
            "A thrombus grows where fluid has stayed for long, but no function object follows the "
            "residence time. Add age { type residenceTime; } to the functions of "
            "system/controlDict",
            where_);
    cloud.fillGhosts(cloud.Up, false);
    const List<scalar> rate = sphc::shearRate(s, cloud.Up);
    List<scalar>& state = cloud.scalars.at(thrombusField);
    forEach(cloud.nSolid(), cloud.n(), [&](label i) {
        if (cloud.beyondOpen(i)) state[i] = 0;
        else if (age->second[i] > residenceTime_ && rate[i] < shearRate_)
            state[i] = std::min(1.0, state[i] + dt / growthTime_);
    });
}

}  // namespace ispf
