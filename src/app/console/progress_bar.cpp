#include "app/console/progress_bar.h"

#include "app/platform/streams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace candela {

using Clock = std::chrono::steady_clock;

namespace {

/// "1:05", "2:00:00", "12 days".
std::string duration_text(double seconds) {
  constexpr double kDay = 86400, kYears = 3650 * kDay;
  if (!(seconds < kYears)) return "years";
  const auto s = static_cast<long>(seconds);
  if (seconds >= 3 * kDay) return fmt::format("{:.0f} days", seconds / kDay);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

} // namespace

ProgressBar::ProgressBar(bool quiet)
    : start_(Clock::now()), last_(start_), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressBar::update(double fraction, const std::string& text) {
  if (quiet_) return;
  auto now = Clock::now();
  std::chrono::duration<double> since = now - last_, elapsed = now - start_;
  if (since.count() < (terminal_ ? 0.1 : 10.0)) return;
  last_ = now;
  double left = fraction > 0 ? elapsed.count() * (1 - fraction) / fraction : 0;
  const std::string time_left = duration_text(left) + " left";
  if (terminal_) {
    constexpr int kBarWidth = 30;
    int full = std::clamp(static_cast<int>(fraction * kBarWidth + 0.5), 0, kBarWidth);
    say("\r[{:#<{}}{:.<{}}] {:3.0f} %  {}  {}\x1b[K", "", full, "", kBarWidth - full, 100 * fraction, text,
        time_left);
    drawn_ = true;
  } else {
    say("{:.0f} %, {}, {}\n", 100 * fraction, text, time_left);
  }
}

void ProgressBar::finish(const std::string& text) {
  if (quiet_) return;
  say("{}{}\n", drawn_ ? "\r\x1b[K" : "", text);
}

} // namespace candela
