// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepReport.H"

#include "execution.H"
#include "messages.H"
#include <ostream>

namespace ispf
{

void printCourant(const particleCloud& cloud, scalar dt)
{
    const auto Co = [&](label i) { return cloud.Up[i].xyz().norm() * dt / cloud.dx; };
    info() << "Courant Number mean: " << sumOf(0, cloud.n(), Co) / cloud.n()
           << " max: " << std::max(scalar(0), largestOf(0, cloud.n(), Co)) << std::endl;
}

namespace entries
{

// Sum of the global errors since the start
const stateEntry<scalar> continuityErrors{"continuityErrors"};

}  // namespace entries

void printContinuityErrors(particleCloud& cloud, const List<scalar>& left, scalar dt)
{
    const auto [local, global] = sumsOf(0, label(left.size()), [&](label i) {
        const scalar error = dt * left[i] / scalar(left.size());
        return std::array<scalar, 2>{std::abs(error), error};
    });
    cloud.state.add(entries::continuityErrors, global);
    info() << "time step continuity errors : sum local = " << local << ", global = " << global
           << ", cumulative = " << cloud.state.get(entries::continuityErrors, 0) << std::endl;
}

}  // namespace ispf
