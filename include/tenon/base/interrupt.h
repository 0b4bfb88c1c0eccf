#pragma once

namespace tenon {

/// While one exists, the first interrupt (Ctrl-C), hang-up or termination is noted instead of ending the process, so
/// that what is done can be kept; the second one ends it as ever (remove_temporary_files_on_signals).
class InterruptDeferral {
 public:
  InterruptDeferral();
  ~InterruptDeferral();
  InterruptDeferral(const InterruptDeferral&) = delete;
  InterruptDeferral& operator=(const InterruptDeferral&) = delete;
};

/// The number of the signal that was noted; 0: none was.
int noted_interrupt();

}  // namespace tenon
