#pragma once
// Keeps a session building for as long as a test needs, independent of the machine's speed.

#include "core/progress.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace candela::test {

/// While it is closed, building does not finish unless it is cancelled. It must outlive the session.
class BuildGate {
public:
  explicit BuildGate(bool closed) : closed_(closed) {}
  void close() { closed_ = true; }
  void open() { closed_ = false; }

  /// For SessionOptions::on_build.
  std::function<void(const Progress&)> hook() {
    return [this](const Progress& progress) {
      while (closed_ && !progress.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
  }

private:
  std::atomic<bool> closed_;
};

} // namespace candela::test
