#include "io/warning_list.h"

#include <fmt/format.h>

#include <filesystem>

namespace candela {

void WarningList::expect_file(const std::string& canonical) {
  std::error_code failed;
  const auto bytes = std::filesystem::file_size(canonical, failed);
  if (!failed && expected_.try_emplace(canonical, bytes).second) progress_->expect(bytes);
}

ProgressPart WarningList::part(const std::string& canonical, std::size_t bytes) {
  progress_->check();
  std::uint64_t work = bytes;
  if (auto known = expected_.find(canonical); known != expected_.end()) {
    work = known->second;
    expected_.erase(known);
  } else {
    progress_->expect(work);
  }
  return {*progress_, work};
}

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
