// SPDX-License-Identifier: GPL-3.0-or-later
// Solids that meet each other, their mirror image and a wall, theory 7.10
#include "caseOnDisk.H"
#include "energyLedger.H"
#include "relative.H"
#include "solidContact.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, G = 1e4, rho = 1000, dt = 2e-3;
constexpr int nx = 30, ny = 14, side = 6;  // of the box and of a block

// A closed box of fluid with square blocks of solid whose lower left cells are given
class blocks
{
public:
    blocks(const word& name, const List<std::array<int, 2>>& corners, const word& bodyForce,
           const word& left = "type wall;")
        : files(name)
    {
        files.fill(nx, ny, dx);
        place(corners);
        files.control =
            "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
        files.solution = "coupling monolithic;";
        files.properties = "rho 1000; mu 1e-2; bodyForce { " + bodyForce + " }";
        const auto plane = [](const word& patch, const word& type, const word& point,
                              const word& normal) {
            return patch + " { " + type + (type == "type wall;" ? " surface plane;" : "") +
                   " point " + point + "; normal " + normal + "; } ";
        };
        files.boundary = plane("left", left, "(0 0 0)", "(-1 0 0)") +
                         plane("right", "type wall;", "(0.03 0 0)", "(1 0 0)") +
                         plane("floor", "type wall;", "(0 0 0)", "(0 -1 0)") +
                         plane("roof", "type wall;", "(0 0.014 0)", "(0 1 0)");
        files.write();
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel totalLagrangian; material { type neoHookean; G 1e4; }");
    }
    caseOnDisk files;

private:
    void place(const List<std::array<int, 2>>& corners)
    {
        particleTable all = files.particles(), &t = files.particles();
        t.x.clear(), t.vectors["U"].clear(), t.scalars["p"].clear();
        t.integers["id"].clear(), t.integers["zone"].clear();
        const auto blockOf = [&](const vector& x) {
            for (size_t b = 0; b < corners.size(); ++b)
                if (const int i = int(x[0] / dx) - corners[b][0],
                    j = int(x[1] / dx) - corners[b][1];
                    i >= 0 && i < side && j >= 0 && j < side)
                    return int(b);
            return -1;
        };
        word zones, phases;
        for (size_t b = 0; b < corners.size(); ++b)
            zones += "block" + std::to_string(b) + " ", phases += "solid ";
        for (const bool solid : {true, false})
            for (const vector& x : all.x)
            {
                const int b = blockOf(x);
                if ((b >= 0) != solid) continue;
                t.x.push_back(x), t.vectors["U"].push_back(vector::Zero());
                t.scalars["p"].push_back(0);
                t.integers["id"].push_back(globalId(t.x.size()) - 1);
                t.integers["zone"].push_back(b >= 0 ? b : int(corners.size()));
            }
        t.attributes["zones"] = zones + "fluid", t.attributes["phases"] = phases + "fluid";
    }
};

// Least distance of two blocks [dx]
scalar apart(const particleCloud& cloud)
{
    scalar least = 1e30;
    for (label i = 0; i < cloud.nSolid(); ++i)
        for (label j = 0; j < cloud.nSolid(); ++j)
            if (cloud.zone[i] == 0 && cloud.zone[j] == 1)
                least = std::min(least, (cloud.x[i].xyz() - cloud.x[j].xyz()).norm() / dx);
    return least;
}

// Least coordinate of the solid along an axis [dx]
scalar lowest(const particleCloud& cloud, int axis)
{
    scalar least = 1e30;
    for (label i = 0; i < cloud.nSolid(); ++i) least = std::min(least, cloud.x[i][axis] / dx);
    return least;
}

// Two slabs between cyclic sides, endless along x, with one layer of fluid between them
class slabs
{
public:
    static constexpr int width = 12, layers = 3, below = 4;

    explicit slabs(const word& structure = "") : files_("contactSlabs")
    {
        files_.fill(width, 2 * below + 2 * layers + 1, dx);
        particleTable all = files_.particles(), &t = files_.particles();
        t.x.clear(), t.integers["zone"].clear();
        for (const int zone : {0, 1, 2})
            for (const vector& x : all.x)
                if (zoneOf(x) == zone) t.x.push_back(x), t.integers["zone"].push_back(zone);
        t.attributes["zones"] = "lower upper fluid", t.attributes["phases"] = "solid solid fluid";
        files_.control =
            "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
        files_.solution = "coupling monolithic;", files_.properties = "rho 1000; mu 1e-2;";
        files_.boundary =
            "sides { type cyclic; point (0 0 0); separation (" + str(width * dx, 17) +
            " 0 0); } floor { type wall; surface plane; point (0 0 0); normal (0 -1 0); }";
        files_.write();
        setContent(
            files_.path() + "/constant/structureProperties",
            "structureModel totalLagrangian; material { type neoHookean; G 1e4; } " + structure);
        time_ = std::make_unique<Time>(files_.path());
        c = std::make_unique<fsiCase>(*time_);
    }
    // Moves the upper slab so that the layers that face each other are `apart` [dx], shifted by `along` [dx]
    void put(scalar apart, scalar along)
    {
        const List<vec4>& rest = c->cloud.vectors.at("x0");
        for (label i = 0; i < c->cloud.nSolid(); ++i)
            if (c->cloud.zone[i] == 1)
                c->cloud.x[i].setXyz(rest[i].xyz() + dx * vector(along, apart - 2, 0));
        c->updateNeighbours(0, 0);
    }
    std::unique_ptr<fsiCase> c;

private:
    static int zoneOf(const vector& x)
    {
        const int j = int(x[1] / dx) - below;
        return j >= 0 && j < layers ? 0 : j > layers && j <= 2 * layers ? 1 : 2;
    }
    caseOnDisk files_;
    capturedLog log_;
    std::unique_ptr<Time> time_;
};

}  // namespace

TEST_CASE("two blocks are pressed together, rest on a layer of fluid, and part again")
{
    const blocks scene("contact", {{6, 4}, {18, 4}},
                       "block0 table ((0 (16 0 0)) (1 (16 0 0)) (1.001 (-16 0 0))); "
                       "block1 table ((0 (-16 0 0)) (1 (-16 0 0)) (1.001 (16 0 0)));");
    capturedLog log;
    Time time(scene.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    scalar least = 1e30;
    for (int k = 0; k < 500; ++k)
    {
        runSteps(c, *scheme, dt, 1);
        least = std::min(least, apart(c.cloud));
    }
    CHECK(least > 1.5);
    CHECK(apart(c.cloud) < 2);
    CHECK(c.cloud.maxSpeed() < 1e-3);
    runSteps(c, *scheme, dt, 250);
    CHECK(apart(c.cloud) > 3);
}

TEST_CASE("blocks that begin a spacing apart are two bodies: they part")
{
    const blocks scene("contactNear", {{8, 4}, {15, 4}}, "block0 (-4 0 0); block1 (4 0 0);");
    capturedLog log;
    Time time(scene.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, dt, 300);
    CHECK(apart(c.cloud) > 4);
}

TEST_CASE(
    "a block that begins a spacing from a symmetry plane meets its image there as one from afar")
{
    const blocks scene("contactImage", {{1, 5}}, "block0 (-8 0 0);", "type symmetryPlane;");
    capturedLog log;
    Time time(scene.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, dt, 300);
    CHECK(lowest(c.cloud, 0) > 0.75);
}

TEST_CASE("a block falls to a wall, and one to its image beyond a symmetry plane")
{
    const blocks scene("contactWall", {{12, 5}}, "block0 (-8 -16 0);", "type symmetryPlane;");
    capturedLog log;
    Time time(scene.files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    scalar floor = 1e30, plane = 1e30;
    for (int k = 0; k < 700; ++k)
    {
        runSteps(c, *scheme, dt, 1);
        floor = std::min(floor, lowest(c.cloud, 1)), plane = std::min(plane, lowest(c.cloud, 0));
    }
    CHECK(floor > 1);
    CHECK(lowest(c.cloud, 1) < 1.5);
    CHECK(plane > 0.75);
}

// No fluid ties the levels of their pressures, and pairs at the end of the kernel must not: their weight is next to nothing
TEST_CASE("two blocks with nothing around them, almost out of each other's reach")
{
    caseOnDisk files("contactDry");
    files.fill(2 * side, side, dx);
    particleTable& t = files.particles();
    for (size_t i = 0; i < t.x.size(); ++i)
    {
        const bool second = t.x[i][0] > side * dx;
        if (second) t.x[i][0] += 1.599999 * dx;
        t.integers["zone"][i] = second, t.vectors["U"][i][0] = second ? 0.01 : -0.01;
    }
    t.attributes["zones"] = "one two", t.attributes["phases"] = "solid solid";
    files.solution = "coupling monolithic;", files.properties = "rho 1000; mu 1e-3;";
    files.write();
    setContent(files.path() + "/constant/structureProperties",
               "structureModel totalLagrangian; material { type neoHookean; G 1e4; }");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    c.cloud.Up[0][1] = 0.01;  // so that there is something to solve
    runSteps(c, *scheme, 1e-6, 1);
    const word text = log.text(), before = "No Iterations ";
    CHECK(std::stoi(text.substr(text.rfind(before) + before.size())) < 25);
}

// Two arms on one root, 17 spacings long, with a slit of `open` columns between them and nothing around.
struct arms
{
    scalar least, tips;  // distances after forces have pulled or pressed the arms for 0.3 s [dx]
};
arms pull(int open, scalar acceleration)
{
    constexpr int width = 5, root = 3, length = 17;
    caseOnDisk files("contactSlit");
    files.fill(2 * width + open, root + length, dx);
    particleTable all = files.particles(), &t = files.particles();
    t.x.clear(), t.integers["zone"].clear();
    for (const int zone : {0, 1, 2})
        for (const vector& x : all.x)
        {
            const int i = int(x[0] / dx), j = int(x[1] / dx);
            if (j >= root && i >= width && i < width + open) continue;
            if (zone == (j < root ? 2 : i >= width))
                t.x.push_back(x), t.integers["zone"].push_back(zone);
        }
    t.vectors["U"].resize(t.x.size()), t.scalars["p"].resize(t.x.size());
    t.integers["id"].resize(t.x.size());
    t.attributes["zones"] = "left right root", t.attributes["phases"] = "solid solid clamped";
    const word outward = str(acceleration, 6), inward = str(-acceleration, 6);
    files.solution = "coupling monolithic;";
    files.properties =
        "rho 1000; mu 1e-3; bodyForce { left (" + inward + " 0 0); right (" + outward + " 0 0); }";
    files.control = "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
    files.write();
    setContent(
        files.path() + "/constant/structureProperties",
        "structureModel totalLagrangian; material { type neoHookean; G 1e4; viscosity 100; }");
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, dt, 150);
    const label tip[2] = {(length - 1) * width + width - 1, length * width + (length - 1) * width};
    return {apart(c.cloud), (c.cloud.x[tip[1]].xyz() - c.cloud.x[tip[0]].xyz()).norm() / dx};
}

TEST_CASE("two arms of one body part across a slit of one spacing as across a wide one, and meet")
{
    const scalar narrow = pull(1, 8).tips - 2, wide = pull(4, 8).tips - 5;
    CHECK(narrow > 2);
    CHECK(narrow == relative(wide, 0.03));
    CHECK(pull(1, -8).least > 1.5);
}

TEST_CASE("layers that slide over each other: what holds them back, over what presses them")
{
    slabs s;
    // for distances at which a layer carries 0.1 G and 0.01 G
    for (const auto& [apart, load, most] :
         {std::tuple(1.695, 0.1, 0.035), std::tuple(1.88, 0.01, 0.17)})
        for (const scalar along : {0.0, 0.1, 0.25, 0.4, 0.5, 0.8})
        {
            s.put(apart, along);
            const solidBodies bodies(*s.c);
            solidContact contact(*s.c, bodies);
            contact.find();
            const particleCloud& cloud = s.c->cloud;
            List<vec4> f(cloud.nSolid());
            contact.addForce(cloud.x, f);
            vector upper = vector::Zero(), lower = vector::Zero();
            for (label i = 0; i < cloud.nSolid(); ++i)
                (cloud.zone[i] == 1 ? upper : lower) += f[i].xyz() / (slabs::width * dx * G);
            CAPTURE(apart);
            CAPTURE(along);
            CHECK((upper + lower).norm() < 1e-12);
            CHECK(upper[1] == relative(load, 0.5));
            CHECK(std::abs(upper[0]) < most * upper[1]);
        }
}

TEST_CASE(
    "contact: forces are the slope of the energy, the tangent that of the forces but for turning")
{
    slabs s;
    s.put(1.4, 0.3);
    const solidBodies bodies(*s.c);
    solidContact contact(*s.c, bodies);
    contact.find();
    CHECK(!contact.empty());
    List<vec4> x(s.c->cloud.x.begin(), s.c->cloud.x.begin() + s.c->cloud.nSolid()), f(x.size()),
        u(x.size()), Ku(x.size());
    contact.addForce(x, f);
    scalar most = 0, error = 0;
    for (size_t i = 0; i < x.size(); ++i)
        for (const int a : {0, 1})
        {
            const scalar at = x[i][a], step = 1e-5 * dx;
            x[i][a] = at + step;
            const scalar up = contact.energy(x);
            x[i][a] = at - step;
            const scalar down = contact.energy(x);
            x[i][a] = at;
            most = std::max(most, std::abs(f[i][a]));
            error = std::max(error, std::abs(f[i][a] + (up - down) / (2 * step)));
        }
    CHECK(most > 0);
    CHECK(error < 1e-6 * most);
    // along the line of the pairs, here across the layers: all of the upper slab moves down
    s.put(1.4, 0);
    contact.find();
    x.assign(s.c->cloud.x.begin(), s.c->cloud.x.begin() + s.c->cloud.nSolid());
    blockMatrix3 K;
    contact.addTangent(x, s.c->structure->tangentPattern(), K);
    CHECK(K.size() == label(x.size()));
    for (label i = 0; i < K.size(); ++i)
    {
        tensor sum = K.diagonal[i];
        for (label k = K.rowStart[i]; k < K.rowStart[i + 1]; ++k) sum += K.value[k];
        CHECK(sum.norm() < 1e-9 * G);  // a motion of all meets nothing
        CHECK(K.diagonal[i](1, 1) >= 0);
    }
}

TEST_CASE(
    "contact { gap .. }: the fluid between surfaces that face each other is more viscous, no other")
{
    slabs s("contact { gap 1.5; viscosity 50; }");
    const auto scheme = couplingScheme::New(*s.c);
    runSteps(*s.c, *scheme, 1e-3, 1);
    const particleCloud& cloud = s.c->cloud;
    const List<scalar>& ratio = cloud.scalars.at("viscosityRatio");
    for (label i = 0; i < cloud.n(); ++i)
    {
        const int j = int(cloud.x[i][1] / dx) - slabs::below;
        CHECK(ratio[i] == (j >= slabs::layers - 1 && j <= slabs::layers + 1 ? 50 : 1));
    }
    slabs without;
    const auto other = couplingScheme::New(*without.c);
    runSteps(*without.c, *other, 1e-3, 1);
    CHECK(without.c->cloud.scalars.count("viscosityRatio") == 0);
    CHECK_THROWS_WITH(couplingScheme::New(*slabs("contact { gap 4; }").c),
                      doctest::Contains("gap"));
    CHECK_THROWS_WITH(couplingScheme::New(*slabs("contact { gap 1; slit 2; }").c),
                      doctest::Contains("Valid are: gap viscosity"));
}
