// SPDX-License-Identifier: GPL-3.0-or-later
// Fibres that are known at points, theory 5.10
#include "errorOf.H"
#include "fibres.H"
#include "fileFormats/scratchFolder.H"

#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace ispf;
using namespace ispf::test;

namespace
{

const word helix = "type helix; point (0 0 0); axis (0 0 1); angles (35 -50);";

fibreDirections fibres(const word& entries, const List<vector>& x)
{
    return {dictionary::fromString(entries), x};
}

// A tube between the radii 8 and 12 mm
List<vector> tube(scalar spacing, scalar offset)
{
    List<vector> all;
    const scalar out = 0.012;
    for (scalar x = -out + offset; x < out; x += spacing)
        for (scalar y = -out + offset; y < out; y += spacing)
            for (scalar z = offset; z < 0.004; z += spacing)
                if (const scalar r = std::hypot(x, y); r > 0.008 && r < out)
                    all.emplace_back(x, y, z);
    return all;
}

word line(const vector& x, const vector& f)
{
    word text;
    for (const scalar v : {1e3 * x[0], 1e3 * x[1], 1e3 * x[2], f[0], f[1], f[2]})
        text += (text.empty() ? "" : ",") + str(v, 12);
    return text + "\n";
}

// The helices at points, with random signs and lengths
struct sampled
{
    scratchFolder folder{"fibrePoints"};
    List<vector> x;
    word files;

    explicit sampled(scalar spacing, unsigned seed = 1) : x(tube(spacing, 0.3 * spacing))
    {
        const fibreDirections exact = fibres(helix, x);
        std::mt19937 generator(seed);
        for (label family = 0; family < 2; ++family)
        {
            word text = "# of a test\nx [mm],y [mm],z [mm],fx,fy,fz\n";
            for (label k = 0; k < label(x.size()); ++k)
            {
                const scalar length = 0.5 + scalar(generator() % 100) / 50;
                text += line(x[k], (generator() % 2 ? length : -length) * exact.of(family, k));
            }
            const word name = folder / ("family" + std::to_string(family) + ".csv");
            setContent(name, text);
            files += " \"" + name + "\"";
        }
    }
    word entries(const word& others = "farthest 1 [mm];") const
    {
        return "type points; files (" + files + "); nHeaderLine 2; " + others;
    }
};

scalar degreesBetween(const vector& a, const vector& b)
{
    return std::acos(std::min(1.0, std::abs(a.dot(b)))) * 180 / M_PI;
}

}  // namespace

TEST_CASE("fibres at points: a sampled helix is that helix, the more so the closer the points are")
{
    const List<vector> particles = tube(0.7e-3, 0.1e-3);
    const fibreDirections exact = fibres(helix, particles);
    scalar before = 90;
    for (const scalar spacing : {1e-3, 0.5e-3})
    {
        const sampled points(spacing);
        scalar nearest = 0;
        for (const int neighbours : {1, 4, 8})
        {
            const fibreDirections found = fibres(
                points.entries("farthest 1.2 [mm]; neighbours " + std::to_string(neighbours) + ";"),
                particles);
            REQUIRE(found.nFamilies() == 2);
            scalar worst = 0;
            for (label family = 0; family < 2; ++family)
                for (label k = 0; k < label(particles.size()); ++k)
                {
                    const vector &a = found.of(family, k), &b = exact.of(family, k);
                    CHECK(std::abs(a.norm() - 1) < 1e-14);
                    worst = std::max(worst, degreesBetween(a, b));
                }
            MESSAGE("points every ", 1e3 * spacing, " mm, ", neighbours, " neighbours: ", worst,
                    " degrees off at most");
            if (neighbours == 1) nearest = worst;
            else CHECK(worst < nearest);
            // half the diagonal of a cell seen from the inner radius
            CHECK(worst < std::sqrt(0.75) * spacing / 0.008 * 180 / M_PI);
        }
        CHECK(nearest < before);
        before = nearest;
    }
}

TEST_CASE("fibres at points: no sign counts, a point itself is exact, two dimensions and columns")
{
    const sampled points(0.8e-3, 1), turned(0.8e-3, 2);
    const List<vector> particles = tube(1e-3, 0.15e-3);
    const fibreDirections a = fibres(points.entries(), particles),
                          b = fibres(turned.entries(), particles);
    for (label k = 0; k < label(particles.size()); ++k)
        CHECK(degreesBetween(a.of(0, k), b.of(0, k)) < 1e-5);
    const fibreDirections there = fibres(points.entries(), points.x),
                          exact = fibres(helix, points.x);
    for (label k = 0; k < label(points.x.size()); ++k)
        CHECK(degreesBetween(there.of(1, k), exact.of(1, k)) < 1e-5);
    const scratchFolder folder("fibreColumns");
    setContent(folder / "a.csv",
               "\"Points:0\";\"Points:1\";r;\"Points:2\";a;b;c\n0;0;9;0;0;0;-2\n\n1;0;9;0;3;0;0\n");
    const fibreDirections other = fibres(
        "type points; files (\"" + word(folder / "a.csv") +
            "\"); separator \";\"; columns (Points:0 Points:1 Points:2 a b c); farthest 0.4;",
        {vector(0.1, 0, 0), vector(0.9, 0, 0.1)});
    CHECK(std::abs(other.of(0, 0)[2]) == doctest::Approx(1).epsilon(1e-14));
    CHECK(std::abs(other.of(0, 1)[0]) == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("fibres at points: what is wrong is refused with its line")
{
    const scratchFolder folder("fibreErrors");
    const word file = folder / "f.csv", head = "x [mm],y,z,fx,fy,fz\n";
    const auto error = [&](const word& text, const word& others = "farthest 1;",
                           const vector& x = vector::Zero()) {
        setContent(file, text);
        try
        {
            fibres("type points; files (\"" + file + "\"); " + others, {x});
        }
        catch (const fatalError& e)
        {
            return word(e.what()) + " line " + std::to_string(e.location().line);
        }
        return word();
    };
    const auto says = [](const word& message, const word& part, const word& line) {
        CAPTURE(message);
        CHECK(message.find(part) != word::npos);
        CHECK(message.find(line) != word::npos);
    };
    CHECK(error(head + "0,0,0,1,0,0\n") == "");
    says(error(head + "0,0,0,1,0,0\n0,0,nan,1,0,0\n"), "found 'nan'", "line 3");
    says(error(head + "0,0,0,1,0,0\n0,0,1,1,0\n"), "has 5 columns", "line 3");
    says(error(head + "0,0,0,0,0,0\n"), "must not be zero", "line 2");
    says(error("x [s],y,z,fx,fy,fz\n0,0,0,1,0,0\n"), "must have", "line 1");
    says(error("x,y,z,fx,fy\n0,0,0,1,0\n"), "No column 'fz'", "Valid columns are: fx fy x y z");
    says(error(head), "no points", "line 1");
    says(error(head + "5,0,0,1,0,0\n2000,0,0,1,0,0\n", "farthest 0.3;", vector(1.5, 0, 0)),
         "0.5 m from its nearest point", "line 3");
    // two fibres of equal weight across each other have no main direction
    says(error(head + "1,0,0,1,0,0\n-1,0,0,0,1,0\n"), "no direction at (0 0 0)", "");
    says(error(head + "0,0,0,1,0,0\n", ""), "farthest", "");
    says(error(head + "0,0,0,1,0,0\n", "farthest 1; neighbours 0;"), "neighbours", "");
    says(error(head + "0,0,0,1,0,0\n", "farthest 1; columns (x y z);"), "Six columns", "");
    CHECK(errorOf([&] {
              fibres("type points; files (\"none.csv\"); farthest 1;", {vector::Zero()});
          }).find("There is no file none.csv") != word::npos);
}
