// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/errorOf.H"
#include "relative.H"
#include "samplePlane.H"

#include <sstream>

using namespace ispf;
using doctest::Approx;

namespace
{

// Quarter x > 0, y > 0 of a block of fluid below z = 10 mm and of wall above it.  U and p are linear
// and compatible with the symmetry planes x = 0, y = 0
const particleCloud& quarter()
{
    static particleCloud t;
    if (t.n() > 0) return t;
    const scalar dx = t.dx = 1e-3;
    t.zones = {{"fluid"}, {"wall"}};
    for (int k = 0; k < 14; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 8; ++i)
            {
                const vector x = dx * vector(i + 0.5, j + 0.5, k + 0.5);
                const vector U(2 * x[0], 3 * x[1], 1 - 4 * x[2]);
                t.append(x, k < 10 ? 0 : 1, vec4::from(U, 5 + 6 * x[2]), t.nextId());
            }
    return t;
}

const word across =
    "point (0 0 5e-3); normal (0 1 0); xAxis (1 0.5 0); xRange (-12e-3 12e-3); yRange (-3e-3 9e-3);"
    "spacing 1e-3; fields (U p); zones (fluid);";

samplePlane plane(const word& text)
{
    return samplePlane("across", dictionary::fromString(text), quarter());
}

// Rows of numbers, "NaN" included
List<List<scalar>> rows(const word& text)
{
    List<List<scalar>> result;
    std::istringstream lines(text);
    for (word line; std::getline(lines, line);)
    {
        if (line.empty() || line[0] == '#') continue;
        List<scalar> row;
        std::istringstream words(line);
        for (word w; words >> w;) row.push_back(std::strtod(w.c_str(), nullptr));
        result.push_back(row);
    }
    return result;
}

}  // namespace

TEST_CASE("linear fields are exact on the plane, through the symmetry planes, and blank elsewhere")
{
    const word text = plane(across + "images ((1 0 0) (0 1 0));").grid(quarter());
    CHECK(text.substr(0, text.find('\n')) == "# x\ty\tU_x\tU_y\tU_n\tp");
    const auto all = rows(text);
    REQUIRE(all.size() == 25 * 13);
    int nBlank = 0;
    for (const auto& row : all)
    {
        const scalar x = row[0], z = 5e-3 + row[1];
        const bool inside = std::abs(x) < 8e-3 && z < 9.9e-3;
        if (std::isnan(row[2])) CHECK_FALSE(inside);
        nBlank += std::isnan(row[2]);
        if (std::abs(x) > 9.01e-3 || z > 10.6e-3) CHECK(std::isnan(row[5]));
        if (std::isnan(row[2])) continue;
        CHECK(row[2] == Approx(2 * x).epsilon(1e-4));
        CHECK(row[3] == Approx(1 - 4 * z).epsilon(1e-4));
        CHECK(std::abs(row[4]) < 1e-7);
        CHECK(row[5] == Approx(5 + 6 * z).epsilon(1e-4));
    }
    CHECK(nBlank > 100);
}

TEST_CASE("a slice holds the particles of its zones within half the thickness, with their images")
{
    const word slice = "slice { zones (wall); thickness 2e-3; }";
    CHECK_FALSE(plane(across).hasSlice());
    const samplePlane one = plane(across + slice);
    REQUIRE(one.hasSlice());
    CHECK(rows(one.slice(quarter())).size() == 4 * 8);
    const auto four = rows(plane(across + slice + "images ((1 0 0) (0 1 0));").slice(quarter()));
    CHECK(four.size() == 4 * 4 * 8);
    for (const auto& row : four) CHECK(std::abs(row[2]) == relative(0.5e-3));
}

TEST_CASE("planes that cannot be are refused")
{
    CHECK_ERROR(plane("point (0 0 0); normal (0 1 0); xAxis (0 2 0); xRange (0 1); yRange (0 1);"
                      "spacing 0.1; fields (U); zones (fluid);"),
                "along the normal", 1);
    CHECK_ERROR(plane("point (0 0 0); normal (0 1 0); xAxis (1 0 0); xRange (1 0); yRange (0 1);"
                      "spacing 0.1; fields (U); zones (fluid);"),
                "(low high)", 1);
    CHECK_ERROR(plane("point (0 0 0); normal (0 1 0); xAxis (1 0 0); xRange (0 1); yRange (0 1);"
                      "spacing 0; fields (U); zones (fluid);"),
                "must lie between 0.0001 and 1", 1);
    CHECK_ERROR(plane("point (0 0 0); normal (0 0 0); xAxis (1 0 0); xRange (0 1); yRange (0 1);"
                      "spacing 0.1; fields (U); zones (fluid);"),
                "must not be zero", 1);
    word text = across;
    text.replace(text.find("(fluid)"), 7, "(fluit)");
    CHECK_ERROR(plane(text), "Valid zones are: fluid wall", 1);
    text = across;
    text.replace(text.find("(U p)"), 5, "(U T)");
    CHECK_ERROR(plane(text), "no field 'T'", 1);
}
