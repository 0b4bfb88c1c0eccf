#pragma once

namespace tenon {

/// For a signal handler: whether the signal is only to be noted now (InterruptDeferral).
bool note_interrupt(int signal);

}  // namespace tenon
