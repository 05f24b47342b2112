#pragma once
// What a command writes: looked at before its work, and none of it lost because of another.

#include "core/error.h"

#include <functional>
#include <string>
#include <vector>

namespace candela {

struct PlannedOutput {
  std::string option; ///< "--stats": what asks for it
  std::string path;
};

/// Before the work: an output_error for a path that cannot be written to (a missing folder, a folder in its
/// place, no permission), a usage error where two outputs would be one file, or an output is one of `inputs`,
/// which would be lost. Every command that writes asks this.
void check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs = {});

/// Writes outputs of which one that fails must not cost the others: what went wrong is said at once, and
/// kept.
class OutputWriter {
public:
  /// Runs `write`; the Error or the lack of memory that it ends with is said on stderr.
  void attempt(const std::string& path, const std::function<void()>& write);
  /// Of the first that failed; done where none did.
  ExitCode code() const { return code_; }

private:
  ExitCode code_ = ExitCode::done;
};

} // namespace candela
