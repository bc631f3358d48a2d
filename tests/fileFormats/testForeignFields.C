// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of other programs in a state: arrays of any number of components are kept; a message names the rest
#include "capturedErrors.H"
#include "fileNames.H"
#include "hdf5File.H"
#include "particleState.H"
#include "sampleTable.H"
#include "scratchFolder.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

// Edits a file as other programs do
class editor
{
public:
    explicit editor(const word& path)
        : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose)
    {
    }

    template <class T>
    void array(const word& path, hid_t type, const List<hsize_t>& shape, const List<T>& values)
    {
        const hdf5Id space(H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose);
        const hdf5Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
        H5Pset_create_intermediate_group(links, 1);
        const hdf5Id set(
            H5Dcreate2(file_, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT),
            H5Dclose);
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
    void text(const word& path, const char* value)
    {
        const hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
        H5Tset_size(type, H5T_VARIABLE), H5Tset_cset(type, H5T_CSET_UTF8);
        const hdf5Id set(
            H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
            H5Dclose);
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
    }
    void remove(const word& path) { H5Ldelete(file_, path.c_str(), H5P_DEFAULT); }
    void link(const word& path)  // to a file that is not there
    {
        H5Lcreate_external("nowhere.hdf", "/x", file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
    void attribute(const word& object, const char* name)
    {
        const hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
        const hdf5Id owner(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose);
        const hdf5Id at(H5Acreate2(owner, name, H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
        const int value = 1;
        H5Awrite(at, H5T_NATIVE_INT, &value);
    }

private:
    hdf5Id file_;
};

template <class T>
List<T> counted(size_t n)
{
    List<T> values;
    for (size_t i = 0; i < n; ++i) values.push_back(T(i) - 7);
    return values;
}

const word columns = "/VTKHDF/PointData/";

word errorsOf(const std::function<void()>& body)
{
    const capturedErrors errors;
    body();
    return errors.text();
}

}  // namespace

TEST_CASE("arrays of any number of components come out as they went in, in both formats")
{
    const scratchFolder folder("wide");
    const word at = folder / "1", path = at + "/particles.hdf";
    particleTable table = sampleTable(5);
    for (globalId& id : table.integers["id"]) id &= 4095;
    writeState(table, at, stateFormat::hdf5);
    const List<hsize_t> widths = {1, 2, 6, 9, 13};
    {
        editor file(path);
        for (const hsize_t k : widths)
        {
            file.array(columns + "s" + std::to_string(k), H5T_NATIVE_DOUBLE, {5, k},
                       counted<double>(5 * k));
            file.array(columns + "i" + std::to_string(k), H5T_NATIVE_INT, {5, k},
                       counted<int>(5 * k));
        }
        file.array(columns + "i3", H5T_NATIVE_INT, {5, 3}, counted<int>(15));
        // names that look like components, beside arrays of that name and alone
        for (const word name : {"s2[0]", "b[0]", "c[0]", "c[1]", "s2:0"})
            file.array(columns + name, H5T_NATIVE_DOUBLE, {5}, counted<double>(5));
        file.array(columns + "i4[0]", H5T_NATIVE_DOUBLE, {5}, counted<double>(5));
        file.array(columns + "i4", H5T_NATIVE_INT, {5, 4}, counted<int>(20));
        file.text("/ispf/text/note", "of somebody");
    }
    for (const stateFormat format :
         {stateFormat::hdf5, stateFormat::ascii, stateFormat::ascii, stateFormat::hdf5})
    {
        table = readState(at);
        CHECK(table.attributes.at("note") == "of somebody");
        CHECK(table.scalars.at("s9/4") == List<scalar>{-3, 6, 15, 24, 33});
        CHECK(table.integers.at("i3/2") == List<globalId>{-5, -2, 1, 4, 7});
        writeState(table, at, format);
        CHECK(sameBits(table, readState(at)));
        for (const word name : {"s2[0]", "b[0]", "c[0]", "c[1]", "s2:0", "i4[0]"})
            CHECK(table.scalars.at(name) == counted<scalar>(5));
        if (format == stateFormat::ascii)
            CHECK(contentOf(at + "/s9")
                      .find("nonuniform List<tensor>\n5\n(\n(-7 -6 -5 -4 -3 -2 -1 0 1)") !=
                  word::npos);
    }
    const hdf5Reader file(path);
    CHECK(file.kindOf(columns + "b[0]") == hdf5Reader::kind::scalars);
    CHECK(!file.found(columns + "b"));
    for (const hsize_t k : widths)
    {
        CAPTURE(k);
        List<scalar> reals;
        List<globalId> wholes;
        file.readWide(columns + "s" + std::to_string(k), reals);
        file.readWide(columns + "i" + std::to_string(k), wholes);
        CHECK(reals == counted<scalar>(5 * k));
        CHECK(wholes == counted<globalId>(5 * k));
        CHECK(file.width(columns + "s" + std::to_string(k)) == k);
    }
}

TEST_CASE("what is not kept is told, each thing once")
{
    const scratchFolder folder("lost");
    const word path = folder / "a.hdf";
    const particleTable table = sampleTable(5);
    writeParticles(table, path);
    {
        editor file(path);
        file.array(columns + "big", H5T_NATIVE_UINT64, {5},
                   List<std::uint64_t>{1, 2, 3, 4, ~std::uint64_t(0)});
        file.array(columns + "small", H5T_NATIVE_UINT64, {5}, List<std::uint64_t>{1, 2, 3, 4, 5});
        file.array(columns + "cube", H5T_NATIVE_DOUBLE, {5, 2, 2}, counted<double>(20));
        file.array("/ispf/mine", H5T_NATIVE_DOUBLE, {2}, counted<double>(2));
        file.array("/ispf/extra/counts", H5T_NATIVE_INT, {2}, counted<int>(2));
        file.array("/VTKHDF/FieldData/TimeValue", H5T_NATIVE_DOUBLE, {1}, counted<double>(1));
        file.attribute("/ispf", "owner"), file.attribute("/", "made"),
            file.attribute(columns + "p", "unit");
    }
    particleTable read;
    const word said = errorsOf([&] { read = readParticles(path); });
    for (const word what : {"'/VTKHDF/PointData/big' holds whole numbers beyond",
                            "'/VTKHDF/PointData/cube'", "'/ispf/mine'", "'/ispf/extra/counts'",
                            "'/VTKHDF/FieldData'", "attribute owner of '/ispf'",
                            "attribute made of '/'", "attribute unit of '/VTKHDF/PointData/p'"})
    {
        CAPTURE(what);
        const size_t first = said.find(what);
        CHECK(first != word::npos);
        CHECK((first == word::npos || said.find(what, first + 1) == word::npos));
    }
    particleTable expected = table;
    expected.integers["small"] = {1, 2, 3, 4, 5};
    CHECK(sameBits(read, expected));
}

TEST_CASE("files of others in an ascii time folder are passed over, and it is said")
{
    const scratchFolder folder("beside");
    particleTable table = sampleTable(3);
    for (globalId& id : table.integers["id"]) id &= 4095;
    const word at = folder / "1";
    writeState(table, at, stateFormat::ascii);
    setContent(at + "/notes.txt", "to do: { buy \"paper\n");
    setContent(at + "/words", "FoamFile { } internalField nonuniform List<word> 3(a b c);");
    setContent(
        at + "/sigma",
        "internalField nonuniform List<symmTensor> 3((1 2 3 4 5 6)(1 2 3 4 5 7)(1 2 3 4 5 8));");
    setContent(at + "/same", "internalField nonuniform List<symmTensor> 3{(1 2 3 4 5 6)};");
    setContent(at + "/pairs", "internalField nonuniform List<vector2D> 3((1 2)(3 4)(5 6));");
    const List<word> wrong = {
        "internalField nonuniform List<vector2D> 3((1 2 3) 4 (5 6));",
        "internalField nonuniform List<symmTensor> 3((1 2 3 4 5 6));",
        "internalField nonuniform List<tensor> 1000000000000{(1 2 3 4 5 6 7 8 9)};",
        "internalField nonuniform List<FixedList<label,2>> 3((1 2)(3 4.5)(5 6));",
        "internalField nonuniform List<scalar> 3(1 two 3);",
        "internalField nonuniform List<scalar> 2(1 2);",
        "internalField nonuniform List<scalar> 3(1 nan 3);",
        "internalField nonuniform List<vector2D> 3((1 2)(3 nan)(5 6));",
        "Some notes: see internalField; of U",
        "internalField { \"left open"};
    for (size_t k = 0; k < wrong.size(); ++k)
        setContent(at + "/wrong" + std::to_string(k), wrong[k]);
    particleTable read;
    const word said = errorsOf([&] { read = readState(at); });
    CAPTURE(said);
    CHECK(says(said, "notes.txt is no field: later times are without it"));
    CHECK(says(said, "Valid lists are: "));
    CHECK(says(said,
               "(line 1: The value of 'internalField' should be a finite number, found 'nan'.)"));
    CHECK(says(said, "column 'wrong5' has 2 rows but there are 3"));
    CHECK(!says(said, "diverged"));
    for (size_t k = 0; k < wrong.size(); ++k)
    {
        CAPTURE(wrong[k]);
        const size_t first = said.find("/wrong" + std::to_string(k) + " is no");
        REQUIRE(first != word::npos);
        CHECK(says(said.substr(first, said.find("-->", first) - first),
                   ": later times are without it"));
    }
    particleTable expected = table;
    for (size_t k = 0; k < 6; ++k)
    {
        const word component = "/" + std::to_string(k);
        expected.scalars["same" + component] = List<scalar>(3, scalar(k + 1));
        expected.scalars["sigma" + component] = List<scalar>(3, scalar(k + 1));
    }
    expected.scalars["sigma/5"] = {6, 7, 8};
    expected.scalars["pairs/0"] = {1, 3, 5}, expected.scalars["pairs/1"] = {2, 4, 6};
    CHECK(sameBits(read, expected));
    writeState(read, at, stateFormat::hdf5);
    CHECK(sameBits(readState(at), expected));
}

TEST_CASE("a damaged file of ours stops the reader, also where its checksum has been taken out")
{
    const scratchFolder folder("ours");
    particleTable table = sampleTable(3);
    for (globalId& id : table.integers["id"]) id &= 4095;
    table.scalars["T"] = {1, 2, 3};
    const word at = folder / "1", state = at + "/uniform/particles";
    for (const word name : {"T", "p"})
    {
        writeState(table, at, stateFormat::ascii);
        setContent(at + "/" + name, "internalField nonuniform List<scalar> 3(1 two 3);");
        const word said = textOfError([&] { readState(at); });
        CAPTURE(said);
        CHECK(says(said, "found 'two'"));
    }
    word text = contentOf(state);
    text.erase(text.find("    (\"p\""),
               text.find('\n', text.find("(\"p\"")) + 1 - text.find("    (\"p\""));
    setContent(state, text);
    CHECK(says(textOfError([&] { readState(at); }), "found 'two'"));
    setContent(at + "/p", "internalField nonuniform List<scalar> 3(1 nan 3);");
    const word said = textOfError([&] { readState(at); });
    CAPTURE(said);
    CHECK(says(said, "found 'nan'"));

    writeState(table, at, stateFormat::hdf5);
    {
        editor file(at + "/particles.hdf");
        file.remove(columns + "p");
        file.array(columns + "p", H5T_NATIVE_DOUBLE, {3}, List<double>{1, std::nan(""), 3});
    }
    const word edited = textOfError([&] { readState(at); });
    CAPTURE(edited);
    CHECK(says(edited, "column 'p' is not a finite number at row 1 (particle id 1)"));
    CHECK(says(edited, "Correct it"));
    CHECK(!says(edited, "diverged"));
}

TEST_CASE("foreign columns of an HDF5 file that are no good are left out, and it is said")
{
    const scratchFolder folder("unsound");
    const word path = folder / "a.hdf";
    const particleTable table = sampleTable(3);
    writeParticles(table, path);
    {
        const scalar nan = std::nan("");
        editor file(path);
        file.array(columns + "heat", H5T_NATIVE_DOUBLE, {3}, List<double>{1, nan, 3});
        file.array(columns + "flow", H5T_NATIVE_DOUBLE, {3, 3},
                   List<double>{1, 2, 3, 4, nan, 6, 7, 8, 9});
        file.array(columns + "pair", H5T_NATIVE_DOUBLE, {3, 2}, List<double>{1, 2, 3, 4, 5, nan});
        file.array(columns + "short", H5T_NATIVE_DOUBLE, {2}, List<double>{1, 2});
        file.array(columns + "good", H5T_NATIVE_DOUBLE, {3}, List<double>{1, 2, 3});
        file.array("/ispf/extra/sums", H5T_NATIVE_DOUBLE, {2}, List<double>{1, nan});
        for (const word& link :
             {columns + "gone", word("/ispf/extra/gone"), word("/ispf/text/gone")})
            file.link(link);
    }
    particleTable read;
    const word said = errorsOf([&] { read = readParticles(path); });
    for (const word what :
         {"'/VTKHDF/PointData/heat' is not kept", "'/VTKHDF/PointData/flow' is not kept",
          "'/VTKHDF/PointData/pair' is not kept", "'/VTKHDF/PointData/short' is not kept",
          "column 'heat' is not a finite number at row 1 (particle id 4611686018427387905)",
          "'/VTKHDF/PointData/good' has no checksum", "'/ispf/extra/sums' holds",
          "'/VTKHDF/PointData/gone' is a link to nothing",
          "'/ispf/extra/gone' is a link to nothing", "'/ispf/text/gone' is a link to nothing"})
    {
        CAPTURE(what);
        CHECK(says(said, what));
    }
    CHECK(!says(said, "diverged"));
    particleTable expected = table;
    expected.scalars["good"] = {1, 2, 3};
    CHECK(sameBits(read, expected));
}
