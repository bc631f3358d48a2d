// SPDX-License-Identifier: GPL-3.0-or-later
#include "packedBytes.H"

#include <cerrno>
#include <new>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ispf
{

namespace
{

constexpr size_t small = 65536;

void writeAll(int file, const char* data, size_t n)
{
    while (n > 0)
    {
        const ssize_t written = ::write(file, data, n);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw std::bad_alloc();
        data += written, n -= size_t(written);
    }
}

}  // namespace

void packer::add(const void* data, size_t n)
{
    const auto* bytes = static_cast<const char*>(data);
    if (n < small) small_.append(bytes, n);
    if (n >= small || small_.size() >= small) flush();
    if (n >= small) writeAll(file_, bytes, n);
}

void packer::flush()
{
    writeAll(file_, small_.data(), small_.size());
    small_.clear();
}

unpacker unpacker::ofFile(int file)
{
    struct stat about;
    if (::fstat(file, &about) != 0) cutOff();
    const auto size = size_t(about.st_size);
    if (size == 0) return unpacker({});
    void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    unpacker in(std::string_view(static_cast<const char*>(memory), size));
    in.owner_.reset(memory, [size](void* m) { ::munmap(m, size); });
    return in;
}

}  // namespace ispf
