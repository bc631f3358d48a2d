// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepReport.H"

#include "messages.H"
#include <ostream>

namespace ispf
{

void printCourant(const particleCloud& cloud, scalar dt)
{
    scalar sum = 0, most = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar Co = cloud.Up[i].xyz().norm() * dt / cloud.dx;
        sum += Co, most = std::max(most, Co);
    }
    info() << "Courant Number mean: " << sum / cloud.n() << " max: " << most << std::endl;
}

namespace entries
{

// Sum of the global errors since the start
const stateEntry<scalar> continuityErrors{"continuityErrors"};

}  // namespace entries

void printContinuityErrors(particleCloud& cloud, const List<scalar>& left, scalar dt)
{
    scalar local = 0, global = 0;
    for (const scalar e : left)
    {
        const scalar error = dt * e / scalar(left.size());
        local += std::abs(error), global += error;
    }
    cloud.state.add(entries::continuityErrors, global);
    info() << "time step continuity errors : sum local = " << local << ", global = " << global
           << ", cumulative = " << cloud.state.get(entries::continuityErrors, 0) << std::endl;
}

}  // namespace ispf
