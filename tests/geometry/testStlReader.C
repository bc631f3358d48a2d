// SPDX-License-Identifier: GPL-3.0-or-later
// STL files as other programs write them, and files that are no STL
#include "testShapes.H"

#include <cstring>
#include <doctest/doctest.h>

using namespace ispf;
using namespace ispf::testShapes;

namespace
{

word facet(const word& end = "\n", const word& corner = "0 0 1")
{
    return word("facet normal 0 0 1") + end + "outer loop" + end + "vertex 0 0 0" + end +
           "vertex 1.5e+00 0 0" + end + "vertex " + corner + end + "endloop" + end + "endfacet" +
           end;
}

word solid(const word& name, const word& facets)
{
    return "solid " + name + "\n" + facets + "endsolid " + name + "\n";
}

word binary(std::uint32_t announced, std::uint32_t held, const word& header = "solid x")
{
    word bytes = header;
    bytes.resize(80, ' ');
    bytes.append(reinterpret_cast<const char*>(&announced), 4);
    for (std::uint32_t t = 0; t < held; ++t)
    {
        const float v[12] = {0, 0, 1, 0, 0, 0, 1.5f, 0, 0, 0, 0, 1};
        bytes.append(reinterpret_cast<const char*>(v), sizeof v).append(2, '\0');
    }
    return bytes;
}

word refusal(const word& bytes)
{
    try
    {
        parseSTL(bytes, "folder/part.stl");
    }
    catch (const fatalError& error)
    {
        return error.what();
    }
    return "accepted";
}

bool isTheFacet(const triSurface& s)
{
    return s.size() == 1 && s.nodes.size() == 3 && s.corner(0, 1) == vector(1.5, 0, 0) &&
           s.corner(0, 2) == vector(0, 0, 1);
}

}  // namespace

TEST_CASE("ascii STL however it is spelt")
{
    const word plain = solid("part", facet());
    CHECK(isTheFacet(parseSTL(plain, "x.stl")));
    word upper = plain;
    for (char& c : upper) c = char(std::toupper(c));
    CHECK(isTheFacet(parseSTL(upper, "x.stl")));
    CHECK(parseSTL(upper, "x.stl").patchNames == List<word>{"PART"});
    for (const char* end : {" ", "\t", "\r\n", "\r", " \n\n  "})
    {
        CAPTURE(end);
        const triSurface s =
            parseSTL("solid part" + word(end) + facet(end) + "endsolid part", "x.stl");
        CHECK(isTheFacet(s));
        CHECK(s.patchNames == List<word>{"part"});
    }
    for (const char* corner : {"0 0 1.0D0", "+0 -0.0 1E+000", "0e5 .0 +1.", "0 1e-320 1"})
    {
        CAPTURE(corner);
        CHECK(parseSTL(solid("part", facet("\n", corner)), "x.stl").corner(0, 2)[2] == 1);
    }
    word strange = plain;
    strange.replace(strange.find("0 0 1"), 5, "-nan(ind) nan 1");
    CHECK(isTheFacet(parseSTL(strange, "x.stl")));  // the normal is not used
    CHECK(isTheFacet(parseSTL("\xEF\xBB\xBF \n" + plain, "x.stl")));
}

TEST_CASE("each named solid is a patch")
{
    const auto names = [](const word& text) { return parseSTL(text, "a/part.stl").patchNames; };
    CHECK(names(solid("in let", facet()) + solid("wall", facet()) + solid("in let", facet())) ==
          List<word>{"in_let", "wall"});
    CHECK(names("solid\n" + facet() + "endsolid\nsolid \n" + facet() + "endsolid") ==
          List<word>{"part", "part2"});
    CHECK(names("solid a " + facet(" ") + "endsolid a solid b c " + facet(" ") + "endsolid b c ") ==
          List<word>{"a", "b_c"});
}

TEST_CASE("a binary STL is known whatever its header says")
{
    CHECK(isTheFacet(parseSTL(binary(1, 1), "x.stl")));
    CHECK(isTheFacet(parseSTL(binary(1, 1, "solid x\nfacet normal 0 0 1\nouter loop"), "x.stl")));
    CHECK(isTheFacet(parseSTL(binary(1, 1) + "made by somebody", "x.stl")));
}

TEST_CASE("what is no STL, or is broken, is refused with the place")
{
    const auto says = [](const word& bytes, const word& what) {
        const word said = refusal(bytes);
        CAPTURE(said);
        CHECK(said.find(what) != word::npos);
        CHECK(said.find("folder/part.stl") != word::npos);
    };
    says("", "is empty");
    says(" \n\n", "is empty");
    says("ISO-10303-21;\nHEADER;", "is not STL");
    says("solid empty\nendsolid empty\n", "holds no triangle");
    says("solid part\n" + facet(), "cut off at line 9: there is no endsolid");
    says("solid part\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "is not a coordinate");
    says("solid part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
         "cut off at line 5, within a facet");
    says("solid part\nfacet normal 0 0 1\n", "no 'outer loop'");
    says(solid("part", facet("\n", "0 0 nan")), "Line 6 of the surface file");
    says(solid("part", facet("\n", "0 inf 0")), "'inf' is not a finite number");
    says(solid("part", facet("\n", "0 1e400 0")), "is not a finite number");
    says(solid("part", facet("\n", "0 1e300 0")), "absurdly large");
    says(solid("part", facet("\n", "0 0,5 0")), "'0,5' is not a coordinate");
    says(solid("part", facet("\n", "0 0\nvertex 1 1 1")), "Line 7");
    says(solid("part", facet("\n", "0 0 1\nvertex 1 1 1")), "'vertex' stands where endloop should");
    says(solid("part", facet() + "garbage"), "'garbageendsolid' stands where");
    says(binary(12, 11), "it announces 12 triangles, which take 684 bytes, and has 634");
    says(binary(4000000000u, 3), "announces 4000000000 triangles");
    says(binary(0, 0), "holds no triangle");
    word broken = binary(3, 3);
    const float nan = std::nanf("");
    std::memcpy(&broken[84 + 50 + 12], &nan, 4);
    says(broken, "A corner of triangle 2");
}
