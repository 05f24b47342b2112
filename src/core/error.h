#pragma once
// The one exception type. Its text is for the user:
// `file:line:col: element: cause: remedy`.

#include <stdexcept>
#include <string>
#include <string_view>

namespace candela {

/// Exit codes of the program.
enum class ExitCode : int {
  done = 0,
  usage = 2,
  bad_input = 3,
  limit = 4, ///< a cap or memory
  output = 5,
  display = 6,
  interrupted = 130,
  terminated = 143,
};

/// Where in a file; lines and columns count from 1, 0 means unknown (binary files, whole-file errors).
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:col" without the unknown parts.
std::string to_string(const Location& where);

class Error : public std::runtime_error {
public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

private:
  ExitCode code_;
};

/// The error of a reader. `element` names the thing ("materials[2].roughness"), `cause` what is wrong with
/// it, `remedy` what to do about it.
Error input_error(const Location& where, std::string_view element, std::string_view cause,
                  std::string_view remedy);
/// The same for a cap that a file exceeds (exit code 4).
Error limit_error(const Location& where, std::string_view element, std::string_view cause,
                  std::string_view remedy);
Error usage_error(std::string_view element, std::string_view cause, std::string_view remedy);
Error output_error(const std::string& file, std::string_view cause, std::string_view remedy);

} // namespace candela
