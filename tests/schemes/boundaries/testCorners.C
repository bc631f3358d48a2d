// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of patch meets every other kind at the corner of a box with four decaying vortices.  If the sides are free of
// friction, the flow decays as Taylor and Green's.  Otherwise no hole, jet or lost particle may appear at the corner
#include "core/errorOf.H"
#include "boxCase.H"
#include "relative.H"
#include "widestGap.H"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar U = 0.05;
constexpr int n = 16;

struct kindOfPatch
{
    word name, left, bottom, opposite;
    bool open() const { return left.find("type open") == 0; }
    bool drives() const { return name == "sliding wall" || name == "inlet" || name == "piston"; }
    bool given() const { return name == "inlet" || name == "piston"; }
    bool isFree() const { return name == "slip wall" || name == "symmetry" || name == "cyclic"; }
};

const word slip = "type wall; slip yes;";
const List<kindOfPatch> kinds = {
    {"particles", "type wall;", "type wall;", slip},
    {"mirror", "type wall; representation mirror;", "type wall; representation mirror;", slip},
    {"slip wall", slip, slip, slip},
    {"sliding wall", "type wall; velocity (0 0.05 0);", "type wall; velocity (0.05 0 0);", slip},
    {"symmetry", "type symmetryPlane;", "type symmetryPlane;", "type symmetryPlane;"},
    {"open", "type open; p 0;", "type open; p 0;", slip},
    {"inlet", "type open; velocity 0.05;", "type open; velocity 0.05;", "type open; p 0;"},
    {"piston", "type wall; motion { velocity (0.01 0 0); }",
     "type wall; motion { velocity (0 0.01 0); }", "type open; p 0;"},
    {"cyclic", "type cyclic;", "type cyclic;", ""}};

struct vortices : runningBox
{
    scalar side, k = 2 * M_PI / side;
    label atStart = c.cloud.n();

    explicit vortices(const boxCase& b) : runningBox(b, "corner"), side(b.length())
    {
        for (label i = 0; i < c.cloud.n(); ++i)
        {
            const vector x = k * c.cloud.x[i].xyz();
            c.cloud.Up[i].setXyz(
                U * vector(std::sin(x[0]) * std::cos(x[1]), -std::cos(x[0]) * std::sin(x[1]), 0));
        }
    }

    scalar energy() const  // over that of the vortices at the start
    {
        scalar e = 0;
        for (label i = 0; i < c.cloud.n(); ++i)
            if (const vector x = c.cloud.x[i].xyz(); x.minCoeff() > -1e-9 && x.maxCoeff() < side)
                e += c.cloud.Up[i].xyz().squaredNorm();
        return e / (0.5 * U * U * n * n);
    }
    scalar fastest() const
    {
        scalar most = 0;
        for (label i = 0; i < c.cloud.n(); ++i) most = std::max(most, c.cloud.Up[i].xyz().norm());
        return most / U;
    }
    scalar gap()
    {
        List<vector> points;
        for (int j = 0; j <= 4 * n; ++j)
            for (int i = 0; i <= 4 * n; ++i)
                if (const vector x(i * side / 64, j * side / 64, 0); c.walls->inside(x))
                    points.push_back(x);
        return widestGap(c, points);
    }
    label unexplained() const
    {
        label made = 0;
        for (const patchBalance& b : c.walls->balance()) made += b.created - b.deleted;
        return c.cloud.n() - atStart - made;
    }
};

boxCase cornerOf(const kindOfPatch& a, const kindOfPatch& b, const word& coupling)
{
    boxCase box;
    box.nx = box.ny = n, box.mu = 0.05, box.coupling = coupling;
    // planes against none: to 1e-4 after a decay by 80
    box.solution = "closure { tolerance 1e-10; }";
    box.patch = {a.left, a.opposite, b.bottom, b.opposite};
    return box;
}

}  // namespace

TEST_CASE("corners between all kinds of patches")
{
    for (const char* coupling : {"projection", "monolithic"})
    {
        const scalar dt = 2.5e-3, nu = 5e-5, k = 2 * M_PI / (n * 1e-3);
        scalar unbounded = 0;  // cyclic both ways: no boundary at all
        for (auto a = kinds.rbegin(); a != kinds.rend(); ++a)
            for (auto b = a; b != kinds.rend(); ++b)
            {
                if (a->given() && b->given()) continue;
                CAPTURE(coupling);
                CAPTURE(a->name);
                CAPTURE(b->name);
                boxCase box = cornerOf(*a, *b, coupling);
                vortices v(box);
                scalar fastest = 0;
                for (int s = 0; s < 12; ++s) v.run(dt, 5), fastest = std::max(fastest, v.fastest());
                const scalar e = v.energy();
                CHECK(v.unexplained() == 0);
                CHECK(v.gap() < 1.25);
                CHECK(fastest < (a->name == "inlet" || b->name == "inlet" ? 2.1 : 1.2));
                if (a->name == "cyclic" && b->name == "cyclic")
                {
                    unbounded = e;
                    CHECK(std::log(e) == relative(-4 * nu * k * k * v.time.value(), 0.1));
                }
                else if (a->isFree() && b->isFree())
                {
                    // planes are no boundary; a wall element takes p of the particle, exact to first order in dx
                    const bool walls = a->name == "slip wall" || b->name == "slip wall";
                    CHECK(e == relative(unbounded, walls ? 1e-2 : 1e-4));
                }
                else if (!a->drives() && !b->drives() && !a->open() && !b->open())
                    CHECK(e < 0.8 * unbounded);  // a wall that holds the fluid takes more out
            }
    }
}

TEST_CASE("what meets at a corner and cannot: two inlets against each other, an inlet and a piston")
{
    const auto refused = [](const word& left, const word& bottom) {
        boxCase box = cornerOf(kinds[0], kinds[0], "projection");
        box.patch = {left, "type open; p 0;", bottom, "type open; p 0;"};
        try
        {
            runningBox r(box, "corner");
        }
        catch (const fatalError& e)
        {
            return word(e.what());
        }
        return word();
    };
    const word inlet = "type open; velocity 0.05;";
    CHECK(refused(inlet, inlet).find("The faces left and bottom meet") != word::npos);
    CHECK(refused(inlet, "type wall; motion { velocity (0 0.01 0); }")
              .find("Wall bottom moves, and ends at the face left") != word::npos);
    CHECK(refused(inlet, "type wall; velocity (0.05 0 0);") == "");
    const word oblique = "type open; velocity (0.05 0.02 0);";
    CHECK(refused(oblique, oblique) == "");
}

TEST_CASE(
    "one face takes out what another, that it meets, brings in; once both bring in, it is refused")
{
    for (const char* coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box = cornerOf(kinds[0], kinds[0], coupling);
        box.patch = {"type open; velocity 0.05;", "type open; p 0; backflow 0;",
                     "type open; velocity table ((0 -0.02) (0.1 -0.02) (0.11 0.02) (0.3 0.02) "
                     "(0.31 -0.02));",
                     "type wall; slip yes;"};
        runningBox r(box, "suction");
        r.run(2.5e-3, 40);
        scalar in = 0, out = 0;
        for (const patchBalance& b : r.c.walls->balance())
            (b.name == "left" ? in : out) += b.volume;
        CHECK(out == relative(-in, 0.03));
        CHECK_ERROR(r.run(2.5e-3, 4), "both bring fluid in", 0);
    }
}

TEST_CASE("a uniform stream across a box that is open on all sides")
{
    for (const char* coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box = cornerOf(kinds[0], kinds[0], coupling);
        const word oblique = "type open; velocity (0.05 0.02 0);",
                   out = "type open; p 0; backflow 0;";
        box.patch = {oblique, out, oblique, out}, box.velocity = {U, 0.4 * U, 0};
        runningBox r(box, "stream");
        scalar worst = 0;
        for (int s = 0; s < 12; ++s)
        {
            r.run(2.5e-3, 10);
            for (label i = 0; i < r.c.cloud.n();
                 ++i)  // what has just been made beyond a face is at rest
                if (!r.c.cloud.beyondOpen(i) && r.c.walls->inside(r.c.cloud.x[i].xyz()))
                    worst = std::max(worst, (r.c.cloud.Up[i].xyz() - box.velocity).norm());
        }
        CHECK(worst < 0.12 * U);
    }
}

TEST_CASE("a particle with nothing around it is counted in the log")
{
    for (const char* coupling : {"projection", "monolithic"})
        for (const bool stray : {true, false})
        {
            boxCase box = cornerOf(kinds[0], kinds[0], coupling);
            if (stray) box.besides = {5e-3, 60e-3, 0};
            box.patch[boxCase::top] = "type open; p 0;";
            runningBox r(box, "stray");
            r.run(2.5e-3, 3);
            r.c.walls->printBalance(r.c.cloud);
            CHECK(r.log.contains(stray ? "; strays 1 without" : "; strays 0 without"));
        }
}

TEST_CASE("a piston that runs along an open face takes its strip away")
{
    for (const char* coupling : {"projection", "monolithic"})
    {
        CAPTURE(coupling);
        boxCase box = cornerOf(kinds[0], kinds[0], coupling);
        const word open = "type open; p 0;";
        box.patch = {open, slip, "type wall; motion { velocity (0 0.04 0); }", open};
        runningBox r(box, "piston");
        r.run(2.5e-3, 60);  // 6 dx
        const List<patchBalance>& books = r.c.walls->balance();
        scalar closest = 1;
        label strip = 0;
        for (label i = 0; i < r.c.cloud.n(); ++i)
        {
            if (r.c.cloud.x[i][0] > 0 || r.c.cloud.x[i][1] > box.height()) continue;
            ++strip;
            for (label j = 0; j < i; ++j)
                closest = std::min(closest,
                                   (r.c.cloud.x[i].xyz() - r.c.cloud.x[j].xyz()).norm() / box.dx);
        }
        CHECK(strip < 30);  // 2 layers of 10
        CHECK(closest > 0.4);
        CHECK(books[0].created < 10);  // behind it none
    }
}
