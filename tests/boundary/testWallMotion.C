// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of a wall, with its entries written in each possible way
#include "core/errorOf.H"
#include "scene.H"
#include "wallMotion.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

wallMotion motionOf(const word& text)
{
    return wallMotion(dictionary::fromString(text), "");
}

vector middleOf(const wallMotion& m, scalar t0, scalar t1)
{
    return m.velocity(t0, t1).at(vector(0.3, 0.2, 0.1));
}

}  // namespace

TEST_CASE("a displacement: along a direction, as a vector, steadily")
{
    for (const char* text :
         {"motion { direction (0 3 4); displacement table ((0 0) (2 0.5)); }",
          "motion { displacement table ((0 (0 0 0)) (2 (0 0.3 0.4))); }",
          "motion { displacement { type scale; scale table ((0 0) (2 1)); value (0 0.3 0.4); } }",
          "motion { velocity (0 0.15 0.2); }"})
    {
        CAPTURE(text);
        const wallMotion m = motionOf(text);
        CHECK((m.frame(1).t - vector(0, 0.15, 0.2)).norm() < 1e-15);
        CHECK((middleOf(m, 0.5, 0.75) - vector(0, 0.15, 0.2)).norm() < 1e-14);
        CHECK(m.moves());
        CHECK(!m.slides());
        CHECK(!m.inPlane());
    }
    CHECK(motionOf("motion { velocity (1 1 0); }").inPlane());
    CHECK_ERROR(motionOf("motion { displacement 0.1; }"), "a vector (x y z)", 1);
    CHECK_ERROR(motionOf("motion { direction (0 0 1); }"), "motion wants 'direction'", 1);
}

TEST_CASE("a wall that slides: steadily, over time, by its size")
{
    for (const char* text :
         {"velocity constant (0.3 0.4 0);", "velocity table ((0 (0 0 0)) (1 (0.6 0.8 0)));",
          "velocity { type sine; frequency 0.5; amplitude (0.3 0.4 0); }",
          "velocity { direction (3 4 0); speed table ((0 0) (1 1)); }"})
    {
        CAPTURE(text);
        const wallMotion m = motionOf(text);
        CHECK((middleOf(m, 0.4, 0.6) - vector(0.3, 0.4, 0)).norm() < 1e-15);
        CHECK(m.slides());
        CHECK(m.frame(1).t.isZero(0));
        CHECK(m.slidesWithin(vector(0, 0, 1)));
        CHECK(!m.slidesWithin(vector(0, 1, 0)));
    }
    // each part of the function counts, also where its present value is zero
    const wallMotion turns = motionOf("velocity table ((0 (1 0 0)) (1 (0 0 1)));");
    CHECK(!turns.slidesWithin(vector(0, 0, 1)));
    CHECK(turns.slidesWithin(vector(0, 1, 0)));
    CHECK(!turns.inPlane());
    CHECK(!motionOf("velocity (0 0 0);").slides());
    CHECK_ERROR(motionOf("velocity fast;"), "'velocity' is a function of time: a vector", 1);
}
