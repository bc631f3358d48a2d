// SPDX-License-Identifier: GPL-3.0-or-later
#include "scratchFile.H"
#include "fileNames.H"
#include "hdf5File.H"
#include "particleFile.H"
#include "targets.H"

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace ispf::fuzz
{

namespace
{

// Small values from the bytes, zero after their end
class byteSource
{
public:
    explicit byteSource(const word& bytes) : bytes_(bytes) {}
    bool done() const { return at_ >= bytes_.size(); }
    unsigned next() { return done() ? 0 : static_cast<unsigned char>(bytes_[at_++]); }
    scalar number()
    {
        scalar value = 0;
        char raw[sizeof value];
        for (char& c : raw) c = char(next());
        std::memcpy(&value, raw, sizeof value);
        return value;
    }

private:
    const word& bytes_;
    size_t at_ = 0;
};

const word names[] = {"/VTKHDF/Points",
                      "/VTKHDF/PointData/p",
                      "/VTKHDF/PointData/U",
                      "/VTKHDF/PointData/id",
                      "/ispf/extra/history",
                      "/ispf/text/time",
                      "/ispf/text/zones",
                      "/VTKHDF",
                      "/ispf"};

// A sound HDF5 file of any content, such as another program might write under our names
word composed(byteSource& in)
{
    hdf5Writer out;
    while (!in.done())
    {
        const word name = names[in.next() % std::size(names)];
        const size_t n = in.next() % 8;
        switch (in.next() % 7)
        {
            case 0:
                out.write(name, List<scalar>(n, in.number()));
                break;
            case 1:
                out.write(name, List<vector>(n, vector(in.number(), 0, 1)));
                break;
            case 2:
                out.write(name, List<globalId>(n, in.next()));
                break;
            case 3:
                out.write(name, List<std::uint8_t>(n, std::uint8_t(in.next())));
                break;
            case 4:
                out.write(name, word(n, char(in.next())));
                break;
            case 5:
                out.group(name);
                break;
            case 6:
                out.attribute(name, in.next() % 2 ? "version" : "checksum",
                              List<globalId>(n, in.next()));
                break;
        }
    }
    return out.bytes();
}

// The bytes of a file as these programs write it
word soundFile()
{
    particleTable t;
    t.x = {vector(0, 0, 0), vector(1, 2, 3)};
    t.scalars["p"] = {1, 2};
    t.vectors["U"] = {vector(0, 1, 0), vector(1, 0, 0)};
    t.integers["id"] = {0, 1};
    t.extra["history"] = {1, 2, 3};
    t.attributes["zones"] = "water";
    t.setAttribute("dx", 0.1);
    scratchFile file;
    writeParticles(t, file.path());
    List<word> remarks;
    if (readParticlesHere(file.path(), remarks).x != t.x || !remarks.empty()) std::abort();
    const word bytes = readText(file.path());
    return bytes;
}

// A sound file with a few bytes changed: libFuzzer, which cannot see into the HDF5 library, would hardly find these
word patched(byteSource& in)
{
    static const word sound = soundFile();
    word content = sound;
    while (!in.done())
    {
        const size_t at = in.next() << 8 | in.next();
        content[at % content.size()] = char(in.next());
    }
    return content;
}

void check(const particleTable& table)
{
    for (const vector& x : table.x)
        if (!x.allFinite()) std::abort();
    for (const auto& [name, values] : table.scalars)
        if (values.size() != table.size()) std::abort();
    for (const auto& [name, text] : table.attributes) try
        {
            table.scalarAttribute(name);
        }
        catch (const fatalError&)
        {
        }
}

}  // namespace

void hdf5(const word& bytes)
{
    static scratchFile file;
    if (bytes.empty()) return;
    const word content = bytes.substr(1);
    quietly([&] {
        if (bytes[0] % 2 == 0)
        {
            unpacker in(content);
            unpackTable(in);
            return;
        }
        byteSource source(content);
        file.set(composed(source));
        List<word> remarks;
        check(readParticlesHere(file.path(), remarks));
    });
}

void hdf5Damaged(const word& bytes)
{
    static scratchFile file;
    if (bytes.empty()) return;
    const word content = bytes.substr(1);
    quietly([&] {
        byteSource source(content);
        file.set(bytes[0] % 2 == 0 ? content : patched(source));
        check(readParticles(file.path()));
    });
}

}  // namespace ispf::fuzz
