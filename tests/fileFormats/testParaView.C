// SPDX-License-Identifier: GPL-3.0-or-later
// ParaView itself opens the files.  Skipped if pvbatch or xvfb-run is not installed.
#include "particleTable.H"
#include "scratchFolder.H"

#include <doctest/doctest.h>
#include <cstdlib>

using namespace ispf;

TEST_CASE("ParaView opens the series with its times, particles and columns")
{
    if (std::system("command -v pvbatch xvfb-run > /dev/null 2>&1") != 0)
    {
        MESSAGE("skipped: pvbatch and xvfb-run are not installed (bin/installDependencies docs)");
        return;
    }
    const scratchFolder folder("paraview");
    List<seriesEntry> entries;
    for (const int n : {10, 12, 14})
    {
        particleTable table;
        for (int i = 0; i < n; ++i) table.x.emplace_back(i, 0, 1);
        table.scalars["p"].assign(size_t(n), n + 1.0 / 3);
        table.vectors["U"].assign(size_t(n), vector(3, 0, 4));
        table.integers["id"].assign(size_t(n), (globalId(1) << 40) + n);
        const word file = std::to_string(n) + "/particles.hdf";
        writeParticles(table, folder / file);
        entries.push_back({n == 10 ? 0 : 0.025 * n, file});
    }
    writeSeries(folder / "case.hdf.series", entries);

    const word command = "xvfb-run -a pvbatch tests/fileFormats/readSeries.py '" +
                         (folder / "case.hdf.series") + "' > '" + (folder / "out") + "' 2> '" +
                         (folder / "errors") + "'";

    CHECK(std::system(command.c_str()) == 0);
    INFO(contentOf(folder / "errors"));
    CHECK(contentOf(folder / "out") ==
          "0 10 10 U 5 id 1099511627786 p 10.333333333333334\n"
          "0.30000000000000004 12 12 U 5 id 1099511627788 p 12.333333333333334\n"
          "0.35000000000000003 14 14 U 5 id 1099511627790 p 14.333333333333334\n");
}
