// SPDX-License-Identifier: GPL-3.0-or-later
// Walls that turn.  A vessel that turns with its fluid: u = omega x r is exact in a vessel of any shape, p = rho omega^2
// r^2/2.  A drum whose wall turns in itself: its fluid reaches the same motion.  A wall that slides to and fro: Stokes'
// second problem.  Cyclic sides with a pressure drop: the same flow as with an equal body force.
#include "boundary/scene.H"
#include "boxCase.H"
#include "relative.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3, omega = 5;
const vector centre(8e-3, 8e-3, 0);

word text(const word& prefix, const word& motion)
{
    return "drum { type wall; representation mirror; " + prefix +
           "rotation { origin (8e-3 8e-3 0); axis (0 0 1); " + motion + " } " +
           (prefix.empty() ? "" : "} ") + "}";
}

void writeSurface(const triSurface& s, const caseOnDisk& files)
{
    std::filesystem::create_directories(files.path() + "/constant/triSurface");
    writeSTL(s, files.path() + "/constant/triSurface/drum.stl");
}

// Four walls of a square, normals outward
triSurface square()
{
    const scalar a = 16 * dx;
    const vector z(0, 0, 4 * dx), low(0, 0, -2 * dx);
    triSurface s = scene::sheet(low, z, {0, a, 0});
    s.append(scene::sheet(low + vector(a, 0, 0), {0, a, 0}, z));
    s.append(scene::sheet(low, {a, 0, 0}, z));
    s.append(scene::sheet(low + vector(0, a, 0), z, {a, 0, 0}));
    s.weld(1e-9);
    return s;
}

// Three layers of rigid particles around the square
void writeWallParticles(const caseOnDisk& files)
{
    particleTable t;
    for (int j = -3; j < 19; ++j)
        for (int i = -3; i < 19; ++i)
            if (i < 0 || i >= 16 || j < 0 || j >= 16)
                t.x.emplace_back((i + 0.5) * dx, (j + 0.5) * dx, 0),
                    t.integers["patch"].push_back(0);
    t.attributes["patches"] = "drum";
    writeParticles(t, files.path() + "/constant/wallParticles.hdf");
}

vector turning(const vector& x)
{
    return omega * vector(0, 0, 1).cross(x - centre);
}

scalar slope(const List<scalar>& x, const List<scalar>& y)
{
    scalar sx = 0, sy = 0, sxx = 0, sxy = 0;
    const scalar n = scalar(x.size());
    for (size_t k = 0; k < x.size(); ++k)
        sx += x[k], sy += y[k], sxx += x[k] * x[k], sxy += x[k] * y[k];
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

scalar worstDeviation(const particleCloud& cloud)
{
    scalar worst = 0;
    for (label i = 0; i < cloud.n(); ++i)
        worst = std::max(worst, (cloud.Up[i].xyz() - turning(cloud.x[i].xyz())).norm());
    return worst;
}

}  // namespace

TEST_CASE("a square vessel that turns with its fluid, with both couplings")
{
    for (const char* coupling : {"projection", "monolithic"})
        for (const char* motion : {"omega 5;", "angle polynomial ((5 1));"})
        {
            CAPTURE(coupling);
            caseOnDisk files("turning");
            files.solution = "coupling " + word(coupling) + ";";
            files.boundary = text("motion { ", motion);
            files.properties = "rho 1000; mu 0.05;";
            files.fill(16, 16, dx);
            for (size_t i = 0; i < files.particles().x.size(); ++i)
                files.particles().vectors["U"][i] = turning(files.particles().x[i]);
            files.write(), writeSurface(square(), files);
            capturedLog log;
            Time time(files.path());
            fsiCase c(time);
            const auto scheme = couplingScheme::New(c);
            runSteps(c, *scheme, 5e-3, 63);  // a quarter turn
            CHECK(worstDeviation(c.cloud) < 0.05 * omega * 8 * dx);
            CHECK(std::abs(c.walls->balance()[0].swept) < 1e-12);
            // after a full turn no particle is outside, and the pressure balances the rotation
            scalar p[2] = {0, 0}, n[2] = {0, 0};
            const scalar angle = omega * time.value();
            for (label i = 0; i < c.cloud.n(); ++i)
            {
                const vector r = Eigen::AngleAxisd(-angle, vector::UnitZ()) *
                                 vector(c.cloud.x[i].xyz() - centre);
                CHECK(r.cwiseAbs().maxCoeff() < 8 * dx);
                const int outer = r.norm() > 6 * dx;
                p[outer] += c.cloud.Up[i][3] - 0.5 * 1000 * omega * omega * r.squaredNorm(),
                    n[outer] += 1;
            }
            CHECK(std::abs(p[1] / n[1] - p[0] / n[0]) <
                  0.05 * 0.5 * 1000 * std::pow(omega * 8 * dx, 2));
        }
}

TEST_CASE("vessels of rigid particles that speed up or turn push their fluid in every step")
{
    constexpr scalar a = 0.4, dt = 2e-3;
    for (const bool turns : {false, true})
    {
        CAPTURE(turns);
        caseOnDisk files("pushed");
        files.solution = "coupling projection; shifting { type none; }";
        files.boundary = word("drum { type wall; motion { ") +
                         (turns ? "rotation { origin (8e-3 8e-3 0); axis (0 0 1); omega 5; }"
                                : "direction (1 0 0); displacement polynomial ((0.2 2));") +
                         " } }";
        files.properties = "rho 1000; mu 1e-4;";
        files.fill(16, 16, dx);
        for (size_t i = 0; i < files.particles().x.size() && turns; ++i)
            files.particles().vectors["U"][i] = turning(files.particles().x[i]);
        files.write(), writeSurface(square(), files), writeWallParticles(files);
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        for (int n = 1; n < 6; ++n)
        {
            CAPTURE(n);
            runSteps(c, *scheme, dt, 1);
            // mean velocity of the vessel over the step, and its change since the step before
            const scalar speed = a * (n - 0.5) * dt, gain = n == 1 ? a / 2 : a;
            scalar worst = 0;
            List<scalar> ours, exact;
            for (label i = 0; i < c.cloud.n(); ++i)
            {
                const vector x = c.cloud.x[i].xyz(), u = turns ? turning(x) : vector(speed, 0, 0);
                worst = std::max(worst, (c.cloud.Up[i].xyz() - u).norm());
                ours.push_back(c.cloud.Up[i][3]);
                exact.push_back(1000 * (turns ? 0.5 * omega * omega * (x - centre).squaredNorm()
                                              : -gain * x[0]));
            }
            CHECK(worst < (turns ? 0.02 * omega * 8 * dx : 0.08 * a * dt));
            if (turns && n == 1) continue;  // how the wall's velocity turned before is not known
            CHECK(slope(exact, ours) == doctest::Approx(1).epsilon(0.05));
        }
    }
}

TEST_CASE("a vessel that turns and travels with its fluid and a solid clamped to it")
{
    for (const char* coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        const vector speed(0.02, 0.01, 0);
        caseOnDisk files("clamped");
        files.solution = "coupling " + word(coupling) + ";";
        files.boundary =
            "drum { type wall; clamps (block); motion { velocity (0.02 0.01 0); rotation "
            "{ origin (8e-3 8e-3 0); axis (0 0 1); omega 5; } } }";
        files.properties = "rho 1000; mu 0.05;";
        files.fill(16, 16, dx);
        particleTable& t = files.particles();
        for (size_t i = 0; i < t.x.size(); ++i)
        {
            t.vectors["U"][i] = speed + turning(t.x[i]);
            t.integers["zone"][i] = t.x[i][1] < 5 * dx ? 0 : 1;
        }
        t.attributes["zones"] = "block water", t.attributes["phases"] = "solid fluid";
        files.write(), writeSurface(square(), files), writeWallParticles(files);
        setContent(files.path() + "/constant/structureProperties",
                   "structureModel springNetwork; G 50; links radius; radius 2.1;");
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        label clamped = 0;
        for (label i = 0; i < c.cloud.nSolid(); ++i) clamped += c.cloud.uFixed[i];
        CHECK(clamped == 3 * 16 + 2 * 2 * 3);
        runSteps(c, *scheme, 2.5e-3, 503);  // once round
        const scalar now = time.value();
        const List<vec4>& rest = c.cloud.vectors.at("x0");
        scalar level = 0;
        for (label i = c.cloud.nSolid(); i < c.cloud.n(); ++i)
            level += c.cloud.Up[i][3] / scalar(c.cloud.n() - c.cloud.nSolid());
        CHECK(std::abs(level) < 2);  // rho omega^2 r^2/2 is 1.6 at most
        for (label i = 0; i < c.cloud.n(); ++i)
        {
            const vector x = c.cloud.x[i].xyz(), from = centre + speed * now;
            const vector u = speed + omega * vector(0, 0, 1).cross(x - from);
            CHECK((c.cloud.Up[i].xyz() - u).norm() < 0.05 * omega * 8 * std::sqrt(2.0) * dx);
            if (!c.cloud.uFixed[i] || c.cloud.isFluid(i)) continue;
            const vector follows =
                from + Eigen::AngleAxisd(omega * now, vector::UnitZ()) * (rest[i].xyz() - centre);
            CHECK((x - follows).norm() < 1e-9 * dx);
        }
    }
}

TEST_CASE("a drum that turns in itself spins its fluid up")
{
    for (const char* coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        caseOnDisk files("drum");
        files.solution = "coupling " + word(coupling) + ";";
        files.boundary = text("", "omega 5;");
        files.properties = "rho 1000; mu 1;";
        files.fill(0, 0, dx);
        particleTable& t = files.particles();
        const auto inDrum = [&](const vector& x) { return (x - centre).norm() < 7.9 * dx; };
        for (const vector& x : scene::lattice(dx, {0, 0, 0}, {16 * dx, 16 * dx, 0}, inDrum, 2))
        {
            t.x.push_back(x), t.vectors["U"].push_back(vector::Zero()), t.scalars["p"].push_back(0);
            t.integers["id"].push_back(globalId(t.x.size()) - 1), t.integers["zone"].push_back(0);
        }
        files.write();
        const auto wall = [](scalar s, scalar z) -> vector {
            const scalar a = 2 * M_PI * s;
            return centre + vector(8 * dx * std::cos(a), 8 * dx * std::sin(a), (4 * z - 2) * dx);
        };
        writeSurface(scene::parametric(wall, 48, 2,
                                       [](const vector& x) -> vector {
                                           return {x[0] - centre[0], x[1] - centre[1], 0};
                                       }),
                     files);
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        const scalar tau = 1000 * std::pow(8 * dx, 2) / 1;  // R^2/nu: e^(-5.78 t/tau) is left
        runSteps(c, *scheme, 2e-3, label(tau / 2e-3));
        CHECK(worstDeviation(c.cloud) < 0.04 * omega * 8 * dx);
    }
}

TEST_CASE("a lid that slides to and fro: Stokes' second problem")
{
    for (const char* kind : {"particles", "mirror"})
    {
        CAPTURE(kind);
        boxCase b;
        b.nx = 6, b.ny = 32, b.mu = 0.05;
        const word wall = "type wall; representation " + word(kind) + ";";
        b.patch = {
            "type cyclic;", "",
            wall +
                "velocity { direction (1 0 0); speed { type sine; frequency 1; amplitude 0.01; "
                "scale 1; level 0; t0 -0.25; } }",  // cos
            wall};
        runningBox r(b);
        const scalar dt = 5e-3, w = 2 * M_PI;
        r.run(dt, 400);
        const scalar k = std::sqrt(w * 1000 / (2 * b.mu)), t = r.time.value();
        for (label i = 0; i < r.c.cloud.n(); ++i)
        {
            const scalar y = r.c.cloud.x[i][1];
            const scalar exact = 0.01 * std::exp(-k * y) * std::cos(w * t - k * y);
            CHECK(std::abs(r.c.cloud.Up[i][0] - exact) < 0.03 * 0.01);
        }
    }
}

TEST_CASE("a pressure drop between cyclic sides that swings drives as the body force does")
{
    for (const char* coupling : {"projection", "monolithic"})
        for (const char* kind : {"particles", "mirror"})
        {
            CAPTURE(coupling);
            CAPTURE(kind);
            const word wall = "type wall; representation " + word(kind) + ";";
            boxCase drop;
            drop.coupling = coupling, drop.mu = 0.5;
            drop.patch = {"type cyclic; pressureDrop { type sine; amplitude 3; frequency 20; }", "",
                          wall, wall};
            drop.solution =
                "solvers { p { solver PCG; preconditioner multigrid; tolerance 1e-11; } } "
                "monolithic "
                "{ tolerance 1e-8; absTolerance 1e-9; }";
            boxCase force = drop;
            force.patch[0] = "type cyclic;";
            runningBox a(drop, "drop");
            runningBox b(force, "force");
            for (int k = 1; k <= 45; ++k)
            {
                const scalar fall = 3 * std::sin(2 * M_PI * 20 * 2e-3 * k);  // at the step's end
                b.c.bodyForce = {vector(fall / (1000 * force.length()), 0, 0)};
                a.run(2e-3, 1), b.run(2e-3, 1);
            }
            scalar most = 0, worst = 0;
            std::map<globalId, vector> byId;
            for (label i = 0; i < b.c.cloud.n(); ++i) byId[b.c.cloud.id[i]] = b.c.cloud.Up[i].xyz();
            for (label i = 0; i < a.c.cloud.n(); ++i)
            {
                const vector u = byId.at(a.c.cloud.id[i]);
                most = std::max(most, u.norm());
                worst = std::max(worst, (u - a.c.cloud.Up[i].xyz()).norm());
            }
            CHECK(most > 1e-4);
            CHECK(worst < 0.005 * most);
        }
}

TEST_CASE("a round vessel turns, however long the step; what slides out of its surface is refused")
{
    const auto drum = [](scalar s, scalar z) -> vector {
        const scalar a = 2 * M_PI * s;
        return centre + vector(8 * dx * std::cos(a), 8 * dx * std::sin(a), (4 * z - 2) * dx);
    };
    const triSurface round =
        scene::parametric(drum, 48, 2, [](const vector& x) -> vector { return x - centre; });
    const auto build = [&](const word& coupling, const word& boundary, const triSurface& surface) {
        auto files = std::make_unique<caseOnDisk>("round");
        files->solution = "coupling " + coupling + ";", files->properties = "rho 1000; mu 0.05;";
        files->boundary = boundary;
        files->fill(0, 0, dx);
        particleTable& t = files->particles();
        const auto inDrum = [&](const vector& x) { return (x - centre).norm() < 7.9 * dx; };
        for (const vector& x : scene::lattice(dx, {0, 0, 0}, {16 * dx, 16 * dx, 0}, inDrum, 2))
        {
            t.x.push_back(x), t.vectors["U"].push_back(turning(x)), t.scalars["p"].push_back(0);
            t.integers["id"].push_back(globalId(t.x.size()) - 1), t.integers["zone"].push_back(0);
        }
        files->write(), writeSurface(surface, *files);
        return files;
    };
    for (const char* coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        const auto files = build(coupling, text("motion { ", "omega 5;"), round);
        capturedLog log;
        Time time(files->path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, 0.01, 32);
        CHECK(worstDeviation(c.cloud) < 0.06 * omega * 8 * dx);
    }
    for (const auto& [boundary, surface] :
         {std::pair(text("", "omega 5;"), square()),
          std::pair(word("drum { type wall; representation mirror; velocity (1 0 0); }"), round)})
    {
        const auto files = build("projection", boundary, surface);
        Time time(files->path());
        CHECK_THROWS_WITH_AS(fsiCase c(time), doctest::Contains("points out of it"), fatalError);
    }
}
