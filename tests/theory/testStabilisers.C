// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.H"
#include "textTable.H"

#include <doctest/doctest.h>

#include <cmath>

using namespace theory;

namespace
{

struct row
{
    spectrum s;
    projectionErrors e[2];
};

row measured(textTable& table, shape kind, const candidate& c, stabiliser form)
{
    row r;
    for (int k = 0; k < 2; ++k)
    {
        const scene s(kind, 20 << k, 1 + k);
        const operatorPair pair = c.build(s);
        const matrix M = pressureOperator(s, pair, form);
        r.e[k] = project(s, pair, M);
        if (k == 0) r.s = spectrumOf(s, pair, M);
    }
    table.add("%-9s %-16s %-9s %8.0e %8.0e %7.3f %6.3f | %6.4f %6.4f | %6.4f %6.4f | %7.4f %7.4f\n",
              name(kind).c_str(), c.name.c_str(), name(form).c_str(), r.s.least, r.s.leastStep,
              r.s.from, r.s.to, r.e[0].p, r.e[1].p, r.e[0].u, r.e[1].u, r.e[0].loss, r.e[1].loss);
    return r;
}

void checkFaces(textTable& table, shape kind, const candidate& c)
{
    const row classic = measured(table, kind, c, stabiliser::classic),
              bounded = measured(table, kind, c, stabiliser::bounded),
              half = measured(table, kind, c, stabiliser::half),
              remainder = measured(table, kind, c, stabiliser::remainder),
              quarter = measured(table, kind, c, stabiliser::quarter);
    for (const row* r : {&bounded, &remainder, &quarter}) CHECK(r->s.least > -1e-12);
    for (const row* r : {&classic, &half}) CHECK(r->s.least < -1e-5);
    CHECK(half.s.leastStep > -1e-12);
    CHECK(remainder.s.from > 0.65);
    CHECK(remainder.s.to < (kind == shape::periodic ? 1.1 : 2));
    CHECK(quarter.s.from > 0.2);
    CHECK(remainder.e[1].p < 0.5 * remainder.e[0].p);
    CHECK(remainder.e[1].loss < 0.02 * bounded.e[1].loss);
    CHECK(quarter.e[1].loss < 0.3 * remainder.e[1].loss);
}

}  // namespace

TEST_CASE("table of candidates: stabiliser")
{
    textTable table;
    table.add(
        "\nStabilisers; n = 20, projection and loss at 20, 40\n%-9s %-16s %-9s %8s %8s %14s | "
        "%-13s | %-13s | "
        "%-15s\n",
        "scene", "pair", "form", "min -C", "2M-GtG", "M against L", "error of p", "error of u",
        "loss");
    for (const shape kind : shapes)
    {
        CAPTURE(name(kind));
        candidate today = candidates()[0];
        const row r = measured(table, kind, today, stabiliser::classic);
        if (kind != shape::periodic) CHECK(r.s.least < -1e-3);
        checkFaces(table, kind, sweptFaces());
        CHECK(measured(table, kind, fitted(5e-3, 20), stabiliser::remainder).s.least > -1e-12);
    }
}

TEST_CASE(
    "the remainder form passes linear p where G is exact, and is of fourth order on a lattice")
{
    const scene s(shape::box, 20);
    const operatorPair exact = oneSidedPair(s);
    const matrix S = pressureOperator(s, exact, stabiliser::remainder) - exact.GtG();
    field p(s.size());
    for (int i = 0; i < s.size(); ++i) p[i] = s.x[i].dot(vec2(2, -1));
    CHECK(std::abs(p.dot(S * p)) < 1e-14 * p.dot(compactLaplacian(s) * p));

    double loss[2];
    for (int k = 0; k < 2; ++k)
    {
        const scene lattice(shape::periodic, 20 << k, 1, 0, 0);
        const operatorPair pair = sweptFaces().build(lattice);
        loss[k] =
            project(lattice, pair, pressureOperator(lattice, pair, stabiliser::remainder)).loss;
    }
    CHECK(std::log2(loss[0] / loss[1]) == doctest::Approx(4).epsilon(0.05));
}
