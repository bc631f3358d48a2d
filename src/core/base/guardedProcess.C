// SPDX-License-Identifier: GPL-3.0-or-later
#include "guardedProcess.H"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
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

// A pipe to hand over data.  A file in memory would be subject to limits on file sizes; a disk may be full
class pipeTo
{
public:
    pipeTo()
    {
        if (pipe2(ends_, O_CLOEXEC) != 0) cannot("open a pipe");
        fcntl(ends_[0], F_SETFL, O_NONBLOCK);
        fcntl(ends_[1], F_SETPIPE_SZ, 1 << 20);  // fewer turns; works without it
    }
    pipeTo(const pipeTo&) = delete;
    ~pipeTo() { closeOwn(), close(ends_[0]); }

    int entry() const { return ends_[1]; }
    int exit() const { return ends_[0]; }
    void closeOwn()  // closes the entry, once another process has it
    {
        if (ends_[1] >= 0) close(ends_[1]);
        ends_[1] = -1;
    }
    // Appends the available data to text; false at the end
    bool drain(word& text)
    {
        for (;;)
        {
            const ssize_t n = read(ends_[0], block_.data(), block_.size());
            if (n > 0) text.append(block_.data(), size_t(n));
            else if (n == 0 || (errno != EAGAIN && errno != EINTR)) return false;
            else return true;
        }
    }

private:
    int ends_[2] = {-1, -1};
    List<char> block_ = List<char>(1 << 18);
};

enum class outcome : int
{
    none,
    done,
    refused,  // the job itself has refused, with a message for the user
    failed
};

// Memory that both processes see
struct sharedPage
{
    volatile scalar deadline;  // time until which the job may run
    volatile outcome result;
    volatile size_t textAt;  // begin of the job's own message in the data it handed over
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

// Removes the colours of a terminal, ESC [ ... m
word uncoloured(word text)
{
    for (size_t at = 0; (at = text.find("\033[", at)) != word::npos;)
    {
        const size_t end = text.find_first_not_of("0123456789;", at + 2);
        text.erase(at, end == word::npos ? end : end + 1 - at);
    }
    return text;
}

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

outcome carryOut(int to, const sharedMemory& shared, const std::function<void(packer&)>& job)
{
    packer out(to);
    const auto say = [&](const word& text, outcome how) {
        shared->textAt = out.endWith(text);
        return how;
    };
    try
    {
        job(out);
        out.flush();
        return outcome::done;
    }
    catch (const fatalError& error)
    {
        return say(error.what(), outcome::refused);
    }
    catch (const std::bad_alloc&)
    {
        return say("out of memory", outcome::failed);
    }
    catch (const std::exception& error)
    {
        return say(error.what(), outcome::failed);
    }
    catch (const std::string& error)  // gmsh throws strings
    {
        return say(error, outcome::failed);
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
    // pages that the process has already: AddressSanitizer takes terabytes at start
    size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    if (limits.memory > 0 && pages > 0)
        most(RLIMIT_AS, scalar(pages) * scalar(sysconf(_SC_PAGESIZE)) + scalar(limits.memory));
}

void prepareChild(int log, const processLimits& limits)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // whatever the parent does on these signals, here they end the process, and the parent sees it
    for (const int s : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(s, SIG_DFL);
    // the signals that stop a run are for the parent
    for (const int s : {SIGTERM, SIGINT}) std::signal(s, SIG_IGN);
    limitTo(limits);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(log, STDOUT_FILENO), dup2(log, STDERR_FILENO);
}

constexpr int glance = 50;          // [ms] between looks at the clock
constexpr size_t lastWords = 8192;  // [byte] of its last output that are kept

// Reads what the process prints and hands over until it has ended; false if it had to be killed
bool waitFor(pid_t pid, const sharedMemory& shared, pipeTo& log, word& printed, pipeTo& result,
             word& handed, int& status)
{
    for (bool open = true;;)
    {
        pollfd ends[] = {{result.exit(), POLLIN, 0}, {log.exit(), POLLIN, 0}};
        if (open) poll(ends, 2, glance);  // at the end of the result the process is about to end
        else std::this_thread::sleep_for(std::chrono::microseconds(100));
        open = open && result.drain(handed);
        log.drain(printed);
        if (printed.size() > 2 * lastWords) printed.erase(0, printed.size() - lastWords);
        const pid_t ended = waitpid(pid, &status, WNOHANG);
        if (ended == pid) return result.drain(handed), log.drain(printed), true;
        if (ended < 0 && errno != EINTR) cannot("wait for a process");
        if (now() > shared->deadline)
        {
            kill(pid, SIGKILL);
            while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {}
            return false;
        }
    }
}

word howItEnded(int status)
{
    if (WIFSIGNALED(status) && WTERMSIG(status) != SIGXCPU)
        return word("was ended by the signal ") + strsignal(WTERMSIG(status));
    if (WIFSIGNALED(status)) return "found no end";
    return "ended its process with status " + std::to_string(WEXITSTATUS(status));
}

word lastSaid(const word& printed)
{
    const word last = lastLines(uncoloured(printed), 5);
    return last.empty() ? word(" It said nothing.") : " The last it said:\n" + last;
}

}  // namespace

unpacker runGuarded(const word& what, const processLimits& limits,
                    const std::function<void(packer&, const grantTime&)>& job)
{
    pipeTo log, result;
    word printed, handed;
    const sharedMemory shared;
    const scalar begin = now();
    shared->deadline = begin + limits.seconds;
    const grantTime grant = [&](scalar more) { shared->deadline = now() + more; };
    info().flush();
    const pid_t pid = fork();
    if (pid < 0) cannot("start a process for " + what);
    if (pid == 0)
    {
        prepareChild(log.entry(), limits);
        shared->result = carryOut(result.entry(), shared, [&](packer& out) { job(out, grant); });
        _exit(0);
    }
    log.closeOwn(), result.closeOwn();
    int status = 0;
    if (!waitFor(pid, shared, log, printed, result, handed, status))
        throw fatalError(what + " did not finish within " + str(shared->deadline - begin, 3) +
                         " s and was stopped." + limits.ifTooLong + lastSaid(printed));
    if (status != 0 || shared->result == outcome::none)
        throw fatalError(what + " " + howItEnded(status) + " after " + str(now() - begin, 3) +
                         " s." + limits.ifEnded + lastSaid(printed));
    if (shared->result == outcome::done) return unpacker(std::move(handed));
    const word said = uncoloured(handed.substr(std::min(size_t(shared->textAt), handed.size())));
    throw fatalError(shared->result == outcome::refused ? said : what + ": " + said);
}

}  // namespace ispf
