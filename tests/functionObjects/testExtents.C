// SPDX-License-Identifier: GPL-3.0-or-later
// Tables say whether their values are of the whole body or of the part that symmetry planes leave of it
#include "testCase.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

const List<word> planes = {"symX { type symmetryPlane; point (0 0 0); normal (-1 0 0); }",
                           "symY { type symmetryPlane; point (0 0 0); normal (0 -1 0); }",
                           "symZ { type symmetryPlane; point (0 0 0); normal (0 0 -1); }"};

// A solid below a fluid below a lid, with this many symmetry planes
struct layered : testCase
{
    explicit layered(size_t nPlanes)
    {
        addBlock("tissue", {0, 0, 0}, {8, 8, 5}, "solid");
        addBlock("blood", {0, 0, 5e-3}, {8, 8, 5});
        boundary = "lid { type wall; representation mirror; }";
        for (size_t k = 0; k < nPlanes; ++k) boundary += planes[k];
        sheet("lid", 10e-3), sheet("tissue_to_blood", 5e-3);
        functions =
            "flux { type patchFlux; patch lid; } section { type patchFlux; surface lid; }"
            "cavity { type cavityVolume; surface tissue_to_blood; }"
            "energy { type energy; } momentum { type momentum; }"
            "load { type forces; patches (lid); } leaks { type surfaceLeaks; patches (lid); }"
            "sum { type volFieldValue; operation volIntegrate; } age { type residenceTime; }"
            "shear { type wallShearStress; patches (lid); writeControl timeStep; }"
            "stress { type solidStress; writeControl timeStep; }";
    }

    void sheet(const word& name, scalar z)
    {
        triSurface s;
        s.addPatch(name);
        const scalar a = 8e-3;
        s.add({0, 0, z}, {a, 0, z}, {a, a, z}, 0), s.add({0, 0, z}, {a, a, z}, {0, a, z}, 0);
        std::filesystem::create_directories(path + "/constant/triSurface");
        writeSTL(s, path + "/constant/triSurface/" + name + ".stl");
    }

    void run()
    {
        auto r = start();
        functionObjectList f(*r.c);
        f.start();
    }
};

}  // namespace

TEST_CASE("where symmetry planes cut the body, a table says to what its values refer")
{
    const List<word> whole = {"section/0/patchFlux", "cavity/0/cavityVolume", "energy/0/energy"};
    const List<word> modelled = {"momentum/0/momentum",  "load/0/force",        "load/0/moment",
                                 "leaks/0/surfaceLeaks", "sum/0/volFieldValue", "shear/0/lid",
                                 "age/0/residenceTime",  "stress/0/solidStress"};
    const List<word> parts = {"", "half", "quarter"};
    for (size_t n = 0; n < parts.size(); ++n)
    {
        layered t(n);
        t.run();
        const auto says = [&](const word& table, const word& what) {
            CAPTURE(table);
            const word text = t.output(table + ".dat");
            CHECK((text.find("# Symmetry planes: ") != word::npos) == (n > 0));
            if (n > 0) CHECK(text.find("# Symmetry planes: " + what + "\n") != word::npos);
        };
        const word ofWhole = "of the whole body, not of the modelled " + parts[n],
                   ofModelled = "of the modelled " + parts[n] + ", not of the whole body";
        for (const word& table : whole) says(table, ofWhole);
        for (const word& table : modelled) says(table, ofModelled);
        says("flux/0/patchFlux",
             "created and deleted of the modelled part, flux and volume " + ofWhole);
    }
}
