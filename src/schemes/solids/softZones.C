// SPDX-License-Identifier: GPL-3.0-or-later
#include "softZones.H"

#include "messages.H"

#include <cmath>

namespace ispf
{

namespace
{

// [G] mean pressure of a zone that tests/runs/contrast.sh reaches, doc/limits.md
constexpr scalar mostPressure = 2;

}  // namespace

void softZones::warn(const fsiCase& c)
{
    const particleCloud& cloud = c.cloud;
    if (warned_ || !c.structure) return;
    List<scalar> sum(cloud.zones.size(), 0), G(cloud.zones.size(), 0);
    List<label> n(cloud.zones.size(), 0);
    for (label i = 0; i < cloud.nSolid(); ++i)
        sum[cloud.zone[i]] += cloud.Up[i][3], ++n[cloud.zone[i]],
            G[cloud.zone[i]] = c.structure->shearModulus(i);
    for (size_t z = 0; z < sum.size(); ++z)
    {
        if (n[z] == 0 || G[z] >= c.structure->shearModulus()) continue;
        const scalar ratio = std::abs(sum[z]) / (n[z] * G[z]);
        if (ratio <= mostPressure) continue;
        warned_ = true;
        warning("The pressure in zone " + cloud.zones[z].name + " is " + str(ratio, 3) +
                " times its shear modulus G of " + str(G[z], 4) +
                " Pa, and other zones are stiffer. Above " + str(mostPressure) +
                " G a soft layer lets volume through, and its pressure is too low (doc/limits.md). "
                "Check the modulus of " +
                cloud.zones[z].name + ", or leave so soft a layer away");
    }
}

}  // namespace ispf
