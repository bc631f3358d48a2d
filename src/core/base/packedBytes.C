// SPDX-License-Identifier: GPL-3.0-or-later
#include "packedBytes.H"

#include <cerrno>
#include <new>
#include <unistd.h>

namespace ispf
{

namespace
{

constexpr size_t small = 65536;

}  // namespace

void packer::add(const void* data, size_t n)
{
    const auto* bytes = static_cast<const char*>(data);
    if (n < small) small_.append(bytes, n);
    if (n >= small || small_.size() >= small) flush();
    if (n >= small) write(bytes, n);
}

void packer::write(const char* data, size_t n)
{
    while (n > 0)
    {
        const ssize_t written = ::write(file_, data, n);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw std::bad_alloc();
        data += written, n -= size_t(written), written_ += size_t(written);
    }
}

void packer::flush()
{
    write(small_.data(), small_.size());
    small_.clear();
}

size_t packer::endWith(const word& text)
{
    const size_t before = written_;
    write(text.data(), text.size());
    return before;
}

}  // namespace ispf
