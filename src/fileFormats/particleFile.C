// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of the file, version 1:
//   /VTKHDF             UnstructuredGrid 1.0: Points, one vertex cell each, PointData/<column>
//   /ispf               attributes version, checksum
//   /ispf/extra/<name>, /ispf/text/<name>
// All numbers are double or 64-bit integers, so what ParaView shows is what a restart reads.
#include "particleTable.H"

#include "fileNames.H"
#include "hdf5File.H"
#include "particleTableCheck.H"

#include <numeric>

namespace ispf
{

namespace
{

constexpr globalId formatVersion = 1;
constexpr std::uint8_t vtkVertex = 1;
const word grid = "/VTKHDF", columns = "/VTKHDF/PointData", ours = "/ispf";
const word extras = "/ispf/extra", texts = "/ispf/text";

void composeGrid(hdf5Writer& file, const particleTable& table)
{
    const globalId n = globalId(table.size());
    file.group(columns);
    file.attribute(grid, "Version", List<globalId>{1, 0});
    file.attribute(grid, "Type", word("UnstructuredGrid"));
    for (const word count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
        file.write(grid + "/" + count, List<globalId>{n});
    List<globalId> index(size_t(n) + 1);
    std::iota(index.begin(), index.end(), globalId(0));
    file.write(grid + "/Offsets", index);
    index.pop_back();
    file.write(grid + "/Connectivity", index);
    file.write(grid + "/Types", List<std::uint8_t>(size_t(n), vtkVertex));
    file.write(grid + "/Points", table.x);
    for (const auto& [name, values] : table.scalars) file.write(columns + "/" + name, values);
    for (const auto& [name, values] : table.vectors) file.write(columns + "/" + name, values);
    for (const auto& [name, values] : table.integers) file.write(columns + "/" + name, values);
}

void readColumns(const hdf5Reader& file, particleTable& table)
{
    for (const word& name : file.children(columns))
    {
        const word path = columns + "/" + name;
        switch (file.kindOf(path))
        {
            case hdf5Reader::kind::scalars:
                file.read(path, table.scalars[name]);
                break;
            case hdf5Reader::kind::vectors:
                file.read(path, table.vectors[name]);
                break;
            case hdf5Reader::kind::integers:
                file.read(path, table.integers[name]);
                break;
            default:
                file.fail("column '" + name + "' is neither scalar, vector nor integer");
        }
    }
}

void checkVersion(const hdf5Reader& file)
{
    if (!file.found(ours) || !file.found(columns) || !file.foundAttribute(ours, "version"))
        file.fail("it is an HDF5 file, but not one of particles written by this program family");
    List<globalId> version;
    file.attribute(ours, "version", version);
    if (version != List<globalId>{formatVersion})
        file.fail("its format version is " +
                  (version.empty() ? word("absent") : std::to_string(version[0])) +
                  "; this program reads version " + std::to_string(formatVersion) +
                  ".  Use the program that wrote it, or a newer one");
}

}  // namespace

void writeParticles(const particleTable& table, const word& path)
{
    checkTable(table, "Particles are not written to '" + path + "'");
    hdf5Writer file;
    composeGrid(file, table);
    file.group(extras);
    file.group(texts);
    file.attribute(ours, "version", List<globalId>{formatVersion});
    file.attribute(ours, "checksum", List<globalId>{checksumOf(table)});
    for (const auto& [name, values] : table.extra) file.write(extras + "/" + name, values);
    for (const auto& [name, text] : table.attributes) file.write(texts + "/" + name, text);
    writeText(path, file.bytes());
}

particleTable readParticles(const word& path)
{
    const hdf5Reader file(path);
    checkVersion(file);
    particleTable table;
    file.read(grid + "/Points", table.x);
    readColumns(file, table);
    for (const word& name : file.children(extras))
        file.read(extras + "/" + name, table.extra[name]);
    for (const word& name : file.children(texts))
        file.read(texts + "/" + name, table.attributes[name]);
    checkTable(table, "Cannot read '" + path + "'");

    List<globalId> sum;
    file.attribute(ours, "checksum", sum);
    if (sum != List<globalId>{checksumOf(table)})
        file.fail("its checksum does not fit its content: the file was damaged or edited");
    return table;
}

}  // namespace ispf
