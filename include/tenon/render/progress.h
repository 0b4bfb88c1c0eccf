#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tenon {

/// How far a piece of work is; set by the threads that do it, read by the one that shows it.
struct ProgressCounters {
  std::atomic<std::uint64_t> total{0};  ///< 0: not known
  std::atomic<std::uint64_t> done{0};
  std::atomic<std::uint64_t> before{0};  ///< of what is done: what was done when the work began
  std::atomic<std::uint64_t> rays{0};
  std::atomic<double> seconds_allowed{0};  ///< after which the work ends, done or not; 0: no such end
};

/// A moment of a piece of work.
struct ProgressFigures {
  std::string what;  ///< such as "rendering"
  std::uint64_t total = 0, done = 0, rays = 0;
  double seconds = 0;  ///< since it began
  std::uint64_t before = 0;
  double seconds_allowed = 0;
};

/// `rendering  42 % [########............] 1.3 Mrays/s, 0:12 left`; without what is not known. No end of line. Where
/// the work may end by the clock, the share is that of the time if it is the larger one.
std::string progress_text(const ProgressFigures& figures, bool with_bar);

enum class ProgressStyle {
  silent,
  lines,  ///< after a second, then a line every five: for logs
  bar,    ///< after half a second, one line that is written over
};

/// Bar on a terminal, lines elsewhere, silent when asked to be.
ProgressStyle progress_style(std::FILE* out, bool quiet);

/// Shows the progress of one piece of work after another from a thread of its own; work that is done at once is not
/// mentioned.
class ProgressDisplay {
 public:
  ProgressDisplay(std::FILE* out, ProgressStyle style);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Begins a piece of work; the one before is over. Only while no thread counts.
  void begin(std::string what);
  /// The last piece of work is over; takes the bar away.
  void end();
  /// A line of text of its own, kept apart from the bar. Shown in every style.
  void say(const std::string& line);

  ProgressCounters& counters() { return counters_; }

 private:
  using Clock = std::chrono::steady_clock;
  void watch(const std::stop_token& stop);
  void show();
  void erase();

  std::FILE* out_;
  ProgressStyle style_;
  ProgressCounters counters_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<std::string> what_;
  Clock::time_point begun_;
  Clock::time_point next_;
  std::size_t shown_ = 0;  // characters of the bar on the screen
  std::jthread watcher_;
};

}  // namespace tenon
