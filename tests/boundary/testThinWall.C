// SPDX-License-Identifier: GPL-3.0-or-later
// Walls thinner than the kernel support: which particles see each other across a sheet, past its rim, through a closed
// plate and through the wall of a tube.
#include <doctest/doctest.h>
#include "scene.H"

#include <algorithm>

using namespace scene;

namespace
{

constexpr scalar dx = 1, side = 10, support = 2.6;

const char* cyclicSides =
    "xLow { type cyclic; point (0 0 0); separation (10 0 0); }"
    "yLow { type cyclic; point (0 0 0); separation (0 10 0); }"
    "zLow { type cyclic; point (0 0 0); separation (0 0 10); }";

List<vector> jittered(List<vector> points, scalar disorder)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<scalar> shift(-disorder, disorder);
    for (vector& x : points) x += vector(shift(random), shift(random), shift(random));
    return points;
}

bool insideBox(const vector& x)
{
    return x.minCoeff() > 0 && x.maxCoeff() < side;
}

struct seen
{
    folder files;
    particleCloud cloud;
    std::unique_ptr<boundary> walls;
    neighbourList list;

    seen(const List<vector>& points, const triSurface& surface, const word& plate,
         const word& others, const List<vector>& rigid = {})
        : cloud(fluid(points, dx))
    {
        files.surface("plate", surface);
        if (!rigid.empty()) files.points("wallParticles.hdf", {{"plate", rigid}});
        walls = std::make_unique<boundary>(
            files.path, dictionary::fromString(others + "plate { type wall; " + plate + " }"),
            cloud, support);
        walls->setStep(0, 1);
        walls->updateGhosts(cloud);
        list.build(cloud, *smoothingKernel::New("WendlandC2", 3, support / 2),
                   walls->visible(cloud));
    }

    List<label> neighbours(label i) const
    {
        return {list.index.begin() + list.start[i], list.index.begin() + list.start[i + 1]};
    }
    bool isWall(label j) const  // velocities of images in walls do not turn with the position
    {
        if (j < cloud.n()) return false;
        if (cloud.ghostSource(j) < 0) return true;
        const ghostRule& rule = cloud.ruleOf(j);
        return (rule.M.topLeftCorner<3, 3>() - rule.R).norm() > 1e-9;
    }
};

// The sheet z = 5, 2.1 < x < 6.8, endless in y
const triSurface sheetAcross = sheet({2.1, 0, 5}, {4.7, 0, 0}, {0, 10, 0}, 3);

bool sheetParts(const vector& a, const vector& b)
{
    if ((a[2] < 5) == (b[2] < 5)) return false;
    const scalar x = a[0] + (5 - a[2]) / (b[2] - a[2]) * (b[0] - a[0]);
    return x > 2.1 && x < 6.8;
}

// True if the segment meets the box
bool boxParts(const vector& a, const vector& b, const vector& low, const vector& high)
{
    scalar from = 0, to = 1;
    for (int d = 0; d < 3; ++d)
    {
        const scalar s = (low[d] - a[d]) / (b[d] - a[d]), t = (high[d] - a[d]) / (b[d] - a[d]);
        from = std::max(from, std::min(s, t)), to = std::min(to, std::max(s, t));
    }
    return from < to;
}

}  // namespace

TEST_CASE("on a lattice every place beside a sheet and its rims is filled exactly once")
{
    const List<vector> points = lattice(dx, vector::Zero(), {side, side, side}, insideBox);
    label full = 0;
    for (const vector& x : lattice(dx, {-4, -4, -4}, {4, 4, 4}, [](const vector&) { return true; }))
        full += (x - vector(0.5, 0.5, 0.5)).norm() < support;
    for (const char* kind : {"mirror", "particles"})
    {
        const seen s(points, sheetAcross, "twoSided yes; representation " + word(kind) + ";",
                     cyclicSides);
        label across = 0;
        for (label i = 0; i < s.cloud.n(); ++i)
        {
            const List<label> near = s.neighbours(i);
            REQUIRE(label(near.size()) == full - 1);
            for (const label j : near)
            {
                const vector cell = s.cloud.x[j].xyz() - vector(0.5, 0.5, 0.5);
                REQUIRE((cell.array() - cell.array().round()).abs().maxCoeff() < 1e-9);
                across += s.isWall(j);
                if (word(kind) == "particles" && s.isWall(j))
                    REQUIRE(s.cloud.phase[j] == phaseType::rigid);
            }
        }
        CHECK(across > 1000);
    }
}

TEST_CASE("fluid sees fluid past the rim of a sheet and not through it, images only through it")
{
    const List<vector> points =
        jittered(lattice(dx, vector::Zero(), {side, side, side}, insideBox), 0.3);
    for (const char* kind : {"mirror", "particles"})
    {
        const seen s(points, sheetAcross, "twoSided yes; representation " + word(kind) + ";",
                     cyclicSides);
        label hidden = 0, images = 0;
        for (label i = 0; i < s.cloud.n(); ++i)
        {
            List<char> listed(s.cloud.nAll(), 0);
            for (const label j : s.neighbours(i)) listed[j] = 1;
            const vector x = s.cloud.x[i].xyz();
            for (label j = 0; j < s.cloud.nAll(); ++j)
            {
                const vector y = s.cloud.x[j].xyz();
                if (j == i || (y - x).norm() >= support) continue;
                const bool parted = sheetParts(x, y);
                hidden += parted && !s.isWall(j), images += parted && s.isWall(j);
                REQUIRE(bool(listed[j]) == (parted == s.isWall(j)));
            }
        }
        CHECK(hidden > 1000);
        CHECK(images > 1000);
    }
}

TEST_CASE("no pair through a closed plate of one spacing, whatever stands for it")
{
    const vector low(2, -20, 5), high(7, 20, 6);
    const auto outside = [&](const vector& x) {
        return insideBox(x) && ((x - low).minCoeff() < 0 || (high - x).minCoeff() < 0);
    };
    const auto within = [&](const vector& x) {
        return (x - low).minCoeff() > 0 && (high - x).minCoeff() > 0 && insideBox(x);
    };
    const List<vector> points =
        jittered(lattice(dx, vector::Zero(), {side, side, side}, outside), 0.2);
    // open at the cyclic sides, where it continues
    triSurface plate;
    plate.addPatch("sheet");
    const triSurface closed = box({2, 0, 5}, {7, 10, 6});
    for (label t = 0; t < closed.size(); ++t)
        if (std::abs(closed.normal(t)[1]) < 0.5)
            plate.add(closed.corner(t, 0), closed.corner(t, 2), closed.corner(t, 1), 0);
    // true if the segment passes from one large face to the other; through an edge fluid may see fluid
    const auto through = [](const vector& a, const vector& b) {
        if ((a[2] - 5.5) * (b[2] - 5.5) > 0) return false;
        const vector t = (b - a) / (b[2] - a[2]);
        const scalar x5 = (a + (5 - a[2]) * t)[0], x6 = (a + (6 - a[2]) * t)[0];
        return std::min(a[2], b[2]) < 5 && std::max(a[2], b[2]) > 6 && std::min(x5, x6) > 2 &&
               std::max(x5, x6) < 7;
    };
    for (const char* kind : {"mirror", "particles"})
    {
        const seen s(points, plate, "representation " + word(kind) + ";", cyclicSides,
                     lattice(dx, vector::Zero(), {side, side, side}, within));
        label hidden = 0, seenWalls = 0;
        for (label i = 0; i < s.cloud.n(); ++i)
        {
            List<char> listed(s.cloud.nAll(), 0);
            for (const label j : s.neighbours(i)) listed[j] = 1, seenWalls += s.isWall(j);
            const vector x = s.cloud.x[i].xyz();
            for (label j = 0; j < s.cloud.nAll(); ++j)
            {
                const vector y = s.cloud.x[j].xyz();
                if (j == i || s.isWall(j) || (y - x).norm() >= support) continue;
                const bool parted = through(x, y);
                hidden += parted;
                if (parted || !boxParts(x, y, low, high)) REQUIRE(bool(listed[j]) == !parted);
            }
            for (const label j : s.neighbours(i))
                if (s.isWall(j)) REQUIRE(boxParts(x, s.cloud.x[j].xyz(), low, high));
        }
        CHECK(hidden > 500);
        CHECK(seenWalls > 1000);
    }
}

TEST_CASE(
    "a tube of one spacing parts inside from outside, also beyond symmetry planes, up to its lip")
{
    constexpr scalar inner = 4, outer = 5, lip = 6;
    const auto face = [](scalar r0, scalar r1, scalar z0, scalar z1, scalar sign) {
        const bool annulus = z0 == z1;
        return parametric(
            [=](scalar s, scalar t) {
                const scalar r = r0 + t * (r1 - r0), z = z0 + t * (z1 - z0);
                return vector(r * std::cos(0.5 * M_PI * s), r * std::sin(0.5 * M_PI * s), z);
            },
            24, 4,
            [=](const vector& x) -> vector {
                if (annulus) return {0, 0, sign};
                return sign * vector(x[0], x[1], 0);
            });
    };
    triSurface tube = face(inner, inner, -3, lip, 1);
    tube.append(face(outer, outer, -3, lip, -1));
    tube.append(face(inner, outer, lip, lip, -1));
    const auto radius = [](const vector& x) { return std::hypot(x[0], x[1]); };
    const auto inTube = [&](const vector& x) {
        return radius(x) > inner && radius(x) < outer && x[2] < lip;
    };
    const auto quarter = [](const vector& x) { return x.minCoeff() > 0; };
    const List<vector> points =
        jittered(lattice(dx, vector::Zero(), {9, 9, 9},
                         [&](const vector& x) {
                             const bool near = radius(x) > inner - 0.3 && radius(x) < outer + 0.3;
                             return quarter(x) && !(near && x[2] < lip + 0.3);
                         }),
                 0.2);
    const List<vector> rigid = lattice(dx, vector::Zero(), {9, 9, 9},
                                       [&](const vector& x) { return quarter(x) && inTube(x); });
    for (const char* kind : {"mirror", "particles"})
    {
        const seen s(points, tube, "representation " + word(kind) + ";",
                     "x0 { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
                     "y0 { type symmetryPlane; point (0 0 0); normal (0 -1 0); }",
                     rigid);
        label close = 0, overLip = 0, images = 0, beyondPlanes = 0;
        for (label i = 0; i < s.cloud.n(); ++i)
        {
            const vector x = s.cloud.x[i].xyz();
            const bool isInner = radius(x) < inner;
            if (x[2] > lip) continue;
            for (const label j : s.neighbours(i))
            {
                const vector y = s.cloud.x[j].xyz();
                images += s.isWall(j);
                if (s.isWall(j)) continue;
                if (y[2] > lip) ++overLip;
                else REQUIRE(isInner == (radius(y) < inner));
            }
            for (label j = 0; j < s.cloud.nAll(); ++j)
            {
                const vector y = s.cloud.x[j].xyz();
                const bool across = isInner != (radius(y) < inner) && y[2] < lip;
                if (s.isWall(j) || !across || (x - y).norm() > support) continue;
                ++close, beyondPlanes += j >= s.cloud.n();
            }
        }
        CHECK(close > 200);
        CHECK(beyondPlanes > 50);
        CHECK(overLip > 500);
        CHECK(images > 1000);
    }
}

TEST_CASE("the guard keeps particles on their side of a sheet, by small steps and by leaps")
{
    const List<vector> points =
        jittered(lattice(dx, vector::Zero(), {side, side, side}, insideBox), 0.2);
    for (const scalar stride : {0.05, 2.0})
    {
        seen s(points, sheetAcross, "twoSided yes;", cyclicSides);
        std::mt19937 random(3);
        std::uniform_real_distribution<scalar> unit(-1, 1);
        List<scalar> before(s.cloud.n());
        scalar nearest = side;
        label pushed = 0;
        for (int step = 0; step < 40; ++step)
        {
            pushed += s.walls->exchange(s.cloud, step);
            std::map<globalId, vector> from;
            for (label i = 0; i < s.cloud.n(); ++i)
            {
                const vector x = s.cloud.x[i].xyz();
                from[s.cloud.id[i]] = x;
                s.cloud.x[i].setXyz(x + stride * vector(unit(random), unit(random), unit(random)));
                // pressed onto the sheet
                if (stride < 1) s.cloud.x[i][2] += x[2] < 5 ? 0.08 : -0.08;
            }
            pushed += s.walls->exchange(s.cloud, step + 1);
            for (label i = 0; i < s.cloud.n(); ++i)
            {
                const vector a = from[s.cloud.id[i]], b = s.cloud.x[i].xyz();
                if ((a - b).norm() < side - 3 * stride) REQUIRE(!sheetParts(a, b));
                if (b[0] > 2.1 && b[0] < 6.8) nearest = std::min(nearest, std::abs(b[2] - 5));
            }
        }
        CHECK(pushed > 100);
        CHECK(nearest > 0.149 * dx);
    }
}

TEST_CASE(
    "walls are met without rebound: no nearer than the gap, energy falls, the guard has nothing to "
    "do")
{
    const List<vector> points =
        jittered(lattice(dx, vector::Zero(), {side, side, side}, insideBox), 0.2);
    const scalar gap = 0.2 * dx;
    seen s(points, sheet({0, 0, 5}, {side, 0, 0}, {0, side, 0}, 3), "twoSided yes;", cyclicSides);
    s.walls->exchange(s.cloud, 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<scalar> unit(-1, 1);
    const auto any = [&] { return vector(unit(random), unit(random), unit(random)); };
    const auto distance = [](const vector& x) { return std::abs(x[2] - 5); };
    label shifted = 0, slowed = 0;
    for (int step = 1; step < 20; ++step)
    {
        s.walls->setStep(step - 1, step);
        List<vector> from, u, to;
        for (label i = 0; i < s.cloud.n(); ++i)
        {
            vector shift = 0.05 * dx * any();
            from.push_back(s.cloud.x[i].xyz()), u.push_back(0.5 * dx * any()),
                to.push_back(from[i] + shift);
            s.walls->limitShift(s.cloud, i, gap, shift);
            s.cloud.x[i].setXyz(from[i] + shift), s.cloud.Up[i].setXyz(u[i]);
        }
        s.walls->limitApproach(s.cloud, gap, 1);
        for (label i = 0; i < s.cloud.n(); ++i)
        {
            const vector x = s.cloud.x[i].xyz(), now = s.cloud.Up[i].xyz(), end = x + now;
            shifted += (x - to[i]).norm() > 0, slowed += (now - u[i]).norm() > 0;
            CHECK(now.norm() <= u[i].norm() + 1e-15);
            const scalar before = std::min(distance(from[i]), gap);
            CHECK(distance(x) >= before - 1e-12);
            CHECK(distance(end) >= before - 1e-12);
            CHECK((from[i][2] < 5) == (end[2] < 5));
            // along the wall nothing changes
            CHECK((now - u[i]).head<2>().norm() < 1e-12);
            if (distance(to[i]) > gap + 0.5 * dx) CHECK(now == u[i]);
        }
        for (label i = 0; i < s.cloud.n(); ++i)
            s.cloud.x[i].setXyz(s.cloud.x[i].xyz() + s.cloud.Up[i].xyz());
        CHECK(s.walls->exchange(s.cloud, step) == 0);
        s.walls->updateGhosts(s.cloud);
    }
    CHECK(shifted > 20);
    CHECK(slowed > 100);
}
