// SPDX-License-Identifier: GPL-3.0-or-later
// Both kinds of wall in flows without an equivalent problem without walls: steady shear between plates and steady flow in a
// pipe must converge with the spacing.
#include "boundary/scene.H"
#include "caseOnDisk.H"

#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace scene;

namespace
{

// Rings of particles with spacing dx, r = (k + 1/2) dx from `from` to `to`, in the plane z
List<vector> rings(scalar dx, scalar from, scalar to, scalar z = 0)
{
    List<vector> points;
    const int first = int(std::lround(from / dx)), last = int(std::lround(to / dx));
    for (int k = first; k < last; ++k)
    {
        const scalar r = (k + 0.5) * dx;
        const int n = std::max(3, int(std::lround(2 * M_PI * r / dx)));
        for (int j = 0; j < n; ++j)
        {
            const scalar a = 2 * M_PI * (j + 0.37 * k) / n;
            points.emplace_back(r * std::cos(a), r * std::sin(a), z);
        }
    }
    return points;
}

// The same for shells of particles, each a Fibonacci spiral
List<vector> shells(scalar dx, scalar from, scalar to)
{
    List<vector> points;
    for (scalar r = from + 0.5 * dx; r < to; r += dx)
    {
        const int n = int(std::lround(4 * M_PI * r * r / (dx * dx)));
        for (int j = 0; j < n; ++j)
        {
            const scalar z = 1 - (2 * j + 1.0) / n, a = M_PI * (3 - std::sqrt(5)) * j;
            const scalar rho = std::sqrt(1 - z * z);
            points.push_back(r * vector(rho * std::cos(a), rho * std::sin(a), z));
        }
    }
    return points;
}

// A ball's surface, normals outward or inward
triSurface ball(scalar dx, bool outward)
{
    const int n = int(std::lround(2 * M_PI / dx));
    return parametric(
        [](scalar s, scalar t) {
            return vector(std::sin(M_PI * t) * std::cos(2 * M_PI * s),
                          std::sin(M_PI * t) * std::sin(2 * M_PI * s), std::cos(M_PI * t));
        },
        2 * n, n, [=](const vector& x) -> vector { return (outward ? 1 : -1) * x; });
}

// A tube about the z-axis, normals away from it (outward) or towards it
triSurface tube(scalar radius, scalar dx, scalar z0, scalar z1, bool outward)
{
    return parametric(
        [=](scalar s, scalar t) {
            return vector(radius * std::cos(2 * M_PI * s), radius * std::sin(2 * M_PI * s),
                          z0 + t * (z1 - z0));
        },
        int(std::lround(4 * M_PI * radius / dx)), 2,
        [=](const vector& x) -> vector { return (outward ? 1 : -1) * vector(x[0], x[1], 0); });
}

constexpr scalar H = 1e-3, nu = 1e-6, force = 1e-4;

// A case of a few particles across H, run until the flow is steady
class steadyFlow
{
public:
    steadyFlow(const word& name, const word& boundary, const word& acceleration) : files(name)
    {
        files.boundary = boundary, files.g = acceleration;
        files.properties = "rho 1000; nu 1e-6;";
        files.schemes = "kernel WendlandC2; hByDx 1.3;";
        files.control =
            "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
    }
    caseOnDisk files;

    // Largest error of the speed over the largest speed
    scalar error(const std::function<scalar(const vector&)>& exact) const
    {
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, 0.5, 8);
        scalar worst = 0, top = 0;
        for (label i = 0; i < c.cloud.n(); ++i)
        {
            const scalar u = exact(c.cloud.x[i].xyz());
            worst = std::max(worst, std::abs(c.cloud.Up[i].xyz().norm() - u));
            top = std::max(top, u);
        }
        return worst / top;
    }
};

const word cyclicIn(const word& direction, scalar length)
{
    return "around { type cyclic; point (0 0 0); separation (" +
           (direction == "x" ? str(length, 17) + " 0 0" : "0 0 " + str(length, 17)) + "); }";
}

// Error of the flow in a plane channel with a moving lid and a bottom at rest
scalar shearError(const word& kind, int n)
{
    const scalar dx = H / n;
    const word wall = "type wall; surface plane; representation " + kind + ";";
    steadyFlow flow("shear" + kind,
                    "bottom { " + wall + " point (0 0 0); normal (0 -1 0); } top { " + wall +
                        " point (0 " + str(H, 17) + " 0); normal (0 1 0); velocity (1e-5 0 0); }" +
                        cyclicIn("x", 8 * dx),
                    "");
    flow.files.fill(8, n, dx);
    flow.files.write();
    return flow.error([](const vector& x) { return 1e-5 * x[1] / H; });
}

// A pipe of radius H with a body force along it
scalar pipeError(const word& kind, int n)
{
    const scalar dx = H / n, length = 4 * dx;
    steadyFlow flow("pipe" + kind,
                    "wall { type wall; representation " + kind + "; }" + cyclicIn("z", length),
                    "(0 0 " + str(force) + ")");
    flow.files.fill(1, 1, dx);
    particleTable& t = flow.files.particles();
    particleTable rigid;
    t.x.clear();
    for (int k = 0; k < 4; ++k)
    {
        const scalar z = (k + 0.5) * dx;
        for (const vector& x : rings(dx, 0, H, z)) t.x.push_back(x);
        for (const vector& x : rings(dx, H, H + 3 * dx, z)) rigid.x.push_back(x);
    }
    t.vectors["U"].assign(t.x.size(), vector::Zero()), t.scalars["p"].assign(t.x.size(), 0);
    t.integers["zone"].assign(t.x.size(), 0), t.integers["id"].clear();
    for (size_t k = 0; k < t.x.size(); ++k) t.integers["id"].push_back(globalId(k));
    t.setAttribute("nDims", 3);
    flow.files.write();
    std::filesystem::create_directories(flow.files.path() + "/constant/triSurface");
    writeSTL(tube(H, dx, 0, length, true), flow.files.path() + "/constant/triSurface/wall.stl");
    rigid.integers["patch"].assign(rigid.x.size(), 0);
    rigid.attributes["patches"] = "wall";
    writeParticles(rigid, flow.files.path() + "/constant/wallParticles.hdf");
    return flow.error(
        [](const vector& x) { return force / (4 * nu) * (H * H - x[0] * x[0] - x[1] * x[1]); });
}

// Factor by which the speed of fluid in a ball of mirrors, or between two balls, grows.  The fluid is almost at rest, hardly
// moves in the steps and has no viscosity
scalar growthAtRest(scalar dx, scalar from, scalar to)
{
    caseOnDisk files("growthAtRest");
    files.fill(1, 1, dx);
    particleTable& t = files.particles();
    t.x = shells(dx, from, to);
    const size_t n = t.x.size();
    t.scalars["p"].assign(n, 0), t.integers["zone"].assign(n, 0), t.integers["id"].clear();
    t.vectors["U"].clear();
    std::mt19937 random(1);
    std::normal_distribution<scalar> part(0, 1e-6);
    for (size_t k = 0; k < n; ++k)
    {
        t.integers["id"].push_back(globalId(k));
        t.vectors["U"].emplace_back(part(random), part(random), part(random));
    }
    t.setAttribute("nDims", 3);
    files.boundary = "outer { type wall; representation mirror; }";
    if (from > 0) files.boundary += "inner { type wall; representation mirror; }";
    files.properties = "rho 1000; mu 1e-9;";
    files.schemes = "kernel WendlandC2; hByDx 1.3;";
    files.solution =
        "coupling monolithic; monolithic { tolerance 1e-8; absTolerance 1e-12; } shifting { type "
        "none; }";
    files.write();
    std::filesystem::create_directories(files.path() + "/constant/triSurface");
    for (const scalar radius : {from, to})
    {
        if (radius == 0) continue;
        triSurface wall = ball(dx / radius, radius == to);
        wall.scale(radius);
        writeSTL(wall, files.path() + "/constant/triSurface/" + (radius == to ? "outer" : "inner") +
                           ".stl");
    }
    capturedLog log;
    Time time(files.path());
    fsiCase c(time);
    const auto scheme = couplingScheme::New(c);
    runSteps(c, *scheme, 0.01, 1);
    const scalar before = c.cloud.maxSpeed();
    runSteps(c, *scheme, 0.01, 60);
    return c.cloud.maxSpeed() / before;
}

}  // namespace

TEST_CASE("steady shear between plates: exact with mirrors, nearly with rigid particles")
{
    CHECK(shearError("mirror", 8) < 1e-5);
    // 3e-4, as the fluid moves past them; ten times that if they were mirror images
    CHECK(shearError("particles", 8) < 1e-3);
}

TEST_CASE("steady flow in a pipe converges with either wall")
{
    const scalar coarse = pipeError("mirror", 4);
    CHECK(coarse < 0.01);                   // 0.73 %
    CHECK(pipeError("mirror", 16) < 0.01);  // 0.92 %
    // 1.0 % each, due to the order of the rings; without wallFriction.H 4.6 % with 4
    CHECK(pipeError("particles", 4) < 0.015);
    CHECK(pipeError("particles", 8) < 0.015);
}

// If images had the volume of their particles, the speed would grow: 9 times in a ball of 3 dx, 1.5 times in one of 5 dx,
// 2.1 times around one of 2.5 dx
TEST_CASE("fluid at rest stays so in and around small balls of mirrors")
{
    CHECK(growthAtRest(0.1, 0, 0.3) < 1);
    CHECK(growthAtRest(0.1, 0, 0.4) < 1.2);
    CHECK(growthAtRest(0.1, 0, 0.5) < 1.2);
    CHECK(growthAtRest(0.1, 0.25, 0.55) < 1.2);
}
