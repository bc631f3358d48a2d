// SPDX-License-Identifier: GPL-3.0-or-later
#include "guardedProcess.H"

#include <doctest/doctest.h>
#include <csignal>
#include <cstdlib>
#include <unistd.h>

using namespace ispf;

namespace
{

using job = std::function<void(packer&)>;

unpacker run(const job& body, const processLimits& limits = {})
{
    return runGuarded("the job", limits, [&](packer& out, const grantTime&) { body(out); });
}
word errorOf(const std::function<void()>& body)
{
    try
    {
        body();
    }
    catch (const fatalError& error)
    {
        return error.what();
    }
    return "no error";
}
word errorOfJob(const job& body, const processLimits& limits = {})
{
    return errorOf([&] { run(body, limits); });
}

}  // namespace

TEST_CASE("a guarded job hands over what it packs, however much")
{
    List<scalar> numbers(100000);
    for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.1 * scalar(i);
    auto in = run([&](packer& out) {
        out.put(7), out.putList(numbers), out.putWords({"a", "", "b c"}), out.putList(List<int>());
    });
    CHECK(in.get<int>() == 7);
    CHECK(in.getList<scalar>() == numbers);
    CHECK(in.getWords() == List<word>{"a", "", "b c"});
    CHECK(in.getList<int>().empty());
    CHECK(errorOf([&] { in.get<char>(); }).find("end too early") != word::npos);
    run([](packer&) {});  // nothing
}

TEST_CASE("lengths beyond the bytes ask for no memory")
{
    const word bytes(8, '\x7f');
    CHECK(errorOf([&] { unpacker(bytes).getList<scalar>(); }).find("end too early") != word::npos);
    CHECK(errorOf([&] { unpacker(bytes).getWord(); }).find("end too early") != word::npos);
    CHECK(errorOf([&] { unpacker(bytes).getWords(); }).find("end too early") != word::npos);
}

TEST_CASE("a guarded job's own error arrives as it is, others with its name")
{
    const auto throwing = [](const auto& error) {
        return [=](packer& out) { out.put(1), throw error; };
    };
    CHECK(errorOfJob(throwing(fatalError("line 3 is wrong"))) == "line 3 is wrong");
    CHECK(errorOfJob(throwing(std::runtime_error("odd"))) == "the job: odd");
    CHECK(errorOfJob(throwing(word("as gmsh"))) == "the job: as gmsh");
    CHECK(errorOfJob(throwing(std::bad_alloc())) == "the job: out of memory");
}

TEST_CASE("a guarded job may crash, leave or hang")
{
    processLimits limits;
    limits.ifEnded = " Do this.";
    const auto has = [](const word& text, const word& part) {
        return text.find(part) != word::npos;
    };
    word error = errorOfJob([](packer&) { std::raise(SIGSEGV); }, limits);
    CHECK(has(error, "the job was ended by the signal Segmentation fault after"));
    CHECK(has(error, "s. Do this. It said nothing."));
    error = errorOfJob([](packer&) {
        if (::write(STDERR_FILENO, "last words\n", 11) == 11) std::abort();
    });
    CHECK(has(error, "Aborted"));
    CHECK(has(error, "The last it said:\nlast words"));
    error = errorOfJob([](packer& out) { out.put(1), ::_exit(0); });
    CHECK(has(error, "the job ended its process with status 0"));

    limits.cpuSeconds = 1;
    volatile bool forever = true;
    error = errorOfJob(
        [&](packer&) {
            while (forever) {}
        },
        limits);
    CHECK(has(error, "the job found no end after"));
    limits = {};
    limits.seconds = 0.2, limits.ifTooLong = " Wait longer.";
    error = errorOfJob(
        [&](packer&) {
            while (forever) ::usleep(1000);
        },
        limits);
    CHECK(has(error, "the job did not finish within 0.2 s and was stopped. Wait longer."));
    limits.seconds = 1;
    CHECK(runGuarded("the job", limits, [](packer& out, const grantTime& grant) {
              grant(60), ::usleep(1200000), out.put(1);
          }).get<int>() == 1);
}

#ifndef __SANITIZE_ADDRESS__
TEST_CASE("a guarded job has so much memory")
{
    processLimits limits;
    limits.memory = size_t(64) << 20;
    const auto take = [](size_t n) {
        return [=](packer& out) { out.put(List<char>(n << 20, 'x').back()); };
    };
    CHECK(run(take(16), limits).get<char>() == 'x');
    CHECK(errorOfJob(take(256), limits) == "the job: out of memory");
}
#endif
