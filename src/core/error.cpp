#include "core/error.h"

#include <fmt/format.h>

namespace candela {

std::string to_string(const Location& where) {
  if (where.line <= 0) return where.file;
  if (where.column <= 0) return fmt::format("{}:{}", where.file, where.line);
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

namespace {
Error located(ExitCode code, const Location& where, std::string_view element, std::string_view cause,
              std::string_view remedy) {
  return {code, fmt::format("{}: {}: {}: {}", to_string(where), element, cause, remedy)};
}
} // namespace

Error input_error(const Location& where, std::string_view element, std::string_view cause,
                  std::string_view remedy) {
  return located(ExitCode::bad_input, where, element, cause, remedy);
}

Error limit_error(const Location& where, std::string_view element, std::string_view cause,
                  std::string_view remedy) {
  return located(ExitCode::limit, where, element, cause, remedy);
}

Error usage_error(std::string_view element, std::string_view cause, std::string_view remedy) {
  return {ExitCode::usage, fmt::format("{}: {}: {}", element, cause, remedy)};
}

Error output_error(const std::string& file, std::string_view cause, std::string_view remedy) {
  return located(ExitCode::output, Location{file, 0, 0}, "output", cause, remedy);
}

} // namespace candela
