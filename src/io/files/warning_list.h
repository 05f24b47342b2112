#pragma once
// What a reader has to say without refusing the file.

#include "core/error.h"
#include "core/progress.h"

#include <map>
#include <memory>
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

/// A reader's line to who waits for it: warnings and progress one way, the wish to stop the other. Collects
/// warnings; those that say the same of the same file become one, counted. The unit of progress is a byte of
/// a file.
class WarningList {
public:
  explicit WarningList(std::shared_ptr<Progress> progress = std::make_shared<Progress>())
      : progress_(std::move(progress)) {}
  /// To be called wherever a reader may be for long; throws Cancelled.
  void check_stop() const { progress_->check(); }
  const Progress& progress() const { return *progress_; }
  /// Counts a file that will be read, so that the share is of all that is known to come.
  void expect_file(const std::string& canonical);
  /// The part of the progress that is one file.
  ProgressPart part(const std::string& canonical, std::size_t bytes);
  void add(const Location& where, std::string_view text);
  /// Those of another list.
  void add(const WarningList& other);
  const std::vector<Warning>& warnings() const { return warnings_; }

private:
  void add(std::string key, const Warning& warning);

  std::shared_ptr<Progress> progress_;
  std::map<std::string, std::uint64_t> expected_; ///< bytes of files that were not read yet, by path
  std::vector<Warning> warnings_;
  std::map<std::string, std::size_t> index_; ///< by file and text
};

} // namespace candela
