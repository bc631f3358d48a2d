// SPDX-License-Identifier: GPL-3.0-or-later
// Forces compared with exact ones, surface samples, and the same values computed later from the written times
#include "core/errorOf.H"
#include "relative.H"
#include "roundSurfaces.H"
#include "presentState.H"
#include "testCase.H"
#include "viscousPairs.H"

#include <regex>

using namespace ispf;

namespace
{

constexpr scalar rho = 1000, mu = 1e-3, g = 9.81;
constexpr scalar side = 10e-3;  // of the box [0, side]^3

// Mirror walls and cyclic sides: linear flow continues beyond them, and the pair sum of the viscosity is exact
word channel(scalar speed)
{
    return "floor { type wall; representation mirror; surface plane; point (0 0 0); normal (0 0 "
           "-1); }"
           "lid { type wall; representation mirror; surface plane; point (0 0 10e-3); normal (0 0 "
           "1); velocity (" +
           str(speed) +
           " 0 0); }"
           "ends { type cyclic; point (0 0 0); separation (10e-3 0 0); }"
           "sides { type cyclic; point (0 0 0); separation (0 10e-3 0); }";
}

// A box of 10^3 particles between a floor and a lid, with open sides except one wall
struct box : testCase
{
    box()
    {
        addBlock("water", {0, 0, 0}, {10, 10, 10});
        boundary =
            "floor { type wall; surface plane; point (0 0 0); normal (0 0 -1); }"
            "lid { type wall; surface plane; point (0 0 10e-3); normal (0 0 1); }"
            "left { type wall; surface plane; point (0 0 0); normal (-1 0 0); }";
    }
    template <class Field>
    void set(Field&& field)  // {u, v, w, p} of x
    {
        for (size_t i = 0; i < particles.x.size(); ++i)
        {
            const Eigen::Vector4d v = field(particles.x[i]);
            particles.vectors["U"][i] = v.head<3>(), particles.scalars["p"][i] = v[3];
        }
    }
    List<scalar> measured(const word& file)
    {
        auto r = start();
        functionObjectList f(*r.c);
        f.start();
        return rows(file).front();
    }
};

// total, pressure, viscous: three components each, after the time
vector part(const List<scalar>& row, int which)
{
    return {row[1 + 3 * which], row[2 + 3 * which], row[3 + 3 * which]};
}

// Laplacian of the velocities
List<vec4> laplacian(const presentState& s)
{
    viscousPairs viscous;
    viscous.setup({s.cloud, s.list, s.B});
    List<vec4> lap;
    viscous.apply(s.cloud.Up, lap);
    for (vec4& a : lap) a.s *= -2;
    return lap;
}

}  // namespace

TEST_CASE("hydrostatic pressure on floor and side, with its moment")
{
    box t;
    t.set([](const vector& x) { return Eigen::Vector4d(0, 0, 0, rho * g * (side - x[2])); });
    t.functions = "f { type forces; patches (floor left); CofR (0 0 0); writePrecision 12; }";
    const List<scalar> sum = t.measured("f/0/force.dat");
    const vector onFloor = part(t.rows("f/0/force_floor.dat").front(), 1);
    const vector onLeft = part(t.rows("f/0/force_left.dat").front(), 1);
    CHECK(onFloor[2] == relative(-rho * g * std::pow(side, 3), 1e-9));
    CHECK(onLeft[0] == relative(-0.5 * rho * g * std::pow(side, 3), 1e-9));
    CHECK((part(sum, 0) - onFloor - onLeft).norm() < 1e-10);
    CHECK(part(sum, 2).norm() < 1e-12);
    CHECK(sum.back() == 1);  // all covered
    // the force on the side acts at a third of the height, up to triangles of 1.5 dx
    const vector moment = part(t.rows("f/0/moment_left.dat").front(), 0);
    CHECK(moment[1] == relative(onLeft[0] * side / 3, 0.01));
    CHECK(t.output("f/0/force.dat")
              .rfind("# Force\n# CofR       : (0 0 0)\n# Time        \t"
                     "(total_x total_y total_z)\t(pressure_x ",
                     0) == 0);
}

TEST_CASE("Couette flow: the shear on both walls, and none of the pressure's reference")
{
    box t;
    const scalar rate = 100;
    t.boundary = channel(rate * side);
    t.set([&](const vector& x) { return Eigen::Vector4d(rate * x[2], 0, 0, 7); });
    t.functions =
        "f { type forces; patches (floor lid); pRef 7; writePrecision 12; }"
        "s { type surfaceSample; patches (floor); surfaceFormat raw; writePrecision 12; }"
        "v { type surfaceSample; patches (floor); fields (U p); }";
    const vector both = part(t.measured("f/0/force.dat"), 0);
    const scalar shear = mu * rate * side * side;
    CHECK(part(t.rows("f/0/force_floor.dat").front(), 2)[0] == relative(shear, 1e-9));
    CHECK(part(t.rows("f/0/force_lid.dat").front(), 2)[0] == relative(-shear, 1e-9));
    CHECK(both.norm() < 1e-9 * shear);
    for (const auto& row : t.rows("s/0/floor.raw"))
    {
        CHECK(row[3] == relative(7, 1e-9));
        CHECK(row[7] == relative(mu * rate, 0.01));    // the friction spread over the triangles
        CHECK(std::abs(row[4]) < 1e-9 * rate * side);  // no slip
    }
    const word vtk = t.output("v/0/floor.vtk");
    CHECK(vtk.rfind("# vtk DataFile Version 3.0\n", 0) == 0);
    // each once, although `fields` names them
    for (const word array : {"VECTORS U ", "SCALARS p "})
        CHECK(vtk.find(array) == vtk.rfind(array));
}

TEST_CASE(
    "walls pay what their fluid loses, each of two in a corner its own, and nothing where they "
    "slip")
{
    box t;
    t.set([&](const vector& x) {
        return Eigen::Vector4d(std::sin(900 * x[2]) + 50 * x[0], x[1] - x[2], 3 * x[2], 0);
    });
    t.boundary =
        std::regex_replace(channel(0.2), std::regex("representation mirror"), "twoSided no");
    t.functions = "f { type forces; patches (floor lid); writePrecision 12; }";
    const vector paid = part(t.measured("f/0/force.dat"), 2);
    auto r = t.start();
    const presentState s(*r.c);
    vector lost = vector::Zero();
    for (const vec4& v : laplacian(s)) lost -= mu * s.cloud.volume() * v.xyz();
    CHECK((paid - lost).norm() < 1e-9 * lost.norm());

    // a solid slab on the floor replaces the floor
    box slab;
    slab.particles = {}, slab.zones = {"slab", "water"}, slab.phases = {"solid", "fluid"};
    slab.addBlock("slab", {0, 0, 0}, {10, 10, 3});
    slab.addBlock("water", {0, 0, 3e-3}, {10, 10, 7});
    slab.set([&](const vector& x) {
        return Eigen::Vector4d(std::sin(900 * x[2]) + 50 * x[0], x[1] - x[2], 3 * x[2], 0);
    });
    triSurface top;
    top.addPatch("slab");
    for (const int k : {0, 1})
        top.add({0, 0, 3e-3}, {side, k ? side : 0, 3e-3}, {k ? 0 : side, side, 3e-3}, 0);
    std::filesystem::create_directories(slab.path + "/constant/triSurface");
    writeSTL(top, slab.path + "/constant/triSurface/slab_to_water.stl");
    slab.boundary = t.boundary;
    slab.functions =
        "f { type forces; patches (lid); zones (slab); writePrecision 12; }"
        "v { type surfaceFieldValue; operation areaAverage; zones (slab); fields (displacement p); "
        "}";
    const vector byBoth = part(slab.measured("f/0/force.dat"), 2);
    auto q = slab.start();
    for (label i = 0; i < q.c->cloud.nSolid(); ++i)
        q.c->cloud.vectors.at("x0")[i].s -= simd4{1e-4, 0, 0, 0};
    functionObjectList values(*q.c);
    values.start();
    CHECK(slab.rows("v/0/surfaceFieldValue.dat").back()[1] == relative(1e-4, 1e-9));
    const presentState state(*q.c);
    const List<vec4> lap = laplacian(state);
    lost = vector::Zero();
    for (label i = state.cloud.nSolid(); i < state.cloud.n(); ++i)
        lost -= mu * state.cloud.volume() * lap[i].xyz();
    CHECK((byBoth - lost).norm() < 1e-9 * lost.norm());
    CHECK(part(slab.rows("f/0/force_slab.dat").front(), 2).norm() > 0.1 * lost.norm());

    box corner;
    const vector u(0.3, 0, 0.2);
    corner.set([&](const vector&) { return Eigen::Vector4d(u[0], 0, u[2], 0); });
    corner.boundary =
        "floor { type wall; surface plane; point (0 0 0); normal (0 0 -1); }"
        "left { type wall; surface plane; point (0 0 0); normal (-1 0 0); }";
    corner.functions = "f { type forces; patches (floor left); writePrecision 12; }";
    const vector both = part(corner.measured("f/0/force.dat"), 2);
    vector floor = part(corner.rows("f/0/force_floor.dat").front(), 2);
    vector left = part(corner.rows("f/0/force_left.dat").front(), 2);
    CHECK((floor + left - both).norm() < 1e-12 * both.norm());
    // equal except for the flow direction; pairs midway between both belong to the floor
    CHECK(floor[0] / u[0] == relative(left[2] / u[2], 0.01));

    corner.boundary =
        "floor { type wall; surface plane; point (0 0 0); normal (0 0 -1); }"
        "left { type wall; surface plane; point (0 0 0); normal (-1 0 0); slip yes; }";
    corner.measured("f/0/force.dat");
    floor = part(corner.rows("f/0/force_floor.dat").front(), 2);
    left = part(corner.rows("f/0/force_left.dat").front(), 2);
    CHECK(floor[0] > 0.5 * mu * u[0] * side * side / (0.5 * corner.dx));
    CHECK(std::abs(left[2]) < 1e-9 * floor[0]);
}

TEST_CASE("buoyancy of an immersed body")
{
    testCase t;
    t.phases = {"solid", "fluid"}, t.zones = {"cube", "water"};
    for (const bool inside : {true, false})  // solids first
        for (int k = 0; k < 12; ++k)
            for (int j = 0; j < 12; ++j)
                for (int i = 0; i < 12; ++i)
                {
                    const auto in = [](int n) { return n >= 4 && n < 8; };
                    if ((in(i) && in(j) && in(k)) != inside) continue;
                    t.add(inside ? "cube" : "water", "", 1e-3 * vector(i + 0.5, j + 0.5, k + 0.5));
                    t.particles.scalars["p"].back() = rho * g * (12e-3 - (k + 0.5) * 1e-3);
                }
    triSurface s;
    s.patchNames = {"cube"};
    const vector low = vector::Constant(4e-3), high = vector::Constant(8e-3);
    for (int d = 0; d < 3; ++d)
        for (const bool up : {false, true})
        {
            const auto corner = [&](int a, int b) {
                vector x = low;
                x[d] = up ? high[d] : low[d];
                if (a) x[(d + 1) % 3] = high[0];
                if (b) x[(d + 2) % 3] = high[0];
                return x;
            };
            const int o = up ? 0 : 1;  // outwards
            s.add(corner(0, 0), corner(1 - o, o), corner(1, 1), 0);
            s.add(corner(0, 0), corner(1, 1), corner(o, 1 - o), 0);
        }
    std::filesystem::create_directories(t.path + "/constant/triSurface");
    writeSTL(s, t.path + "/constant/triSurface/cube_to_water.stl");
    REQUIRE(s.volume() > 0);

    t.functions = "f { type forces; zones (cube); writePrecision 12; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    f.start();
    const List<scalar> row = t.rows("f/0/force.dat").front();
    CHECK(part(row, 1)[2] == relative(rho * g * 64e-9, 1e-9));
    CHECK(part(row, 1).head<2>().norm() < 1e-9 * rho * g * 64e-9);
    CHECK(row.back() == 1);
}

TEST_CASE("energies of a given state")
{
    box t;
    const scalar rate = 100, V = side * side * side;
    t.set([&](const vector& x) { return Eigen::Vector4d(rate * x[2], 0, 0, 0); });
    t.boundary = channel(rate * side);
    t.functions = "e { type energy; writePrecision 12; }";
    t.write("constant/g", "value (0 0 -9.81);");
    const List<scalar> row = t.measured("e/0/energy.dat");
    const scalar squares = (side * side / 3 - 1e-6 / 12);  // mean of z^2 over the lattice
    CHECK(row[1] == relative(0.5 * rho * V * rate * rate * squares, 1e-9));
    CHECK(row[2] == 0);
    CHECK(row[3] == relative(rho * g * V * side / 2, 1e-9));
    CHECK(row[4] == relative(mu * rate * rate * V, 1e-9));
    // the lid, at rate times side, does all the work
    CHECK(row[5] == relative(mu * rate * rate * V, 1e-9));
}

TEST_CASE(
    "fluid that turns with its drum does not drag at it, nor is heated; one that is braked pays "
    "for both")
{
    const scalar omega = 5, R = 8e-3, length = 10e-3;
    box t;
    t.particles = {}, t.zones = {}, t.phases = {};
    for (int k = 0; k < 10; ++k)  // in rings
        for (int ring = 0; ring < 8; ++ring)
        {
            const scalar r = (ring + 0.5) * t.dx;
            const label n = std::lround(2 * M_PI * (ring + 0.5));
            for (label m = 0; m < n; ++m)
            {
                const scalar a = 2 * M_PI * m / n;
                t.add("water", "fluid", {r * std::cos(a), r * std::sin(a), (k + 0.5) * t.dx});
                t.particles.vectors["U"].back() =
                    omega * vector::UnitZ().cross(t.particles.x.back());
            }
        }
    triSurface drum = tube(R, length, 64, 10);
    drum.flip();
    drum.patchNames = {"drum"};
    std::filesystem::create_directories(t.path + "/constant/triSurface");
    writeSTL(drum, t.path + "/constant/triSurface/drum.stl");
    const auto withOmega = [&](const word& speed) {
        return "drum { type wall; representation mirror; rotation { origin (0 0 0); axis (0 0 1); "
               "omega " +
               speed + "; } } ends { type cyclic; point (0 0 0); separation (0 0 10e-3); }";
    };
    t.functions =
        "f { type forces; patches (drum); writePrecision 12; } e { type energy; writePrecision 12; "
        "}";
    t.boundary = withOmega("5");
    const vector along = part(t.measured("f/0/moment.dat"), 2);
    const List<scalar> together = t.rows("e/0/energy.dat").front();
    t.boundary = withOmega("4.99");
    const vector ahead = part(t.measured("f/0/moment.dat"), 2);
    const scalar flux = 2 * mu * omega * M_PI * R * R * length;  // of mu du/dn alone
    CHECK(std::abs(along[2]) < 1e-9 * flux);
    CHECK(std::abs(together[4]) < 0.01 * flux * omega);
    CHECK(std::abs(together[5]) < 1e-9 * flux * omega);
    CHECK(ahead[2] > 0);  // the fluid is faster than its wall
    CHECK(t.rows("e/0/energy.dat").front()[5] == relative(-4.99 * ahead[2], 1e-6));
}

TEST_CASE("bodies that are none are refused")
{
    const auto wrong = [](const word& functions) {
        box t;
        t.functions = functions;
        auto r = t.start();
        functionObjectList f(*r.c);
    };
    CHECK_ERROR(wrong("f { type forces; }"), "wants patches", 3);
    CHECK_ERROR(wrong("f { type forces; patches (flor); }"), "Did you mean 'floor'?", 3);
    CHECK_ERROR(wrong("f { type forces; patches (wall); }"), "Valid walls are: floor left lid", 3);
    CHECK_ERROR(wrong("f { type forces; zones (water); }"), "is not solid", 3);
    CHECK_ERROR(wrong("f { type surfaceFieldValue; operation max; patches (lid); fields (); }"),
                "names no field", 3);
    CHECK_ERROR(wrong("f { type surfaceSample; }"), "wants patches", 3);
    CHECK_ERROR(wrong("f { type surfaceSample; surfaces (cut); }"), "There is no surface", 3);
    CHECK_ERROR(wrong("f { type surfaceSample; patches (lid); surfaceFormat stl; }"),
                "Valid surfaceFormats are: raw vtk", 3);
    CHECK_ERROR(wrong("f { type minMax; timeStart 2; timeEnd 1; }"), "lies before timeStart", 3);
    CHECK_ERROR(wrong("f { type minMax; executeControl sometimes; }"), "Valid executeControls", 3);
}
