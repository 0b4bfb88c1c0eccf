#include "tenon/render/progress.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <system_error>

namespace tenon {

namespace {

using namespace std::chrono_literals;

std::string clock_text(double seconds) {
  const auto s = static_cast<std::uint64_t>(std::clamp(std::ceil(seconds), 0.0, 1e9));
  std::array<char, 48> text{};
  if (s >= 3600) {
    std::snprintf(text.data(), text.size(), "%llu:%02llu:%02llu", static_cast<unsigned long long>(s / 3600),
                  static_cast<unsigned long long>(s / 60 % 60), static_cast<unsigned long long>(s % 60));
  } else {
    std::snprintf(text.data(), text.size(), "%llu:%02llu", static_cast<unsigned long long>(s / 60),
                  static_cast<unsigned long long>(s % 60));
  }
  return text.data();
}

std::string rate_text(double rays_per_second) {
  constexpr std::array<const char*, 4> units{"", "k", "M", "G"};
  std::size_t unit = 0;
  while (rays_per_second >= 999.5 && unit + 1 < units.size()) rays_per_second /= 1000, ++unit;
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.3g %srays/s", rays_per_second, units[unit]);
  return text.data();
}

// By how fast the work has gone since it began, or until time is over.
std::optional<double> seconds_left(const ProgressFigures& f) {
  std::optional<double> left;
  if (f.done > f.before) {
    left =
        f.seconds * static_cast<double>(f.total - std::min(f.total, f.done)) / static_cast<double>(f.done - f.before);
  }
  if (f.seconds_allowed > 0) {
    const double allowed = std::max(0.0, f.seconds_allowed - f.seconds);
    left = std::min(left.value_or(allowed), allowed);
  }
  return left;
}

// Of the work, or of the time that it may take, whichever ends it sooner.
double share_done(const ProgressFigures& f) {
  double share = static_cast<double>(f.done) / static_cast<double>(f.total);
  if (f.seconds_allowed > 0) share = std::max(share, f.seconds / f.seconds_allowed);
  return std::min(1.0, share);
}

}  // namespace

std::string progress_text(const ProgressFigures& f, bool with_bar) {
  constexpr std::size_t bar_width = 24;
  std::string text = f.what;
  if (f.total == 0) return text + ", " + clock_text(f.seconds);

  const double share = share_done(f);
  std::array<char, 16> percent{};
  std::snprintf(percent.data(), percent.size(), " %3d %%", static_cast<int>(share * 100));
  text += percent.data();
  if (with_bar) {
    const auto filled = static_cast<std::size_t>(share * bar_width);
    text += " [" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "]";
  }
  if (f.rays > 0 && f.seconds > 0) text += "  " + rate_text(static_cast<double>(f.rays) / f.seconds);
  if (const auto left = seconds_left(f)) text += ", " + clock_text(*left) + " left";
  return text;
}

ProgressStyle progress_style(std::FILE* out, bool quiet) {
  if (quiet) return ProgressStyle::silent;
  return isatty(fileno(out)) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

ProgressDisplay::ProgressDisplay(std::FILE* out, ProgressStyle style) : out_(out), style_(style) {
  if (style_ == ProgressStyle::silent) return;
  try {
    watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  } catch (const std::system_error&) {
    // No thread to be had: the work goes on unseen.
    style_ = ProgressStyle::silent;
  }
}

ProgressDisplay::~ProgressDisplay() {
  end();
}

void ProgressDisplay::begin(std::string what) {
  const std::lock_guard lock(mutex_);
  erase();
  counters_.total = 0;
  counters_.done = 0;
  counters_.before = 0;
  counters_.seconds_allowed = 0;
  counters_.rays = 0;
  what_ = std::move(what);
  begun_ = Clock::now();
  next_ = begun_ + (style_ == ProgressStyle::bar ? 500ms : 1000ms);
  wake_.notify_all();
}

void ProgressDisplay::end() {
  const std::lock_guard lock(mutex_);
  erase();
  what_.reset();
}

void ProgressDisplay::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  erase();
  std::fprintf(out_, "%s\n", line.c_str());
  std::fflush(out_);
}

void ProgressDisplay::watch(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (!what_) {
      wake_.wait(lock, stop, [this] { return what_.has_value(); });
    } else if (Clock::now() >= next_) {
      show();
      next_ = Clock::now() + (style_ == ProgressStyle::bar ? 100ms : 5000ms);
    } else {
      wake_.wait_until(lock, stop, Clock::time_point(next_), [] { return false; });
    }
  }
}

void ProgressDisplay::show() {
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  std::string text = progress_text(
      {*what_, counters_.total, counters_.done, counters_.rays, seconds, counters_.before, counters_.seconds_allowed},
      style_ == ProgressStyle::bar);
  if (style_ == ProgressStyle::lines) {
    std::fprintf(out_, "tenon: %s\n", text.c_str());
  } else {
    const std::size_t length = text.size();
    if (length < shown_) text.append(shown_ - length, ' ');
    std::fprintf(out_, "\r%s", text.c_str());
    shown_ = length;
  }
  std::fflush(out_);
}

void ProgressDisplay::erase() {
  if (shown_ == 0) return;
  std::fprintf(out_, "\r%s\r", std::string(shown_, ' ').c_str());
  std::fflush(out_);
  shown_ = 0;
}

}  // namespace tenon
