// SPDX-License-Identifier: GPL-3.0-or-later
// For energy, momentum and extrema of shifted flows see testAdjointPair.C
#include "approachLimit.H"
#include "core/errorOf.H"
#include "particleShifting.H"
#include "periodicBox.H"
#include "relative.H"

#include <doctest/doctest.h>

using namespace ispf;

namespace
{

constexpr scalar noLimit = 1e30;

// A disordered box with a flow, seen by an observer who moves at -drift
periodicBox disordered(const vector& drift = vector::Zero())
{
    periodicBox box(2, 12, 0.2, "WendlandC2", 1.3);
    for (label i = 0; i < box.cloud.n(); ++i)
    {
        const vector x = 2 * M_PI * box.cloud.x[i].xyz();
        box.cloud.Up[i] = vec4::from(vector(std::sin(x[1]), std::sin(x[0]), 0) + drift);
    }
    box.update();
    return box;
}

scalar shift(particleCloud& cloud, const neighbourList& list, const kernelCorrection& B,
             const word& entries, const std::function<void(label, vector&)>& confine = nullptr)
{
    const particleShifting shifting(dictionary::fromString(entries));
    return shifting.shift(cloud, list, B, 0.01, noLimit, confine);
}

// Places of the particles after shifting
List<vec4> shifted(const word& entries, const word& frame, const vector& drift)
{
    periodicBox box = disordered(drift);
    const particleShifting shifting(dictionary::fromString(entries), frame);
    shifting.shift(box.cloud, box.list, box.B, 0.01, noLimit, nullptr);
    return {box.cloud.x.begin(), box.cloud.x.begin() + box.cloud.n()};
}

scalar difference(const List<vec4>& a, const List<vec4>& b)
{
    scalar most = 0;
    for (size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i].xyz() - b[i].xyz()).norm());
    return most;
}

enum class below
{
    nothing,
    solid,
    rigid
};

// A lattice of fluid above three rows of another phase; sides and top are free
struct column
{
    static constexpr scalar dx = 0.1;
    particleCloud cloud;
    neighbourList list;
    kernelCorrection B;

    explicit column(below what)
    {
        cloud.nDims = 2, cloud.dx = dx;
        cloud.zones = {{"solid", phaseType::solid, false}, {"fluid", phaseType::fluid, false}};
        const auto at = [](int i, int j) -> vector { return dx * vector(i + 0.5, j + 0.5, 0); };
        const vec4 moves = vec4::from({0, 1, 0});
        for (int j = -3; j < 8; ++j)
            for (int i = 0; i < 13; ++i)
                if (j >= 0) cloud.append(at(i, j), 1, moves, cloud.nextId());
                else if (what == below::solid) cloud.append(at(i, j), 0, moves, cloud.nextId());
        for (int j = -3; j < 0 && what == below::rigid; ++j)
            for (int i = 0; i < 13; ++i) cloud.addRigid(at(i, j), vector::Zero());
        list.build(cloud, *smoothingKernel::New("WendlandC2", 2, 1.3 * dx));
        B.build(cloud, list);
    }
    label lowest() const { return cloud.nSolid() + 6; }  // fluid, in the middle of its row
};

}  // namespace

TEST_CASE("by the speed against the mean, shifting is the same for every observer")
{
    const vector drift(3, -1, 0);
    const word given = "maxShift 0.2;";
    const List<vec4> still = shifted(given, "mean", vector::Zero());
    CHECK(difference(still, shifted(given, "mean", drift)) < 1e-14);
    CHECK(difference(still, shifted(given + "frame mean;", "still", drift)) < 1e-14);
    const List<vec4> byAll = shifted(given, "still", vector::Zero());
    CHECK(difference(still, byAll) < 3e-4);  // the flow's own mean is nearly zero
    CHECK(difference(byAll, shifted(given, "still", drift)) > 1e-3);
    CHECK(difference(shifted(given + "frame still;", "mean", drift),
                     shifted(given, "still", drift)) == 0);
}

TEST_CASE(
    "walls and solids are neighbours: fluid stays away from them, and they stay where they are")
{
    for (const word entries : {"closing 0;", "constant 0;"})
        for (const below what : {below::nothing, below::solid, below::rigid})
        {
            CAPTURE(entries);
            CAPTURE(int(what));
            column c(what);
            const List<vec4> x = c.cloud.x, Up = c.cloud.Up;
            shift(c.cloud, c.list, c.B, entries);
            const label i = c.lowest();
            const scalar down = x[i][1] - c.cloud.x[i][1];
            if (what == below::nothing) CHECK(down > 0.01 * column::dx);
            else CHECK(std::abs(down) < 1e-12 * column::dx);
            label moved = 0;
            for (label k = 0; k < c.cloud.nAll(); ++k)
            {
                const bool stays = difference({x[k], Up[k]}, {c.cloud.x[k], c.cloud.Up[k]}) == 0;
                moved += !stays;
                if (k < c.cloud.nSolid() || k >= c.cloud.n()) CHECK(stays);
            }
            CHECK(moved > 20);
        }
}

TEST_CASE("a particle moves by maxShift at most, and not at all if it is to be left alone")
{
    for (const scalar most : {0.05, 0.02})
    {
        periodicBox box = disordered();
        const List<vec4> x = box.cloud.x, Up = box.cloud.Up;
        const auto leftAlone = [](label i) { return i % 3 == 0; };
        const auto confine = [&](label i, vector& dr) {
            if (leftAlone(i)) dr.setZero();
        };
        shift(box.cloud, box.list, box.B, "constant 1; maxShift " + str(most) + ";", confine);
        scalar way = 0;
        for (label i = 0; i < box.cloud.n(); ++i)
            if (leftAlone(i))
                CHECK(difference({x[i], Up[i]}, {box.cloud.x[i], box.cloud.Up[i]}) == 0);
            else way = std::max(way, (box.cloud.x[i].xyz() - x[i].xyz()).norm() / box.cloud.dx);
        CHECK(way == doctest::Approx(most).epsilon(1e-12));
    }
    CHECK(difference(
              shifted("", "still", vector::Zero()),
              shifted("constant 0.2; closing 0.7; maxShift 0.05;", "still", vector::Zero())) == 0);
}

TEST_CASE("in a linear flow a particle takes over the velocity of its new place")
{
    Eigen::Matrix<scalar, 4, 3> A = Eigen::Matrix<scalar, 4, 3>::Zero();
    A.topLeftCorner<2, 2>() << 1.5, -2, 0.5, -3;
    periodicBox box(2, 12, 0.2, "WendlandC2", 1.3);
    particleCloud& cloud = box.cloud;
    box.jump = A;
    for (label i = 0; i < cloud.n(); ++i)
        cloud.Up[i] = vec4::from((A * cloud.x[i].xyz()).head<3>());
    box.update();
    // with walls nothing has to keep the momentum
    cloud.surface.push_back({{9, 9, 0}, {1, 0, 0}, {0, 0, 0}, true});
    const List<vec4> x = cloud.x;
    shift(cloud, box.list, box.B, "");
    scalar way = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        CHECK((cloud.Up[i].xyz() - (A * cloud.x[i].xyz()).head<3>()).norm() < 1e-12);
        way = std::max(way, (cloud.x[i].xyz() - x[i].xyz()).norm());
    }
    CHECK(way > 0.01 * cloud.dx);
}

TEST_CASE(
    "pairs that would meet exchange momentum: none is lost, energy falls, the others do not notice")
{
    // pairs farther apart than two such ways change nothing
    periodicBox far(2, 12, 0.05, "WendlandC2", 1.3);
    for (label i = 0; i < far.cloud.n(); ++i) far.cloud.Up[i] = vec4::from({0.1, 0, 0});
    List<vec4> toSolid;
    CHECK(limitApproach(far.cloud, far.list, 0.4 * far.cloud.dx, 0.4 * far.cloud.dx, far.cloud.dx,
                        toSolid) == 0);

    for (const int nDims : {2, 3})
        for (const label held : {-1, 11})
        {
            CAPTURE(nDims);
            CAPTURE(held);
            const scalar dt = nDims == 2 ? 0.4 : 0.1;
            periodicBox box(nDims, nDims == 2 ? 20 : 8, 0.7, "WendlandC2", 1.3);
            particleCloud& cloud = box.cloud;
            const scalar closest = 0.4 * cloud.dx, step = dt * cloud.dx;
            std::mt19937 random(7);
            std::uniform_real_distribution<scalar> any(-1, 1);
            for (label i = 0; i < cloud.n(); ++i)
                cloud.Up[i] =
                    vec4::from({any(random), any(random), nDims == 3 ? any(random) : 0}, 5);
            if (held >= 0) cloud.uFixed[held] = 1;
            box.update();
            const List<vec4> before = cloud.Up;
            const auto worst = [&] {
                cloud.fillGhosts(cloud.Up, false);
                scalar most = 0;
                for (label i = 0; i < cloud.n(); ++i)
                    for (std::int64_t k = box.list.start[i]; k < box.list.start[i + 1]; ++k)
                    {
                        const label j = box.list.index[k];
                        const vector d = cloud.x[i].xyz() - cloud.x[j].xyz();
                        const scalar way =
                            -step * d.normalized().dot(cloud.Up[i].xyz() - cloud.Up[j].xyz());
                        most = std::max(most, way - std::max(d.norm() - closest, scalar(0)));
                    }
                return most / cloud.dx;
            };
            CHECK(worst() > 0.5 * dt);
            const label exchanges = limitApproach(cloud, box.list, closest, closest, step, toSolid);
            CHECK(exchanges > 10);
            CHECK(worst() < 0.05 * dt);  // five sweeps
            vector momentum = vector::Zero();
            scalar gained = 0;
            label changed = 0;
            for (label i = 0; i < cloud.n(); ++i)
            {
                momentum += cloud.Up[i].xyz() - before[i].xyz();
                gained += cloud.Up[i].xyz().squaredNorm() - before[i].xyz().squaredNorm();
                changed += difference({before[i]}, {cloud.Up[i]}) > 0;
                CHECK(cloud.Up[i][3] == before[i][3]);
            }
            CHECK(gained < -0.01);
            CHECK(changed < 0.9 * cloud.n());
            if (held < 0) CHECK(momentum.norm() < 1e-12);
            else CHECK(difference({before[held]}, {cloud.Up[held]}) == 0);
        }
}

TEST_CASE(
    "fluid that is crowded against a solid is not shifted into it and does not go through between "
    "two of "
    "its particles")
{
    column c(below::solid);
    const scalar dx = column::dx, dt = 0.01, least = 0.75;
    const label i = c.lowest();
    // before the gap between two of the first row, with another that presses it in
    c.cloud.x[i] = vec4::from(dx * vector(7, 0.04, 0));
    c.cloud.x[i + 13] = vec4::from(dx * vector(7, 0.5, 0));
    c.list.build(c.cloud, *smoothingKernel::New("WendlandC2", 2, 1.3 * dx));
    c.B.build(c.cloud, c.list);
    const auto fromRow = [&](scalar x) {
        return (c.cloud.x[i].xyz() - dx * vector(x, -0.5, 0)).norm();
    };
    const vec4 start = c.cloud.x[i];
    const scalar left = fromRow(6.5), right = fromRow(7.5);
    for (const word entries : {"closest 0;", ""})
    {
        c.cloud.x[i] = start;
        shift(c.cloud, c.list, c.B, entries);
        const scalar nearer = std::min(fromRow(6.5) - left, fromRow(7.5) - right);
        CHECK((nearer > -1e-12 * dx) == entries.empty());
    }

    for (label k = 0; k < c.cloud.n(); ++k) c.cloud.Up[k] = vec4{};
    for (const scalar solid : {0.4, least})
    {
        c.cloud.x[i] = vec4::from(dx * vector(7, 0.2, 0));
        c.cloud.Up[i] = vec4::from(vector(0, -0.4 * dx / dt, 0));
        c.list.build(c.cloud, *smoothingKernel::New("WendlandC2", 2, 1.3 * dx));
        List<vec4> toSolid;
        limitApproach(c.cloud, c.list, 0.4 * dx, solid * dx, dt, toSolid);
        const scalar end = c.cloud.x[i][1] + dt * c.cloud.Up[i][1];
        if (solid < least) CHECK(end == doctest::Approx(-0.2 * dx));
        else CHECK(end > (std::sqrt(least * least - 0.25) - 0.5 - 0.05) * dx);
    }
}

TEST_CASE(
    "fluid that meets a solid gives it momentum for the time after the step: springs are not "
    "stretched by it")
{
    particleCloud cloud;
    cloud.nDims = 2, cloud.dx = 0.1;
    cloud.zones = {{"solid", phaseType::solid, false}, {"fluid", phaseType::fluid, false}};
    std::mt19937 random(7);
    std::uniform_real_distribution<scalar> any(-1, 1);
    for (const int zone : {0, 1})
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i)
                if ((i < 6) == (zone == 0))
                    cloud.append(
                        0.1 * vector(i + 0.5 + 0.4 * any(random), j + 0.5 + 0.4 * any(random), 0),
                        zone, vec4::from({any(random), any(random), 0}), cloud.nextId());
    cloud.uFixed[3] = 1;
    const auto kernel = smoothingKernel::New("WendlandC2", 2, 0.13);
    neighbourList list;
    list.build(cloud, *kernel);
    const List<vec4> before = cloud.Up;
    List<vec4> toSolid;
    CHECK(limitApproach(cloud, list, 0.04, 0.04, 0.04, toSolid) > 10);
    vector momentum = vector::Zero();
    scalar gained = 0, given = 0;
    for (label i = 0; i < cloud.n(); ++i)
    {
        vector u = cloud.Up[i].xyz();
        if (i < cloud.nSolid())
        {
            CHECK(difference({before[i]}, {cloud.Up[i]}) == 0);
            u += toSolid[i].xyz(), given = std::max(given, toSolid[i].xyz().norm());
        }
        momentum += u - before[i].xyz();
        gained += u.squaredNorm() - before[i].xyz().squaredNorm();
    }
    CHECK(given > 0.1);
    CHECK(toSolid[3].xyz().norm() == 0);
    CHECK(momentum.norm() < 1e-12);
    CHECK(gained < -0.01);
}

TEST_CASE("no wave of displacement grows by shifting, however far the fluid goes in the step")
{
    // values from another program
    const auto known = [](int nDims, const word& kernel, scalar hByDx) {
        return shiftStiffness::ofLattice(*smoothingKernel::New(kernel, nDims, 0.1 * hByDx), nDims,
                                         0.1);
    };
    CHECK(known(2, "WendlandC2", 1.3).crowding == relative(28.83, 1e-3));
    CHECK(known(2, "WendlandC2", 1.3).closing == relative(1.61, 5e-3));
    CHECK(known(2, "quintic", 1).closing == relative(1.56, 5e-3));
    CHECK(known(3, "WendlandC2", 1.3).crowding == relative(40.42, 1e-2));

    for (const int nDims : {2, 3})
        for (const bool limited : {false, true})
        {
            CAPTURE(nDims);
            CAPTURE(limited);
            const int n = nDims == 2 ? 16 : 8;
            periodicBox box(nDims, n, 0, "WendlandC2", 1.3);
            particleCloud& cloud = box.cloud;
            const scalar dx = cloud.dx;
            const particleShifting shifting(
                dictionary::fromString(""), "still",
                limited ? known(nDims, "WendlandC2", 1.3) : shiftStiffness());
            // columns move alternately to the left and to the right
            const auto place = [&](label i) { return std::floor(cloud.x[i][0] / dx) + 0.5; };
            const auto side = [&](label i) { return std::lround(place(i) - 0.5) % 2 ? -1 : 1; };
            const auto amplitude = [&] {
                scalar sum = 0;
                for (label i = 0; i < cloud.n(); ++i)
                    sum += side(i) * (cloud.x[i][0] / dx - place(i)) / cloud.n();
                return sum;
            };
            for (label i = 0; i < cloud.n(); ++i)
                cloud.x[i][0] += 1e-3 * side(i) * dx, cloud.Up[i] = vec4::from({1, 0, 0});
            box.update();
            shifting.shift(cloud, box.list, box.B, 0.4 * dx, 0, nullptr);
            const scalar ratio = amplitude() / 1e-3;
            if (limited) CHECK(std::abs(ratio + 0.9) < 0.101);
            else CHECK(ratio < -2);
        }
}

TEST_CASE("shifting that is off, and fluid at rest, move nothing")
{
    for (const word entries : {"type none;", "constant 0; closing 0;"})
    {
        CHECK(!particleShifting(dictionary::fromString(entries)).on());
        CHECK(particleShifting(dictionary::fromString(entries)).describe() == "none");
        periodicBox box = disordered();
        const List<vec4> x = box.cloud.x, Up = box.cloud.Up;
        CHECK(shift(box.cloud, box.list, box.B, entries) == 0);
        CHECK(difference(x, box.cloud.x) == 0);
        CHECK(difference(Up, box.cloud.Up) == 0);
    }
    CHECK(particleShifting(dictionary::fromString("")).on());
    CHECK(particleShifting(dictionary::fromString("frame mean;")).describe() ==
          "Xu, constant 0.2, closing 0.7, at most 0.05 dx, pairs kept 0.4 dx apart, by the speed "
          "against the mean");
    periodicBox rest(2, 12, 0.2, "WendlandC2", 1.3);
    const List<vec4> x = rest.cloud.x;
    CHECK(shift(rest.cloud, rest.list, rest.B, "") == 0);
    CHECK(difference(x, rest.cloud.x) == 0);
}

TEST_CASE("words and numbers that shifting does not know are refused")
{
    const auto given = [](const word& entries) {
        return particleShifting(dictionary::fromString(entries)).on();
    };
    CHECK_ERROR(given("type Lind;"), "Valid", 1);
    CHECK_ERROR(given("frame moving;"), "Valid", 1);
    CHECK_ERROR(given("\nconstant 1.1;"), "constant", 2);
    CHECK_ERROR(given("\nclosing 2.1;"), "closing", 2);
    CHECK_ERROR(given("maxShift 0.3;"), "maxShift", 1);
    CHECK_ERROR(given("closest 1;"), "closest", 1);
    CHECK_ERROR(given("maxShift -0.1;"), "maxShift", 1);
}
