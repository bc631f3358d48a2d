// SPDX-License-Identifier: GPL-3.0-or-later
// Seeds and former findings of `make fuzz`, and a few thousand mutations of them, which are always the same.
// ISPF_MUTATIONS=n in the environment sets their number per reader
#include "fileNames.H"
#include "targets.H"

#include <doctest/doctest.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>

using namespace ispf;

namespace
{

using target = std::function<void(const word&)>;

List<word> seedsOf(const word& name)
{
    const auto here = std::filesystem::path(__FILE__).parent_path() / "seeds" / name;
    List<word> paths;
    for (const auto& file : std::filesystem::directory_iterator(here))
        paths.push_back(file.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

// Makes one to four changes: a byte is replaced, a piece is removed, doubled or moved
word mutated(word text, std::mt19937& random)
{
    const auto below = [&](size_t n) { return size_t(random()) % std::max<size_t>(1, n); };
    for (size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes)
    {
        const size_t from = below(text.size()), n = 1 + below(std::min<size_t>(64, text.size()));
        switch (below(4))
        {
            case 0:
                text[from] = char(below(256));
                break;
            case 1:
                text.erase(from, n);
                break;
            case 2:
                text.insert(below(text.size()), text.substr(from, n));
                break;
            case 3:
                text.resize(from);
                break;
        }
    }
    return text;
}

// Hides the warnings of the readers
struct quietStderr
{
    int kept = ::dup(STDERR_FILENO);
    quietStderr() { REQUIRE(std::freopen("/dev/null", "w", stderr)); }
    ~quietStderr() { ::dup2(kept, STDERR_FILENO), ::close(kept); }
};

void replay(const word& name, const target& run, size_t mutations)
{
    const quietStderr quiet;
    const List<word> paths = seedsOf(name);
    REQUIRE(paths.size() > 3);
    if (const char* asked = std::getenv("ISPF_MUTATIONS"))
        mutations = std::strtoul(asked, nullptr, 10) / paths.size() + 1;
    std::mt19937 random(1);
    for (const word& path : paths)
    {
        const word seed = readText(path);
        CAPTURE(path);
        CHECK_NOTHROW(run(seed));
        for (size_t k = 0; k < mutations; ++k) CHECK_NOTHROW(run(mutated(seed, random)));
    }
}

}  // namespace

TEST_CASE("any bytes end in a result or a fatalError: dictionaries")
{
    replay("dictionary", fuzz::dictionary, 1000);
}
TEST_CASE("any bytes end in a result or a fatalError: csv and list files")
{
    replay("csv", fuzz::csv, 1000);
}
TEST_CASE("any bytes end in a result or a fatalError: STL")
{
    replay("stl", fuzz::stl, 1000);
}
TEST_CASE("any bytes end in a result or a fatalError: HDF5")
{
    replay("hdf5", fuzz::hdf5, 200);
}
TEST_CASE("any bytes end in a result or a fatalError: damaged HDF5")
{
    replay("hdf5Damaged", fuzz::hdf5Damaged, 20);
}
