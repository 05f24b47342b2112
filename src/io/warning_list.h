#pragma once
// What a reader has to say without refusing the file.

#include "core/error.h"

#include <exception>
#include <map>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// `text` is located ("models/x.obj:12: …") at the first of the `count` places where it happened.
struct Warning {
  std::string text;
  int count = 1;
  bool operator==(const Warning&) const = default;
};

/// Thrown out of a reader that was asked to stop.
struct ReadCancelled : std::exception {
  const char* what() const noexcept override { return "reading was given up"; }
};

/// A reader's line to who waits for it: warnings one way, the wish to stop the other. Collects warnings;
/// those that say the same of the same file become one, counted.
class WarningList {
public:
  explicit WarningList(std::stop_token stop = {}) : stop_(std::move(stop)) {}
  /// To be called wherever a reader may be for long; throws ReadCancelled.
  void check_stop() const {
    if (stop_.stop_requested()) throw ReadCancelled();
  }
  void add(const Location& where, std::string_view text);
  const std::vector<Warning>& warnings() const { return warnings_; }

private:
  std::stop_token stop_;
  std::vector<Warning> warnings_;
  std::map<std::string, std::size_t> index_; ///< by file and text
};

} // namespace candela
