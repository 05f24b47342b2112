#include "io/warning_list.h"

#include <fmt/format.h>

namespace candela {

void WarningList::add(const Location& where, std::string_view text) {
  // A hostile file could say something different in every line: beyond this many, all the rest is one.
  constexpr std::size_t kMaxDistinct = 200;
  std::string key = fmt::format("{}\n{}", where.file, text);
  std::string shown = fmt::format("{}: {}", to_string(where), text);
  if (auto known = index_.find(key); known != index_.end()) {
    ++warnings_[known->second].count;
  } else if (warnings_.size() < kMaxDistinct) {
    index_.emplace(std::move(key), warnings_.size());
    warnings_.push_back({std::move(shown), 1});
  } else if (warnings_.size() == kMaxDistinct) {
    warnings_.push_back({"further warnings", 1});
  } else {
    ++warnings_.back().count;
  }
}

} // namespace candela
