#pragma once

#include <chrono>
#include <string>

namespace candela {

/// Progress of long work on stderr: a bar that rewrites its line on a terminal, else a plain line every ten
/// seconds.
class ProgressBar {
public:
  explicit ProgressBar(bool quiet);
  /// `fraction` in 0..1; the time left is what the rate so far makes it.
  void update(double fraction, const std::string& text);
  void finish(const std::string& text);

private:
  std::chrono::steady_clock::time_point start_, last_;
  bool quiet_, terminal_, drawn_ = false;
};

} // namespace candela
