// SPDX-License-Identifier: GPL-3.0-or-later
// Wall shear stress of flows whose stress is known, and its history under a flow that reverses
#include "core/errorOf.H"
#include "relative.H"
#include "roundSurfaces.H"
#include "testCase.H"

using namespace ispf;

namespace
{

constexpr scalar mu = 1e-3, side = 10e-3;

void writeSurface(const testCase& t, const triSurface& s, const word& name)
{
    std::filesystem::create_directories(t.path + "/constant/triSurface");
    writeSTL(s, t.path + "/constant/triSurface/" + name + ".stl");
}

// A box of 10^3 particles between a floor at rest and a lid that slides with 1 m/s
struct channel : testCase
{
    channel()
    {
        addBlock("water", {0, 0, 0}, {10, 10, 10});
        boundary =
            "floor { type wall; representation mirror; surface plane; point (0 0 0); normal (0 0 "
            "-1); }"
            "lid { type wall; representation mirror; surface plane; point (0 0 10e-3); normal (0 0 "
            "1); velocity (1 0 0); }"
            "ends { type cyclic; point (0 0 0); separation (10e-3 0 0); }"
            "sides { type cyclic; point (0 0 0); separation (0 10e-3 0); }";
        functions =
            "w { type wallShearStress; patches (floor lid); writeControl timeStep; "
            "writePrecision 12; }";
        control = "endTime 1; deltaT 0.1; writeControl timeStep; writeInterval 1;";
    }

    // The values of a field of the file, without its head
    List<scalar> field(const word& file, const word& name, size_t n) const
    {
        const word text = output(file);
        size_t at = text.find(" " + name + " double");
        REQUIRE(at != word::npos);
        at = text.find('\n', at) + 1;
        if (text.compare(at, 6, "LOOKUP") == 0) at = text.find('\n', at) + 1;
        std::istringstream in(text.substr(at));
        List<scalar> values(n);
        for (scalar& v : values) in >> v;
        return values;
    }
};

template <class Velocity>
void setVelocity(particleCloud& cloud, const Velocity& u)
{
    for (label i = 0; i < cloud.n(); ++i) cloud.Up[i] = vec4::from(vector(u(cloud.x[i].xyz())), 7);
}

}  // namespace

TEST_CASE(
    "Couette flow: the exact stress on both walls, along the flow; in any, the friction of "
    "`forces`")
{
    channel t;
    t.functions +=
        "f { type forces; patches (floor lid); writeControl timeStep; writePrecision 12; }"
        "v { type surfaceFieldValue; patches (floor); fields (wallShearStress); operation "
        "areaIntegrate; writeControl timeStep; writePrecision 12; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    setVelocity(r.c->cloud, [](const vector& x) { return vector(x[2] / side, 0, 0); });
    f.start();
    for (const word wall : {"floor", "lid"})
    {
        const List<scalar> row = t.rows("w/0/" + wall + ".dat").front();
        CHECK(row[1] == relative(mu / side, 1e-9));
        CHECK(row[2] == relative(mu / side, 0.01));
        CHECK(row[8] == relative(7, 1e-9));
        CHECK(row[9] == 1);
    }
    CHECK(t.field("w/0/floor.vtk", "wallShearStress", 3)[0] == relative(mu / side, 0.01));
    CHECK(t.field("w/0/lid.vtk", "wallShearStress", 3)[0] == relative(-mu / side, 0.01));
    setVelocity(r.c->cloud, [](const vector& x) {
        return vector(1e4 * x[2] * (side - x[2]) + x[2] / side, 0, 0);
    });
    f.start();
    const scalar viscous = t.rows("f/0/force_floor.dat").back()[7];
    CHECK(t.rows("w/0/floor.dat").back()[1] == relative(viscous / (side * side), 1e-9));
    CHECK(t.rows("v/0/surfaceFieldValue.dat").back()[1] == relative(viscous, 1e-9));
    // fluid that slips along the floor is steeper there
    setVelocity(r.c->cloud, [](const vector& x) { return vector(0.1 + x[2] / side, 0, 0); });
    f.start();
    CHECK(t.rows("w/0/floor.dat").back()[1] > 1.1 * mu / side);
}

TEST_CASE("flow that reverses: TAWSS, OSI and RRT by hand, also continued from the written state")
{
    // after each step the shear rate is this, with a lid that does not fit: only the floor counts
    const List<scalar> rates = {100, 300, -200, 50};
    const scalar sum = 250, size = 650;
    for (const bool continued : {false, true})
    {
        channel t;
        auto r = t.start();
        auto f = std::make_unique<functionObjectList>(*r.c);
        f->start();
        for (const scalar rate : rates)
        {
            ++*r.time;
            setVelocity(r.c->cloud, [&](const vector& x) { return vector(rate * x[2], 0, 0); });
            f->execute();
            if (continued && rate == 300) f = std::make_unique<functionObjectList>(*r.c);
        }
        const word folder = continued ? "w/0.2/" : "w/0/";
        const List<scalar> row = t.rows(folder + "floor.dat").back();
        CHECK(row[1] == relative(mu * 50, 1e-6));
        CHECK(row[3] == relative(mu * size / 4, 1e-6));
        CHECK(row[5] == relative(0.5 * (1 - sum / size), 1e-6));
        // of a single triangle
        CHECK(row[7] == relative(4 / (mu * sum), 0.01));
        CHECK(t.field("w/0.4/floor.vtk", "OSI", 1)[0] == relative(0.5 * (1 - sum / size), 1e-6));
        CHECK(t.field("w/0.4/floor.vtk", "TAWSS", 1)[0] == relative(mu * size / 4, 0.01));
        CHECK(t.field("w/0.4/floor.vtk", "RRT", 1)[0] == relative(4 / (mu * sum), 0.01));
    }
}

TEST_CASE("the history begins at `start`, with the part of the step after it")
{
    channel t;
    t.functions =
        "w { type wallShearStress; patches (floor); writeControl timeStep; start 0.15; "
        "writePrecision 12; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    for (const scalar rate : {100, 300, -200})
    {
        ++*r.time;
        setVelocity(r.c->cloud, [&](const vector& x) { return vector(rate * x[2], 0, 0); });
        f.execute();
    }
    CHECK(std::isnan(t.rows("w/0/floor.dat").front()[3]));
    CHECK(t.rows("w/0/floor.dat").back()[3] == relative(mu * (0.5 * 300 + 200) / 1.5, 1e-6));
}

TEST_CASE("Poiseuille flow in a pipe of 10 spacings: rms over the triangles within 1 %")
{
    const scalar R = 10e-3, length = 6e-3, peak = 1;
    channel t;
    t.particles = {}, t.zones = {}, t.phases = {};
    for (int k = 0; k < 6; ++k)
        for (int ring = 0; ring < 10; ++ring)
        {
            const scalar r = (ring + 0.5) * t.dx;
            const label n = std::lround(2 * M_PI * (ring + 0.5));
            for (label m = 0; m < n; ++m)
            {
                const scalar a = 2 * M_PI * m / n;
                t.add("water", "fluid", {r * std::cos(a), r * std::sin(a), (k + 0.5) * t.dx});
            }
        }
    triSurface pipe = tube(R, length, 64, 6);
    pipe.flip();
    pipe.patchNames = {"pipe"};
    writeSurface(t, pipe, "pipe");
    t.boundary =
        "pipe { type wall; representation mirror; }"
        "ends { type cyclic; point (0 0 0); separation (0 0 6e-3); }";
    t.functions = "w { type wallShearStress; patches (pipe); writePrecision 12; }";
    auto r = t.start();
    setVelocity(r.c->cloud, [&](const vector& x) {
        return vector(0, 0, peak * (1 - (x[0] * x[0] + x[1] * x[1]) / (R * R)));
    });
    functionObjectList f(*r.c);
    f.start();
    const size_t n = size_t(pipe.size());
    const List<scalar> tau = t.field("w/0/pipe.vtk", "wallShearStress", 3 * n);
    scalar squares = 0;
    const scalar exact = 2 * mu * peak / R;
    for (size_t k = 0; k < n; ++k) squares += std::pow(tau[3 * k + 2] / exact - 1, 2) / scalar(n);
    MESSAGE("rms over the triangles: " << 100 * std::sqrt(squares) << " %");
    CHECK(std::sqrt(squares) < 0.01);
}

TEST_CASE("a wall that moves keeps its triangles; bodies that are none are refused")
{
    channel t;
    t.boundary +=
        "plate { type wall; representation mirror; twoSided yes; motion { velocity (0 0 5e-3); "
        "rotation { origin (5e-3 5e-3 0); axis (0 0 1); omega 3; } } }";
    triSurface plate;
    plate.addPatch("plate");
    // edges of 3 dx, of which half are 1.5 dx: rounding must not change their number
    plate.add({3e-3, 3e-3, 3.1e-3}, {6e-3, 3e-3, 3.1e-3}, {6e-3, 6e-3, 3.1e-3}, 0);
    plate.add({3e-3, 3e-3, 3.1e-3}, {6e-3, 6e-3, 3.1e-3}, {3e-3, 6e-3, 3.1e-3}, 0);
    writeSurface(t, plate, "plate");
    t.functions = "w { type wallShearStress; patches (plate); writeControl timeStep; }";
    auto r = t.start();
    functionObjectList f(*r.c);
    f.start();
    for (int k = 0; k < 5; ++k) ++*r.time, f.execute();
    const auto text = [&](const word& time) { return t.output("w/" + time + "/plate.vtk"); };
    const auto count = [&](const word& time) {
        const size_t at = text(time).find("POLYGONS");
        return text(time).substr(at, 20);
    };
    CHECK(count("0.5") == count("0"));
    // the surface has moved by 2.5 mm and turned by 1.5 about (5 5) mm
    std::istringstream in(text("0.5").substr(text("0.5").find(" double\n") + 8));
    vector first, second;
    in >> first[0] >> first[1] >> first[2] >> second[0] >> second[1] >> second[2];
    const vector arm(1e-3 * std::cos(1.5) + 2e-3 * std::sin(1.5),
                     1e-3 * std::sin(1.5) - 2e-3 * std::cos(1.5), 5.6e-3);
    CHECK((second - vector(5e-3, 5e-3, 0) - arm).norm() < 1e-8);

    const auto wrong = [&](const word& functions) {
        t.functions = functions;
        auto again = t.start();
        functionObjectList list(*again.c);
    };
    CHECK_ERROR(wrong("f { type wallShearStress; }"), "wants patches", 3);
    CHECK_ERROR(wrong("f { type wallShearStress; patches (flor); }"), "Did you mean 'floor'?", 3);
}
