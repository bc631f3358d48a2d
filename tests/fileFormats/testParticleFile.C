// SPDX-License-Identifier: GPL-3.0-or-later
#include "fileNames.H"
#include "hdf5File.H"
#include "particleTable.H"
#include "scratchFolder.H"

#include <doctest/doctest.h>
#include <cstring>
#include <limits>

using namespace ispf;

namespace
{

particleTable sampleTable(size_t n)
{
    particleTable table;
    List<scalar>& p = table.scalars["p"];
    List<vector>& U = table.vectors["U"];
    List<globalId>& id = table.integers["id"];
    for (size_t i = 0; i < n; ++i)
    {
        const scalar s = scalar(i) + 1;
        table.x.emplace_back(1e-3 * std::sin(s), 1 / s, -0.0);
        p.push_back(std::ldexp(s / 3, int(i % 2000) - 1000));
        U.emplace_back(-s, std::numeric_limits<scalar>::denorm_min() * s, 1 / s);
        id.push_back((globalId(1) << 62) + globalId(i));
    }
    table.extra["history"] = {0.1, 0.2, 1e308, -0.0};
    table.extra["empty"] = {};
    table.attributes["zones"] = "fluid wall buffer";
    table.attributes["empty"] = "";
    table.setAttribute("time", 0.1 + 0.2);
    return table;
}

template <class T>
bool sameBits(const List<T>& a, const List<T>& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

template <class T>
bool sameBits(const std::map<word, List<T>>& a, const std::map<word, List<T>>& b)
{
    if (a.size() != b.size()) return false;
    for (const auto& [name, values] : a)
        if (!b.count(name) || !sameBits(values, b.at(name))) return false;
    return true;
}

bool sameBits(const particleTable& a, const particleTable& b)
{
    return sameBits(a.x, b.x) && sameBits(a.scalars, b.scalars) && sameBits(a.vectors, b.vectors) &&
           sameBits(a.integers, b.integers) && sameBits(a.extra, b.extra) &&
           a.attributes == b.attributes;
}

// The text of the fatalError that body throws, "" if it throws none
template <class Body>
word errorOf(const Body& body)
{
    try
    {
        body();
    }
    catch (const fatalError& error)
    {
        return error.what();
    }
    return "";
}

bool says(const word& text, const word& part)
{
    return text.find(part) != word::npos;
}

}  // namespace

TEST_CASE("particles read back bit by bit, and equal tables give equal bytes")
{
    const scratchFolder folder("particles");
    for (const size_t n : {0, 1, 1234})
    {
        const particleTable table = sampleTable(n);
        writeParticles(table, folder / "0.1/particles.hdf");
        CHECK(sameBits(table, readParticles(folder / "0.1/particles.hdf")));
        writeParticles(table, folder / "again.hdf");
        CHECK(contentOf(folder / "again.hdf") == contentOf(folder / "0.1/particles.hdf"));
    }
    CHECK(folder.nFiles() == 2);  // no temporary file is left
}

TEST_CASE("ParaView's part of the file has the asked layout")
{
    const scratchFolder folder("vtk");
    writeParticles(sampleTable(3), folder / "a.hdf");
    const hdf5Reader file(folder / "a.hdf");
    List<globalId> values;
    file.attribute("/VTKHDF", "Version", values);
    CHECK(values == List<globalId>{1, 0});
    for (const word count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    {
        file.read("/VTKHDF/" + count, values);
        CHECK(values == List<globalId>{3});
    }
    file.read("/VTKHDF/Connectivity", values);
    CHECK(values == List<globalId>{0, 1, 2});
    file.read("/VTKHDF/Offsets", values);
    CHECK(values == List<globalId>{0, 1, 2, 3});
    file.read("/VTKHDF/Types", values);
    CHECK(values == List<globalId>{1, 1, 1});
    CHECK(file.children("/VTKHDF/PointData") == List<word>{"U", "id", "p"});
    // a fixed-length string, without which ParaView refuses the file
    CHECK(says(contentOf(folder / "a.hdf"), "UnstructuredGrid"));
}

TEST_CASE("numbers that are not finite are refused before anything is written")
{
    const scratchFolder folder("nan");
    particleTable table = sampleTable(10);
    const word path = folder / "a.hdf";
    table.vectors["U"][7][1] = std::nan("");
    const word error = errorOf([&] { writeParticles(table, path); });
    CHECK(says(error, "'U'"));
    CHECK(says(error, "row 7"));
    CHECK(says(error, "(0.000989358 0.125 -0) m"));
    table = sampleTable(10);
    table.x[2][0] = std::numeric_limits<scalar>::infinity();
    CHECK(says(errorOf([&] { writeParticles(table, path); }), "row 2"));
    table = sampleTable(10);
    table.extra["history"][1] = std::nan("");
    CHECK(says(errorOf([&] { writeParticles(table, path); }), "'history'"));
    CHECK(folder.nFiles() == 0);
}

TEST_CASE("columns of unequal length and impossible names are refused")
{
    const scratchFolder folder("columns");
    const word path = folder / "a.hdf";
    particleTable table = sampleTable(10);
    table.scalars["p"].pop_back();
    CHECK(says(errorOf([&] { writeParticles(table, path); }), "9 rows but there are 10"));
    table = sampleTable(10);
    table.scalars["U"] = table.scalars["p"];
    CHECK(says(errorOf([&] { writeParticles(table, path); }), "two columns"));
    table = sampleTable(10);
    table.scalars["a/b"] = table.scalars["p"];
    CHECK(says(errorOf([&] { writeParticles(table, path); }), "'a/b'"));
    CHECK(folder.nFiles() == 0);

    // on disk: a column shortened by somebody else
    hdf5Writer foreign;
    foreign.write("/VTKHDF/Points", table.x);
    foreign.write("/VTKHDF/PointData/p", List<scalar>(9));
    foreign.group("/ispf/extra");
    foreign.group("/ispf/text");
    foreign.attribute("/ispf", "version", List<globalId>{1});
    writeText(path, foreign.bytes());
    CHECK(says(errorOf([&] { readParticles(path); }), "9 rows but there are 10"));
}

TEST_CASE("a file cut anywhere is an error, never a crash")
{
    const scratchFolder folder("cut");
    writeParticles(sampleTable(40), folder / "whole.hdf");
    const word bytes = contentOf(folder / "whole.hdf");
    const word path = folder / "cut.hdf";
    setContent(path, bytes);
    for (size_t length = bytes.size() - 1;; length -= std::min<size_t>(length, 10))
    {
        std::filesystem::resize_file(path, length);
        REQUIRE(says(errorOf([&] { readParticles(path); }), path));
        if (length == 0) break;
    }
}

TEST_CASE("changed bytes are an error or change nothing, never a crash")
{
    const scratchFolder folder("flip");
    const particleTable table = sampleTable(40);
    const word path = folder / "a.hdf";
    writeParticles(table, path);
    const word bytes = contentOf(path);
    for (size_t at = 0; at < bytes.size(); at += 7)
    {
        word changed = bytes;
        changed[at] = char(changed[at] ^ 0x10);
        setContent(path, changed);
        const word error = errorOf([&] {
            if (!sameBits(table, readParticles(path)))
                FAIL("a change was not noticed at byte " << at);
        });
        if (!error.empty()) REQUIRE(says(error, path));
    }
}

TEST_CASE("missing, foreign and newer files are told apart")
{
    const scratchFolder folder("foreign");
    const word path = folder / "a.hdf";
    CHECK(says(errorOf([&] { readParticles(path); }), "No such file"));
    setContent(path, "solid cube\n");
    CHECK(says(errorOf([&] { readParticles(path); }), "not an HDF5 file"));
    hdf5Writer other;
    other.write("/data", List<scalar>{1});
    writeText(path, other.bytes());
    CHECK(says(errorOf([&] { readParticles(path); }), "not one of particles"));
    other.group("/VTKHDF/PointData");
    other.group("/ispf");
    other.attribute("/ispf", "version", List<globalId>{999});
    writeText(path, other.bytes());
    CHECK(says(errorOf([&] { readParticles(path); }), "version is 999"));
}

TEST_CASE("attributes keep their bits and errors list what there is")
{
    particleTable table;
    for (const scalar value : {0.1 + 0.2, 1e-300, -0.0, 10.476})
    {
        table.setAttribute("time", value);
        CHECK(table.scalarAttribute("time") == value);
    }
    table.attributes["zones"] = "fluid";
    CHECK(says(errorOf([&] { table.scalarAttribute("zones"); }), "no number"));
    CHECK(says(errorOf([&] { table.scalarAttribute("dx"); }), "time zones"));
}
