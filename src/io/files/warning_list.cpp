#include "io/files/warning_list.h"

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
  add(fmt::format("{}\n{}", where.file, text), {fmt::format("{}: {}", to_string(where), text), 1});
}

void WarningList::add(const WarningList& other) {
  std::vector<const std::string*> keys(other.warnings_.size());
  for (const auto& [key, index] : other.index_) keys[index] = &key;
  for (std::size_t i = 0; i < keys.size(); ++i)
    add(keys[i] ? *keys[i] : other.warnings_[i].text, other.warnings_[i]);
}

void WarningList::add(std::string key, const Warning& warning) {
  // A malicious file could cause a different warning in every line: beyond this limit, the rest is merged.
  constexpr std::size_t kMaxDistinct = 200;
  if (auto known = index_.find(key); known != index_.end()) {
    warnings_[known->second].count += warning.count;
  } else if (warnings_.size() < kMaxDistinct) {
    index_.emplace(std::move(key), warnings_.size());
    warnings_.push_back(warning);
  } else if (warnings_.size() == kMaxDistinct) {
    warnings_.push_back({"further warnings", warning.count});
  } else {
    warnings_.back().count += warning.count;
  }
}

} // namespace candela
