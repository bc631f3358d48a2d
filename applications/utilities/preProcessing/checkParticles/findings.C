// SPDX-License-Identifier: GPL-3.0-or-later
#include "findings.H"

#include <cmath>
#include <ostream>

namespace ispf
{

void findings::heading(const word& text) const
{
    info() << "\n" << text << "\n";
}

void findings::fine(const word& text) const
{
    info() << "    " << text << " OK.\n";
}

void findings::note(const word& text) const
{
    info() << "    " << text << "\n";
}

void findings::warn(const word& text)
{
    info() << "   *" << text << "\n";
    ++warned_;
}

void findings::fail(const word& text)
{
    info() << " ***" << text << "\n";
    ++failed_;
}

void findings::judge(bool good, const word& text)
{
    good ? fine(text) : fail(text);
}

int findings::close() const
{
    const auto counted = [](int n, const word& what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    if (warned_ > 0) info() << "\n" << counted(warned_, "warning") << ", marked *";
    info() << "\n"
           << (failed_ > 0 ? "Failed " + counted(failed_, "check") + "." : "Particles OK.")
           << "\n\nEnd" << std::endl;
    return failed_ > 0 ? 1 : 0;
}

word percent(scalar fraction)
{
    char text[32];
    std::snprintf(text, sizeof text, "%+.2f %%", std::round(1e4 * fraction) / 100 + 0.0);
    return text;
}

word valueRange::text() const
{
    return str(least, 4) + "/" + str(mean(), 4) + "/" + str(most, 4);
}

}  // namespace ispf
