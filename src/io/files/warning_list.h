#pragma once
// Warnings of readers, and their progress.

#include "core/error.h"
#include "core/progress.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// `text` has the location ("models/x.obj:12: …") of the first of `count` occurrences.
struct Warning {
  std::string text;
  int count = 1;
  bool operator==(const Warning&) const = default;
};

/// Connects a reader with its caller: collects warnings, reports progress and checks for cancellation. Equal
/// warnings about one file are merged and counted. The unit of progress is a byte of a file.
class WarningList {
public:
  explicit WarningList(std::shared_ptr<Progress> progress = std::make_shared<Progress>())
      : progress_(std::move(progress)) {}
  /// Called regularly during long work; throws Cancelled.
  void check_stop() const { progress_->check(); }
  const Progress& progress() const { return *progress_; }
  /// Announces a file that will be read, so that the progress includes it.
  void expect_file(const std::string& canonical);
  /// The progress of one file.
  ProgressPart part(const std::string& canonical, std::size_t bytes);
  void add(const Location& where, std::string_view text);
  /// Adds the warnings of another list.
  void add(const WarningList& other);
  const std::vector<Warning>& warnings() const { return warnings_; }

private:
  void add(std::string key, const Warning& warning);

  std::shared_ptr<Progress> progress_;
  std::map<std::string, std::uint64_t> expected_; ///< bytes of files that have not been read yet, by path
  std::vector<Warning> warnings_;
  std::map<std::string, std::size_t> index_; ///< by file and text
};

} // namespace candela
