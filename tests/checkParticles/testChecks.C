// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.H"
#include "schemes/caseOnDisk.H"
#include "relative.H"

using namespace ispf;

namespace
{

constexpr scalar dx = 1e-3;

const word strip = "structureModel springNetwork; E 1e5; links lattice8;";

// Two-dimensional tank of 30 x 20 particles between symmetry planes; its lowest rows are solid
class tank
{
public:
    explicit tank(const word& name, int solidRows = 0) : disk(name)
    {
        disk.fill(30, 20, dx);
        disk.boundary =
            "left { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
            "right { type symmetryPlane; point (0.03 0 0); normal (1 0 0); }"
            "bottom { type symmetryPlane; point (0 0 0); normal (0 -1 0); }"
            "top { type wall; surface plane; point (0 0.02 0); normal (0 1 0); }";
        if (solidRows == 0) return;
        disk.particles().attributes["zones"] = "plate fluid";
        disk.particles().attributes["phases"] = "solid fluid";
        auto& zone = disk.particles().integers["zone"];
        for (size_t i = 0; i < zone.size(); ++i) zone[i] = int(i) >= 30 * solidRows;
        // free at its lower side: the planes of the fluid do not carry links of the solid
        disk.boundary = "";
    }
    caseOnDisk disk;

    fsiCase& start()
    {
        disk.write();
        if (disk.particles().attributes["zones"] != "fluid")
            setContent(disk.path() + "/constant/structureProperties", strip);
        time = std::make_unique<Time>(disk.path());
        c = std::make_unique<fsiCase>(*time);
        c->updateNeighbours(0, time->deltaT());
        return *c;
    }
    void drop(size_t i)
    {
        particleTable& table = disk.particles();
        const auto without = [i](auto& column) {
            column.erase(column.begin() + std::ptrdiff_t(i));
        };
        without(table.x), without(table.vectors["U"]), without(table.scalars["p"]);
        without(table.integers["id"]), without(table.integers["zone"]);
    }
    std::unique_ptr<Time> time;
    std::unique_ptr<fsiCase> c;
};

particleCloud pairOfParticles(scalar apart)
{
    particleCloud cloud;
    cloud.nDims = 2, cloud.dx = dx, cloud.zones = {{"water"}};
    cloud.append(vector(0, 0, 0), 0, vec4{}, 0);
    cloud.append(vector(apart, 0, 0), 0, vec4{}, 1);
    return cloud;
}

}  // namespace

TEST_CASE("a sound tank passes, and nothing is said of what it has not")
{
    const capturedLog log;
    tank t("soundTank");
    fsiCase& c = t.start();
    findings found;
    checkPositions(c.cloud, 0, found);
    checkSides(c, found), checkSpacing(c, found), checkNeighbours(c, found);
    checkKernelSums(c, found), checkSolids(c, found);
    timeSteps(c, 2, found);
    CHECK(found.close() == 0);
    CHECK(log.contains("Particles OK."));
    CHECK(log.contains("Closest pair 1 dx OK"));
    CHECK(log.contains("empty ball: 0.707 dx OK"));  // half the diagonal of a cell
    CHECK(log.contains("least/mean/most: 20/20/20"));
    CHECK(log.contains("Time per step"));
    for (const char* absent : {"warning", "solid", "Layers", "Links"}) CHECK(!log.contains(absent));
}

TEST_CASE("two particles in one place, an id given twice, a number that is none")
{
    const capturedLog log;
    const auto failures = [](const particleCloud& cloud) {
        findings found;
        checkPositions(cloud, 0, found);
        return found.nFailed();
    };
    CHECK(failures(pairOfParticles(dx)) == 0);
    CHECK(failures(pairOfParticles(1e-4 * dx)) == 1);
    CHECK(log.contains("Particles 0 and 1 are in the same place"));
    particleCloud twice = pairOfParticles(dx);
    twice.id[1] = 0;
    CHECK(failures(twice) == 1);
    CHECK(log.contains("***One id a particle"));
    particleCloud broken = pairOfParticles(dx);
    broken.Up[1][3] = std::numeric_limits<scalar>::quiet_NaN();
    CHECK(failures(broken) == 1);
    CHECK(log.contains("Particle 1 (zone water)"));
}

TEST_CASE("a particle beyond a wall fails, a hole and a clump warn")
{
    const capturedLog log;
    tank t("brokenTank");
    List<vector>& x = t.disk.particles().x;
    x[599][1] = 20.1 * dx;
    x[0][0] = x[1][0] - 0.3 * dx;
    for (const size_t i : {346, 345, 316, 315}) t.drop(i);  // a hole of two by two
    fsiCase& c = t.start();
    findings found;
    checkSides(c, found);
    CHECK(found.nFailed() == 1);
    CHECK(log.contains("1 fluid particles beyond a wall or plane, e.g. 599"));
    checkSpacing(c, found);
    CHECK(found.nFailed() == 1);
    CHECK(log.contains("*Closest pair 0.3 dx"));
    CHECK(log.contains("*Largest gap, radius of an empty ball: 1.5"));
}

TEST_CASE("a particle with too few neighbours for a gradient fails")
{
    const capturedLog log;
    tank t("strayTank");
    t.disk.boundary = "";
    t.disk.particles().x[599] = vector(0.05, 0.05, 0);
    findings found;
    checkNeighbours(t.start(), found);
    CHECK(found.nFailed() == 1);
    CHECK(log.contains("***Particle 599 (zone fluid) has too few neighbours"));
}

TEST_CASE("layers: as many as the support needs, and one; one fewer warns, fewer fail")
{
    const auto outcome = [](int rows, word& text) {
        const capturedLog log;
        tank t("plate" + std::to_string(rows), rows);
        findings found;
        checkSolids(t.start(), found);
        text = log.text();
        return found.nFailed();
    };
    word text;
    for (const int rows : {4, 7})
    {
        CHECK(outcome(rows, text) == 0);
        CHECK(text.find("Layers through zone plate: " + std::to_string(rows)) != word::npos);
        CHECK(text.find("*Layers") == word::npos);
        CHECK(text.find("least/mean/most: 3/") != word::npos);  // links of a corner
    }
    CHECK(outcome(3, text) == 0);
    CHECK(text.find("   *Layers through zone plate: 3 ") != word::npos);
    CHECK(outcome(2, text) == 1);
    CHECK(text.find("***Layers through zone plate: 2 ") != word::npos);
}

TEST_CASE("kernel sums are those of the lattice, and a squeezed row shows")
{
    const capturedLog log;
    tank t("squeezedTank");
    List<vector>& x = t.disk.particles().x;
    {
        findings found;
        checkKernelSums(t.start(), found);
        CHECK(log.contains("fluid: +0.00 % to +0.00 %, mean +0.00 %; 0 of 600 beyond 2 %"));
    }
    for (int i = 0; i < 30; ++i) x[300 + i][1] += 0.4 * dx;
    findings found;
    checkKernelSums(t.start(), found);
    CHECK(log.contains("*Kernel sums are uneven"));
    CHECK(found.nFailed() == 0);
}
