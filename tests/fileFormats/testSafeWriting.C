// SPDX-License-Identifier: GPL-3.0-or-later
#include "fileNames.H"
#include "particleTable.H"
#include "scratchFolder.H"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <csignal>

using namespace ispf;

namespace
{

// Limits the size of files of this process to `bytes`: writing then fails as on a full disk
class fileSizeLimit
{
public:
    explicit fileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limited{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limited);
    }
    ~fileSizeLimit()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    void (*handler_)(int);
    rlimit before_{};
};

}  // namespace

TEST_CASE("a full disk is an error and leaves the earlier file untouched")
{
    const scratchFolder folder("full");
    const word path = folder / "a.hdf";
    particleTable table;
    table.x.assign(100, vector::Ones());
    writeParticles(table, path);
    const word before = contentOf(path);

    table.x.assign(10000, vector::Ones());
    {
        const fileSizeLimit limit(50000);
        CHECK_THROWS_WITH_AS(writeParticles(table, path), doctest::Contains("Free some space"),
                             fatalError);
    }
    CHECK(contentOf(path) == before);
    CHECK(folder.nFiles() == 1);
    writeParticles(table, path);
    CHECK(readParticles(path).size() == 10000);
}

TEST_CASE("an unwritable folder is an error that names it")
{
    const scratchFolder folder("unwritable");
    setContent(folder / "file", "not a folder");
    CHECK_THROWS_WITH_AS(writeText(folder / "file/a.hdf", "x"), doctest::Contains("file/a.hdf"),
                         fatalError);
    CHECK_THROWS_AS(writeText("/proc/none/a.hdf", "x"), fatalError);
    CHECK(contentOf(folder / "file") == "not a folder");
}

TEST_CASE("the series lists every time in full precision")
{
    const scratchFolder folder("series");
    const word path = folder / "case.hdf.series";
    writeSeries(path, {{0, "0/particles.hdf"}, {0.1 + 0.2, "0.3/parti\"cles.hdf"}});
    CHECK(contentOf(path) ==
          "{\n"
          "  \"file-series-version\" : \"1.0\",\n"
          "  \"files\" : [\n"
          "    { \"name\" : \"0.3/parti\\\"cles.hdf\", \"time\" : 0.30000000000000004 },\n"
          "    { \"name\" : \"0/particles.hdf\", \"time\" : 0 }\n"
          "  ]\n"
          "}\n");
    writeSeries(path, {});
    CHECK(contentOf(path) == "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n  ]\n}\n");
    CHECK_THROWS_AS(writeSeries(path, {{std::nan(""), "x"}}), fatalError);
    CHECK(folder.nFiles() == 1);
}
