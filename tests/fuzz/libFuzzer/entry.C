// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled once per target: TARGET is the name in targets.H
#include "targets.H"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size)
{
    ispf::fuzz::TARGET(ispf::word(reinterpret_cast<const char*>(data), size));
    return 0;
}
