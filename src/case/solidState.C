// SPDX-License-Identifier: GPL-3.0-or-later
#include "solidState.H"

namespace ispf
{

namespace entries
{

// The numbers of the solid's memory; absent before the first step
const stateEntry<List<scalar>> solidMemory{"solidMemory"};

}  // namespace entries

namespace
{

solidMemory* memoryOf(const fsiCase& c)
{
    return c.structure ? c.structure->memory() : nullptr;
}

}  // namespace

void recallSolid(fsiCase& c)
{
    if (solidMemory* memory = memoryOf(c))
        memory->recall(c.cloud.state.get(entries::solidMemory, {}));
    else c.cloud.state.erase(entries::solidMemory);
}

void keepSolid(fsiCase& c)
{
    if (const solidMemory* memory = memoryOf(c))
        c.cloud.state.set(entries::solidMemory, memory->numbers());
}

}  // namespace ispf
