// SPDX-License-Identifier: GPL-3.0-or-later
// Forces against exact ones, surface samples, and the same afterwards from the written times
#include "core/errorOf.H"
#include "relative.H"
#include "testCase.H"

using namespace ispf;

namespace
{

constexpr scalar rho = 1000, mu = 1e-3, g = 9.81;
constexpr scalar side = 10e-3;  // of the box [0, side]^3

// A box of 10^3 particles between a floor and a lid, open at its sides but for one wall
struct box : testCase
{
    box()
    {
        addBlock("water", {0, 0, 0}, {10, 10, 10});
        boundary =
            "floor { type wall; surface plane; point (0 0 0); normal (0 0 -1); }"
            "lid { type wall; surface plane; point (0 0 10e-3); normal (0 0 1); velocity (1 0 0); }"
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

// total, pressure, viscous: three components each behind the time
vector part(const List<scalar>& row, int which)
{
    return {row[1 + 3 * which], row[2 + 3 * which], row[3 + 3 * which]};
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
    // the side's force acts at a third of the height: by triangles of 1.5 dx
    const vector moment = part(t.rows("f/0/moment_left.dat").front(), 0);
    CHECK(moment[1] == relative(onLeft[0] * side / 3, 0.01));
    CHECK(t.output("f/0/force.dat")
              .rfind("# Force\n# CofR       : (0 0 0)\n# Time        \t"
                     "(total_x total_y total_z)\t(pressure_x ",
                     0) == 0);
}

TEST_CASE(
    "Couette and Poiseuille flow: the shear on both walls, and none of the pressure's reference")
{
    box t;
    const scalar rate = 100;
    t.set([&](const vector& x) { return Eigen::Vector4d(rate * x[2], 0, 0, 7); });
    t.functions =
        "f { type forces; patches (floor lid); pRef 7; writePrecision 12; }"
        "s { type surfaceSample; patches (floor); surfaceFormat raw; writePrecision 12; }"
        "v { type surfaceSample; patches (floor); }";
    const vector both = part(t.measured("f/0/force.dat"), 0);
    const scalar shear = mu * rate * side * side;
    CHECK(part(t.rows("f/0/force_floor.dat").front(), 2)[0] == relative(shear, 1e-9));
    CHECK(part(t.rows("f/0/force_lid.dat").front(), 2)[0] == relative(-shear, 1e-9));
    CHECK(both.norm() < 1e-9 * shear);
    for (const auto& row : t.rows("s/0/floor.raw"))
    {
        CHECK(row[3] == relative(7, 1e-9));
        CHECK(row[7] == relative(mu * rate, 1e-9));
        CHECK(std::abs(row[4]) < 1e-9 * rate * side);  // no slip
    }
    CHECK(t.output("v/0/floor.vtk").rfind("# vtk DataFile Version 3.0\n", 0) == 0);

    box q;
    q.set([&](const vector& x) { return Eigen::Vector4d(1e4 * x[2] * (side - x[2]), 0, 0, 0); });
    q.functions = t.functions;
    q.measured("f/0/force.dat");
    for (const char* wall : {"floor", "lid"})
        CHECK(part(q.rows(word("f/0/force_") + wall + ".dat").front(), 2)[0] ==
              relative(mu * 1e4 * side * side * side, 1e-9));
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
    // a wall across the flow would stop it
    t.boundary.erase(t.boundary.find("left"));
    t.functions = "e { type energy; writePrecision 12; }";
    t.write("constant/g", "value (0 0 -9.81);");
    const List<scalar> row = t.measured("e/0/energy.dat");
    const scalar squares = (side * side / 3 - 1e-6 / 12);  // the lattice's mean of z^2
    CHECK(row[1] == relative(0.5 * rho * V * rate * rate * squares, 1e-9));
    CHECK(row[2] == 0);
    CHECK(row[3] == relative(rho * g * V * side / 2, 1e-9));
    // mu (dU/dz)^2 per volume, but for the free sides, where half the neighbours are missing; the lid, at rate times
    // side, does all the work
    CHECK(row[4] == relative(mu * rate * rate * V, 0.2));
    CHECK(row[5] == relative(mu * rate * rate * V, 1e-6));
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
    CHECK_ERROR(wrong("f { type surfaceSample; }"), "wants patches", 3);
    CHECK_ERROR(wrong("f { type surfaceSample; surfaces (cut); }"), "There is no surface", 3);
    CHECK_ERROR(wrong("f { type surfaceSample; patches (lid); surfaceFormat stl; }"),
                "Valid surfaceFormats are: raw vtk", 3);
    CHECK_ERROR(wrong("f { type minMax; timeStart 2; timeEnd 1; }"), "lies before timeStart", 3);
    CHECK_ERROR(wrong("f { type minMax; executeControl sometimes; }"), "Valid executeControls", 3);
}
