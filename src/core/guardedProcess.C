// SPDX-License-Identifier: GPL-3.0-or-later
#include "guardedProcess.H"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace ispf
{

namespace
{

using seconds = std::chrono::duration<scalar>;

scalar now()
{
    return seconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

[[noreturn]] void cannot(const word& what)
{
    throw fatalError("Cannot " + what + ": " + std::strerror(errno));
}

// In memory, without a name: it is gone with the last process that has it open
class namelessFile
{
public:
    namelessFile() : file_(memfd_create("ispf", MFD_CLOEXEC))
    {
        if (file_ < 0) cannot("create a file in memory");
    }
    namelessFile(const namelessFile&) = delete;
    ~namelessFile() { close(file_); }

    operator int() const { return file_; }

private:
    int file_;
};

enum class outcome : int
{
    none,
    done,
    refused,  // by the job itself, in words for the user
    failed
};

// What both processes see
struct sharedPage
{
    volatile scalar deadline;  // the moment until which the job may run
    volatile outcome result;
};

class sharedMemory
{
public:
    sharedMemory()
        : page_(mmap(nullptr, sizeof(sharedPage), PROT_READ | PROT_WRITE,
                     MAP_SHARED | MAP_ANONYMOUS, -1, 0))
    {
        if (page_ == MAP_FAILED) cannot("share memory with a process");
    }
    sharedMemory(const sharedMemory&) = delete;
    ~sharedMemory() { munmap(page_, sizeof(sharedPage)); }

    sharedPage* operator->() const { return static_cast<sharedPage*>(page_); }

private:
    void* page_;
};

word lastLines(const word& text, int count)
{
    const size_t end = text.find_last_not_of(" \n") + 1;
    size_t from = end;
    for (int n = 0; n < count && from > 0; ++n)
    {
        const size_t before = text.rfind('\n', from - 1);
        from = before == word::npos ? 0 : before;
    }
    from += text[from] == '\n';
    return text.substr(from, end - from);
}

// In place of what the job has handed over
outcome say(int file, const word& text, outcome how)
{
    if (ftruncate(file, 0) != 0 || lseek(file, 0, SEEK_SET) != 0) return outcome::none;
    const ssize_t written = write(file, text.data(), text.size());
    return written == ssize_t(text.size()) ? how : outcome::none;
}

outcome carryOut(int file, const std::function<void(packer&)>& job)
{
    try
    {
        packer out(file);
        job(out);
        out.flush();
        return outcome::done;
    }
    catch (const fatalError& error)
    {
        return say(file, error.what(), outcome::refused);
    }
    catch (const std::bad_alloc&)
    {
        return say(file, "out of memory", outcome::failed);
    }
    catch (const std::exception& error)
    {
        return say(file, error.what(), outcome::failed);
    }
    catch (const std::string& error)  // as gmsh throws
    {
        return say(file, error, outcome::failed);
    }
}

void limitTo(const processLimits& limits)
{
    const auto most = [](auto resource, scalar value) {
        rlimit now;
        if (getrlimit(resource, &now) != 0 || value >= scalar(now.rlim_max)) return;
        now.rlim_cur = rlim_t(value);
        setrlimit(resource, &now);
    };
    most(RLIMIT_CORE, 0);
    most(RLIMIT_CPU, std::ceil(limits.cpuSeconds));
    size_t pages = 0;  // that the process has already: AddressSanitizer takes terabytes at start
    std::ifstream("/proc/self/statm") >> pages;
    if (limits.memory > 0 && pages > 0)
        most(RLIMIT_AS, scalar(pages) * scalar(sysconf(_SC_PAGESIZE)) + scalar(limits.memory));
}

void prepareChild(int log, const processLimits& limits)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // Whatever the parent does on these: here they end the process, and the parent sees it
    for (const int s : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(s, SIG_DFL);
    // Those that stop a run are for the parent
    for (const int s : {SIGTERM, SIGINT}) std::signal(s, SIG_IGN);
    limitTo(limits);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(log, STDOUT_FILENO), dup2(log, STDERR_FILENO);
}

constexpr auto longestPause = std::chrono::microseconds(5000);

// False if it had to be killed
bool waitFor(pid_t pid, const sharedMemory& shared, int& status)
{
    // Soon at first: a small file takes less than a millisecond
    for (auto pause = std::chrono::microseconds(100);; pause = std::min(2 * pause, longestPause))
    {
        const pid_t ended = waitpid(pid, &status, WNOHANG);
        if (ended == pid) return true;
        if (ended < 0 && errno != EINTR) cannot("wait for a process");
        if (now() > shared->deadline)
        {
            kill(pid, SIGKILL);
            while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {}
            return false;
        }
        std::this_thread::sleep_for(pause);
    }
}

word howItEnded(int status)
{
    if (WIFSIGNALED(status) && WTERMSIG(status) != SIGXCPU)
        return word("was ended by the signal ") + strsignal(WTERMSIG(status));
    if (WIFSIGNALED(status)) return "found no end";
    return "ended its process with status " + std::to_string(WEXITSTATUS(status));
}

word lastSaid(int log)
{
    const word printed = lastLines(unpacker::ofFile(log).rest(), 5);
    return printed.empty() ? word(" It said nothing.") : " The last it said:\n" + printed;
}

}  // namespace

unpacker runGuarded(const word& what, const processLimits& limits,
                    const std::function<void(packer&, const grantTime&)>& job)
{
    const namelessFile log, result;
    const sharedMemory shared;
    const scalar begin = now();
    shared->deadline = begin + limits.seconds;
    const grantTime grant = [&](scalar more) { shared->deadline = now() + more; };
    info().flush();
    const pid_t pid = fork();
    if (pid < 0) cannot("start a process for " + what);
    if (pid == 0)
    {
        prepareChild(log, limits);
        shared->result = carryOut(result, [&](packer& out) { job(out, grant); });
        _exit(0);
    }
    int status = 0;
    if (!waitFor(pid, shared, status))
        throw fatalError(what + " did not finish within " + str(shared->deadline - begin, 3) +
                         " s and was stopped." + limits.ifTooLong + lastSaid(log));
    if (status != 0 || shared->result == outcome::none)
        throw fatalError(what + " " + howItEnded(status) + " after " + str(now() - begin, 3) +
                         " s." + limits.ifEnded + lastSaid(log));
    unpacker in = unpacker::ofFile(result);
    if (shared->result == outcome::refused) throw fatalError(in.rest());
    if (shared->result == outcome::failed) throw fatalError(what + ": " + in.rest());
    return in;
}

}  // namespace ispf
