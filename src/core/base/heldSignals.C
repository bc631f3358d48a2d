// SPDX-License-Identifier: GPL-3.0-or-later
#include "heldSignals.H"

namespace ispf
{

namespace
{

volatile std::sig_atomic_t held = 0;

}  // namespace

// Uses handlers, because a mask would hold for this thread only
heldSignals::heldSignals()
{
    for (std::size_t k = 0; k < n; ++k)
    {
        ::sigaction(signals[k], nullptr, &earlier_[k]);
        if (earlier_[k].sa_handler != SIG_DFL) continue;
        struct sigaction action = {};
        action.sa_handler = signals[k] == SIGXFSZ ? SIG_IGN : [](int signal) { held = signal; };
        action.sa_flags = SA_RESTART;
        ::sigaction(signals[k], &action, nullptr);
    }
}

heldSignals::~heldSignals()
{
    bool outermost = false;
    for (std::size_t k = 0; k < n; ++k)
        if (earlier_[k].sa_handler == SIG_DFL)
            ::sigaction(signals[k], &earlier_[k], nullptr), outermost = true;
    if (const int signal = held; outermost && signal != 0)
    {
        held = 0;
        ::raise(signal);
    }
}

}  // namespace ispf
