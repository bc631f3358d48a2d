// SPDX-License-Identifier: GPL-3.0-or-later
#include "guardedProcess.H"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
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

// A temporary file without a name: it is gone with the last process that has it open
struct namelessFile
{
    std::FILE* file = std::tmpfile();
    namelessFile()
    {
        if (!file) cannot("create a temporary file");
    }
    namelessFile(const namelessFile&) = delete;
    ~namelessFile() { std::fclose(file); }

    int descriptor() const { return fileno(file); }
    word content() const
    {
        word bytes(size_t(std::max<off_t>(0, lseek(descriptor(), 0, SEEK_END))), '\0');
        size_t have = 0;
        for (ssize_t n = 1; n > 0 && have < bytes.size(); have += size_t(std::max<ssize_t>(0, n)))
            n = pread(descriptor(), &bytes[have], bytes.size() - have, off_t(have));
        return bytes.substr(0, have);
    }
};

// The moment until which the job may run, seen by both processes
struct sharedDeadline
{
    volatile scalar* at;
    sharedDeadline()
    {
        void* page = mmap(nullptr, sizeof(scalar), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (page == MAP_FAILED) cannot("share memory with a process");
        at = static_cast<volatile scalar*>(page);
    }
    sharedDeadline(const sharedDeadline&) = delete;
    ~sharedDeadline() { munmap(const_cast<scalar*>(at), sizeof(scalar)); }
};

word lastLines(const word& text, int count)
{
    size_t from = text.size();
    for (int n = 0; n <= count && from != word::npos && from > 0; ++n)
        from = text.rfind('\n', from - 1);
    return from == word::npos ? text : text.substr(from);
}

constexpr char done = 'd', failed = 'f';  // first byte of the result

[[noreturn]] void child(const namelessFile& log, const namelessFile& result,
                        const std::function<word()>& job)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(log.descriptor(), STDOUT_FILENO), dup2(log.descriptor(), STDERR_FILENO);
    word bytes;
    try
    {
        bytes = done + job();
    }
    catch (const std::exception& error)
    {
        bytes = failed + word(error.what());
    }
    catch (const std::string& error)  // as gmsh throws
    {
        bytes = failed + error;
    }
    size_t sent = 0;
    for (ssize_t n = 1; n > 0 && sent < bytes.size(); sent += size_t(std::max<ssize_t>(0, n)))
        n = write(result.descriptor(), &bytes[sent], bytes.size() - sent);
    _exit(sent == bytes.size() ? 0 : 1);
}

// False if it had to be killed
bool waitFor(pid_t pid, const sharedDeadline& deadline, int& status)
{
    while (true)
    {
        const pid_t ended = waitpid(pid, &status, WNOHANG);
        if (ended == pid) return true;
        if (ended < 0 && errno != EINTR) cannot("wait for a process");
        if (now() > *deadline.at)
        {
            kill(pid, SIGKILL);
            while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {}
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

word howItEnded(int status)
{
    if (WIFSIGNALED(status)) return word("was ended by the signal ") + strsignal(WTERMSIG(status));
    return "ended its process with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

word runGuarded(const word& what, scalar limit, const std::function<word(const grantTime&)>& job)
{
    const namelessFile log, result;
    const sharedDeadline deadline;
    const scalar begin = now();
    *deadline.at = begin + limit;
    const grantTime grant = [&](scalar more) { *deadline.at = now() + more; };
    info().flush();
    const pid_t pid = fork();
    if (pid < 0) cannot("start a process for " + what);
    if (pid == 0) child(log, result, [&] { return job(grant); });
    int status = 0;
    const bool ended = waitFor(pid, deadline, status);
    const word printed = lastLines(log.content(), 5);
    const word said = printed.find_first_not_of(" \n") == word::npos
                          ? word(" It said nothing.")
                          : " The last it said:" + printed;
    if (!ended)
        throw fatalError(what + " did not finish within " + str(*deadline.at - begin, 3) +
                         " s and was stopped. Is the unit right, the mesh size (surfaceSize) not "
                         "absurdly small? 'timeLimit' sets the seconds it may take." +
                         said);
    const word bytes = result.content();
    if (!bytes.empty() && bytes[0] == failed) throw fatalError(what + ": " + bytes.substr(1));
    if (bytes.empty() || status != 0)
        throw fatalError(what + " " + howItEnded(status) + " after " + str(now() - begin, 3) +
                         " s." + said);
    return bytes.substr(1);
}

}  // namespace ispf
