// SPDX-License-Identifier: GPL-3.0-or-later
#include "guardedProcess.H"

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace ispf
{

namespace
{

namespace fs = std::filesystem;

struct scratchFolder
{
    fs::path path;
    scratchFolder()
    {
        word name = (fs::temp_directory_path() / "ispf.XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw fatalError("Cannot create a temporary folder " + name + ": " +
                             std::strerror(errno));
        path = name;
    }
    ~scratchFolder()
    {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

word contents(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

word lastLines(const word& text, int count)
{
    size_t from = text.size();
    for (int n = 0; n <= count && from != word::npos && from > 0; ++n)
        from = text.rfind('\n', from - 1);
    return from == word::npos ? text : text.substr(from);
}

[[noreturn]] void child(const fs::path& folder, const std::function<word()>& job)
{
    const int log = open((folder / "log").c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(log, STDOUT_FILENO), dup2(log, STDERR_FILENO);
    int status = 0;
    word result;
    try
    {
        result = job();
    }
    catch (const std::exception& error)
    {
        result = error.what(), status = 1;
    }
    catch (const std::string& error)  // as gmsh throws
    {
        result = error, status = 1;
    }
    std::ofstream out(folder / "result", std::ios::binary);
    out << result;
    out.close();
    _exit(out ? status : 2);
}

// False if it had to be killed
bool waitFor(pid_t pid, scalar timeLimit, int& status)
{
    using clock = std::chrono::steady_clock;
    const auto end = clock::now() + std::chrono::duration<scalar>(timeLimit);
    while (waitpid(pid, &status, WNOHANG) == 0)
    {
        if (clock::now() > end)
        {
            kill(pid, SIGKILL);
            waitpid(pid, &status, 0);
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

}  // namespace

word runGuarded(const word& what, scalar timeLimit, const std::function<word()>& job)
{
    const scratchFolder folder;
    info().flush();
    const pid_t pid = fork();
    if (pid < 0)
        throw fatalError("Cannot start a process for " + what + ": " + std::strerror(errno));
    if (pid == 0) child(folder.path, job);
    int status = 0;
    if (!waitFor(pid, timeLimit, status))
        throw fatalError(
            what + " did not finish within " + str(timeLimit) +
            " s. Is the unit right, and the mesh size (surfaceSize) not absurdly small?");
    const word result = contents(folder.path / "result");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return result;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 1) throw fatalError(what + ": " + result);
    throw fatalError(what + " ended abnormally" +
                     (WIFSIGNALED(status) ? word(": ") + strsignal(WTERMSIG(status)) : word()) +
                     ". The last it said:" + lastLines(contents(folder.path / "log"), 5));
}

}  // namespace ispf
