// SPDX-License-Identifier: GPL-3.0-or-later
// Errors in constant/boundary or its surfaces are reported with the patch, the place and the remedy
#include "core/errorOf.H"
#include "scene.H"

using namespace scene;

namespace
{

// Fluid in the unit cube, ten particles per side
struct cube
{
    folder files;
    particleCloud cloud =
        fluid(lattice(0.1, {0, 0, 0}, {1, 1, 1},
                      [](const vector& x) { return x.minCoeff() > 0 && x.maxCoeff() < 1; }),
              0.1);

    boundary with(const word& patches) const
    {
        return boundary(files.path, dictionary::fromString(patches), cloud, 0.26);
    }
};

// The text that body writes to stderr
word errorOutput(const std::function<void()>& body)
{
    std::fflush(stderr);
    const int before = dup(2);
    FILE* const file = std::tmpfile();
    dup2(fileno(file), 2);
    body();
    std::fflush(stderr);
    dup2(before, 2), close(before);
    word text(4096, ' ');
    std::rewind(file);
    text.resize(std::fread(text.data(), 1, text.size(), file));
    std::fclose(file);
    return text;
}

const triSurface bottom = sheet({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2);  // normal down

}  // namespace

TEST_CASE("an unknown type or word lists the valid ones")
{
    const cube c;
    CHECK_ERROR(c.with("\nbase { type noSlip; }"),
                "Valid types are: cyclic open symmetryPlane wall", 2);
    CHECK_ERROR(c.with("base { type wall; representation mirrors; }"), "mirror particles", 1);
    CHECK_ERROR(c.with("base { type wall; surface sphere; }"), "plane triSurface", 1);
    CHECK_ERROR(c.with("x0 { type symmetryPlane; point (0 0 0);\n normal (-1 0 0); colour red; }"),
                "colour", 2);
    CHECK_ERROR(c.with("x0 { type symmetryPlane; point (0 0 0); }"), "normal", 1);
    // those of other types are not among the valid ones
    CHECK_ERROR(c.with("base { type wall; representation mirror; surface plane; point (0 0 0); "
                       "normal (0 0 -1); pressureDrop 1; }"),
                "Valid entries here are: clamps motion normal point representation rotation slip "
                "surface twoSided type velocity\n",
                1);
    CHECK_ERROR(c.with("x0 { type symmetryPlane; point (0 0 0); normal (0 0 0); }"),
                "must not be zero", 1);
}

TEST_CASE("surfaces that are missing, empty, flat to a line, reversed or in other units")
{
    cube c;
    const word wall = "base { type wall; representation mirror; }";
    CHECK_ERROR(c.with("\n" + wall), "constant/triSurface/base.stl", 2);
    triSurface line;
    line.addPatch("base");
    line.add({0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, 0);
    c.files.surface("base", line);
    CHECK_ERROR(c.with("\n" + wall), "without an area", 2);

    triSurface reversed = bottom;
    reversed.flip();
    c.files.surface("base", reversed);
    CHECK_ERROR(c.with("\n" + wall), "Its normals must point out of the fluid", 2);

    triSurface millimetres = bottom;
    millimetres.scale(1000);
    for (vector& x : millimetres.nodes) x[2] -= 500;
    c.files.surface("base", millimetres);
    // no error, because fluid may come there later
    CHECK(errorOutput([&] { c.with(wall); }).find("Is its surface in metres?") != word::npos);
    c.files.surface("base", sheet({-1, -1, 0}, {0, 0.5, 0}, {0.5, 0, 0}));
    CHECK_ERROR(c.with(wall + "x0 { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"),
                "base lies beyond", 0);

    c.files.surface("base", bottom);
    CHECK_ERROR(c.with("base { type wall; }"), "constant/wallParticles.hdf", 0);
    c.files.points("wallParticles.hdf", {{"lid", {{0, 0, -0.05}}}});
    CHECK_ERROR(c.with("\nbase { type wall; }"), "Valid patches are: lid", 2);
}

TEST_CASE("cyclic pairs and symmetry planes that do not fit the particles")
{
    const cube c;
    const auto pair = [&](const word& point, const word& separation) {
        return c.with("x { type cyclic; point " + point + "; separation " + separation + "; }");
    };
    CHECK_ERROR(pair("(0 0 0)", "(0 0 0)"), "must not be zero", 1);
    CHECK_ERROR(pair("(0 0 0)", "(0.8 0 0)"), "beyond patch x", 0);
    CHECK_ERROR(pair("(0 0 0)", "(1.2 0 0)"), "would enter a gap", 0);
    CHECK_ERROR(pair("(-0.2 0 0)", "(1.2 0 0)"), "would enter a gap", 0);
    CHECK_ERROR(c.with("x { type symmetryPlane; point (0 0 0); normal (1 0 0); }"),
                "beyond patch x", 0);
    CHECK_ERROR(c.with("x { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
                       "y { type symmetryPlane; point (0 0 0); normal (-1 -0.2 0); }"),
                "x and y meet at", 0);
}

TEST_CASE("open faces without sites, without fluid, with reversed normals")
{
    cube c;
    const word top = "\ntop { type open; p 0; }";
    const triSurface face = sheet({0, 0, 0.8}, {1, 0, 0}, {0, 1, 0}, 2);
    c.files.surface("top", face);
    CHECK_ERROR(c.with(top), "constant/openSites.hdf", 0);
    const auto sitesAt = [](scalar z) {
        return std::map<word, List<vector>>{
            {"top", lattice(0.1, {0, 0, z}, {1, 1, z + 0.2}, [&](const vector& x) {
                 return x.minCoeff() > 0 && x.head<2>().maxCoeff() < 1 && x[2] > z &&
                        x[2] < z + 0.2;
             })}};
    };
    c.files.points("openSites.hdf", sitesAt(0.8));
    c.with(top);
    CHECK_ERROR(c.with("\ntop { type open; }"), "'p'", 2);
    c.files.points("openSites.hdf", sitesAt(0.4));
    CHECK_ERROR(c.with(top), "Its normals must point out of the fluid", 2);
    triSurface far = face;
    for (vector& x : far.nodes) x[2] += 3;
    c.files.surface("top", far);
    c.files.points("openSites.hdf", sitesAt(3.8));
    CHECK_ERROR(c.with(top), "no fluid particle within 2 dx", 2);
}

TEST_CASE("motions that cannot be")
{
    cube c;
    c.files.surface("base", bottom);
    const auto moving = [&](const word& motion) {
        return c.with("base { type wall; representation mirror;\nmotion { " + motion + " } }");
    };
    CHECK_ERROR(moving("direction (0 0 1);"),
                "'direction' and 'displacement', 'velocity', or 'rotation'", 2);
    CHECK_ERROR(moving("direction (0 0 0); displacement 1;"), "must not be zero", 2);
    CHECK_ERROR(moving("velocity (0 0 1); displacement 1;"), "or 'velocity'", 2);
    CHECK_ERROR(c.with("base { type wall; surface plane; point (0 0 0); normal (0 0 -1);\n"
                       "velocity (0 0 1); }"),
                "must lie in the plane", 2);
    CHECK_ERROR(c.with("base { type wall; surface plane; point (0 0 0); normal (0 0 -1);\n"
                       "twoSided yes; }"),
                "a plane has no end", 2);
}

TEST_CASE("walls that move over a cyclic plane are refused, at the start and as they get there")
{
    cube c;
    const auto moving = [&](const triSurface& s, const word& motion) {
        c.files.surface("base", s);
        return c.with(
            "x { type cyclic; point (0 0 0); separation (1 0 0); }"
            "base { type wall; representation mirror;\n" +
            motion + " }");
    };
    for (const word along : {"velocity (1 0 0.1);", "direction (-1 0 0); displacement 0;",
                             "rotation { origin (0 0 0); axis (0 0 1); omega 1; }"})
        CHECK_ERROR(moving(bottom, "motion { " + along + " }"), "give the wall a 'velocity'", 2);
    moving(bottom, "velocity (1 0 0);");
    moving(bottom, "motion { velocity (0 0.1 -0.1); }");
    moving(bottom, "motion { rotation { origin (0 0.5 0); axis (1 0 0); omega 1; } }");
    moving(bottom, "motion { velocity (0 0 0); }");
    CHECK_ERROR(
        moving(bottom,
               "surface plane; point (0 0 0); normal (0 0 -1); motion { velocity (1 0 0); }"),
        "across the cyclic patch x, and at time 0 s", 2);
    moving(bottom, "surface plane; point (0 0 0); normal (0 0 -1); motion { velocity (0 1 -1); }");
    // its image is nearer to the plane than it is to itself
    boundary inside =
        moving(sheet({0.1, 0, 0}, {0, 1, 0}, {0.6, 0, 0}), "motion { velocity (1 0 0); }");
    const auto moveTo = [&](scalar t) { inside.setStep(0, t), inside.exchange(c.cloud, t); };
    moveTo(0.2);
    CHECK_ERROR(moveTo(0.27), "moves across the cyclic patch x, and at time 0.27 s", 2);
}

// The place of the wall at the time of the cloud shows on which side of it the particles are
TEST_CASE("a moving wall behind its particles")
{
    cube c;
    c.files.surface("base", bottom);
    const word text = "base { type wall; representation mirror; motion { velocity (0 0 0.1); } }";
    const auto at = [&](scalar t0) {
        return boundary(c.files.path, dictionary::fromString(text), c.cloud, 0.26, t0);
    };
    CHECK(errorOutput([&] { at(1); }).empty());
    CHECK_ERROR(at(9), "particles are behind the wall", 1);
    CHECK(errorOutput([&] { at(60); }).find("no particle is within") != word::npos);
}
