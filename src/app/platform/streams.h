#pragma once
// The standard streams: results go to stdout and must not be lost, messages go to stderr.

#include <fmt/format.h>

#include <string_view>

namespace candela {

/// Called first in main(). A closed standard stream gets a descriptor that cannot be read or written;
/// otherwise the next opened file would become that stream. SIGPIPE and SIGXFSZ no longer end the program, so
/// that a render survives the reader of its progress.
void prepare_streams();

/// An output_error if stdout cannot be written to, as far as that can be known in advance.
void check_stdout();

/// Writes results to stdout; output_error on failure. If the reader of a pipe is gone, the program ends by
/// SIGPIPE like other programs, unless the parent process ignores that signal.
void print_result(std::string_view text);

/// Writes to stderr; a closed or broken stream is ignored.
void say_text(std::string_view text);
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  say_text(fmt::format(format, std::forward<T>(values)...));
}

} // namespace candela
