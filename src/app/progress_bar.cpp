#include "app/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace candela {

using Clock = std::chrono::steady_clock;

ProgressBar::ProgressBar(bool quiet)
    : start_(Clock::now()), last_(start_), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressBar::update(double fraction, const std::string& text) {
  if (quiet_) return;
  auto now = Clock::now();
  std::chrono::duration<double> since = now - last_, elapsed = now - start_;
  if (since.count() < (terminal_ ? 0.1 : 10.0)) return;
  last_ = now;
  double left = fraction > 0 ? elapsed.count() * (1 - fraction) / fraction : 0;
  std::string time_left =
      fmt::format("{}:{:02} left", static_cast<int>(left) / 60, static_cast<int>(left) % 60);
  if (terminal_) {
    constexpr int kWidth = 30;
    int full = std::clamp(static_cast<int>(fraction * kWidth + 0.5), 0, kWidth);
    fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} %  {}  {}\x1b[K", "", full, "", kWidth - full,
               100 * fraction, text, time_left);
    std::fflush(stderr);
    drawn_ = true;
  } else {
    fmt::print(stderr, "{:.0f} %, {}, {}\n", 100 * fraction, text, time_left);
  }
}

void ProgressBar::finish(const std::string& text) {
  if (quiet_) return;
  fmt::print(stderr, "{}{}\n", drawn_ ? "\r\x1b[K" : "", text);
}

} // namespace candela
