// SPDX-License-Identifier: GPL-3.0-or-later
// writeText: afterwards the file is either the old one or the new one, never a part of it
#include "fileNames.H"
#include "heldSignals.H"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <list>
#include <set>
#include <string_view>

namespace ispf
{

namespace
{

[[noreturn]] void fail(const word& path, const word& doing, int error)
{
    const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
    throw fatalError("Cannot write '" + path + "': " + doing + ": " + std::strerror(error) + ".\n" +
                     "An earlier file of that name is untouched.  " +
                     (full ? "Free some space or raise the limit, then run again."
                           : "Check that the folder exists and that you may write there."));
}

// The file under its temporary name; its destructor removes it unless it was moved into place.  It gets mode and owner of
// the file that it replaces; until it is complete nobody else may read it
class temporaryFile
{
public:
    explicit temporaryFile(const word& path)
        : path_(path),
          temporary_(path + ".tmp"),
          replaces_(::stat(path.c_str(), &earlier_) == 0),
          descriptor_(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC,
                             replaces_ ? 0600 : 0666))
    {
        if (descriptor_ < 0) fail(path_, "opening '" + temporary_ + "'", errno);
    }
    ~temporaryFile()
    {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!moved_) ::unlink(temporary_.c_str());
    }
    temporaryFile(const temporaryFile&) = delete;
    temporaryFile& operator=(const temporaryFile&) = delete;

    void write(std::string_view bytes)
    {
        while (!bytes.empty())
        {
            const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) fail(path_, "writing", errno);
            bytes.remove_prefix(size_t(n));
        }
    }

    // Completes the file on disk, still under the temporary name
    void finish()
    {
        if (replaces_) takeOver();
        if (::fsync(descriptor_) != 0) fail(path_, "flushing to disk", errno);
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) fail(path_, "closing", errno);
    }
    void moveIntoPlace()
    {
        if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "renaming", errno);
        moved_ = true;
    }
    const word& path() const { return path_; }

private:
    // Only an administrator may give a file to another owner, and some file systems have no modes: errors are ignored
    void takeOver() const
    {
        [[maybe_unused]] const bool owned =
            ::fchown(descriptor_, earlier_.st_uid, earlier_.st_gid) == 0 ||
            ::fchown(descriptor_, uid_t(-1), earlier_.st_gid) == 0;
        ::fchmod(descriptor_, earlier_.st_mode & 07777);
    }

    word path_, temporary_;
    struct stat earlier_ = {};
    bool replaces_;
    int descriptor_;
    bool moved_ = false;
};

// Without this, a power failure may lose the rename.  Some file systems cannot sync a folder and
// return EINVAL; then nothing more can be done.
void syncFolder(const word& path, const word& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) fail(path, "opening folder '" + folder + "'", errno);
    const int error = ::fsync(descriptor) != 0 ? errno : 0;
    ::close(descriptor);
    if (error != 0 && error != EINVAL) fail(path, "flushing folder '" + folder + "'", error);
}

}  // namespace

void writeTexts(const List<namedText>& files)
{
    const heldSignals untilDone;
    std::list<temporaryFile> written;
    for (const auto& [path, text] : files)
    {
        const word folder = folderOf(path).empty() ? "." : folderOf(path);
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        if (error) fail(path, "creating folder '" + folder + "'", error.value());
        if (std::filesystem::is_directory(path, error)) fail(path, "replacing it", EISDIR);
        written.emplace_back(path);
        written.back().write(text);
        written.back().finish();
    }
    std::set<word> folders;
    for (temporaryFile& file : written)
    {
        file.moveIntoPlace();
        folders.insert(folderOf(file.path()).empty() ? "." : folderOf(file.path()));
    }
    for (const word& folder : folders) syncFolder(files.front().path, folder);
}

void writeText(const word& path, const word& text)
{
    writeTexts({{path, text}});
}

}  // namespace ispf
