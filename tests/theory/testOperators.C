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
    shape kind;
    candidate c;
    balances b;
    errors e[3];
    double closure = 0, linear = 0;

    double order(double errors::*what) const { return std::log2(e[1].*what / (e[2].*what)); }
};

row measured(shape kind, const candidate& c)
{
    const scene s(kind, 20);
    row r{kind, c, balancesOf(s, c.build(s)), {}};
    for (int k = 0; k < 3; ++k)
    {
        const scene finer(kind, 20 << k, 1 + k);
        r.e[k] = errorsOf(finer, c.build(finer));
    }
    if (c.direct) return r;
    const faceVectors f(s, c.options);
    r.closure = f.closure(), r.linear = f.linear();
    return r;
}

void print(textTable& table, const row& r)
{
    table.add("%-9s %-16s %7.0e %7.0e %7.0e %7.0e %7.0e ", name(r.kind).c_str(), r.c.name.c_str(),
              r.b.adjointness, r.b.momentum, r.b.flux, r.b.uniformForce, r.b.uniformLoad);
    if (r.c.direct) table.add("%7s %6s", "-", "-");
    else table.add("%7.0e %6.3f", r.closure, r.linear);
    table.add(" | %6.4f %6.4f %6.4f %5.2f", r.e[0].G, r.e[1].G, r.e[2].G, r.order(&errors::G));
    table.add(" | %6.4f %6.4f %6.4f %5.2f\n", r.e[0].D, r.e[1].D, r.e[2].D, r.order(&errors::D));
}

void check(const row& r)
{
    CAPTURE(name(r.kind) + ", " + r.c.name);
    if (r.c.adjoint) CHECK(r.b.adjointness < 1e-14);
    else CHECK(r.b.adjointness > 1e-4);
    if (!r.c.closed) return;
    CHECK(r.b.momentum < 1e-12);
    CHECK(r.b.flux < 1e-14);
    CHECK(r.b.uniformForce < 1e-14);
    CHECK(r.b.uniformLoad < 1e-14);
    CHECK(r.closure < 1e-12);
}

const row& find(const std::vector<row>& rows, shape kind, const std::string& name)
{
    for (const row& r : rows)
        if (r.kind == kind && r.c.name == name) return r;
    FAIL("no such candidate: " << name);
    return rows[0];
}

}  // namespace

TEST_CASE("table of candidates: gradient and divergence")
{
    textTable table;
    table.add(
        "\nPairs of gradient and divergence; n = 20 across, smooth fields at 20, 40, 80 (order "
        "from the "
        "last two)\n%-9s %-16s %7s %7s %7s %7s %7s %7s %6s | %-26s | %-26s\n",
        "scene", "pair", "adjoint", "moment.", "flux", "G 1", "load", "closure", "linear",
        "error of G, order", "error of D, order");
    std::vector<row> rows;
    for (const shape kind : shapes)
        for (const candidate& c : candidates())
        {
            rows.push_back(measured(kind, c));
            print(table, rows.back());
            check(rows.back());
        }
    for (const shape kind : shapes)
    {
        CAPTURE(name(kind));
        const row &swept = find(rows, kind, "faces 3/1"), &often = find(rows, kind, "faces 3/6"),
                  &fit = find(rows, kind, "faces fitted 20"),
                  &exact = find(rows, kind, "faces fitted 200");
        CHECK(often.e[2].G < 0.75 * swept.e[2].G);
        CHECK(fit.e[2].G < 0.8 * often.e[2].G);
        CHECK(fit.e[2].D < 0.7 * swept.e[2].D);
        CHECK(exact.order(&errors::G) > 0.65);
        if (kind == shape::periodic) continue;
        CHECK(swept.e[2].GAtWall < 0.5 * find(rows, kind, "faces 3/1, p_i").e[2].GAtWall);
        // not closed, or not in balance at the wall: an error of order 0 or worse
        CHECK(find(rows, kind, "symmetric, open").order(&errors::D) < -0.5);
        CHECK(find(rows, kind, "plain adjoint").order(&errors::G) < -0.5);
    }
}
