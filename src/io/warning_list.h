#pragma once
// What a reader has to say without refusing the file.

#include "core/error.h"

#include <map>
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

/// Collects warnings; those that say the same of the same file become one, counted.
class WarningList {
public:
  void add(const Location& where, std::string_view text);
  const std::vector<Warning>& warnings() const { return warnings_; }

private:
  std::vector<Warning> warnings_;
  std::map<std::string, std::size_t> index_; ///< by file and text
};

} // namespace candela
