#include "tenon/base/interrupt.h"

#include <atomic>
#include <csignal>

#include "base/note_interrupt.h"

namespace tenon {

namespace {

std::atomic<int> deferrals{0};
std::atomic<int> noted{0};

}  // namespace

InterruptDeferral::InterruptDeferral() {
  ++deferrals;
}

InterruptDeferral::~InterruptDeferral() {
  --deferrals;
}

int noted_interrupt() {
  return noted;
}

bool note_interrupt(int signal) {
  if (signal == SIGPIPE || deferrals == 0) return false;
  int none = 0;
  return noted.compare_exchange_strong(none, signal);
}

}  // namespace tenon
