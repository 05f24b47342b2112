#pragma once
// The outputs of a command: checked before its work; one that fails does not prevent the others.

#include "core/error.h"

#include <functional>
#include <string>
#include <vector>

namespace candela {

struct PlannedOutput {
  std::string option; ///< "--stats": what asks for it
  std::string path;
};

/// Called before the work by every command that writes. Throws output_error for a path that cannot be written
/// (missing folder, folder of that name, no permission); a usage error if two outputs are the same file, or
/// if an output would overwrite one of `inputs`.
void check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs = {});

/// Writes outputs; one that fails does not prevent the others. Errors are printed at once, and the first is
/// kept.
class OutputWriter {
public:
  /// Runs `write`; prints an Error or a lack of memory on stderr.
  void attempt(const std::string& path, const std::function<void()>& write);
  /// The code of the first failure; done if there was none.
  ExitCode code() const { return code_; }

private:
  ExitCode code_ = ExitCode::done;
};

} // namespace candela
