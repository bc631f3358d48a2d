// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's passes over the solid's force within a step, doc/theory 7.7, on a thick ring that its inner fluid inflates
#include "elasticRing.H"

#include <doctest/doctest.h>
#include <regex>

using namespace ispf;
using namespace ispf::elasticRing;

namespace
{

const word rubber = "structureModel totalLagrangian; material { type neoHookean; G 1e3; }";
const word springs = "structureModel springNetwork; G 1e3; links radius; radius 2.1;";
// the residual of the linear system does not hide that of the force
const word exact = "tolerance 1e-12; absTolerance 1e-14; ";

struct inflation
{
    List<vec4> x, Up;
    word log;

    // Adds a fifth to the inner area within 0.1 s
    inflation(const word& structure, const word& monolithic, int steps,
              const word& scheme = "Euler")
    {
        constexpr scalar duration = 0.1;
        ringCase ring("newton", structure);
        setContent(ring.files.path() + "/system/sphSolution",
                   "coupling monolithic; monolithic { " + monolithic + " }");
        setContent(ring.files.path() + "/system/sphSchemes", "ddtScheme " + scheme + ";");
        capturedLog text;
        Time time(ring.files.path());
        fsiCase c(time);
        const auto coupling = couplingScheme::New(c);
        for (int step = 0; step < steps; ++step)
        {
            addArea(c, 0.2 * M_PI / duration);
            runSteps(c, *coupling, duration / steps, 1);
        }
        x.assign(c.cloud.x.begin(), c.cloud.x.begin() + c.cloud.nSolid());
        Up.assign(c.cloud.Up.begin(), c.cloud.Up.begin() + c.cloud.n());
        log = text.text();
    }

    // Residuals of the passes, step by step
    List<List<scalar>> residuals() const
    {
        static const std::regex line("Newton: pass ([0-9]+), residual ([-+.e0-9]+) m/s");
        List<List<scalar>> all;
        for (std::sregex_iterator m(log.begin(), log.end(), line), end; m != end; ++m)
        {
            if ((*m)[1] == "1") all.emplace_back();
            all.back().push_back(std::stod((*m)[2]));
        }
        return all;
    }
};

bool sameBits(const List<vec4>& a, const List<vec4>& b)
{
    for (size_t i = 0; i < a.size(); ++i)
        for (int k = 0; k < 4; ++k)
            if (a[i][k] != b[i][k]) return false;
    return a.size() == b.size();
}

scalar distance(const inflation& a, const inflation& b)
{
    scalar most = 0;
    for (size_t i = 0; i < a.x.size(); ++i)
        most = std::max(most, (a.x[i].xyz() - b.x[i].xyz()).norm());
    return most / dx;
}

}  // namespace

TEST_CASE("each pass squares the residual, with any structure and either time scheme")
{
    for (const word& structure : {rubber, springs})
        for (const word scheme : {"Euler", "DLN"})
        {
            CAPTURE(structure);
            CAPTURE(scheme);
            const inflation run(structure, exact + "newton { maxIter 8; tolerance 1e-12; }", 4,
                                scheme);
            const List<List<scalar>> steps = run.residuals();
            REQUIRE(steps.size() >= 4);
            for (const List<scalar>& r : steps)
            {
                REQUIRE(r.size() >= 2);
                CHECK(r.size() <= 5);
                CHECK(r[1] < 5e-3 * r[0]);
                // below 1e-12 m/s it is rounding
                for (size_t k = 2; k < r.size(); ++k)
                    CHECK(r[k] < std::max(1e-12, r[k - 1] * std::pow(r[k - 1] / r[k - 2], 1.4)));
            }
        }
}

TEST_CASE("one pass is the step without the entry, bit for bit, and tells nothing")
{
    const inflation none(rubber, "", 4), one(rubber, "newton { maxIter 1; }", 4);
    CHECK(sameBits(none.x, one.x));
    CHECK(sameBits(none.Up, one.Up));
    CHECK(one.log.find("Newton") == word::npos);
}

TEST_CASE("passes change the less the shorter the steps are")
{
    const word several = "newton { maxIter 5; tolerance 1e-9; }";
    scalar before = 0;
    for (const int steps : {4, 16})
    {
        const scalar change =
            distance(inflation(rubber, exact, steps), inflation(rubber, exact + several, steps));
        MESSAGE("steps ", steps, ": passes change the solid's places by ", change, " dx");
        CHECK(change > 0);
        CHECK(change < 0.01);
        if (before > 0) CHECK(change < 0.35 * before);
        before = change;
    }
}

TEST_CASE("passes without a solid are refused")
{
    caseOnDisk files("newtonWithout");
    files.fill(6, 6, 1e-3);
    files.solution = "coupling monolithic; monolithic { newton { maxIter 2; } }";
    files.write();
    word error;
    try
    {
        capturedLog log;
        Time time(files.path());
        fsiCase c(time);
        couplingScheme::New(c);
    }
    catch (const fatalError& e)
    {
        error = e.what();
    }
    CHECK(error.find("It acts on a solid") != word::npos);
}
