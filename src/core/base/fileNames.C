// SPDX-License-Identifier: GPL-3.0-or-later
#include "fileNames.H"

#include <sys/stat.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace ispf
{

namespace
{

word environment(const word& name, const word& path)
{
    const char* value = std::getenv(name.c_str());
    if (!value)
        throw fatalError("The path '" + path + "' uses $" + name +
                         ", but the environment variable " + name + " is not set.");
    return value;
}

word caseFolder()
{
    const char* value = std::getenv("FOAM_CASE");
    return value ? value : ".";
}

}  // namespace

word readText(const word& path)
{
    if (isFolder(path)) throw fatalError("Cannot read " + path + ": it is a folder.");
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    // a shell's own pipes, below /dev, do come to an end
    const bool ownPipe = fs::is_fifo(status) && path.rfind("/dev/", 0) == 0;
    if (fs::exists(status) && !fs::is_regular_file(status) && !ownPipe)
        throw fatalError("Cannot read " + path + ": it is " +
                         (fs::is_fifo(status) ? "a named pipe" : "a device and no file") +
                         ", from which an end may never come.");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) throw fatalError("Cannot read " + path + ": " + std::strerror(errno) + ".");
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

bool isFile(const word& path)
{
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool isFolder(const word& path)
{
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

List<word> folderNames(const word& folder)
{
    List<word> names;
    std::error_code error;
    for (const auto& item : fs::directory_iterator(folder, error))
        if (item.is_directory(error)) names.push_back(item.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::int64_t modificationStamp(const word& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0) return 0;
    return std::int64_t(status.st_mtim.tv_sec) * 1000000000 + status.st_mtim.tv_nsec;
}

word folderOf(const word& path)
{
    return fs::path(path).parent_path().string();
}

word fromFolder(const word& folder, const word& path)
{
    return folder.empty() ? path : (fs::path(folder) / path).string();
}

word expandPath(const word& path)
{
    word out;
    size_t i = 0;
    for (const auto& [tag, folder] : {std::pair<word, word>{"<case>", ""},
                                      {"<system>", "/system"},
                                      {"<constant>", "/constant"}})
        if (path.compare(0, tag.size(), tag) == 0) out = caseFolder() + folder, i = tag.size();
    if (path.compare(0, 5, "<etc>") == 0)
        return etcFile(path.substr(path.find_first_not_of('/', 5)));
    if (path == "~" || path.compare(0, 2, "~/") == 0) out = environment("HOME", path), i = 1;
    while (i < path.size())
    {
        if (path[i] != '$')
        {
            out += path[i++];
            continue;
        }
        const bool braces = i + 1 < path.size() && path[i + 1] == '{';
        const size_t begin = i + 1 + braces;
        size_t e = begin;
        while (e < path.size() &&
               (std::isalnum(static_cast<unsigned char>(path[e])) || path[e] == '_'))
            ++e;
        out += environment(path.substr(begin, e - begin), path);
        i = e + braces;
    }
    return out;
}

namespace
{

List<fs::path> etcFolders()
{
    List<fs::path> folders;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    // not in the root itself: /etc belongs to the system
    for (fs::path p = program.parent_path(); p.has_relative_path(); p = p.parent_path())
        folders.push_back(p / "etc");
    if (const char* openfoam = std::getenv("WM_PROJECT_DIR"))
        folders.push_back(fs::path(openfoam) / "etc");
    return folders;
}

}  // namespace

word etcFile(const word& name)
{
    for (const fs::path& folder : etcFolders())
        if (const word file = (folder / name).string(); isFile(file)) return file;
    return "";
}

word etcFileBelow(const word& folder, const word& name)
{
    for (const fs::path& etc : etcFolders())
    {
        List<word> files;
        std::error_code error;
        for (const auto& item : fs::recursive_directory_iterator(etc / folder, error))
            if (item.path().filename() == name && isFile(item.path())) files.push_back(item.path());
        if (!files.empty()) return *std::min_element(files.begin(), files.end());
    }
    return "";
}

}  // namespace ispf
