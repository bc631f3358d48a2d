// SPDX-License-Identifier: GPL-3.0-or-later
// Two chambers of a plane channel at different pressures, divided by a wall thinner than the kernel support,
// and the flow around the free edge of a plate.
#include "boundary/scene.H"
#include "caseOnDisk.H"

#include <cmath>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr int nx = 20, ny = 12;  // an even number of cells left and right of the wall
constexpr scalar dx = 1e-3, length = nx * dx, height = ny * dx, pLeft = 1000;
constexpr scalar strip = 2 * dx;
// [m/s] velocity that a pressure of 1 kPa over one spacing gives to fluid in a step of 1 ms
constexpr scalar fromLeak = pLeft / (1000 * dx) * 1e-3;

struct divided
{
    word coupling, plate;
    word mu = "1e-2", tolerance = "1e-5";  // of the solvers
    scalar from = 0, to = height;          // where the plate stands
    scalar thickness = 0, pRight = 0;
};

triSurface plateOf(const divided& d)
{
    const scalar x = 0.5 * length, z = dx;
    if (d.thickness == 0)
        return scene::sheet({x, d.from, -z}, {0, d.to - d.from, 0}, {0, 0, 2 * z}, 2);
    // open where the wall continues: at the cyclic sides and across the plane
    const scalar t = 0.5 * d.thickness;
    triSurface s = scene::sheet({x - t, d.from, -z}, {0, d.to - d.from, 0}, {0, 0, 2 * z}, 2);
    s.append(scene::sheet({x + t, d.from, -z}, {0, 0, 2 * z}, {0, d.to - d.from, 0}, 2));
    return s;
}

class chambers
{
public:
    chambers(const word& name, const divided& d) : files(name), d_(d)
    {
        files.fill(nx, ny, dx);
        place();
        files.properties = "rho 1000; mu " + d.mu + ";";
        files.solution = "coupling " + d.coupling + "; monolithic { tolerance " + d.tolerance +
                         "; }"
                         "solvers { p { solver PCG; preconditioner multigrid; tolerance " +
                         d.tolerance + "; } }";
        files.control =
            "startTime 0; endTime 100; deltaT 1; writeControl timeStep; writeInterval 1e6;";
        files.boundary = "plate { type wall; " + d.plate +
                         " }"
                         "sides { type cyclic; point (0 0 0); separation (0 " +
                         str(height, 17) +
                         " 0); }"
                         "left { type open; surface plane; point (0 0 0); normal (-1 0 0); p " +
                         str(pLeft, 17) +
                         "; }"
                         "right { type open; surface plane; point (" +
                         str(length, 17) + " 0 0); normal (1 0 0); p " + str(d.pRight, 17) + "; }";
        files.write();
        std::filesystem::create_directories(files.path() + "/constant/triSurface");
        writeSTL(plateOf(d), files.path() + "/constant/triSurface/plate.stl");
        writeSites("openSites.hdf", {{"left", sites_[0]}, {"right", sites_[1]}});
        if (!rigid_.empty()) writeSites("wallParticles.hdf", {{"plate", rigid_}});
    }
    caseOnDisk files;

private:
    // Places strips beyond both ends; the wall replaces the fluid in it
    void place()
    {
        particleTable& t = files.particles();
        List<vector> fluid;
        for (const vector& x : t.x)
            (std::abs(x[0] - 0.5 * length) < 0.5 * d_.thickness ? rigid_ : fluid).push_back(x);
        for (int side = 0; side < 2; ++side)
            for (scalar depth = 0.5 * dx; depth < strip; depth += dx)
                for (int j = 0; j < ny; ++j)
                    sites_[side].emplace_back(side ? length + depth : -depth, (j + 0.5) * dx, 0);
        for (const auto& s : sites_) fluid.insert(fluid.end(), s.begin(), s.end());
        t.x = fluid;
        t.vectors["U"].assign(fluid.size(), vector::Zero());
        t.scalars["p"].assign(fluid.size(), 0);
        t.integers["zone"].assign(fluid.size(), 0);
        t.integers["id"].clear();
        for (size_t k = 0; k < fluid.size(); ++k) t.integers["id"].push_back(globalId(k));
    }
    void writeSites(const word& file, const std::map<word, List<vector>>& patches) const
    {
        particleTable t;
        word names;
        for (const auto& [name, points] : patches)
        {
            const globalId index = globalId(std::count(names.begin(), names.end(), ' '));
            names += name + " ";
            for (const vector& x : points) t.x.push_back(x), t.integers["patch"].push_back(index);
        }
        t.attributes["patches"] = names;
        writeParticles(t, files.path() + "/constant/" + file);
    }

    divided d_;
    List<vector> sites_[2], rigid_;
};

bool isLeft(const vec4& x)
{
    return x[0] < 0.5 * length;
}

scalar maxSpeed(const particleCloud& cloud)
{
    scalar u = 0;
    for (label i = 0; i < cloud.n(); ++i) u = std::max(u, cloud.Up[i].xyz().norm());
    return u;
}

// Number of fluid pairs across the wall; zero if no fluid sees through the wall
label pairsAcross(fsiCase& c)
{
    c.updateNeighbours(c.time.value(), c.time.value() + 1e-3);
    label n = 0;
    for (label i = 0; i < c.cloud.n(); ++i)
        for (std::int64_t k = c.list.start[i]; k < c.list.start[i + 1]; ++k)
        {
            const label j = c.list.index[k];
            n += j < c.cloud.n() && isLeft(c.cloud.x[i]) != isLeft(c.cloud.x[j]);
        }
    return n;
}

const List<divided>& walls()
{
    static const List<divided> all = [] {
        List<divided> list;
        for (const char* coupling : {"projection", "monolithic"})
            for (const char* kind : {"mirror", "particles"})
            {
                const word representation = "representation " + word(kind) + ";";
                divided d = {coupling, "twoSided yes; " + representation};
                list.push_back(d);
                d.plate = representation, d.thickness = 2 * dx;
                list.push_back(d);
            }
        return list;
    }();
    return all;
}

// Sets vortices that fill each chamber and press on the wall between them, U = curl of psi
void stir(particleCloud& cloud, scalar speed)
{
    for (label i = 0; i < cloud.n(); ++i)
    {
        const scalar kx = 2 * M_PI / length, ky = 2 * M_PI / height;
        const scalar x = kx * cloud.x[i][0], y = ky * cloud.x[i][1];
        cloud.Up[i] = vec4::from(
            speed * vector(std::sin(x) * std::cos(y) * ky / kx, -std::cos(x) * std::sin(y), 0));
    }
}

}  // namespace

TEST_CASE("fluid at rest at 1 kPa and 0 on the two sides of a thin wall stays at rest")
{
    for (divided d : walls())
    {
        d.tolerance = "1e-12";
        CAPTURE(d.coupling);
        CAPTURE(d.plate);
        CAPTURE(d.thickness);
        const chambers ch("thinWallAtRest", d);
        capturedLog log;
        Time time(ch.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        runSteps(c, *scheme, 1e-3, 1);
        scalar error = 0;
        for (label i = 0; i < c.cloud.n(); ++i)
            error =
                std::max(error, std::abs(c.cloud.Up[i][3] - (isLeft(c.cloud.x[i]) ? pLeft : 0)));
        CHECK(pairsAcross(c) == 0);
        // the elements of one side do not close to the last digit
        CHECK(error < 2e-6 * pLeft);
        CHECK(maxSpeed(c.cloud) < 2e-8 * fromLeak);
    }
}

TEST_CASE("stirred fluid at 1 kPa and 0 does not pass a thin wall in 100 steps")
{
    for (const divided& d : walls())
    {
        CAPTURE(d.coupling);
        CAPTURE(d.plate);
        CAPTURE(d.thickness);
        const chambers ch("thinWallStirred", d);
        capturedLog log;
        Time time(ch.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        stir(c.cloud, 0.05);
        std::map<globalId, bool> left;
        for (label i = 0; i < c.cloud.n(); ++i) left[c.cloud.id[i]] = isLeft(c.cloud.x[i]);
        label across = 0, passed = 0;
        scalar way = 0;
        for (int step = 0; step < 100; ++step)
        {
            runSteps(c, *scheme, 4e-3, 1);
            way += 4e-3 * maxSpeed(c.cloud);
            across += pairsAcross(c);
            for (label i = 0; i < c.cloud.n(); ++i)
            {
                const auto known = left.emplace(c.cloud.id[i], isLeft(c.cloud.x[i])).first;
                passed += known->second != isLeft(c.cloud.x[i]);
            }
        }
        CHECK(across == 0);
        CHECK(passed == 0);
        CHECK(way > 4 * dx);
        scalar sum[2] = {}, n[2] = {};
        for (label i = 0; i < c.cloud.n(); ++i)
            if (std::abs(c.cloud.x[i][0] - 0.5 * length) < 3 * dx)
                sum[isLeft(c.cloud.x[i])] += c.cloud.Up[i][3], ++n[isLeft(c.cloud.x[i])];
        CHECK(std::abs(sum[0] / n[0]) < 0.005 * pLeft);
        CHECK(std::abs(sum[1] / n[1] - pLeft) < 0.005 * pLeft);
    }
}

TEST_CASE("flow round the free edge of a sheet: through the gap, never through the sheet")
{
    for (divided d : walls())
    {
        if (d.thickness > 0) continue;
        CAPTURE(d.coupling);
        CAPTURE(d.plate);
        d.to = 0.6 * height, d.mu = "5e-2", d.pRight = pLeft - 5;
        const chambers ch("thinWallEdge", d);
        capturedLog log;
        Time time(ch.files.path());
        fsiCase c(time);
        const auto scheme = couplingScheme::New(c);
        CHECK(pairsAcross(c) > 50);
        label throughSheet = 0, throughGap = 0;
        std::map<globalId, vector> before;
        for (int step = 0; step < 100; ++step)
        {
            for (label i = 0; i < c.cloud.n(); ++i) before[c.cloud.id[i]] = c.cloud.x[i].xyz();
            runSteps(c, *scheme, 4e-3, 1);
            for (label i = 0; i < c.cloud.n(); ++i)
            {
                if (!before.count(c.cloud.id[i])) continue;
                const vector a = before[c.cloud.id[i]], b = c.cloud.x[i].xyz();
                if ((a[0] < 0.5 * length) == (b[0] < 0.5 * length)) continue;
                const scalar y = a[1] + (0.5 * length - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
                ++(y > d.from && y < d.to ? throughSheet : throughGap);
            }
        }
        CHECK(throughSheet == 0);
        CHECK(throughGap > 20);
    }
}
