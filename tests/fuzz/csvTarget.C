// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1.H"
#include "scratchFile.H"
#include "targets.H"

#include <cmath>
#include <cstdlib>

namespace ispf::fuzz
{

namespace
{

// The bits of the first byte choose the options of the entry for the file
word entryFor(const word& path, unsigned how)
{
    const word outOfBounds[] = {"error", "warn", "clamp", "repeat"};
    const bool csv = how & 1;
    word text = "f { type " + word(csv ? "csvFile" : "tableFile") + "; file \"" + path +
                "\"; outOfBounds " + outOfBounds[how >> 1 & 3] + ";";
    if (csv && how & 8) text += "nHeaderLine 1;";
    if (csv && how & 16) text += "separator \";\";";
    if (csv && how & 32) text += "mergeSeparators yes;";
    if (csv && how & 64) text += "refColumn time; componentColumns (value); scale 1e-3;";
    return text + "}";
}

}  // namespace

void csv(const word& bytes)
{
    static scratchFile file;
    if (bytes.empty()) return;
    quietly([&] {
        file.set(bytes.substr(1));
        const word entry = entryFor(file.path(), static_cast<unsigned char>(bytes[0]));
        const auto d = ispf::dictionary::fromString(entry);
        const auto f = Function1::New("f", d, "");
        for (const scalar t : {-1e300, -1., 0., 0.5, 1., 1e300})
            if (std::isnan(f->value(t))) std::abort();
    });
}

}  // namespace ispf::fuzz
