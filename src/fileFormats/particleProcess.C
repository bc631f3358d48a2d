// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleFile.H"

#include "guardedProcess.H"

#include <filesystem>

namespace ispf
{

namespace
{

template <class T>
void packColumns(packer& out, const std::map<word, List<T>>& columns)
{
    out.put(columns.size());
    for (const auto& [name, values] : columns) out.putWord(name), out.putList(values);
}

template <class T>
std::map<word, List<T>> unpackColumns(unpacker& in)
{
    std::map<word, List<T>> columns;
    for (size_t n = in.get<size_t>(); n > 0; --n)
    {
        const word name = in.getWord();
        columns[name] = in.getList<T>();
    }
    return columns;
}

// Reading takes 2 ms of work and two copies in memory for 1 MB.  It waits for a slow disk.  It would wait for ever for
// the other end of a pipe that a link in the file names.
processLimits limitsFor(size_t fileSize)
{
    processLimits limits;
    limits.seconds = 60 + 1e-6 * scalar(fileSize);
    limits.cpuSeconds = 10 + 1e-7 * scalar(fileSize);
    limits.memory = (size_t(256) << 20) + 8 * fileSize;
    limits.ifEnded = " The HDF5 library itself failed: the file is damaged. Take another time.";
    return limits;
}

}  // namespace

void pack(packer& out, const particleTable& table)
{
    out.putList(table.x);
    packColumns(out, table.scalars), packColumns(out, table.vectors);
    packColumns(out, table.integers), packColumns(out, table.extra);
    out.put(table.attributes.size());
    for (const auto& [name, text] : table.attributes) out.putWord(name), out.putWord(text);
}

particleTable unpackTable(unpacker& in)
{
    particleTable table;
    table.x = in.getList<vector>();
    table.scalars = unpackColumns<scalar>(in);
    table.vectors = unpackColumns<vector>(in);
    table.integers = unpackColumns<globalId>(in);
    table.extra = unpackColumns<scalar>(in);
    for (size_t n = in.get<size_t>(); n > 0; --n)
    {
        const word name = in.getWord();
        table.attributes[name] = in.getWord();
    }
    return table;
}

particleTable readParticles(const word& path)
{
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) throw fatalError("Cannot read '" + path + "': " + error.message() + ".");
    const auto job = [&](packer& out, const grantTime&) {
        List<word> remarks;
        const particleTable table = readParticlesHere(path, remarks);
        out.putWords(remarks);
        pack(out, table);
    };
    unpacker in = runGuarded("Cannot read '" + path + "': reading", limitsFor(size), job);
    for (const word& remark : in.getWords()) warning(remark);
    return unpackTable(in);
}

}  // namespace ispf
