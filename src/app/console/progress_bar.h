#pragma once

#include <chrono>
#include <string>

namespace candela {

/// Progress on stderr: on a terminal a bar that is redrawn in place, else a line every ten seconds.
class ProgressBar {
public:
  explicit ProgressBar(bool quiet);
  /// `fraction` in 0..1; the remaining time is extrapolated from it.
  void update(double fraction, const std::string& text);
  void finish(const std::string& text);

private:
  std::chrono::steady_clock::time_point start_, last_;
  bool quiet_, terminal_, drawn_ = false;
};

} // namespace candela
