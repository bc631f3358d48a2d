// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleState.H"

#include "fileNames.H"

#include <filesystem>

namespace ispf
{

namespace
{

const word container = "/particles.hdf";

}  // namespace

void writeState(const particleTable& table, const word& folder, stateFormat format, int precision)
{
    std::error_code ignored;
    if (format == stateFormat::ascii)
    {
        writeAsciiState(table, folder, precision);
        std::filesystem::remove(folder + container, ignored);
        return;
    }
    writeParticles(table, folder + container);
    for (const word& file : asciiStateFiles(folder)) std::filesystem::remove(file, ignored);
}

particleTable readState(const word& folder)
{
    if (isFile(folder + container) || !isFile(folder + "/uniform/particles"))
        return readParticles(folder + container);
    return readAsciiState(folder);
}

}  // namespace ispf
