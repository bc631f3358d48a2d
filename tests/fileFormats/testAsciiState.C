// SPDX-License-Identifier: GPL-3.0-or-later
// writeFormat ascii: the same state bit by bit, as text that OpenFOAM's own reader accepts
#include "fileNames.H"
#include "particleState.H"
#include "sampleTable.H"
#include "scratchFolder.H"

#include <doctest/doctest.h>
#include <cstdlib>

using namespace ispf;

namespace
{

// Text can hold whole numbers up to 2^53
particleTable asciiTable(size_t n)
{
    particleTable table = sampleTable(n);
    for (globalId& id : table.integers["id"]) id = (globalId(1) << 53) - (id & 4095);
    return table;
}

void replace(const word& path, const word& what, const word& by)
{
    word text = contentOf(path);
    REQUIRE(text.find(what) != word::npos);
    setContent(path, text.replace(text.find(what), what.size(), by));
}

}  // namespace

TEST_CASE("text reads back bit by bit, whatever the precision of ParaView's copy")
{
    const scratchFolder folder("ascii");
    for (const size_t n : {0, 1, 2345})
    {
        particleTable table = asciiTable(n);
        table.attributes["a note"] = "several\nlines with \"quotes\" and \\";
        table.scalars["Up_0:w"].assign(n, 1.0 / 3);
        writeState(table, folder / "0.3", stateFormat::ascii, 3);
        CHECK(sameBits(table, readState(folder / "0.3")));
        // fields of the previous table that this one does not have are removed
        table.scalars.erase("Up_0:w");
        writeState(table, folder / "0.3", stateFormat::ascii, 3);
        CHECK(sameBits(table, readState(folder / "0.3")));
    }
    CHECK(contentOf(folder / "0.3/U").find("nonuniform List<vector>\n2345\n(\n(-1 5e-324 1)") !=
          word::npos);
    CHECK(contentOf(folder / "0.3/particles.vtp").find("0.000841 1 -0\n") != word::npos);
}

TEST_CASE("one format takes the other's place, and nothing is left of it")
{
    const scratchFolder folder("formats");
    const particleTable first = asciiTable(7), second = sampleTable(9);
    writeState(first, folder / "1", stateFormat::ascii);
    writeState(second, folder / "1", stateFormat::hdf5);
    CHECK(sameBits(second, readState(folder / "1")));
    CHECK(!isFile(folder / "1/U"));
    CHECK(!isFile(folder / "1/particles.vtp"));
    writeState(first, folder / "1", stateFormat::ascii);
    CHECK(sameBits(first, readState(folder / "1")));
    CHECK(!isFile(folder / "1/particles.hdf"));
}

TEST_CASE("fields by hand: added and edited ones are taken, damaged ones refused")
{
    const scratchFolder folder("hand");
    const particleTable table = asciiTable(3);
    const word at = folder / "1";
    const auto error = [&] { return textOfError([&] { readState(at); }); };
    writeState(table, at, stateFormat::ascii);
    const word state = at + "/uniform/particles";
    setContent(at + "/T", "internalField nonuniform List<scalar> 3(1 2 3); // mine\n");
    particleTable more = table;
    more.scalars["T"] = {1, 2, 3};
    CHECK(sameBits(more, readState(at)));

    replace(at + "/U", "(-1 5e-324 1)", "(-1 0 1)");
    CHECK(says(error(), "take its checksum out of"));
    word text = contentOf(state);
    const size_t sum = text.find("(\"U\""), end = text.find(')', sum);
    setContent(state, text.erase(sum, end + 1 - sum));
    CHECK(readState(at).vectors["U"][0] == vector(-1, 0, 1));

    for (const auto& [right, wrong] : {std::pair<word, word>{"\n3\n", "\n4\n"},
                                       {"\n4\n", "\n4000000000\n"},
                                       {"\n4000000000\n", "\n2\n"}})
    {
        replace(at + "/U", right, wrong);
        CHECK(says(error(), at + "/U"));
    }
    std::filesystem::remove(at + "/U");
    CHECK(error() == "");  // it has no checksum any more
    std::filesystem::remove(at + "/p");
    CHECK(says(error(), "the field is missing"));
    writeState(table, at, stateFormat::ascii);
    replace(state, "0.30000000000000004", "0.30000000000000005");
    CHECK(says(error(), "does not fit attributes and arrays"));
    writeState(table, at, stateFormat::ascii);
    replace(state, "version     1;", "version     2;");
    CHECK(says(error(), "this program reads version 1"));
}

TEST_CASE("text cut anywhere or with a changed byte is an error or changes nothing")
{
    const scratchFolder folder("cutText");
    const particleTable table = asciiTable(6);
    writeState(table, folder / "1", stateFormat::ascii);
    for (const word name : {"U", "id", "uniform/particles"})
    {
        const word path = folder / ("1/" + name), bytes = contentOf(path);
        for (size_t k = 0; k < bytes.size(); k += 3)
            for (const bool cut : {true, false})
            {
                word changed = bytes;
                if (cut) changed.resize(k);
                else changed[k] = char(changed[k] ^ 0x10);
                setContent(path, changed);
                textOfError([&] {
                    if (!sameBits(table, readState(folder / "1")))
                        FAIL(name << ": a change was not noticed at byte " << k);
                });
            }
        setContent(path, bytes);
    }
}

TEST_CASE("OpenFOAM's foamDictionary reads a field")
{
    if (std::system("command -v foamDictionary > /dev/null 2>&1") != 0)
    {
        MESSAGE("skipped: foamDictionary is not installed");
        return;
    }
    const scratchFolder folder("foam");
    particleTable table = asciiTable(2);
    table.extra = {{"history", {0.1, 0.2}}};
    table.vectors["U"] = {vector(1, 2, 3), vector(0.1, -4, 1e-5)};
    writeState(table, folder / "1", stateFormat::ascii);
    const auto entry = [&](const word& file, const word& key) {
        const word out = folder / "out";
        const word command = "WM_PROJECT_DIR=/usr/share/openfoam foamDictionary -entry " + key +
                             " -value '" + (folder / file) + "' > '" + out + "' 2>&1";
        CHECK(std::system(command.c_str()) == 0);
        return contentOf(out);
    };
    CHECK(says(entry("1/U", "internalField"), "nonuniform List<vector> 2((1 2 3) (0.1 -4 1e-05))"));
    CHECK(says(entry("1/U", "dimensions"), "[ 0 1 -1 0 0 0 0 ]"));
    CHECK(says(entry("1/uniform/particles", "nParticles"), "2"));
}
