// SPDX-License-Identifier: GPL-3.0-or-later
#include "closedBox.H"
#include "densityFeedback.H"
#include "relative.H"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace ispf;

namespace
{

constexpr scalar dt = 0.1;

// A pipe of 60 by 15 particles between walls, dx = 1, open at both ends: beyond each end are four columns with given
// pressure.  With two zones the front zone is a third of the pipe
struct openPipe
{
    static constexpr int length = 60, width = 15, strip = 4;
    particleCloud cloud;
    std::unique_ptr<smoothingKernel> kernel = smoothingKernel::New("WendlandC2", 2, 1.3);
    neighbourList list;
    kernelCorrection B;
    adjointPair pair;

    explicit openPipe(scalar disorder, int zones = 1)
    {
        cloud.nDims = 2, cloud.dx = 1;
        cloud.zones = {{"front", phaseType::fluid, false}};
        if (zones == 2) cloud.zones.push_back({"rear", phaseType::fluid, false});
        for (int j = 0; j < width; ++j)
            for (int i = -strip; i < length + strip; ++i)
            {
                const vec4 u = vec4::from({i % 2 ? 0.5 : 1, 0.2, 0});
                cloud.append({i + 0.5, j + 0.5, 0}, std::uint8_t(zones == 2 && 3 * i >= length), u,
                             cloud.nextId());
            }
        for (label i = 0; i < cloud.n(); ++i)
            cloud.pFixed[i] = cloud.x[i][0] < 0 || cloud.x[i][0] > length;
        displace(disorder, 3);
    }

    // Displaces the particles further, at random
    void displace(scalar disorder, unsigned seed)
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<scalar> shift(-disorder, disorder);
        for (label i = 0; i < cloud.n(); ++i)
            for (int d : {0, 1}) cloud.x[i][d] += shift(random);
        build();
    }

    void remove(const List<char>& gone) { cloud.remove(gone), build(); }

    // Every 90th particle before the faces: ten
    void removeTen()
    {
        List<char> gone(cloud.n(), 0);
        label n = 0;
        for (label i = 0; i < cloud.n(); ++i)
            if (!cloud.pFixed[i]) gone[i] = n++ % 90 == 50;
        remove(gone);
    }

    label nBetween() const
    {
        return label(std::count(cloud.pFixed.begin(), cloud.pFixed.end(), 0));
    }

private:
    void build()
    {
        cloud.clearGhosts();
        for (int i = -strip; i < length + strip; ++i)
        {
            for (const int j : {-3, -2, -1, width, width + 1, width + 2})
                cloud.addRigid({i + 0.5, j + 0.5, 0}, vector::Zero());
            for (const int top : {0, 1})
                cloud.surface.push_back({{i + 0.5, scalar(top * width), 0},
                                         {0, 2.0 * top - 1, 0},
                                         vector::Zero(),
                                         true});
        }
        cloud.stripArea = {vector::Zero(), {-width, 0, 0}, {width, 0, 0}};
        cloud.strip.assign(cloud.n(), 0);
        for (label i = 0; i < cloud.n(); ++i)
            if (cloud.pFixed[i]) cloud.strip[i] = cloud.x[i][0] < 0 ? 1 : 2;
        list.build(cloud, *kernel), B.build(cloud, list);
        pair.setup(cloud, list, *kernel, medium::fluid(cloud, list, B));
    }
};

// Means over the particles with isOf(i): e of their cells, w at C = 1, and the change of e that has no effect
struct meanOf
{
    scalar e, w, band;

    scalar sure(scalar change) const { return change - std::clamp(change, -band, band); }

    template <class IsOf>
    meanOf(const openPipe& p, const IsOf& isOf)
    {
        scalar room = 0, speed = 0, left = 1e9, right = -1e9;
        label n = 0;
        for (label i = 0; i < p.cloud.n(); ++i)
            if (isOf(i))
            {
                room += p.pair.cell(i), speed += p.cloud.Up[i].xyz().norm(), ++n;
                left = std::min(left, p.cloud.x[i][0]), right = std::max(right, p.cloud.x[i][0]);
            }
        e = 1 - room / n, w = speed / n * 4 / (right - left);
        band = 0.03 * p.cloud.dx / (right - left);
    }
    explicit meanOf(const openPipe& p) : meanOf(p, [&](label i) { return !p.cloud.pFixed[i]; }) {}
};

List<scalar> sourceOf(openPipe& p, densityFeedback& feedback, const List<char>& drained,
                      List<scalar> given)
{
    feedback.addTo(given, p.pair, drained, dt);
    return given;
}

List<scalar> sourceOf(openPipe& p, densityFeedback& feedback)
{
    return sourceOf(p, feedback, List<char>(p.cloud.n(), 1), List<scalar>(p.cloud.n(), 0));
}

densityFeedback with(const word& solution, const particleCloud& cloud)
{
    return {dictionary::fromString(solution), cloud};
}

// One step of (3.15)
scalar next(scalar q, scalar w, scalar change)
{
    return q + (1 - std::exp(-4 * w * dt)) * (w * change - q);
}

// The first step of a run, of zero length: it stores the state
void begin(openPipe& p)
{
    densityFeedback feedback = with("densityFeedback 1;", p.cloud);
    List<scalar> q(p.cloud.n(), 0);
    feedback.addTo(q, p.pair, List<char>(p.cloud.n(), 1), 0);
    feedback.book(p.cloud, 0);
}

// A disordered pipe that has lost ten particles since its start
struct emptied : openPipe
{
    const scalar start;  // e
    meanOf now;
    scalar lost() const { return now.e - start; }

    explicit emptied(scalar disorder = 0.1)
        : openPipe(disorder), start(meanOf(*this).e), now(emptying(*this))
    {
    }

private:
    static meanOf emptying(openPipe& p)
    {
        begin(p), p.removeTen();
        return meanOf(p);
    }
};

}  // namespace

TEST_CASE("the cells of fluid between walls fill the room, whatever is missing")
{
    for (const int nDims : {2, 3})
        for (const sides kind : {sides::walls, sides::reentrant})
        {
            const int n = nDims == 2 ? 30 : 10;
            closedBox box(nDims, n, 0.1, kind, 3, [](surfaceElement&) {});
            particleCloud& cloud = box.cloud;
            const label whole = cloud.n();
            const List<vec4> rigid(cloud.x.begin() + whole, cloud.x.end());
            const List<surfaceElement> surface = cloud.surface;
            List<char> gone(whole, 0);
            for (label i = 45; i < whole; i += 90) gone[i] = 1;
            cloud.remove(gone);
            for (const vec4& x : rigid) cloud.addRigid(x.xyz(), vector::Zero());
            cloud.surface = surface;
            box.list.build(cloud, *box.kernel), box.B.build(cloud, box.list);
            adjointPair pair;
            pair.setup(cloud, box.list, *box.kernel, medium::fluid(cloud, box.list, box.B));
            scalar room = 0, worst = 0;
            for (label i = 0; i < cloud.n(); ++i)
            {
                scalar cell = pair.walls().moment[i].trace();
                for (auto k = box.list.start[i]; k < box.list.mid[i]; ++k)
                    cell += pair.face(k).dot(cloud.x[box.list.index[k]].xyz() - cloud.x[i].xyz());
                worst = std::max(worst, std::abs(pair.cell(i) - cell / nDims));
                room += pair.cell(i);
            }
            CHECK(worst < 1e-12);
            CHECK(cloud.n() < whole - 5);
            CHECK(room / whole == relative(1, 3e-4));
        }
}

TEST_CASE("density feedback: none at the start, next to none of disorder that comes later")
{
    for (const scalar disorder : {0.0, 0.05, 0.2})
    {
        CAPTURE(disorder);
        openPipe p(disorder);
        REQUIRE(p.nBetween() == 900);
        densityFeedback feedback = with("densityFeedback 1;", p.cloud);
        CHECK(sourceOf(p, feedback) == List<scalar>(p.cloud.n(), 0));
        begin(p);
        for (const unsigned seed : {4, 5, 6})
        {
            openPipe other(0);
            other.displace(0.2, seed), other.cloud.state = p.cloud.state;
            densityFeedback goesOn = with("densityFeedback 1;", other.cloud);
            // one particle more or less is 0.0011
            CHECK(std::abs(sourceOf(other, goesOn)[9]) < 0.0025 * next(0, meanOf(other).w, 1));
        }
    }
}

TEST_CASE("density feedback: fluid flows in where particles are missing, critically damped")
{
    for (const scalar disorder : {0.0, 0.1})
    {
        emptied p(disorder);
        CHECK(p.lost() == relative(-10.0 / 890, 0.1));
        densityFeedback feedback = with("densityFeedback 1;", p.cloud);
        scalar q = 0;
        for (int step = 0; step < 800; ++step)
        {
            const List<scalar> now = sourceOf(p, feedback);
            q = next(q, p.now.w, p.now.sure(p.lost()));
            for (label i = 0; i < p.cloud.n(); ++i)
                if (p.cloud.pFixed[i]) REQUIRE(now[i] == 0);
                else REQUIRE(now[i] == relative(q, 1e-12));
            feedback.book(p.cloud, dt);
        }
        CHECK(q < 0);
        CHECK(q == relative(p.now.w * p.now.sure(p.lost()), 1e-5));
    }
}

TEST_CASE("density feedback: its constant is the rate")
{
    emptied p;
    densityFeedback half = with("densityFeedback 0.5;", p.cloud);
    CHECK(sourceOf(p, half)[9] == relative(next(0, 0.5 * p.now.w, p.now.sure(p.lost())), 1e-12));
    CHECK(half.on());
    densityFeedback none = with("densityFeedback 0;", p.cloud);
    CHECK(!none.on());
    CHECK(sourceOf(p, none)[9] == 0);
    p.cloud.state = {};
    none.book(p.cloud, dt);
    CHECK(p.cloud.state.values().empty());
}

TEST_CASE("density feedback: none if closed, with a source of its own, or at rest")
{
    emptied p;
    densityFeedback feedback = with("densityFeedback 1;", p.cloud);
    const label n = p.cloud.n();
    const List<scalar> nothing(n, 0), given(n, 0.3);
    CHECK(sourceOf(p, feedback)[9] < 0);
    CHECK(sourceOf(p, feedback, List<char>(n, 0), nothing) == nothing);
    CHECK(sourceOf(p, feedback, List<char>(n, 1), given) == given);

    // an eighth of the pipe has a source, another eighth is not drained: both do not count
    List<char> drained(n, 1);
    List<scalar> some(n, 0);
    const auto of = [&](label i) { return int(p.cloud.x[i][0] + 10) % 8; };
    for (label i = 0; i < n; ++i) some[i] = of(i) == 1 ? 0.3 : 0, drained[i] = of(i) != 2;
    const auto counts = [&](label i) { return !p.cloud.pFixed[i] && of(i) != 1 && of(i) != 2; };
    const meanOf rest(p, counts);
    CHECK(std::abs(rest.e / p.now.e - 1) > 0.01);
    const List<scalar> q = sourceOf(p, feedback, drained, some);
    for (label i = 0; i < n; ++i)
        if (counts(i))
            REQUIRE(q[i] == relative(next(0, rest.w, rest.sure(rest.e - p.start)), 1e-12));
        else REQUIRE(q[i] == some[i]);

    for (vec4& u : p.cloud.Up) u = vec4{};
    CHECK(sourceOf(p, feedback) == nothing);
}

TEST_CASE("density feedback: fluid that is closed at first begins when it is drained")
{
    openPipe p(0.1);
    densityFeedback feedback = with("densityFeedback 1;", p.cloud);
    sourceOf(p, feedback, List<char>(p.cloud.n(), 0), List<scalar>(p.cloud.n(), 0));
    feedback.book(p.cloud, dt);
    p.removeTen();
    CHECK(sourceOf(p, feedback)[9] == 0);
    feedback.book(p.cloud, dt);
    p.removeTen();
    CHECK(sourceOf(p, feedback)[9] < 0);
}

TEST_CASE("density feedback: each zone has its own source")
{
    openPipe p(0.1, 2);
    const auto between = [&](int zone) {
        return meanOf(p, [&](label i) { return !p.cloud.pFixed[i] && p.cloud.zone[i] == zone; });
    };
    const scalar start[2] = {between(0).e, between(1).e};
    begin(p);
    List<char> gone(p.cloud.n(), 0);
    for (label i = 0; i < p.cloud.n(); ++i)
        gone[i] = !p.cloud.pFixed[i] && p.cloud.zone[i] == 1 && i % 37 == 5;
    p.remove(gone);
    const meanOf part[2] = {between(0), between(1)};
    const scalar lost[2] = {part[0].e - start[0], part[1].e - start[1]};
    CHECK(std::abs(lost[0]) < 0.005);
    CHECK(lost[1] < -0.02);
    densityFeedback feedback = with("densityFeedback 1;", p.cloud);
    scalar q[2] = {0, 0};
    for (int step = 0; step < 3; ++step)
    {
        const List<scalar> now = sourceOf(p, feedback);
        for (const int z : {0, 1}) q[z] = next(q[z], part[z].w, part[z].sure(lost[z]));
        for (label i = 0; i < p.cloud.n(); ++i)
            if (const scalar own = q[p.cloud.zone[i]]; !p.cloud.pFixed[i])
                REQUIRE(std::abs(now[i] - own) <= 1e-12 * std::abs(own) + 1e-20);
        feedback.book(p.cloud, dt);
    }
}

TEST_CASE("density feedback: only accepted steps count, and a restart goes on from the state")
{
    emptied p;
    densityFeedback first = with("densityFeedback 1;", p.cloud);
    const List<scalar> once = sourceOf(p, first);
    CHECK(sourceOf(p, first) == once);  // the step is done again
    first.book(p.cloud, dt);
    const List<scalar> twice = sourceOf(p, first);
    CHECK(twice[9] < 1.3 * once[9]);  // it grows
    densityFeedback again = with("densityFeedback 1;", p.cloud);
    CHECK(sourceOf(p, again) == twice);
    p.cloud.state = {};
    CHECK(sourceOf(p, again)[9] == 0);  // another start
}

TEST_CASE("density feedback books what it has put in")
{
    emptied p;
    densityFeedback feedback = with("densityFeedback 1;", p.cloud);
    scalar sum = 0;
    for (const scalar step : {0.25, 0.5})
    {
        for (const scalar q : sourceOf(p, feedback)) sum += step * q * p.cloud.volume();
        feedback.book(p.cloud, step);
    }
    CHECK(sum < 0);
    CHECK(p.cloud.state.get(entries::fluidFeedback, 0) == relative(sum, 1e-12));
}
