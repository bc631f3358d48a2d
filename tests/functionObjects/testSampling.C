// SPDX-License-Identifier: GPL-3.0-or-later
// probes, lineProfile, minMax, patchFlux
#include "core/errorOf.H"
#include "roundSurfaces.H"
#include "particleFields.H"
#include "testCase.H"
#include "relative.H"

using namespace ispf;

namespace
{

// Velocity and pressure are linear in space: every interpolation must give them exactly
const tensor gradU = (tensor() << 1, 2, 3, 4, 5, 6, 7, 8, -6).finished();
vector velocityAt(const vector& x)
{
    return vector(0.1, 0.2, 0.3) + gradU * x;
}
scalar pressureAt(const vector& x)
{
    return 100 + vector(1e4, -2e4, 3e4).dot(x);
}

void setLinear(particleCloud& cloud)
{
    for (label i = 0; i < cloud.n(); ++i)
    {
        const vector x = cloud.x[i].xyz();
        cloud.Up[i] = vec4::from(velocityAt(x), pressureAt(x));
    }
}

}  // namespace

TEST_CASE("probes: exact on linear fields, NaN away from particles, OpenFOAM's layout")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {8, 8, 8});
    t.functions =
        "here { type probes; probeLocations ((4.2e-3 3.3e-3 2.9e-3) (8.8e-3 3.5e-3 3.5e-3)); }";
    auto r = t.start();
    setLinear(r.c->cloud);
    functionObjectList f(*r.c);
    f.start();
    const vector x(4.2e-3, 3.3e-3, 2.9e-3), U = velocityAt(x);
    const auto p = t.rows("here/0/p"), u = t.rows("here/0/U");
    REQUIRE(p.size() == 1);
    CHECK(p[0][0] == 0);
    CHECK(p[0][1] == relative(pressureAt(x), 1e-6));
    CHECK(std::isnan(p[0][2]));  // particles within 2 dx, but none within dx
    REQUIRE(u[0].size() == 7);
    for (int d = 0; d < 3; ++d) CHECK(u[0][1 + d] == relative(U[d], 1e-6));
    CHECK(std::isnan(u[0][4]));
    const word text = t.output("here/0/p");
    CHECK(text.find("# Probe 0 (0.0042 0.0033 0.0029)\n# Probe 1 (0.0088 0.0035 0.0035)\n#") == 0);
    CHECK(text.find("Time\n") != word::npos);
}

TEST_CASE("probes beside cyclic sides with a pressure drop see it across them")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {8, 8, 8});
    t.boundary = "ends { type cyclic; point (0 0 0); separation (8e-3 0 0); pressureDrop 16; }";
    t.functions =
        "at { type probes; fields (p); probeLocations ((1e-4 4e-3 4e-3) (7.9e-3 4e-3 4e-3)); }";
    auto r = t.start();
    particleCloud& cloud = r.c->cloud;
    for (label i = 0; i < cloud.n(); ++i) cloud.Up[i][3] = 100 - 2000 * cloud.x[i][0];
    r.c->walls->setStep(0, 0.1);
    functionObjectList f(*r.c);
    f.start();
    const auto p = t.rows("at/0/p");
    CHECK(p[0][1] == relative(99.8, 1e-6));
    CHECK(p[0][2] == relative(84.2, 1e-6));
}

TEST_CASE("a probe in a hole between particles has a value, one as far outside them has none")
{
    testCase t;
    const vector centre = vector::Constant(4.5e-3);
    for (int k = 0; k < 8; ++k)  // a lattice of 1.1 dx without its middle
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 8; ++i)
                if (const vector x = t.dx * vector(i - 4, j - 4, k - 4); x.norm() > 0.1 * t.dx)
                    t.add("chamber", "fluid", centre + 1.1 * x);
    t.functions =
        "here { type probes; fields (p); probeLocations ((4.5e-3 4.5e-3 4.5e-3) (4.5e-3 4.5e-3 "
        "8.9e-3)); radius 2.3; }";
    auto r = t.start();
    setLinear(r.c->cloud);
    functionObjectList f(*r.c);
    f.start();
    const auto p = t.rows("here/0/p");
    CHECK(p[0][1] == relative(pressureAt(centre), 1e-6));
    CHECK(std::isnan(p[0][2]));
}

TEST_CASE("a probe on symmetry planes sees the images: no flow through the planes")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {8, 8, 8});
    t.boundary =
        "symX { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
        "symY { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
    t.functions = "axis { type probes; fields (U); probeLocations ((0 0 4e-3)); }";
    auto r = t.start();
    for (label i = 0; i < r.c->cloud.n(); ++i)
        r.c->cloud.Up[i] = vec4::from({3, 2, 1}, 0);  // towards the planes, everywhere
    functionObjectList f(*r.c);
    f.start();
    const auto u = t.rows("axis/0/U");
    CHECK(std::abs(u[0][1]) < 1e-12);
    CHECK(std::abs(u[0][2]) < 1e-12);
    CHECK(u[0][3] == relative(1));
}

TEST_CASE("materialProbes go with the solid: exact on a linear displacement, refused for fluid")
{
    testCase t;
    t.addBlock("flag", {0, 0, 0}, {8, 8, 8}, "solid");
    t.addBlock("chamber", {8e-3, 0, 0}, {8, 8, 8});
    t.functions =
        "tip { type materialProbes; probeLocations ((7.9e-3 3.3e-3 2.9e-3)); }"
        "speed { type materialProbes; fields (U); probeLocations ((1e-3 4e-3 4e-3)); }";
    auto r = t.start();
    particleCloud& cloud = r.c->cloud;
    const auto moved = [](const vector& x) {
        return vector(-0.02 + 0.3 * x[1], 0.05 - 0.2 * x[0], 0.1 * x[2]);
    };
    for (label i = 0; i < cloud.nSolid(); ++i)
    {
        const vector x0 = cloud.vectors.at("x0")[i].xyz();
        cloud.x[i] = vec4::from(x0 + moved(x0), 0);
        cloud.Up[i] = vec4::from(velocityAt(x0), 0);
    }
    functionObjectList f(*r.c);
    f.start();
    const vector tip = moved({7.9e-3, 3.3e-3, 2.9e-3}), U = velocityAt({1e-3, 4e-3, 4e-3});
    const auto row = t.rows("tip/0/displacement")[0], speed = t.rows("speed/0/U")[0];
    for (int d = 0; d < 3; ++d) CHECK(row[1 + d] == relative(tip[d], 1e-6));
    for (int d = 0; d < 3; ++d) CHECK(speed[1 + d] == relative(U[d], 1e-6));
    t.functions =
        "a { type materialProbes; probeLocations ((1e-3 4e-3 4e-3) (9.5e-3 4e-3 4e-3)); }";
    CHECK_ERROR(functionObjectList(*t.start().c), "the nearest particle is at (0.0075 ", 3);
    t.functions = "a { type materialProbes; probeLocations ((0 0 0)); zones (flag chamber); }";
    CHECK_ERROR(functionObjectList(*t.start().c), "Zone 'chamber' is fluid", 3);
}

TEST_CASE("zones: nothing comes from the other side")
{
    testCase t;
    t.addBlock("left", {0, 0, 0}, {4, 8, 8});
    t.addBlock("right", {4e-3, 0, 0}, {4, 8, 8});
    const word probe = "{ type probes; fields (p); probeLocations ((3.9e-3 4e-3 4e-3)); ";
    t.functions =
        "l " + probe + "zones (left); } r " + probe + "zones (right); } both " + probe + "}";
    auto r = t.start();
    particleCloud& cloud = r.c->cloud;
    for (label i = 0; i < cloud.n(); ++i) cloud.Up[i][3] = cloud.zone[i] ? 100 : 1;
    functionObjectList f(*r.c);
    f.start();
    CHECK(t.rows("l/0/p")[0][1] == relative(1, 1e-6));
    CHECK(t.rows("r/0/p")[0][1] == relative(100, 1e-6));
    CHECK(t.rows("both/0/p")[0][1] > 5);
    CHECK(t.rows("both/0/p")[0][1] < 95);
}

TEST_CASE("lineProfile: a file per write time")
{
    testCase t;
    t.control = "endTime 1; deltaT 0.1; writeControl timeStep; writeInterval 2;";
    t.addBlock("chamber", {0, 0, 0}, {8, 8, 8});
    t.functions =
        "line { type lineProfile; start (1e-3 4e-3 4e-3); end (7e-3 4e-3 4e-3);"
        "nPoints 7; fields (p U); }";
    auto r = t.start();
    setLinear(r.c->cloud);
    functionObjectList f(*r.c);
    f.start();
    for (int k = 0; k < 2; ++k) ++*r.time, f.execute();
    CHECK(!isFile(t.path + "/postProcessing/line/0.1/line.dat"));
    for (const char* time : {"0", "0.2"})
    {
        const auto rows = t.rows("line/" + word(time) + "/line.dat");
        REQUIRE(rows.size() == 7);
        for (size_t k = 0; k < 7; ++k)
        {
            const vector x((1 + scalar(k)) * 1e-3, 4e-3, 4e-3), U = velocityAt(x);
            CHECK(std::abs(rows[k][0] - k * 1e-3) < 1e-9);
            CHECK(rows[k][1] == relative(x[0]));
            CHECK(rows[k][4] == relative(pressureAt(x), 1e-6));
            CHECK(rows[k][7] == relative(U[2], 1e-6));
        }
    }
    CHECK(t.output("line/0/line.dat").find("# distance\tx\ty\tz\tp\tU_x\tU_y\tU_z\n") == 0);
}

TEST_CASE("minMax: values and positions, magnitudes of vectors, chosen zones only")
{
    testCase t;
    t.addBlock("a", {0, 0, 0}, {4, 4, 4});
    t.addBlock("b", {4e-3, 0, 0}, {4, 4, 4});
    t.functions = "m { type minMax; zones (a); }";
    auto r = t.start();
    particleCloud& cloud = r.c->cloud;
    for (label i = 0; i < cloud.n(); ++i)
    {
        const vector x = cloud.x[i].xyz();
        cloud.Up[i] = vec4::from({-x[0], 0, -x[1]}, x[0] + 10 * x[1] + 100 * x[2]);
    }
    functionObjectList f(*r.c);
    f.start();
    const auto row = t.rows("m/0/minMax.dat").at(0);
    REQUIRE(row.size() == 17);  // time, then (value, position) for min, max of U and p
    CHECK(row[1] == relative(0.5e-3 * std::sqrt(2), 1e-6));
    CHECK(row[5] == relative(3.5e-3 * std::sqrt(2), 1e-6));
    CHECK(row[9] == relative(111 * 0.5e-3));
    CHECK(row[13] == relative(111 * 3.5e-3));
    for (int d = 0; d < 3; ++d) CHECK(row[10 + d] == relative(0.5e-3));
    for (int d = 0; d < 3; ++d) CHECK(row[14 + d] == relative(3.5e-3));
    CHECK(t.output("m/0/minMax.dat").find("# Time        \tmin(U)\tatmin(U)\tmax(U)") !=
          word::npos);
}

TEST_CASE("minMax of a zone that all particles have left is no number")
{
    testCase t;
    t.addBlock("a", {0, 0, 0}, {4, 4, 4});
    t.zones.push_back("lake"), t.phases.push_back("fluid");
    t.functions = "m { type minMax; zones (lake); }";
    auto r = t.start();
    functionObjectList f(*r.c);
    f.start();
    const auto row = t.rows("m/0/minMax.dat").at(0);
    REQUIRE(row.size() == 17);
    for (size_t k = 1; k < row.size(); ++k) CHECK(std::isnan(row[k]));
}

TEST_CASE("patchFlux through a surface: exact for linear velocity, times the symmetry factor")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {8, 8, 8});
    t.boundary = "symX { type symmetryPlane; point (0 0 0); normal (-1 0 0); }";
    t.functions = "q { type patchFlux; surface disc; } far { type patchFlux; surface far; }";
    triSurface disc, far;
    disc.add({3e-3, 2e-3, 4e-3}, {6e-3, 2e-3, 4e-3}, {3e-3, 6e-3, 4e-3}, disc.addPatch("disc"));
    far.append(disc), far.append(disc);
    for (size_t k = 0; k < 3; ++k) far.nodes[k][2] += 1;
    auto r = t.start();
    std::filesystem::create_directories(t.path + "/constant/triSurface");
    writeSTL(disc, t.path + "/constant/triSurface/disc.stl");
    writeSTL(far, t.path + "/constant/triSurface/far.stl");
    setLinear(r.c->cloud);
    functionObjectList f(*r.c);
    f.start();
    const auto q = t.rows("q/0/patchFlux.dat").at(0), half = t.rows("far/0/patchFlux.dat").at(0);
    const scalar exact = velocityAt({4e-3, 10e-3 / 3, 4e-3})[2] * 6e-6;  // at the centroid
    CHECK(q[1] == relative(2 * exact, 1e-9));
    CHECK(q[2] == 1);
    CHECK(half[1] == relative(2 * exact, 1e-9));
    CHECK(half[2] == relative(0.5));
}

TEST_CASE("patchFlux in two dimensions: per metre, and exact of a parabola over one long facet")
{
    testCase t;
    t.nDims = 2;
    for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 12; ++i) t.add("chamber", "fluid", t.dx * vector(i + 0.5, j + 0.5, 0));
    t.functions = "q { type patchFlux; surface line; }";
    triSurface line;  // a slice at x = 6 mm, as deep as dx
    const scalar high = 12 * t.dx;
    const vector x(6 * t.dx, high / 6, 0), up(0, high * 2 / 3, 0), z(0, 0, t.dx);
    line.add(x, x + up, x + up + z, line.addPatch("line"));
    line.add(x, x + up + z, x + z, 0);
    auto r = t.start();
    std::filesystem::create_directories(t.path + "/constant/triSurface");
    writeSTL(line, t.path + "/constant/triSurface/line.stl");
    particleCloud& cloud = r.c->cloud;
    for (label i = 0; i < cloud.n(); ++i)
        cloud.Up[i][0] = 4 * cloud.x[i][1] * (high - cloud.x[i][1]) / (high * high);
    functionObjectList f(*r.c);
    f.start();
    const auto q = t.rows("q/0/patchFlux.dat").at(0);
    CHECK(std::abs(q[1]) ==
          relative(46.0 / 81 * high, 0.015));  // of 4 s (1 - s), s from 1/6 to 5/6
    CHECK(q[2] == relative(1));
}

TEST_CASE("patchFlux of a boundary patch: from its books, out is positive")
{
    testCase t;
    t.addBlock("chamber", {0, 0, 0}, {8, 8, 8});
    t.boundary =
        "symX { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
        "lid { type wall; representation mirror; surface plane; point (0 0 8e-3);"
        "normal (0 0 1); }";
    t.functions = "q { type patchFlux; patch lid; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    f.start();
    List<patchBalance> books = r.c->walls->balance();
    for (patchBalance& b : books)
        if (b.name == "lid")
            b.swept = 3e-9, b.volume = 5e-9, b.flux = 4e-9, b.created = 2, b.deleted = 7;
    r.c->walls->restoreBalance(books);
    ++*r.time, f.execute();
    ++*r.time, f.execute();
    const auto rows = t.rows("q/0/patchFlux.dat");
    REQUIRE(rows.size() == 3);
    CHECK(rows[0][2] == 0);
    CHECK(rows[1][2] == relative(2 * (5e-9 - 3e-9)));
    CHECK(rows[1][1] == relative(2 * 4e-9));
    CHECK((rows[2][3] == 2 && rows[2][4] == 7));
    t.functions = "q { type patchFlux; patch lit; }";
    auto wrong = t.start();
    CHECK_ERROR(functionObjectList(*wrong.c), "There is no patch 'lit'. Valid patches are: lid", 0);
}

TEST_CASE("a field is found again after the cloud has been assigned, as where a step is taken back")
{
    particleCloud cloud;
    for (const char* name : {"a", "b", "c"}) cloud.scalars[name] = {scalar(name[0])};
    const particleField c(cloud, "c", fileLocation());
    const particleCloud before = cloud;
    cloud = before;
    CHECK(c.at(0) == 'c');
    CHECK(particleField(cloud, "a", fileLocation()).at(0) == 'a');
}
