// SPDX-License-Identifier: GPL-3.0-or-later
// cavityVolume and zoneDiameter on a shell that is a cylinder closed by a half sphere
#include "core/errorOf.H"
#include "roundSurfaces.H"
#include "testCase.H"
#include "relative.H"

using namespace ispf;

namespace
{

constexpr scalar R = 10e-3, length = 20e-3;

// Quarter of the shell: three layers of particles on R + dx/2, R + 3 dx/2, R + 5 dx/2
struct shell : testCase
{
    shell()
    {
        for (int layer = 0; layer < 3; ++layer)
        {
            const scalar r = R + (layer + 0.5) * dx;
            const label n = label(0.5 * M_PI * r / dx);
            for (scalar z = 0.5 * dx; z < length; z += dx) ring(r, z, n);
            for (label k = 0; k < n; ++k)
            {
                const scalar up = 0.5 * M_PI * (k + 0.5) / n, rr = r * std::cos(up);
                ring(rr, length + r * std::sin(up),
                     std::max(1, label(std::lround(0.5 * M_PI * rr / dx))));
            }
        }
        boundary =
            "symX { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
            "symY { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
        inner = tube(R, length, 16, 20, 0.5 * M_PI);
        inner.append(dome(R, 16, 16, length, 0.5 * M_PI));
        inner.weld(1e-9);
        std::filesystem::create_directories(path + "/constant/triSurface");
        writeSTL(inner, path + "/constant/triSurface/inner.stl");
    }

    void ring(scalar r, scalar z, label n)
    {
        for (label k = 0; k < n; ++k)
        {
            const scalar angle = 0.5 * M_PI * (k + 0.5) / n;
            add("wall", "solid", {r * std::cos(angle), r * std::sin(angle), z});
        }
    }

    // Volume below the facets, closed by the plane z = 0, of the whole body
    scalar facetVolume() const
    {
        scalar v = 0;
        for (label t = 0; t < inner.size(); ++t)
            v += inner.corner(t, 0).dot(inner.areaVector(t)) / 3;
        return 4 * std::abs(v);
    }

    triSurface inner;
};

void deform(particleCloud& cloud, const std::function<vector(const vector&)>& map)
{
    for (label i = 0; i < cloud.nSolid(); ++i) cloud.x[i].setXyz(map(cloud.x[i].xyz()));
}

const word both =
    "volume { type cavityVolume; surface inner; }"
    "diameter { type zoneDiameter; surface inner; point (0 0 10.3e-3); axis (0 0 1); nAngles 720; "
    "}";

}  // namespace

TEST_CASE("the shell at rest: volume and diameter of the shape, up to its facets")
{
    shell s;
    s.functions = both;
    auto r = s.start();
    functionObjectList f(*r.c);
    f.start();
    const auto v = s.rows("volume/0/cavityVolume.dat").at(0);
    CHECK(v[1] == relative(s.facetVolume(), 1e-8));
    CHECK(v[1] == relative(M_PI * R * R * length + 2 * M_PI * R * R * R / 3, 3e-3));
    CHECK(std::abs(v[2]) < 1e-8 * v[1]);
    const auto d = s.rows("diameter/0/zoneDiameter.dat").at(0);
    CHECK(d[1] == relative(2 * R, 1e-3));
    CHECK(std::abs(d[2]) < 1e-8);
    CHECK(d[4] <= 2 * R * (1 + 1e-9));
    CHECK(s.output("diameter/0/zoneDiameter.dat")
              .find("# Symmetry planes: of the whole body, not of the modelled quarter\n"
                    "# Time        \tdiameter\tdDoverD\tmin\tmax\n") != word::npos);
}

TEST_CASE("an affine motion is followed exactly: volume by the determinant, diameters by the axes")
{
    shell s;
    s.functions = both;
    auto r = s.start();
    const tensor F = vector(1.3, 1.1, 1.2).asDiagonal();
    deform(r.c->cloud, [&](const vector& x) { return vector(F * x); });
    functionObjectList f(*r.c);
    f.start();
    const auto v = s.rows("volume/0/cavityVolume.dat").at(0);
    CHECK(v[1] == relative(F.determinant() * s.facetVolume(), 1e-7));
    CHECK(v[3] == relative(F.determinant() - 1, 1e-6));
    const auto d = s.rows("diameter/0/zoneDiameter.dat").at(0);
    CHECK(d[3] == relative(2.2 * R, 1e-3));
    CHECK(d[4] == relative(2.6 * R, 1e-3));
}

TEST_CASE("inflation at constant wall volume: rho = sqrt(r^2 + c)")
{
    // the vertices lie half a spacing inside the particles that they follow; a linear fit would have an error of 1.1 %
    shell s;
    s.functions =
        "diameter { type zoneDiameter; surface inner; point (0 0 10.3e-3); axis (0 0 1);"
        "band 2e-3; }";
    auto r = s.start();
    const scalar c = 0.3 * R * R;
    deform(r.c->cloud, [&](const vector& x) {
        const scalar rr = std::hypot(x[0], x[1]), grow = std::sqrt(rr * rr + c) / rr;
        return vector(grow * x[0], grow * x[1], x[2]);
    });
    functionObjectList f(*r.c);
    f.start();
    const auto d = s.rows("diameter/0/zoneDiameter.dat").at(0);
    CHECK(d[2] == relative(std::sqrt(1.3) - 1, 5e-3));
    CHECK(d[4] / d[3] < 1.005);
}

TEST_CASE("a tube with two open ends: caps or symmetry planes close it")
{
    // whole; half of its length, or of its section, cut by a symmetry plane; half of it between planes that face each other
    const word symZ = "symZ { type symmetryPlane; point (0 0 0); normal (0 0 -1); }",
               symY = "symY { type symmetryPlane; point (0 0 0); normal (0 -1 0); }";
    for (const word& plane :
         {word(), symZ, symY,
          symY + symZ + "far { type symmetryPlane; point (0 0 20e-3); normal (0 0 1); }"})
    {
        const bool half = plane.rfind("symY", 0) == 0;
        const scalar sweep = half ? M_PI : 2 * M_PI;
        testCase s;
        for (int layer = 0; layer < 3; ++layer)
            for (scalar z = 0.5 * s.dx; z < length; z += s.dx)
                for (label k = 0; k < 64; ++k)
                {
                    const scalar r = R + (layer + 0.5) * s.dx, a = sweep * (k + 0.5) / 64;
                    s.add("wall", "solid", {r * std::cos(a), r * std::sin(a), z});
                }
        s.boundary = plane;
        const triSurface inner = tube(R, length, 64, 20, sweep);
        std::filesystem::create_directories(s.path + "/constant/triSurface");
        writeSTL(inner, s.path + "/constant/triSurface/inner.stl");
        s.functions = "volume { type cavityVolume; surface inner; }";
        auto r = s.start();
        functionObjectList f(*r.c);
        f.start();
        const label n = half ? 128 : 64;  // sides of the whole section
        const scalar polygon = 0.5 * n * R * R * std::sin(2 * M_PI / n);
        const scalar whole = (plane.rfind("symZ", 0) == 0 ? 2 : 1) * polygon * length;
        CHECK(s.rows("volume/0/cavityVolume.dat").at(0)[1] == relative(whole, 1e-6));
        // it widens: the rims move along with their ends
        deform(r.c->cloud, [](const vector& x) { return vector(1.2 * x[0], 1.2 * x[1], x[2]); });
        f.start();
        CHECK(s.rows("volume/0/cavityVolume.dat").back()[1] == relative(1.44 * whole, 1e-6));
    }
}

TEST_CASE("in two dimensions two walls of a channel have four ends, of which no one knows the caps")
{
    testCase s;
    s.nDims = 2;
    triSurface walls;
    walls.addPatch("wall");
    for (const scalar side : {-1.0, 1.0})
    {
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 10; ++i)
                s.add("wall", "solid", s.dx * vector(i + 0.5, side * (5.5 + j), 0));
        const vector a(0, 5e-3 * side, 0), b(10e-3, 5e-3 * side, 0), up(0, 0, 1e-3);
        walls.add(a, b, b + up, 0), walls.add(a, b + up, a + up, 0);
    }
    std::filesystem::create_directories(s.path + "/constant/triSurface");
    writeSTL(walls, s.path + "/constant/triSurface/inner.stl");
    s.functions = "volume { type cavityVolume; surface inner; }";
    auto r = s.start();
    CHECK_ERROR(functionObjectList(*r.c), "its lines have 4 free ends", 3);
}

TEST_CASE("surfaces and planes that do not fit are refused")
{
    shell s;
    const auto with = [&](const word& functions) {
        s.functions = functions;
        auto r = s.start();
        functionObjectList f(*r.c);
    };
    CHECK_ERROR(with("d { type zoneDiameter; surface inner; point (0 0 0.1); axis (0 0 1); }"),
                "does not cut the surface inner", 0);
    CHECK_ERROR(
        with("d { type zoneDiameter; surface inner; point (1e-3 1e-3 10e-3); axis (0 0 1); }"),
        "two opposite sides", 0);
    CHECK_ERROR(with("d { type zoneDiameter; surface inner; point (0 0 0.01); axis (0 0 0); }"),
                "no direction", 0);
    CHECK_ERROR(with("d { type cavityVolume; surface outer; }"), "outer.stl", 0);
}

TEST_CASE("particles that went through a wall that has moved are counted, and how deep")
{
    shell s;
    for (const scalar z : {-3e-3, 2.3e-3, 11.3e-3, 19.3e-3})
        for (const scalar r : {1.5e-3, 9.5e-3})
            s.add("chamber", "fluid", {r * std::cos(0.7), r * std::sin(0.7), z});
    s.functions = "leaks { type surfaceLeaks; surface inner; zones (chamber); }";
    auto r = s.start();
    functionObjectList f(*r.c);
    f.start();
    CHECK(s.rows("leaks/0/surfaceLeaks.dat").at(0) == List<scalar>{0, 0, 0, 0});

    // the wall shrinks over the three outer particles above its rim
    deform(r.c->cloud, [](const vector& x) { return vector(0.91 * x[0], 0.91 * x[1], x[2]); });
    ++*r.time;
    f.execute();
    const auto row = s.rows("leaks/0/surfaceLeaks.dat").at(1);
    CHECK(row[1] == 3);
    CHECK(row[2] == 0);  // none deeper than half the spacing of 1 mm
    CHECK(row[3] == relative(0.4e-3, 0.05));
}

TEST_CASE("a surface with as many particles on one side as on the other has no right side")
{
    shell s;
    s.add("chamber", "fluid", {9.5e-3 * std::cos(0.7), 9.5e-3 * std::sin(0.7), 11e-3});
    s.add("chamber", "fluid", {10.5e-3 * std::cos(0.7), 10.5e-3 * std::sin(0.7), 11e-3});
    s.functions = "leaks { type surfaceLeaks; surface inner; zones (chamber); }";
    auto r = s.start();
    CHECK_ERROR(functionObjectList(*r.c), "No side", 0);
}

TEST_CASE(
    "particles below a rigid floor are counted until the guard has put them back, which is counted "
    "too")
{
    testCase s;
    s.addBlock("water", {0, 0, 0}, {6, 6, 4});
    s.boundary =
        "floor { type wall; representation mirror; }"
        "lid { type wall; surface plane; point (0 0 4e-3); normal (0 0 1);"
        "motion { velocity (0 0 0); } }";
    triSurface floor;
    const label patch = floor.addPatch("floor");
    const scalar l = 6e-3;  // seen from below
    floor.add({0, 0, 0}, {0, l, 0}, {l, l, 0}, patch);
    floor.add({0, 0, 0}, {l, l, 0}, {l, 0, 0}, patch);
    std::filesystem::create_directories(s.path + "/constant/triSurface");
    writeSTL(floor, s.path + "/constant/triSurface/floor.stl");
    s.functions = "leaks { type surfaceLeaks; patches (floor); }";
    auto r = s.start();
    functionObjectList f(*r.c);
    f.start();
    particleCloud& cloud = r.c->cloud;
    cloud.x[14][2] = -0.2e-3, cloud.x[15][2] = -0.7e-3;
    ++*r.time;
    f.execute();
    r.c->walls->exchange(cloud, 0.1);
    ++*r.time;
    f.execute();
    const auto rows = s.rows("leaks/0/surfaceLeaks.dat");
    for (const size_t column : {1, 2, 3, 4}) CHECK(rows.at(0).at(column) == 0);
    CHECK(rows.at(1)[1] == 2);
    CHECK(rows.at(1)[2] == 1);
    CHECK(rows.at(1)[3] == relative(0.7e-3, 1e-6));
    CHECK(rows.at(1)[4] == 0);
    CHECK(rows.at(2)[1] == 0);
    CHECK(rows.at(2)[4] == 2);

    for (const word wrong : {"lid", "water"})
    {
        s.functions = "leaks { type surfaceLeaks; patches (" + wrong + "); }";
        auto again = s.start();
        CHECK_ERROR(functionObjectList(*again.c), "Valid patches are: floor", 0);
    }
}
